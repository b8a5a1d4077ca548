// Random numbers: range, uniformity and independence of neighbouring streams (numerics 23).
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

TEST(TwinRng, UnitIsBelowOneForEveryWord) {
  // Only the upper 24 bits count: these are all results there are.
  for (uint64_t upper = 0; upper < 1u << 24; ++upper) {
    const real u = rng_unit(uint(upper << 8 | 0xff));
    ASSERT_EQ(double(u), double(upper) * 0x1p-24);
    ASSERT_LT(u, real(1));
    ASSERT_EQ(u, rng_unit(uint(upper << 8)));
  }
}

/// Most 16-bit halves of words that a stream of dimensions has in common with another, over paths
/// that both draw.
int equal_halves(uint dimension, uint other) {
  int equal = 0;
  for (uint path = 0; path < 4096; ++path) {
    const U4 a = random_words({path, 7, 3}, dimension), b = random_words({path, 7, 3}, other);
    for (uint shift : {0u, 16u})
      for (const auto& [x, y] : {std::pair{a.x, b.x}, {a.y, b.y}, {a.z, b.z}, {a.w, b.w}})
        equal += ((x >> shift) & 0xffffu) == ((y >> shift) & 0xffffu);
  }
  return equal;
}

// Sobol scrambles use every bit of a word: where the hash of two dimensions agrees in the lower
// ones, an eye path and the light path that it is connected with know of each other.
TEST(TwinRng, EyeAndLightWalksShareNoBits) {
  // 4096 paths of 8 halves: 0.5 by chance; 8 and more have a probability of 6e-8, over 1088 pairs.
  for (uint k = 0; k < 32; ++k)
    for (uint eye = 0; eye < 34; ++eye) {
      ASSERT_LT(equal_halves(eye, DIM_LIGHT_WALK + k), 8) << eye << " " << k;
    }
}

constexpr int side = 32;  // cells per axis of a pair
constexpr uint draws = 1000000;

template <class Draw>
ChiSquare pair_test(Draw draw) {
  std::vector<double> observed(side * side, 0.0);
  for (uint i = 0; i < draws; ++i) {
    const std::pair<real, real> p = draw(i);
    ++observed[size_t(int(p.first * side) * side + int(p.second * side))];
  }
  return chi_square(observed, std::vector<double>(observed.size(), double(draws) / (side * side)));
}

/// Two streams that must not know of each other, as pairs of their numbers.
struct Pair {
  const char* name;
  Random4 (*first)(uint i);
  Random4 (*second)(uint i);
};

constexpr uint dim = DIM_BSDF(0);
const Pair pairs[] = {
    {"path, path + 1",
     [](uint i) {
       return rng4({2 * i, 0, 1}, dim);
     },
     [](uint i) {
       return rng4({2 * i + 1, 0, 1}, dim);
     }},
    {"path, path + 512",
     [](uint i) {
       return rng4({i, 0, 1}, dim);
     },
     [](uint i) {
       return rng4({i + 512, 0, 1}, dim);
     }},
    {"iteration, iteration + 1",
     [](uint i) {
       return rng4({7, 2 * i, 1}, dim);
     },
     [](uint i) {
       return rng4({7, 2 * i + 1, 1}, dim);
     }},
    {"iteration along many paths",
     [](uint i) {
       return rng4({i, 0, 1}, dim);
     },
     [](uint i) {
       return rng4({i, 1, 1}, dim);
     }},
    {"dimension, dimension + 1",
     [](uint i) {
       return rng4({i, 3, 1}, DIM_BSDF(0));
     },
     [](uint i) {
       return rng4({i, 3, 1}, DIM_LIGHT(0));
     }},
    {"bounce, bounce + 1",
     [](uint i) {
       return rng4({i, 3, 1}, DIM_BSDF(4));
     },
     [](uint i) {
       return rng4({i, 3, 1}, DIM_BSDF(5));
     }},
    {"seed, seed + 1",
     [](uint i) {
       return rng4({i, 0, 1}, dim);
     },
     [](uint i) {
       return rng4({i, 0, 2}, dim);
     }},
    {"path and iteration exchanged",
     [](uint i) {
       return rng4({i, i + 1, 1}, dim);
     },
     [](uint i) {
       return rng4({i + 1, i, 1}, dim);
     }},
};

TEST(TwinRng, NeighbouringStreamsAreIndependent) {
  const double alpha = sidak(family_alpha, 2 * int(std::size(pairs)));
  for (const Pair& pair : pairs) {
    const ChiSquare same =
        pair_test([&](uint i) { return std::make_pair(pair.first(i).x, pair.second(i).x); });
    EXPECT_TRUE(accepted(same, alpha)) << pair.name << " x-x: " << same.describe();
    const ChiSquare cross =
        pair_test([&](uint i) { return std::make_pair(pair.first(i).y, pair.second(i).z); });
    EXPECT_TRUE(accepted(cross, alpha)) << pair.name << " y-z: " << cross.describe();
  }
}

TEST(TwinRng, FourNumbersOfOneCallAreIndependent) {
  const double alpha = sidak(family_alpha, 6);
  const auto component = [](const Random4& u, int k) {
    return k == 0 ? u.x : k == 1 ? u.y : k == 2 ? u.z : u.w;
  };
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b) {
      const ChiSquare test = pair_test([&](uint i) {
        const Random4 u = rng4({i % 4096, i / 4096, 5}, dim);
        return std::make_pair(component(u, a), component(u, b));
      });
      EXPECT_TRUE(accepted(test, alpha)) << a << b << ": " << test.describe();
    }
}

TEST(TwinRng, NoTwoStreamsAreEqual) {
  // 128 bits each: any repetition among these is a fault of the hash, not chance.
  std::vector<std::tuple<uint, uint, uint, uint>> words;
  for (uint path = 0; path < 64; ++path)
    for (uint iteration = 0; iteration < 32; ++iteration)
      for (uint dimension = 0; dimension < 32; ++dimension)
        for (uint seed = 0; seed < 8; ++seed) {
          const U4 v = random_words({path, iteration, seed}, dimension);
          words.emplace_back(v.x, v.y, v.z, v.w);
        }
  const size_t count = words.size();
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  EXPECT_EQ(words.size(), count);
}

TEST(TwinRng, BlocksOfDimensionsDoNotOverlap) {
  std::set<uint> used{DIM_PIXEL};
  for (uint bounce = 0; bounce < 1000; ++bounce) {
    EXPECT_TRUE(used.insert(DIM_BSDF(bounce)).second);
    EXPECT_TRUE(used.insert(DIM_LIGHT(bounce)).second);
  }
}

}  // namespace
