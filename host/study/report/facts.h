// What both reports say of a study: curves, floors, ranks, and verdicts in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/study.h"

namespace pellucid {

/// An option's runs at one rung; errors are sqrt(relMSE). None where noise, taken off, leaves
/// nothing of the mean; no interval from a single run.
struct ErrorPoint {
  std::uint64_t spp = 0;
  int runs = 0;
  double seconds = 0;
  std::optional<double> error, low, high;  ///< 90 %: t over the runs, on the log of their mean
};
std::vector<ErrorPoint> error_curve(const StudyOption& option);

/// Seconds of the longest run; 0 without runs.
double longest_run(const StudyOption& option);

/// The verdict of an option; an unknown one where nothing was concluded.
Verdict verdict_of(const Study& study, std::size_t option);

/// sqrt(relMSE) by the fit of its verdict; none without a fit.
std::optional<double> fitted_error(const StudyOption& option, const Verdict& verdict,
                                   double seconds);

/// The paired comparison of an option with strict arithmetic, if there was one.
const PrecisionPair* pair_of(const Study& study, const StudyOption& option);

/// sqrt(relMSE) that no time takes away from an option, where there certainly is one.
std::optional<double> error_floor(const Study& study, std::size_t option);

/// sqrt of a pair's squared bias in words; "none seen" where it is not there for certain.
std::string pair_bias_text(const PrecisionPair& pair);

/// When the noise of the strict option meets a precision's bias (accuracy.md 7): harmless before.
struct FloorTime {
  double seconds = 0;
  bool at_least = false;  ///< only a bound on the bias is known
};
std::optional<FloorTime> floor_time(const Study& study, const PrecisionPair& pair);

/// Options, the recommended one first, then its equals, then by time to the target.
std::vector<std::size_t> ranked(const Study& study);

/// "38 s [34, 43] interpolated", "never (floor 0.40 %)", ...
std::string target_text(const Study& study, std::size_t option);

/// "-0.96 [-1.02, -0.90]", or "-"
std::string slope_text(const Verdict& verdict);

/// Share of tiles within the target at the last rung, "87 %", or "-".
std::string tiles_text(const StudyOption& option);

/// "<= 0.12 %" without the sign: the upper 90 % bound at the last rung, or "-".
std::string bias_text(const StudyOption& option);

/// Why it is not to be recommended: red flags, and its state with the reason.
std::vector<std::string> flags_of(const Study& study, std::size_t option);

/// "recommended", "no different from ...", or "".
std::string rank_text(const Study& study, std::size_t option);

const char* state_text(OptionState state);  ///< "too slow"; "" for `main`

/// Sentences about what errors were measured against.
std::vector<std::string> reference_lines(const StudyReference& reference);
std::string machine_line(const StudyMachine& machine);
/// "640x480 max-depth 5 ...; target 1 %, budget 10 min, ..."
std::string settings_line(const Study& study);

}  // namespace pellucid
