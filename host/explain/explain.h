// Why are two pictures of one scene not equally bright? The answer in words, from energies by path
// length and from the cause that predicts the one picture best from the other's layers.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "explain/causes.h"

namespace pellucid::explain {

/// Energies, means over pixels, by channel, of some path lengths or of a strategy.
struct Row {
  std::string name;
  std::array<double, COLOURS> known{}, other{};
  std::array<double, COLOURS> ratio{}, error{};  ///< other / known and its standard error
  /// Of all channels together.
  double all_known() const { return known[0] + known[1] + known[2]; }
  double all_other() const { return other[0] + other[1] + other[2]; }
  double all_error() const;
};
using Rows = std::vector<Row>;

enum class Finding {
  none,         ///< no difference beyond noise
  cause,        ///< one cause explains it
  several,      ///< causes that cannot be told apart do
  partly,       ///< the best one explains more than half of it
  unexplained,  ///< nothing here does
};
const char* finding_name(Finding finding);

struct Ranked {
  Cause cause;
  double explained = 0;    ///< part of the squared difference, noise taken off
  double probability = 0;  ///< that it is this one, if it is one of those
};

struct Explanation {
  Finding finding = Finding::none;
  Names names;
  std::string words, advice;
  bool by_regression = false;  ///< lengths of the other picture: it has no layers
  Rows lengths, strategies;    ///< strategies only where both tell them
  std::vector<Ranked> causes;  ///< best first
  double significance = 0;     ///< standard errors by which "no difference" is worse than the best
  double detectable = 0;       ///< part of the energy that would have been found
  double remains = 0;          ///< misfit of the best over what noise makes; about 1 is noise
  std::vector<std::string> notes;
};

/// Both are finite, of one size, and `known` has layers that add up to it. `use_layers`: those of
/// `other` count, too.
Explanation explain(const Layered& known, const Layered& other, const Names& names,
                    bool use_layers);

/// Ratios by length of two pictures with layers, or by non-negative regression of the other one on
/// the known lengths; lengths whose ratio would be off by more than a tenth are put together.
/// `inflation`: of variances, by what the best cause leaves.
Rows length_rows(const Evidence& e, double inflation);
/// Strategies that both pictures keep layers of (tech.*), and merges.
Rows strategy_rows(const Layered& known, const Layered& other);

}  // namespace pellucid::explain
