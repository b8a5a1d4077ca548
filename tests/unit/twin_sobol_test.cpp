// Sobol points: against the direction numbers in full, the exactness of the scrambles, the strata
// of every block, and independence of what is scrambled apart.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <set>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;

std::array<uint, 4> coordinates(const U4& v) {
  return {v.x, v.y, v.z, v.w};
}

/// Column of 32 bits of a generator matrix by the recurrence of [JoeKuo08]: a primitive polynomial
/// of degree s with inner coefficients a, and the first s direction numbers m.
std::vector<uint> generator(uint s, uint a, std::vector<uint> m) {
  for (size_t k = m.size(); k < 32; ++k) {
    uint next = m[k - s] ^ (m[k - s] << s);
    for (uint j = 1; j < s; ++j)
      if (a >> (s - 1 - j) & 1) next ^= m[k - j] << j;
    m.push_back(next);
  }
  for (size_t k = 0; k < 32; ++k) m[k] <<= 31 - k;
  return m;
}

TEST(TwinSobol, PointsAreThoseOfJoeAndKuo) {
  std::vector<uint> first(32);
  for (uint k = 0; k < 32; ++k) first[k] = 1u << (31 - k);
  // Coordinates x y z w are the dimensions 2 1 3 4 of new-joe-kuo-6.21201.
  const std::vector<uint> columns[4] = {generator(1, 0, {1}), first, generator(2, 1, {1, 3}),
                                        generator(3, 1, {1, 3, 1})};
  for (uint i = 0; i < SOBOL_BLOCK; ++i)
    for (uint c = 0; c < 4; ++c) {
      uint point = 0;
      for (uint bit = 0; bit < 32; ++bit)
        if (i >> bit & 1) point ^= columns[c][bit];
      ASSERT_EQ(sobol_nibbles(i) >> (4 * c) & 15u, point >> 28) << i << " " << c;
      ASSERT_EQ(point & 0x0fffffffu, 0u) << "16 points have 4 bits";
    }
}

using Permutation = std::array<uint, 16>;

/// Owen's property: two numbers part at the same bit before and after.
bool nested(const Permutation& p) {
  for (uint a = 0; a < 16; ++a)
    for (uint b = 0; b < a; ++b)
      if (__builtin_clz(p[a] ^ p[b]) != __builtin_clz(a ^ b)) return false;
  return true;
}

// There are 2^15 nested permutations of 16 numbers. Each choice of the 15 coefficient bits that
// count gives another one, so random bits give all of them alike.
TEST(TwinSobol, ScramblesOfIndicesAreAllNestedPermutations) {
  std::set<Permutation> all;
  for (uint bits = 0; bits < 1u << 15; ++bits) {
    Permutation p;
    for (uint i = 0; i < 16; ++i) p[i] = owen_index(i, bits << 1);
    ASSERT_TRUE(nested(p));
    all.insert(p);
  }
  EXPECT_EQ(all.size(), size_t{1} << 15);
}

TEST(TwinSobol, ScramblesOfCoordinatesAreAllNestedPermutations) {
  for (uint nibble = 0; nibble < 4; ++nibble) {
    const uint shift = 4 * nibble;
    std::set<Permutation> all;
    for (uint bits = 0; bits < 1u << 15; ++bits) {
      U4 c;
      c.x = (bits & 15u) << shift | (bits >> 4 & 7u) << (16 + shift);
      c.w = (bits >> 7 & 3u) << shift | (bits >> 9 & 3u) << (16 + shift);
      c.y = (bits >> 11 & 1u) << shift | (bits >> 12 & 1u) << (16 + shift);
      c.z = (bits >> 13 & 1u) << shift | (bits >> 14 & 1u) << (16 + shift);
      Permutation p;
      for (uint i = 0; i < 16; ++i) {
        const uint v = owen_nibbles(i << shift, c);
        p[i] = v >> shift & 15u;
        // Where the others hold 0, their coefficients are 0, too.
        ASSERT_EQ(v & 0xffffu & ~(15u << shift), 0u);
      }
      ASSERT_TRUE(nested(p));
      all.insert(p);
    }
    EXPECT_EQ(all.size(), size_t{1} << 15) << nibble;
  }
}

// Nibbles do not know of each other, and the bits that no coefficient uses (they scramble the
// index) change nothing.
TEST(TwinSobol, NibblesAreScrambledApart) {
  for (uint i = 0; i < 20000; ++i) {
    const U4 c = random_words({i, 0, 7}, 0);
    const uint v = random_words({i, 1, 7}, 0).x & 0xffffu;
    for (uint shift = 0; shift < 16; shift += 4) {
      const uint own = 15u << shift | 15u << (16 + shift);
      const U4 mine = {c.x & own, c.y & own, c.z & own, c.w & own};
      ASSERT_EQ(owen_nibbles(v, c) >> shift & 15u,
                owen_nibbles(v & 15u << shift, mine) >> shift & 15u);
    }
    const U4 used = {c.x, c.y & ~0xeeeeu, c.z & ~0x2222u, c.w};
    ASSERT_EQ(owen_nibbles(v, c) & 0xffffu, owen_nibbles(v, used) & 0xffffu);
  }
}

/// Every interval of size 2^-a x 2^-b holds the same number of points of [first, first + count).
bool is_net(const std::vector<std::array<uint, 4>>& points, size_t c, size_t d, uint a, uint b) {
  std::vector<size_t> cells(size_t{1} << (a + b), 0);
  for (const auto& p : points) {
    const size_t row = a ? p[c] >> (32 - a) : 0, column = b ? p[d] >> (32 - b) : 0;
    ++cells[row << b | column];
  }
  for (size_t n : cells)
    if (n != points.size() >> (a + b)) return false;
  return true;
}

std::vector<std::array<uint, 4>> iterations(uint path, uint dimension, uint seed, uint first,
                                            uint count) {
  std::vector<std::array<uint, 4>> points;
  for (uint i = first; i < first + count; ++i)
    points.push_back(coordinates(sobol_words({path, i, seed}, dimension)));
  return points;
}

TEST(TwinSobol, EveryBlockFillsItsStrata) {
  // Quality t of each pair as a (t,4,2)-net; 0 is best, and stands where pairs belong together.
  const uint quality[4][4] = {{0, 0, 1, 1}, {0, 0, 0, 2}, {1, 0, 0, 0}, {1, 2, 0, 0}};
  for (uint k = 0; k < 2000; ++k) {
    const U4 any = random_words({k, 0, 1}, 0);
    const uint block = any.y % 1000 * SOBOL_BLOCK;
    const auto points = iterations(any.x, any.z % 99, any.w, block, SOBOL_BLOCK);
    for (size_t c = 0; c < 4; ++c) {
      ASSERT_TRUE(is_net(points, c, c, 4, 0)) << "strata of coordinate " << c;
      for (size_t d = c + 1; d < 4; ++d)
        for (uint a = 0; a + quality[c][d] <= 4; ++a)
          ASSERT_TRUE(is_net(points, c, d, a, 4 - quality[c][d] - a))
              << "coordinates " << c << d << ", " << a << " bits of the first";
      // A render that ends within a block keeps the strata of its aligned parts.
      for (uint part : {2u, 4u, 8u})
        for (uint at = 0; at < SOBOL_BLOCK; at += part)
          ASSERT_TRUE(is_net(iterations(any.x, any.z % 99, any.w, block + at, part), c, c,
                             uint(__builtin_ctz(part)), 0));
    }
  }
}

/// A stratum is filled evenly: the mean of a block varies by 1/(12 n^3).
TEST(TwinSobol, VarianceOfABlocksMean) {
  for (size_t c = 0; c < 4; ++c) {
    Moments means, squares;
    for (uint path = 0; path < 20000; ++path) {
      double mean = 0;
      for (const auto& p : iterations(path, 3, 5, 32, SOBOL_BLOCK))
        mean += double(rng_unit(p[c])) / SOBOL_BLOCK;
      // The centre of the numbers on a grid of 2^-24 is half a step below 1/2.
      means.add(mean - 0.5 + 0x1p-25);
      squares.add((mean - 0.5) * (mean - 0.5));
    }
    const double variance = 1.0 / (12.0 * SOBOL_BLOCK * SOBOL_BLOCK * SOBOL_BLOCK);
    EXPECT_GT(z_test(means, 0.0, 0.0), sidak(family_alpha, 8)) << c;
    EXPECT_GT(z_test(squares, variance, 0.0), sidak(family_alpha, 8)) << c;
  }
}

constexpr uint draws = 500000;

ChiSquare even_test(size_t cells, const std::function<size_t(uint)>& cell) {
  std::vector<double> observed(cells, 0.0);
  for (uint i = 0; i < draws; ++i) ++observed[cell(i)];
  return chi_square(observed, std::vector<double>(cells, double(draws) / double(cells)));
}

TEST(TwinSobol, EveryByteOfEveryWordIsUniform) {
  const double alpha = sidak(family_alpha, 16);
  for (size_t c = 0; c < 4; ++c)
    for (uint byte = 0; byte < 4; ++byte) {
      const ChiSquare test = even_test(256, [&](uint i) {
        return coordinates(sobol_words({i, 21, 3}, DIM_LIGHT(2)))[c] >> (8 * byte) & 255u;
      });
      EXPECT_TRUE(accepted(test, alpha)) << c << " byte " << byte << ": " << test.describe();
    }
}

/// Two points that must not know of each other.
struct Pair {
  const char* name;
  U4 (*first)(uint i);
  U4 (*second)(uint i);
};

constexpr uint dim = DIM_BSDF(0);
const Pair pairs[] = {
    {"coordinates of one point",
     [](uint i) {
       return sobol_words({i, 5, 1}, dim);
     },
     [](uint i) {
       const U4 v = sobol_words({i, 5, 1}, dim);
       return U4{v.y, v.z, v.w, v.x};
     }},
    {"path, path + 1",
     [](uint i) {
       return sobol_words({2 * i, 5, 1}, dim);
     },
     [](uint i) {
       return sobol_words({2 * i + 1, 5, 1}, dim);
     }},
    {"path, path + 512",
     [](uint i) {
       return sobol_words({i, 5, 1}, dim);
     },
     [](uint i) {
       return sobol_words({i + 512, 5, 1}, dim);
     }},
    {"BSDF, light",
     [](uint i) {
       return sobol_words({i, 5, 1}, DIM_BSDF(0));
     },
     [](uint i) {
       return sobol_words({i, 5, 1}, DIM_LIGHT(0));
     }},
    {"pixel, BSDF",
     [](uint i) {
       return sobol_words({i, 5, 1}, DIM_PIXEL);
     },
     [](uint i) {
       return sobol_words({i, 5, 1}, DIM_BSDF(0));
     }},
    {"BSDF, light, along a block",
     [](uint i) {
       return sobol_words({i / 16, i, 1}, DIM_BSDF(0));
     },
     [](uint i) {
       return sobol_words({i / 16, i, 1}, DIM_LIGHT(0));
     }},
    {"bounce, bounce + 1",
     [](uint i) {
       return sobol_words({i, 5, 1}, DIM_BSDF(4));
     },
     [](uint i) {
       return sobol_words({i, 5, 1}, DIM_BSDF(5));
     }},
    {"block, next block",
     [](uint i) {
       return sobol_words({i, 5, 1}, dim);
     },
     [](uint i) {
       return sobol_words({i, 21, 1}, dim);
     }},
    {"block, next block, of one path",
     [](uint i) {
       return sobol_words({7, 32 * i, 1}, dim);
     },
     [](uint i) {
       return sobol_words({7, 32 * i + 16, 1}, dim);
     }},
    {"seed, seed + 1",
     [](uint i) {
       return sobol_words({i, 5, 1}, dim);
     },
     [](uint i) {
       return sobol_words({i, 5, 2}, dim);
     }},
};

TEST(TwinSobol, WhatIsScrambledApartIsIndependent) {
  constexpr uint side = 32;
  const double alpha = sidak(family_alpha, 4 * int(std::size(pairs)));
  for (const Pair& pair : pairs)
    for (size_t c = 0; c < 4; ++c) {
      const ChiSquare test = even_test(side * side, [&](uint i) {
        const uint a = coordinates(pair.first(i))[c], b = coordinates(pair.second(i))[c];
        return size_t(a >> 27) * side + (b >> 27);
      });
      EXPECT_TRUE(accepted(test, alpha)) << pair.name << " " << c << ": " << test.describe();
    }
}

/// The same of means over blocks: products of deviations of independent blocks vanish.
TEST(TwinSobol, MeansOfBlocksAreUncorrelated) {
  const auto deviation = [](uint path, uint dimension, uint seed, uint block) {
    double sum = 0;
    for (const auto& p : iterations(path, dimension, seed, block * SOBOL_BLOCK, SOBOL_BLOCK))
      sum += std::pow(double(rng_unit(p[1])) * double(rng_unit(p[2])), 2) - 1.0 / 9.0;
    return sum;
  };
  Moments path, dimension, seed, block;
  for (uint i = 0; i < 20000; ++i) {
    const double own = deviation(i, dim, 1, 2);
    path.add(own * deviation(i + 1, dim, 1, 2));
    dimension.add(own * deviation(i, dim + 1, 1, 2));
    seed.add(own * deviation(i, dim, 2, 2));
    block.add(own * deviation(i, dim, 1, 3));
  }
  for (const Moments* m : {&path, &dimension, &seed, &block})
    EXPECT_GT(z_test(*m, 0.0, 0.0), sidak(family_alpha, 4)) << m->mean;
}

}  // namespace
