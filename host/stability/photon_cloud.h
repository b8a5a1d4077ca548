// Clouds of photons to search in, and what a search must find.
#pragma once

#include <random>
#include <vector>

#include "shared/layout.h"

namespace pellucid::stability {

inline bool same(const U4& a, const U4& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
}

/// Photons, where to look for them, and the grid's own figures.
struct Cloud {
  std::vector<F4> photons, queries;
  float radius = 1;
  F4 origin{};
};

/// Floats for clouds, the same in every run.
class CloudRandom {
 public:
  float signed_unit() { return 2 * std::uniform_real_distribution<float>()(engine_) - 1; }
  F4 in_box(const F4& center, float half) {
    return {center.x + half * signed_unit(), center.y + half * signed_unit(),
            center.z + half * signed_unit(), 0};
  }
  std::size_t below(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937 engine_{5};
};

/// n photons, in clumps so that there is something to find, in a box of half the given extent on
/// each side of `center`; a third of the queries at photons, the others near them.
Cloud cloud_of(std::size_t n, double extent_in_radii, float radius, const F4& center,
               std::size_t queries = 10000);

/// What is there by trying all photons for all queries, with the same test as kernels have: the
/// number found, the sums of their places, of the squares and of the cubes, modulo 2^32.
std::vector<U4> brute_force(const Cloud& cloud);

}  // namespace pellucid::stability
