// The stability suite: the hard cases of light transport, each measured on a device and held to a
// bound. A new case is a function in a file of its own and a row in cases.cpp.
#pragma once

#include <string>
#include <vector>

#include "stability/lab.h"

namespace pellucid::stability {

/// One figure and the most that it may be: what is measured is always an error or a number of
/// faults.
struct Check {
  std::string what;
  double measured = 0, bound = 0;
  bool holds() const { return measured <= bound; }  ///< never where `measured` is NaN
};

/// What a case found.
struct Findings {
  std::vector<Check> checks;
  std::string warning;  ///< what the program tells its user of this; "" where it just works

  void at_most(const std::string& what, double measured, double bound) {
    checks.push_back({what, measured, bound});
  }
  /// A number of faults, of which there must be none.
  void none(const std::string& what, std::uint64_t count) { at_most(what, double(count), 0); }
  /// What just has to be so.
  void require(const std::string& what, bool holds) { none(what, holds ? 0 : 1); }
};

using Measurement = void (*)(const Lab& lab, Findings& findings);

struct Case {
  int number;         ///< of the catalogue, worst for users first
  std::string name;   ///< as --case has it
  std::string title;  ///< what is hard
  std::string methods;
  std::string naive;    ///< what goes wrong in code that does not mind
  Measurement measure;  ///< null: not applicable ...
  std::string why_not;  ///< ... for this reason
};

/// The table, by number.
const std::vector<Case>& cases();
/// Numbers of the catalogue that it has no case for yet.
std::vector<int> missing_cases();

enum class Verdict { pass, warned, not_applicable, fail };
const char* verdict_name(Verdict verdict);

struct Result {
  const Case* which = nullptr;
  Verdict verdict = Verdict::fail;
  std::vector<Check> checks;
  std::string note;  ///< why it is not applicable, what the user is warned of, or what was thrown
  double seconds = 0;

  /// The check nearest to its bound, or the first beyond; null where there is none.
  const Check* worst() const;
};

/// What a measurement throws is a failure of its case, but for a device that does not work at all.
Result run_case(const Case& which, const Lab& lab);

}  // namespace pellucid::stability
