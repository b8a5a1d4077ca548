// The recommendation: a rule, its sentence, and its conditions.
#include "study/recommend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "base/text.h"
#include "study/analyse.h"

namespace pellucid {
namespace {

/// Methods from the simplest on; then the precisions; then radii that are not the default.
int simplicity(const StudyOption& option) {
  static const std::vector<std::string> methods{"naive", "nee",  "path", "light",
                                                "bdpt",  "sppm", "bpm",  "vcm"};
  static const std::vector<std::string> precisions{"strict", "mad", "fast", "compact"};
  const auto place = [](const std::vector<std::string>& list, const std::string& name) {
    return int(std::find(list.begin(), list.end(), name) - list.begin());
  };
  return 2 * (place(methods, option.integrator) * int(precisions.size() + 1) +
              place(precisions, option.precision)) +
         (option.radius_factor == 1 ? 0 : 1);
}

bool timed(const Verdict& v) {
  return v.kind == TargetKind::measured || v.kind == TargetKind::interpolated ||
         v.kind == TargetKind::extrapolated;
}

class Chooser {
 public:
  explicit Chooser(Study& study) : s_(study) {}
  void choose();

 private:
  std::vector<int> candidates() const;
  bool differ(int a, int b) const;
  bool idle(int i, const std::vector<int>& all) const;
  std::size_t runs_of(const StudyOption& option) const;
  double error_of(int i) const;
  std::pair<double, double> time_ratio(const StudyOption& option) const;
  std::string time_text(int i) const;
  void explain_nothing();
  void tell_conditions();

  Study& s_;
};

std::vector<int> Chooser::candidates() const {
  std::vector<int> out;
  for (int i = 0; i < int(s_.options.size()); ++i)
    if (eligible(s_.options[std::size_t(i)], s_.verdicts[std::size_t(i)])) out.push_back(i);
  return out;
}

/// Those that its interval is of: a relaxed option has its strict sibling's.
std::size_t Chooser::runs_of(const StudyOption& option) const {
  constexpr std::size_t least = 2;
  if (option.precision != "strict")
    for (const StudyOption& o : s_.options)
      if (o.integrator == option.integrator && o.plain()) return std::max(o.runs.size(), least);
  return std::max(option.runs.size(), least);
}

/// Standard error of log seconds.
double Chooser::error_of(int i) const {
  const Verdict& v = s_.verdicts[std::size_t(i)];
  const double dof = double(runs_of(s_.options[std::size_t(i)]) - 1);
  return std::log(v.high / v.low) / (2 * student_quantile(0.5 + 0.5 * STUDY_CONFIDENCE, dof));
}

/// Seconds over those of the strict sibling: least and largest of the pairs.
std::pair<double, double> Chooser::time_ratio(const StudyOption& option) const {
  for (const PrecisionPair& p : s_.pairs)
    if (p.integrator == option.integrator && p.precision == option.precision)
      return {p.time_low, p.time_high};
  return {1, 1};
}

/// Whether their times do, at the study's confidence. Of a method in two precisions, only what the
/// pairs say counts: noise is theirs in common. A gain of less than `worth` there is none: nobody
/// gives up exact rounding for it, and with several precisions one looks so by chance.
bool Chooser::differ(int a, int b) const {
  const StudyOption &x = s_.options[std::size_t(a)], &y = s_.options[std::size_t(b)];
  if (x.integrator == y.integrator && x.radius_factor == y.radius_factor) {
    const auto [x_low, x_high] = time_ratio(x);
    const auto [y_low, y_high] = time_ratio(y);
    constexpr double worth = 0.02;
    return x_high < (1 - worth) * y_low || y_high < (1 - worth) * x_low;
  }
  const double u = s_.verdicts[std::size_t(a)].seconds, v = s_.verdicts[std::size_t(b)].seconds;
  const double dof = double(runs_of(x) + runs_of(y) - 2);
  return std::abs(std::log(u / v)) >
         student_quantile(0.5 + 0.5 * STUDY_CONFIDENCE, dof) * std::hypot(error_of(a), error_of(b));
}

/// Whether it is a relaxed precision that is no better than the strict one, though it may not
/// differ from a quicker one.
bool Chooser::idle(int i, const std::vector<int>& all) const {
  const StudyOption& option = s_.options[std::size_t(i)];
  return option.precision != "strict" && std::any_of(all.begin(), all.end(), [&](int j) {
           const StudyOption& other = s_.options[std::size_t(j)];
           return other.integrator == option.integrator && other.plain() && !differ(i, j);
         });
}

std::string Chooser::time_text(int i) const {
  const Verdict& v = s_.verdicts[std::size_t(i)];
  const std::string kind = v.kind == TargetKind::extrapolated
                               ? fmt::format("extrapolated x{:.2g}", v.beyond_factor)
                           : v.kind == TargetKind::measured ? "measured"
                                                            : "interpolated";
  return fmt::format("{} [{}, {}], {}", format_seconds(v.seconds), format_seconds(v.low),
                     format_seconds(v.high), kind);
}

void Chooser::explain_nothing() {
  s_.recommendation = fmt::format(
      "Inconclusive: no option is known to reach {:.3g} % without a flag. ", 100 * s_.target);
  const bool short_of_time =
      std::any_of(s_.options.begin(), s_.options.end(), [](const StudyOption& o) {
        return o.state == OptionState::too_slow ||
               (o.state == OptionState::main && o.runs.size() < 3);
      });
  if (!s_.reference.trusted)
    s_.recommendation += "The reference is in doubt: " + s_.reference.doubt + ".";
  else if (short_of_time || s_.options.empty())
    s_.recommendation += "The budget is too small: raise --budget, or lower --size.";
  else
    s_.recommendation += "See the flags; raise --budget or --target.";
}

void Chooser::tell_conditions() {
  const StudyOption& best = s_.options[std::size_t(s_.recommended)];
  const Verdict& v = s_.verdicts[std::size_t(s_.recommended)];
  if (v.kind == TargetKind::extrapolated && v.beyond_factor > 1)
    s_.would_change.push_back(
        fmt::format("Its time is extrapolated x{:.2g}: a budget of about {} would measure it.",
                    v.beyond_factor, format_seconds(s_.budget_seconds * v.beyond_factor)));
  std::vector<std::string> too_slow, left;
  for (const StudyOption& other : s_.options) {
    if (other.state == OptionState::pilot)
      left.push_back(fmt::format("{} ({})", other.name(), other.reason));
    if (other.state == OptionState::too_slow) too_slow.push_back(other.name());
  }
  if (!left.empty())
    s_.would_change.push_back(
        fmt::format("Left after the pilot: {}; only a pilot that misjudged them would change that.",
                    join(left)));
  if (!too_slow.empty())
    s_.would_change.push_back(fmt::format(
        "A larger budget may bring in what had too few rungs for a curve: {}.", join(too_slow)));
  if (best.merges)
    s_.would_change.push_back(
        "Merging is biased by its radius: a smaller target, or another radius, may change the "
        "ranks.");
  if (!s_.pairs.empty())
    s_.would_change.push_back("Precisions were compared on this device and driver alone.");
  s_.would_change.push_back(fmt::format(
      "Times are for {}x{} pixels on {}: another size changes the radius of merging and what a "
      "light path is worth to a pixel.",
      s_.width, s_.height, s_.machine.device));
}

void Chooser::choose() {
  s_.recommended = -1, s_.equals.clear(), s_.would_change.clear();
  const std::vector<int> all = candidates();
  if (all.empty() || !s_.reference.trusted) return explain_nothing();
  const int quickest = *std::min_element(all.begin(), all.end(), [&](int a, int b) {
    return s_.verdicts[std::size_t(a)].high < s_.verdicts[std::size_t(b)].high;
  });
  std::vector<int> alike;
  for (int i : all)
    if (i == quickest || !differ(i, quickest)) alike.push_back(i);
  s_.recommended = *std::min_element(alike.begin(), alike.end(), [&](int a, int b) {
    return std::pair(idle(a, all), simplicity(s_.options[std::size_t(a)])) <
           std::pair(idle(b, all), simplicity(s_.options[std::size_t(b)]));
  });
  std::vector<std::string> names;
  for (int i : alike)
    if (i != s_.recommended) {
      s_.equals.push_back(i);
      names.push_back(s_.options[std::size_t(i)].name());
    }
  const std::string name = s_.options[std::size_t(s_.recommended)].name();
  s_.recommendation =
      fmt::format("{} reaches {:.3g} % in {}.", name, 100 * s_.target, time_text(s_.recommended));
  if (!names.empty())
    s_.recommendation +=
        fmt::format(" No significant difference to {}: it is the simplest of them.", join(names));
  tell_conditions();
}

}  // namespace

bool eligible(const StudyOption& option, const Verdict& verdict) {
  return option.state == OptionState::main && timed(verdict) && verdict.flags.empty();
}

void recommend(Study& study) {
  Chooser(study).choose();
}

}  // namespace pellucid
