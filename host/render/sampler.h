// Where a render's random numbers come from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/platform.h"

namespace pellucid {

enum class Sampler {
  sobol,   ///< scrambled Sobol points: less noise; iterations are independent by SOBOL_BLOCK
  random,  ///< independent numbers
};

/// In the order of the enum.
std::vector<std::string> sampler_names();
std::string sampler_name(Sampler sampler);
/// By name; `name` must be one of sampler_names().
Sampler find_sampler(const std::string& name);

/// Mixes a 64-bit user seed into the word that kernels get (SplitMix64's finaliser), so that seeds
/// 0, 1, 2 share nothing.
uint hash_seed(std::uint64_t seed);

}  // namespace pellucid
