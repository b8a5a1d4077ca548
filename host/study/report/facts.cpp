// The facts of a study that its reports share.
#include "study/report/facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/statistics.h"
#include "base/text.h"
#include "study/fit.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

/// Of one rung: mean over runs and the t interval, by the delta method on the log of the mean,
/// which also serves where the noise taken off leaves single runs below 0.
ErrorPoint error_point(std::uint64_t spp, const std::vector<const Rung*>& rungs) {
  ErrorPoint point;
  point.spp = spp;
  point.runs = int(rungs.size());
  const double n = double(rungs.size());
  double mean = 0, spread = 0;
  for (const Rung* r : rungs) point.seconds += r->seconds / n, mean += r->relmse / n;
  for (const Rung* r : rungs) spread += (r->relmse - mean) * (r->relmse - mean);
  if (mean > 0) point.error = std::sqrt(mean);
  if (rungs.size() < 2) return point;
  const double half = student_quantile(0.95, n - 1) * std::sqrt(spread / (n - 1) / n);
  if (mean > 0) {
    point.low = std::sqrt(mean * std::exp(-half / mean));
    point.high = std::sqrt(mean * std::exp(half / mean));
    if (!std::isfinite(*point.high)) point.high.reset();
  } else if (mean + half > 0) {
    point.high = std::sqrt(mean + half);
  }
  return point;
}

/// One of those that the recommended option does not beat.
bool is_equal(const Study& study, std::size_t i) {
  return std::count(study.equals.begin(), study.equals.end(), int(i)) > 0;
}

std::string never_text(const Study& study, std::size_t i) {
  const StudyOption& option = study.options[i];
  if (!option.unreachable.empty()) return "never (cannot see all paths)";
  const std::optional<double> floor = error_floor(study, i);
  if (floor && *floor > 0.5 * study.target) return fmt::format("never (floor {})", percent(*floor));
  return option.reason.empty() ? "never" : fmt::format("never ({})", option.reason);
}

}  // namespace

std::vector<ErrorPoint> error_curve(const StudyOption& option) {
  std::map<std::uint64_t, std::vector<const Rung*>> by_spp;
  for (const StudyRun& run : option.runs)
    for (const Rung& rung : run.rungs)
      if (std::isfinite(rung.relmse) && std::isfinite(rung.seconds))
        by_spp[rung.spp].push_back(&rung);
  std::vector<ErrorPoint> curve;
  for (const auto& [spp, rungs] : by_spp) curve.push_back(error_point(spp, rungs));
  return curve;
}

double longest_run(const StudyOption& option) {
  double longest = 0;
  for (const StudyRun& run : option.runs)
    for (const Rung& rung : run.rungs)
      if (std::isfinite(rung.seconds)) longest = std::max(longest, rung.seconds);
  return longest;
}

Verdict verdict_of(const Study& study, std::size_t option) {
  return option < study.verdicts.size() ? study.verdicts[option] : Verdict{};
}

std::optional<double> fitted_error(const StudyOption& option, const Verdict& verdict,
                                   double seconds) {
  const double relmse = verdict.noise * std::pow(seconds, -verdict.exponent) +
                        verdict.bias * std::pow(seconds, -(2 - 2 * option.radius_alpha));
  if (!(verdict.noise > 0) || !(relmse > 0) || !std::isfinite(relmse)) return std::nullopt;
  return std::sqrt(relmse);
}

const PrecisionPair* pair_of(const Study& study, const StudyOption& option) {
  for (const PrecisionPair& pair : study.pairs)
    if (pair.integrator == option.integrator && pair.precision == option.precision) return &pair;
  return nullptr;
}

std::optional<double> error_floor(const Study& study, std::size_t i) {
  const StudyOption& option = study.options[i];
  double bias2 = 0;
  // Where it forbids the target: one of many unbiased options seems to have one by chance, and what
  // methods that merge are off by shrinks with their radius.
  const bool never = verdict_of(study, i).kind == TargetKind::never;
  if (never && !option.merges && !option.splits.empty())
    bias2 = certain_bias(option.splits.back().bias2, option.splits.back().bias2_upper90,
                         int(option.runs.size()));
  if (const PrecisionPair* pair = pair_of(study, option))
    bias2 = std::max(bias2, certain_bias(pair->bias2, pair->bias2_upper90, pair->runs));
  return bias2 > 0 ? std::optional(std::sqrt(bias2)) : std::nullopt;
}

std::string pair_bias_text(const PrecisionPair& pair) {
  const double bias2 = certain_bias(pair.bias2, pair.bias2_upper90, pair.runs);
  return bias2 > 0 ? percent(std::sqrt(bias2)) : "none seen";
}

std::optional<FloorTime> floor_time(const Study& study, const PrecisionPair& pair) {
  const double sure = certain_bias(pair.bias2, pair.bias2_upper90, pair.runs);
  const double bias2 = sure > 0 ? sure : pair.bias2_upper90;
  for (std::size_t i = 0; i < study.options.size(); ++i) {
    const Verdict v = verdict_of(study, i);
    if (study.options[i].name() == pair.integrator + " strict" && v.exponent == 1 && v.noise > 0 &&
        bias2 > 0)
      return FloorTime{v.noise / bias2, !(sure > 0)};
  }
  return std::nullopt;
}

std::vector<std::size_t> ranked(const Study& study) {
  const auto rank = [&](std::size_t i) {
    const Verdict v = verdict_of(study, i);
    const int group = int(i) == study.recommended     ? 0
                      : is_equal(study, i)            ? 1
                      : v.kind == TargetKind::never   ? 5
                      : v.kind == TargetKind::unknown ? 4
                      : v.kind == TargetKind::beyond  ? 3
                                                      : 2;
    return std::tuple(group, group < 4 ? v.seconds : 0.0, i);
  };
  std::vector<std::size_t> order(study.options.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

std::string target_text(const Study& study, std::size_t i) {
  const Verdict v = verdict_of(study, i);
  const std::string time = duration_interval(v.seconds, v.low, v.high);
  switch (v.kind) {
    case TargetKind::measured:
      return time + " measured";
    case TargetKind::interpolated:
      return time + " interpolated";
    case TargetKind::extrapolated:
      return fmt::format("{} extrapolated x{}", time, digits(v.beyond_factor));
    case TargetKind::beyond:
      return fmt::format(">= {} (x{} the longest run)", duration(v.seconds),
                         digits(v.beyond_factor));
    case TargetKind::never:
      return never_text(study, i);
    case TargetKind::unknown:
      break;
  }
  return "unknown";
}

std::string slope_text(const Verdict& v) {
  const bool any = v.slope != 0 || v.slope_low != 0 || v.slope_high != 0;
  if (!any || !std::isfinite(v.slope)) return "-";
  if (!std::isfinite(v.slope_low) || !std::isfinite(v.slope_high))
    return fmt::format("{:.2f}", v.slope);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", v.slope, v.slope_low, v.slope_high);
}

std::string tiles_text(const StudyOption& option) {
  return option.tiles.empty() ? "-" : fmt::format("{:.0f} %", 100 * option.tiles_within);
}

std::string bias_text(const StudyOption& option) {
  if (option.splits.empty() || !(option.splits.back().bias2_upper90 > 0)) return "-";
  return percent(std::sqrt(option.splits.back().bias2_upper90));
}

std::vector<std::string> flags_of(const Study& study, std::size_t i) {
  const StudyOption& option = study.options[i];
  std::vector<std::string> flags = verdict_of(study, i).flags;
  const std::string state = state_text(option.state);
  const auto told = [&](const std::string& words) {
    return std::any_of(flags.begin(), flags.end(), [&](const std::string& flag) {
      return flag.find(words) != std::string::npos;
    });
  };
  if (!option.reason.empty() && !told(option.reason))
    flags.push_back(state.empty() ? option.reason : fmt::format("{}: {}", state, option.reason));
  else if (option.reason.empty() && option.state == OptionState::blind &&
           !option.unreachable.empty() && !told(option.unreachable.front()))
    flags.push_back("cannot see " + join(option.unreachable));
  else if (option.reason.empty() && !state.empty() && flags.empty())
    flags.push_back(state);
  return flags;
}

std::string rank_text(const Study& study, std::size_t i) {
  if (study.recommended < 0) return "";
  if (int(i) == study.recommended) return "recommended";
  return is_equal(study, i)
             ? "no different from " + study.options[std::size_t(study.recommended)].name()
             : "";
}

const char* state_text(OptionState state) {
  switch (state) {
    case OptionState::main:
      break;
    case OptionState::too_slow:
      return "too slow";
    case OptionState::pilot:
      return "pilot only";
    case OptionState::blind:
      return "blind";
    case OptionState::refused:
      return "refused";
  }
  return "";
}

std::vector<std::string> reference_lines(const StudyReference& r) {
  std::vector<std::string> lines;
  std::string first = r.source.empty() ? "none" : r.source;
  if (r.relmse > 0) first += fmt::format("; its own noise is {}", percent(std::sqrt(r.relmse)));
  if (r.energy_error > 0)
    first += fmt::format(", its energy known to {} (one standard error)", percent(r.energy_error));
  lines.push_back(first);
  if (r.disagreement != 0)
    lines.push_back(fmt::format("Its two methods differ by {} standard errors in energy.",
                                digits(r.disagreement)));
  if (!r.trusted)
    lines.push_back(fmt::format("Not trusted{}", r.doubt.empty() ? "." : ": " + r.doubt));
  else if (!r.doubt.empty())
    lines.push_back(r.doubt);
  return lines;
}

std::string machine_line(const StudyMachine& m) {
  std::vector<std::string> parts;
  for (const std::string& part : {m.device, m.driver, m.version})
    if (!part.empty()) parts.push_back(part);
  if (m.threads > 0)
    parts.push_back(fmt::format("{} thread{}", m.threads, m.threads > 1 ? "s" : ""));
  if (m.clock == "cpu")
    parts.push_back("seconds are CPU seconds over the cores");
  else if (!m.clock.empty())
    parts.push_back(fmt::format("seconds of the {} clock", m.clock));
  parts.push_back(fmt::format("other processes took {} of the machine", percent(m.foreign_load)));
  return join(parts, "; ");
}

std::string settings_line(const Study& s) {
  // Those of a render begin with the size.
  std::string line =
      s.settings.empty() ? fmt::format("{} x {} pixels", s.width, s.height) : s.settings;
  line += fmt::format("; target {}, budget {}, taken {}, seed {}", percent(s.target, 1),
                      duration(s.budget_seconds), duration(s.seconds), s.seed);
  if (!s.scene_hash.empty()) line += ", scene " + s.scene_hash;
  return line;
}

}  // namespace pellucid
