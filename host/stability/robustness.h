// What robustness buys: faults among the same rays by this program and by naive code (see
// render/naive_rays.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stability/lab.h"

namespace pellucid::stability {

struct Faults {
  std::string what;
  std::uint64_t rays = 0;
  std::uint64_t ours = 0, naive = 0;  ///< of these rays
};

// leaks.cpp
void compare_leaks(const Lab& lab, std::vector<Faults>& faults);
// rehits.cpp
void compare_rehits(const Lab& lab, std::vector<Faults>& faults);

}  // namespace pellucid::stability
