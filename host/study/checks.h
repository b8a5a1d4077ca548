// What has to hold before a study may be believed, and what is said where it does not.
#pragma once

#include "study/study.h"

namespace pellucid {

/// Throw InputError where a figure that all others rest on is no number.
void check_numbers(const StudyOption& option);
void check_reference_numbers(const Study& study);

/// Energy over that of the reference, with its interval; an unbiased method that is off is flagged.
void check_energy(const Study& study, const StudyOption& option, Verdict& verdict);
/// Runs that differ so much that rare bright paths rule their errors.
void check_spread(const StudyOption& option, Verdict& verdict);

/// After all verdicts: where all unbiased methods are off alike, it is the reference that is wrong.
void check_reference(Study& study);
/// Share of the machine beside which a study is disturbed.
constexpr double DISTURBING_LOAD = 0.05;

/// Warns of other programs on the machine, and of a clock that drifts.
void check_machine(Study& study);

}  // namespace pellucid
