// A study: what was run on a scene, and what follows from it. All of it is in study.json, from
// which every report is made.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pellucid {

/// A run after so many samples per pixel. Errors are relMSE against the reference, the reference's
/// own variance taken off, so they may come out negative.
struct Rung {
  std::uint64_t spp = 0;
  double seconds = 0;  ///< on the study's clock, of rendering alone
  double relmse = 0;
  double energy_ratio = 0;  ///< sum of the picture over that of the reference
  double wall_seconds = 0;  ///< the same work by the clock on the wall
};

/// One render with a seed of its own, and what was seen of it on the way.
struct StudyRun {
  std::uint64_t seed = 0;
  std::vector<Rung> rungs;
};

/// Of all runs of an option together, at one rung: relMSE of a run = variance + bias2.
struct Split {
  std::uint64_t spp = 0;
  double variance = 0;
  double bias2 = 0;          ///< may be negative: noise of the estimate
  double bias2_upper90 = 0;  ///< one-sided bound
};

struct PassSeconds {
  std::string name;
  double seconds = 0;  ///< of a sample per pixel
};

enum class OptionState {
  main,      ///< replicates at all rungs
  too_slow,  ///< fewer rungs than a fit needs within the budget
  pilot,     ///< ten times dearer than the best after the pilot: no more budget
  blind,     ///< cannot see some paths: run, but never recommended
  refused,   ///< failed: see `reason`
};

/// A method in one precision.
struct StudyOption {
  std::string integrator, precision = "strict";
  OptionState state = OptionState::main;
  std::string reason;                    ///< why not `main`
  std::vector<std::string> unreachable;  ///< path classes it never draws
  std::vector<std::string> chance;       ///< and those that it finds by chance alone
  bool merges = false;                   ///< biased by its radius, which shrinks
  double radius_alpha = 1;               ///< how fast, for merging methods
  double radius = 0, radius_factor = 1;  ///< of the first pass, in scene units; over the default
  double setup_seconds = 0;              ///< kernels built and loaded
  std::uint64_t memory_bytes = 0;        ///< on the device
  std::uint64_t wrong = 0;               ///< device counters that tell of errors, and NaN
  double pilot_efficiency = 0;           ///< 1 / (relMSE x seconds) by the film's own variances
  std::vector<StudyRun> runs;
  std::vector<Split> splits;  ///< by rung
  std::vector<PassSeconds> passes;
  std::vector<double> tiles;  ///< relMSE of each tile of the picture, mean of the runs, last rung
  double tiles_within = 0;    ///< share of them within the target then
  std::string picture, error_map;  ///< PNG files, base64; of one run at its last rung

  /// In strict arithmetic and with its own radius: what variants are measured beside.
  bool plain() const { return precision == "strict" && radius_factor == 1; }
  std::string name() const;
};

/// Width and height of a tile in pixels; those at the right and lower edge may be smaller.
constexpr int STUDY_TILE = 8;

/// The same seeds in two precisions: noise cancels.
struct PrecisionPair {
  std::string integrator, precision;
  std::uint64_t spp = 0;
  double bias2 = 0, bias2_upper90 = 0;                 ///< relMSE between them that no time removes
  double time_ratio = 1, time_low = 1, time_high = 1;  ///< seconds over those of strict; least and
                                                       ///< largest of the pairs
  double divergent_per_million = 0;                    ///< paths that took another turn
  std::uint64_t wrong = 0;  ///< as StudyOption::wrong, of the relaxed one
  int runs = 0;             ///< pairs that bias and times are of
};

/// What errors are measured against.
struct StudyReference {
  std::string source;       ///< methods and their runs, or a file
  double relmse = 0;        ///< its own variance, as relMSE
  double energy_error = 0;  ///< standard error of its sum, relative
  double disagreement = 0;  ///< of its two methods' sums, in standard errors
  bool trusted = true;
  std::string doubt;           ///< why not, or what limits it
  std::string picture;         ///< PNG, base64
  bool variance_known = true;  ///< else `relmse` is 0 for want of a figure
};

struct StudyMachine {
  std::string device, driver, version, clock;  ///< clock: "cpu" (over the cores) or "wall"
  unsigned threads = 0;
  double foreign_load = 0;  ///< share of the machine that other processes took
};

enum class TargetKind { measured, interpolated, extrapolated, beyond, never, unknown };

/// What follows for one option.
struct Verdict {
  TargetKind kind = TargetKind::unknown;
  double seconds = 0, low = 0, high = 0;  ///< to the target; 90 % interval. `beyond`: at least
  double beyond_factor = 1;               ///< seconds over those of the longest run
  double slope = 0, slope_low = 0, slope_high = 0;  ///< of log relMSE over log seconds, 90 %
  double slope_from = 0, slope_to = 0;              ///< where it should be
  double noise = 0, bias = 0,
         exponent = 1;      ///< relMSE = noise t^-exponent + bias t^-(2 - 2 radius_alpha)
  double fit_residual = 0;  ///< largest, relative
  double energy = 1, energy_low = 1, energy_high = 1;
  std::vector<std::string> flags;  ///< red ones: what forbids a recommendation
};

struct Study {
  std::string scene, scene_hash, settings;
  int width = 0, height = 0;
  double target = 0.01;                      ///< sqrt(relMSE)
  double budget_seconds = 600, seconds = 0;  ///< asked for; taken
  std::uint64_t seed = 0;
  bool complete = true;               ///< not stopped early
  std::vector<std::string> warnings;  ///< of the scene, and that the machine was disturbed
  StudyMachine machine;
  StudyReference reference;
  std::vector<StudyOption> options;
  std::vector<PrecisionPair> pairs;
  // What follows (analyse.h)
  std::vector<Verdict> verdicts;          ///< of `options`, in their order
  int recommended = -1;                   ///< index of an option, or -1
  std::vector<int> equals;                ///< others that do not differ significantly
  std::string recommendation;             ///< a sentence
  std::vector<std::string> would_change;  ///< what would change this verdict
};

}  // namespace pellucid
