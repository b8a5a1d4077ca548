// Verdicts: each option by itself, then beside the others.
#include "study/analyse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/statistics.h"
#include "base/text.h"
#include "study/checks.h"
#include "study/fit.h"
#include "study/recommend.h"

namespace pellucid {
namespace {

/// A fit that is off by more is not believed beyond its rungs.
constexpr double most_residual = 0.15;

double t_of(std::size_t runs) {
  return student_quantile(0.5 + 0.5 * STUDY_CONFIDENCE, double(runs - 1));
}

/// Seconds to the target: between two rungs along the straight line of their logarithms, else by
/// the fit. None where the curve never comes there.
std::optional<double> crossing(const std::vector<CurvePoint>& curve, const CurveFit& fit,
                               double relmse) {
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const CurvePoint &a = curve[i], &b = curve[i + 1];
    if (!(a.relmse > relmse && b.relmse <= relmse && b.relmse > 0)) continue;
    const double share = std::log(a.relmse / relmse) / std::log(a.relmse / b.relmse);
    return a.seconds * std::pow(b.seconds / a.seconds, share);
  }
  return fit.reaches(relmse);
}

/// Of one option with its runs.
class Judge {
 public:
  Judge(const Study& study, const StudyOption& option)
      : study_(study), option_(option), curve_(mean_curve(option.runs)) {}
  Verdict verdict();

 private:
  CurveFit fit(const std::vector<CurvePoint>& curve) const {
    return fit_curve(curve, option_.merges, option_.radius_alpha);
  }
  int runs() const { return int(option_.runs.size()); }
  void measure_slope();
  bool starts_below(double relmse);
  void measure_time();
  void label();
  bool floors() const;

  const Study& study_;
  const StudyOption& option_;
  std::vector<CurvePoint> curve_;
  Verdict v_;
};

void Judge::measure_slope() {
  v_.slope_from = -1.1;
  v_.slope_to =
      option_.merges ? -0.9 * std::min(option_.radius_alpha, 2 - 2 * option_.radius_alpha) : -0.9;
  const auto slope =
      jackknife(runs(), [&](int leave) { return curve_slope(mean_curve(option_.runs, leave)); });
  if (!slope) return;
  const double half = t_of(option_.runs.size()) * slope->error;
  v_.slope = slope->value, v_.slope_low = slope->value - half, v_.slope_high = slope->value + half;
  if (v_.slope_high < v_.slope_from || v_.slope_low > v_.slope_to)
    v_.flags.push_back(
        fmt::format("error falls as t^{:.2f} [{:.2f}, {:.2f}]; t^{:.1f} to t^{:.1f} "
                    "is expected",
                    v_.slope, v_.slope_low, v_.slope_high, v_.slope_from, v_.slope_to));
}

/// A bias that no time removes and that alone is more than the target allows; only a reference that
/// is known well enough can tell.
bool Judge::floors() const {
  constexpr double well = 0.1;
  const double target2 = study_.target * study_.target;
  if (option_.merges || option_.splits.empty() || !study_.reference.variance_known ||
      study_.reference.relmse > well * target2)
    return false;
  const Split& last = option_.splits.back();
  return certain_bias(last.bias2 - target2, last.bias2_upper90 - target2, runs()) > 0;
}

/// Whether the shortest runs are surely good enough, so that nothing is known of shorter ones.
bool Judge::starts_below(double relmse) {
  const auto first = [&](auto&& value) {
    return jackknife(runs(), [&](int leave) -> std::optional<double> {
      return value(mean_curve(option_.runs, leave).front());
    });
  };
  const double wide = t_of(option_.runs.size());
  const auto error = first([](const CurvePoint& p) { return p.relmse; });
  if (error->value + wide * error->error > relmse) return false;
  const auto time = first([](const CurvePoint& p) { return std::log(p.seconds); });
  v_.kind = TargetKind::measured;
  v_.seconds = curve_.front().seconds;
  v_.low = v_.seconds * std::exp(-wide * time->error);
  v_.high = v_.seconds * std::exp(wide * time->error);
  return true;
}

void Judge::measure_time() {
  const double relmse = study_.target * study_.target;
  if (starts_below(relmse)) return;
  const auto time = jackknife(runs(), [&](int leave) -> std::optional<double> {
    const std::vector<CurvePoint> curve = mean_curve(option_.runs, leave);
    const std::optional<double> t = crossing(curve, fit(curve), relmse);
    return t ? std::optional(std::log(*t)) : std::nullopt;
  });
  if (!time) return;
  const double half = t_of(option_.runs.size()) * time->error;
  v_.seconds = std::exp(time->value);
  v_.low = std::exp(time->value - half), v_.high = std::exp(time->value + half);
  label();
}

void Judge::label() {
  const double first = curve_.front().seconds, last = curve_.back().seconds;
  v_.beyond_factor = v_.seconds / last;
  const bool between = v_.seconds >= first && v_.seconds <= last;
  v_.kind = between ? TargetKind::interpolated : TargetKind::extrapolated;
  constexpr double same_time = 0.05;
  for (const CurvePoint& p : curve_)
    if (std::abs(p.seconds / v_.seconds - 1) < same_time) v_.kind = TargetKind::measured;
  if (v_.beyond_factor > EXTRAPOLATION_MOST) {
    v_.kind = TargetKind::beyond;
    v_.beyond_factor = EXTRAPOLATION_MOST;
    v_.seconds = v_.low = EXTRAPOLATION_MOST * last;
  }
  if (v_.seconds > last && v_.fit_residual > most_residual)
    v_.flags.push_back(fmt::format(
        "its errors are off the fitted curve by {:.0f} %: it says nothing beyond {:.2g} s",
        100 * v_.fit_residual, last));
}

Verdict Judge::verdict() {
  check_numbers(option_);
  const bool enough = runs() >= 3 && curve_.size() >= LEAST_RUNGS;
  if (option_.state == OptionState::main && option_.precision == "strict" && !enough)
    v_.flags.push_back(
        fmt::format("{} runs of {} rungs are too few for a verdict", runs(), curve_.size()));
  if (enough) {
    const CurveFit all = fit(curve_);
    v_.noise = all.noise, v_.exponent = all.exponent, v_.bias = all.bias;
    v_.fit_residual = all.residual;
    // Below the reference's own noise neither slope nor spread is the method's.
    const bool told = curve_.back().relmse > study_.reference.relmse;
    if (told) measure_slope();
    check_energy(study_, option_, v_);
    if (told) check_spread(option_, v_);
    measure_time();
  }
  if (option_.wrong > 0)
    v_.flags.push_back(
        fmt::format("{} device counters or values that are no number", option_.wrong));
  if (option_.state == OptionState::blind || floors()) v_.kind = TargetKind::never;
  if (option_.state == OptionState::blind)
    v_.flags.push_back("cannot see " + join(option_.unreachable));
  else if (floors())
    v_.flags.push_back(fmt::format("a bias of {:.2g} % that no time removes",
                                   100 * std::sqrt(option_.splits.back().bias2)));
  if (option_.state == OptionState::refused || option_.state == OptionState::too_slow)
    v_.flags.push_back(option_.reason);
  return v_;
}

/// Of an option that was measured beside its strict sibling alone.
Verdict paired_verdict(const Study& s, const PrecisionPair& pair, const StudyOption& strict,
                       const Verdict& of_strict) {
  Verdict v = of_strict;
  // Significant, or nothing at all.
  const double bias2 = certain_bias(pair.bias2, pair.bias2_upper90, pair.runs);
  const double left = s.target * s.target - bias2;
  CurveFit fit = fit_curve(mean_curve(strict.runs), strict.merges, strict.radius_alpha);
  const std::optional<double> now = fit.reaches(s.target * s.target), then = fit.reaches(left);
  if (pair.wrong > 0) v.flags.push_back(fmt::format("{} device counters", pair.wrong));
  if (bias2 > 0 && !then) {
    v.kind = TargetKind::never;
    v.flags.push_back(fmt::format("a floor of {:.2g} %", 100 * std::sqrt(bias2)));
    return v;
  }
  const double longer = then && now ? *then / *now : 1;
  v.seconds *= pair.time_ratio * longer;
  v.low *= pair.time_low * longer, v.high *= pair.time_high * longer;
  v.noise *= std::pow(pair.time_ratio, v.exponent);
  v.beyond_factor *= longer;  // its longest run would take as much longer as its time to the target
  if (v.kind == TargetKind::measured) v.kind = TargetKind::interpolated;
  constexpr double harmless = 0.1;  // of the target
  if (std::sqrt(bias2) > harmless * s.target)
    v.flags.push_back(fmt::format("rounding alone is off by {:.2g} %, over a tenth of the target",
                                  100 * std::sqrt(bias2)));
  return v;
}

const StudyOption* strict_sibling(const Study& s, const StudyOption& option, std::size_t& at) {
  for (at = 0; at < s.options.size(); ++at)
    if (s.options[at].integrator == option.integrator && s.options[at].plain())
      return &s.options[at];
  return nullptr;
}

void judge_pairs(Study& s) {
  for (std::size_t i = 0; i < s.options.size(); ++i) {
    const StudyOption& option = s.options[i];
    if (option.precision == "strict") continue;
    std::size_t strict_at = 0;
    const StudyOption* strict = strict_sibling(s, option, strict_at);
    for (const PrecisionPair& pair : s.pairs)
      if (strict && pair.integrator == option.integrator && pair.precision == option.precision)
        s.verdicts[i] = paired_verdict(s, pair, *strict, s.verdicts[strict_at]);
  }
}

/// A reference whose own noise is not small beside what is judged (accuracy.md 5).
void check_reference_noise(Study& s) {
  constexpr double most = 0.1;
  if (s.reference.relmse > most * s.target * s.target)
    s.warnings.push_back(fmt::format(
        "the reference's own noise, {:.2g} %, is not small beside the target: intervals hold the "
        "spread of runs, not that of the reference, and no floor is claimed",
        100 * std::sqrt(s.reference.relmse)));
}

}  // namespace

std::string StudyOption::name() const {
  const std::string plain_name = integrator + " " + precision;
  return radius_factor == 1 ? plain_name
                            : fmt::format("{} (radius x{:g})", plain_name, radius_factor);
}

void analyse(Study& s) {
  check_reference_numbers(s);
  s.verdicts.clear();
  for (const StudyOption& option : s.options) s.verdicts.push_back(Judge(s, option).verdict());
  judge_pairs(s);
  check_reference(s);
  check_reference_noise(s);
  check_machine(s);
  recommend(s);
}

}  // namespace pellucid
