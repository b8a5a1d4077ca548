// Doubts: numbers, energy, spread, the reference, the machine.
#include "study/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/statistics.h"
#include "study/analyse.h"

namespace pellucid {
namespace {

/// Two-sided, for flags: several options are tested in every study.
constexpr double flag_confidence = 0.999;

struct Spread {
  double mean = 0, deviation = 0;
};

template <typename F>
Spread spread_of(const std::vector<StudyRun>& runs, F&& value) {
  Spread s;
  const double n = double(runs.size());
  for (const StudyRun& run : runs) s.mean += value(run) / n;
  for (const StudyRun& run : runs) s.deviation += std::pow(value(run) - s.mean, 2) / (n - 1);
  s.deviation = std::sqrt(s.deviation);
  return s;
}

/// Seconds for a sample per pixel in each run, over their median.
std::vector<double> rates(const StudyOption& option) {
  std::vector<double> out;
  for (const StudyRun& run : option.runs)
    if (!run.rungs.empty()) out.push_back(run.rungs.back().seconds / double(run.rungs.back().spp));
  if (out.empty()) return out;
  const double middle = median_of(out);
  for (double& rate : out) rate /= middle;
  return out;
}

}  // namespace

void check_numbers(const StudyOption& option) {
  if (option.state == OptionState::refused) return;
  for (const StudyRun& run : option.runs)
    for (const Rung& r : run.rungs)
      if (!std::isfinite(r.relmse) || !std::isfinite(r.energy_ratio) || !(r.seconds > 0))
        throw InputError(fmt::format("{}: the run with seed {} holds what is no number at {} spp",
                                     option.name(), run.seed, r.spp));
}

void check_reference_numbers(const Study& s) {
  if (!std::isfinite(s.reference.relmse) || !std::isfinite(s.reference.energy_error))
    throw InputError(
        fmt::format("the reference ({}) holds pixels that are no numbers", s.reference.source));
}

void check_energy(const Study& study, const StudyOption& option, Verdict& v) {
  const Spread s =
      spread_of(option.runs, [](const StudyRun& run) { return run.rungs.back().energy_ratio; });
  const double n = double(option.runs.size());
  const double own = s.deviation / std::sqrt(n), reference = study.reference.energy_error;
  const double error = std::sqrt(own * own + reference * reference);
  const double half = student_quantile(0.5 + 0.5 * STUDY_CONFIDENCE, n - 1) * error;
  v.energy = s.mean, v.energy_low = s.mean - half, v.energy_high = s.mean + half;
  const double limit = student_quantile(0.5 + 0.5 * flag_confidence, n - 1) * error;
  if (!option.merges && option.state != OptionState::blind && std::abs(s.mean - 1) > limit)
    v.flags.push_back(
        fmt::format("its pictures have {:.4f} of the reference's light [{:.4f}, {:.4f}]", v.energy,
                    v.energy_low, v.energy_high));
}

void check_spread(const StudyOption& option, Verdict& v) {
  constexpr double most = 0.5;
  const Spread s =
      spread_of(option.runs, [](const StudyRun& run) { return run.rungs.back().relmse; });
  if (s.mean > 0 && s.deviation > most * s.mean)
    v.flags.push_back(
        fmt::format("rare bright paths rule its error: runs of the same length differ by {:.0f} %",
                    100 * s.deviation / s.mean));
}

void check_reference(Study& s) {
  int judged = 0, brighter = 0, darker = 0;
  for (std::size_t i = 0; i < s.options.size(); ++i) {
    const StudyOption& option = s.options[i];
    if (option.merges || option.state != OptionState::main || option.runs.size() < 3) continue;
    const Verdict& v = s.verdicts[i];
    ++judged;
    brighter += v.energy_low > 1, darker += v.energy_high < 1;
  }
  // One alone may itself be the one that is wrong.
  if (judged < 2 || (brighter < judged && darker < judged)) return;
  bool flagged = false;  // by the stricter test
  for (const Verdict& v : s.verdicts)
    for (const std::string& flag : v.flags) flagged |= flag.rfind("its pictures have", 0) == 0;
  if (!flagged) return;
  s.reference.trusted = false;
  if (!s.reference.doubt.empty()) s.reference.doubt += "; ";
  s.reference.doubt += fmt::format(
      "every unbiased method is {} than the reference: the reference is wrong, or made for another "
      "scene or exposure",
      brighter ? "brighter" : "darker");
}

void check_machine(Study& s) {
  constexpr double most_change = 0.1;
  if (s.machine.foreign_load > DISTURBING_LOAD)
    s.warnings.push_back(fmt::format("disturbed: other programs took {:.0f} % of the machine",
                                     100 * s.machine.foreign_load));
  std::vector<double> first, last, all;
  for (const StudyOption& option : s.options) {
    const std::vector<double> r = rates(option);
    if (r.size() < 3) continue;
    const std::size_t third = r.size() / 3;
    all.insert(all.end(), r.begin(), r.end());
    first.insert(first.end(), r.begin(), r.begin() + std::ptrdiff_t(third));
    last.insert(last.end(), r.end() - std::ptrdiff_t(third), r.end());
  }
  if (all.empty()) return;
  const double drift = median_of(last) / median_of(first) - 1;
  std::sort(all.begin(), all.end());
  const double spread = all[all.size() * 3 / 4] - all[all.size() / 4];
  if (std::abs(drift) > most_change)
    s.warnings.push_back(
        fmt::format("disturbed: the same work took {:.0f} % {} at the end than at the start",
                    100 * std::abs(drift), drift > 0 ? "longer" : "less"));
  else if (spread > most_change)
    s.warnings.push_back(fmt::format(
        "disturbed: repeats of the same work differ by {:.0f} % in time", 100 * spread));
}

}  // namespace pellucid
