// How far runs may go: samples per pixel in steps that all runs of an option share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "shared/limits.h"

namespace pellucid {

/// At most so many samples per pixel: whole blocks of the sampler, one at least.
inline std::uint64_t whole_blocks(double spp) {
  constexpr double most = 1 << 16;
  return SOBOL_BLOCK * std::max<std::uint64_t>(1, std::uint64_t(std::min(spp / SOBOL_BLOCK, most)));
}

/// From one block on in powers of two, up to `spp`; the first is always there.
inline std::vector<std::uint64_t> ladder_to(double spp) {
  std::vector<std::uint64_t> ladder{SOBOL_BLOCK};
  while (double(2 * ladder.back()) <= spp && ladder.back() < (1u << 24))
    ladder.push_back(2 * ladder.back());
  return ladder;
}

}  // namespace pellucid
