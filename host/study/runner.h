// The course of a study: pilot, reference, replicates in turns, precisions beside each other.
#pragma once

#include "integrators/reach.h"
#include "study/contender.h"

namespace pellucid {

struct StudyRequest {
  double target = 0.01, budget_seconds = 600;
  std::vector<std::string> integrators;  ///< names, in order
  std::vector<std::string> precisions;   ///< of strict, mad, fast, compact; strict is always there
  std::string reference;                 ///< a file; empty: made here
  std::uint64_t seed = 0;
  std::string folder;  ///< for pictures on their way into the document
  std::function<void(const std::string&)> tell;
};

/// Runs and analyses; what the user stops is whole as far as it goes, with `complete` false. The
/// caller fills in what names the scene. Throws InputError for a reference that is of no use.
Study run_study(const StudyStage& stage, const SceneOptics& optics, const StudyRequest& request);

}  // namespace pellucid
