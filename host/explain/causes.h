// What may make one picture brighter than another: each cause is a model with few unknowns that
// predicts one picture from the other's layers by path length.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "explain/evidence.h"

namespace pellucid::explain {

/// The two pictures by the names that people know them by.
struct Names {
  std::string known = "A", other = "B";
};

struct Cause {
  std::string id;                                       ///< for scripts
  std::string words;                                    ///< what it says of this pair, with figures
  std::string advice;                                   ///< how to make sure
  std::vector<std::pair<std::string, double>> figures;  ///< for scripts
  double misfit = 0;           ///< what it leaves: sum of squares over variances
  std::size_t parameters = 0;  ///< unknowns that were fitted
  Layers predicted;            ///< layers by length, where the cause is all over the picture
};
using Causes = std::vector<Cause>;

/// Everything that causes are judged by.
struct Case {
  const Layered &known, &other;
  Evidence evidence;
  Names names;
};

/// Each adds what it has to say of the pair; nothing where it cannot be.

/// One factor on a range of lengths: exposure, lit parts, lights seen directly, depth cap,
/// roulette.
void try_factors(const Case& c, Causes& causes);
/// A factor for every bounce.
void try_albedo(const Case& c, Causes& causes);
/// Channels mixed by a matrix.
void try_colour_space(const Case& c, Causes& causes);
/// Nothing above a value.
void try_clamp(const Case& c, Causes& causes);
/// Light where the other has none, and what it lights.
void try_local(const Case& c, Causes& causes);
/// Edges alone. `unexplained`: sum of squares over variances of what edges tell and all other
/// causes leave; 0 where this is none.
void try_filter(const Case& c, Causes& causes, double& unexplained);

}  // namespace pellucid::explain
