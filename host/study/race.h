// Who takes part in a study's race, and how far each of them runs.
#pragma once

#include <memory>
#include <vector>

#include "study/contender.h"
#include "study/reference.h"

namespace pellucid {

/// Runs of each option in the pilot, and in the race; of one that is blind to some paths, fewer.
constexpr int pilot_runs = 4, main_runs = 10, blind_runs = 4;

/// An option of the study, or a method that only helps to make the reference.
struct Entry {
  std::unique_ptr<Contender> contender;
  StudyOption option;
  bool asked = false;
  bool voice = false;  ///< sees all, so it may speak for the truth
  bool raced = true;   ///< has, or would have, runs beside those of the pilot
  std::vector<LadderStep> pilots;
  std::vector<std::uint64_t> ladder;
  std::vector<PictureStack> stacks;  ///< by rung

  double pilot_seconds() const {
    double sum = 0;
    for (const LadderStep& p : pilots) sum += p.rung.seconds;
    return sum / double(pilots.size());
  }
};

/// What is ten times dearer than the best, at a confidence of 99 %, gets no more of the budget.
void eliminate(const Reference& reference, std::vector<Entry>& entries);

/// Those that go on after the pilot.
std::vector<Entry*> racing(std::vector<Entry>& entries);

/// Ladders for all of them, about as long in time, within so many wall seconds together; what
/// cannot have the rungs that a curve needs is left out, the dearest first.
void plan_ladders(double seconds, std::vector<Entry>& entries);

}  // namespace pellucid
