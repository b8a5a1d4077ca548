// Running a case and judging it.
#include "stability/suite.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/timer.h"

namespace pellucid::stability {
namespace {

/// How near to its bound, or how far beyond.
double strain(const Check& check) {
  if (!check.holds()) return std::numeric_limits<double>::infinity();
  return check.bound > 0 ? check.measured / check.bound : 0;
}

}  // namespace

const char* verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::pass:
      return "pass";
    case Verdict::warned:
      return "warned";
    case Verdict::not_applicable:
      return "not applicable";
    case Verdict::fail:
      break;
  }
  return "fail";
}

const Check* Result::worst() const {
  const auto most =
      std::max_element(checks.begin(), checks.end(),
                       [](const Check& a, const Check& b) { return strain(a) < strain(b); });
  return most == checks.end() ? nullptr : &*most;
}

Result run_case(const Case& which, const Lab& lab) {
  Result result;
  result.which = &which;
  if (!which.measure) {
    result.verdict = Verdict::not_applicable;
    result.note = which.why_not;
    return result;
  }
  const Timer timer;
  Findings findings;
  try {
    which.measure(lab, findings);
  } catch (const NumericError& e) {
    findings.require("counters of errors", false);
    result.note = e.what();
  } catch (const InternalError& e) {
    findings.require("no fault of pellucid's own", false);
    result.note = e.what();
  }
  result.seconds = timer.seconds();
  result.checks = std::move(findings.checks);
  // A case that measured nothing has shown nothing.
  const bool holds =
      !result.checks.empty() && std::all_of(result.checks.begin(), result.checks.end(),
                                            [](const Check& check) { return check.holds(); });
  result.verdict = !holds                     ? Verdict::fail
                   : findings.warning.empty() ? Verdict::pass
                                              : Verdict::warned;
  if (result.note.empty()) result.note = findings.warning;
  return result;
}

}  // namespace pellucid::stability
