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
  std::string scene_hash, settings;  ///< as renders store them, to know a reference by
  std::string folder;                ///< for pictures on their way into the document
  std::function<void(const std::string&)> tell;
  /// After every round: what there is so far, without verdicts or pictures.
  std::function<void(Study)> save;
};

/// Bytes of the host for the pictures that a study of so many methods keeps: of every run at every
/// rung.
std::uint64_t study_host_bytes(std::uint64_t pixels, std::size_t methods);

/// Runs; what the user stops is whole as far as it goes, with `complete` false. The caller fills in
/// what names the scene, and analyses. Throws InputError for a reference that is of no use.
Study run_study(const StudyStage& stage, const SceneOptics& optics, const StudyRequest& request);

}  // namespace pellucid
