// The small codes: largest errors, extremes, and codes that come back as they went.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <glm/gtc/packing.hpp>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::asin(std::min(1.0, glm::length(glm::cross(a, b))));
}

TEST(TwinCodes, DirectionsTo65Microradians) {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    glm::dvec3 d = random.direction();
    if (i % 4 == 1) d = glm::normalize(glm::dvec3(d.x, d.y, 1e-5 * d.z));  // along the fold
    if (i % 4 == 2) d = glm::normalize(glm::dvec3(1e-5 * d.x, 1e-5 * d.y, d.z));
    const real3 back = octahedral_unpack(octahedral_pack(to_real3(d)));
    ASSERT_GT(glm::dot(d, to_dvec3(back)), 0.0);
    worst = std::max(worst, angle_between(d, to_dvec3(back)));
  }
  std::printf("octahedral: worst error %.3g rad\n", worst);
  EXPECT_LT(worst, 6.5e-5);
  for (int axis = 0; axis < 3; ++axis)
    for (int sign : {-1, 1}) {
      glm::dvec3 d(0);
      d[axis] = sign;
      EXPECT_EQ(to_dvec3(octahedral_unpack(octahedral_pack(to_real3(d)))), d);
    }
}

TEST(TwinCodes, SignedUnits) {
  for (int i = -1; i <= 1; ++i) EXPECT_EQ(from_snorm16(snorm16(real(i))), real(i));
  EXPECT_EQ(snorm16(real(-2)), snorm16(real(-1)));
  EXPECT_EQ(snorm16(real(2)), snorm16(real(1)));
  for (uint bits = 1; bits <= 0xffffu; ++bits) ASSERT_EQ(snorm16(from_snorm16(bits)), bits);
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const double x = random.uniform(-1, 1);
    // Half a step, and float's 2^-8 of one when it is added to 32768.
    ASSERT_NEAR(double(from_snorm16(snorm16(real(x)))), x, 0.505 / 32767);
  }
}

TEST(TwinCodes, FloatsOf24Bits) {
  Random random(3);
  for (int i = 0; i < 300000; ++i) {
    const float x = float(std::pow(10.0, random.uniform(-37, 38)));
    const uint bits = float24_pack(x);
    ASSERT_EQ(bits & 0xffu, 0u);
    ASSERT_NEAR(double(float_from_bits(bits)) / double(x), 1.0, 0x1p-16);
    ASSERT_EQ(float24_pack(float_from_bits(bits)), bits);
  }
  EXPECT_EQ(float24_pack(0.0f), 0u);
  EXPECT_TRUE(std::isfinite(float_from_bits(float24_pack(std::numeric_limits<float>::max()))));
}

TEST(TwinCodes, PowersOfTwoNotBelow) {
  Random random(4);
  for (int i = 0; i < 100000; ++i) {
    const float x = float(std::pow(10.0, random.uniform(-30, 30)));
    const float above = float_from_bits(float_exponent_above(x) << 23);
    ASSERT_GE(above, x);
    ASSERT_LT(above, 2 * x);
  }
  EXPECT_EQ(float_from_bits(float_exponent_above(8.0f) << 23), 8.0f);
  EXPECT_EQ(float_exponent_above(0.0f), 0u);
}

TEST(TwinCodes, EveryHalfComesBack) {
  for (uint h = 0; h <= 0xffffu; ++h) {
    if ((h & 0x7c00u) == 0x7c00u) continue;  // infinities and NaN
    const real x = half_unpack(h);
    ASSERT_EQ(float(x), glm::unpackHalf1x16(glm::uint16(h))) << h;
    ASSERT_EQ(half_pack(float(x)), h == 0x8000u ? half_pack(-0.0f) : h) << h;
  }
  Random random(5);
  for (int i = 0; i < 300000; ++i) {
    const float x = float(random.uniform(-1, 1) * std::pow(10.0, random.uniform(-9, 4.8)));
    const double step = std::max(0x1p-24, std::pow(2.0, std::floor(std::log2(std::abs(x))) - 10));
    ASSERT_LE(std::abs(double(half_unpack(half_pack(x))) - double(x)), 0.5 * step * (1 + 1e-6));
  }
  EXPECT_EQ(half_unpack(half_pack(1e30f)), real(65504));
  EXPECT_EQ(half_unpack(half_pack(-1e30f)), real(-65504));
}

TEST(TwinCodes, ColoursToA255thOfTheLargest) {
  Random random(6);
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    // Above what is black, 2^-118, and below where steps of the largest would overflow.
    const double scale = std::pow(10.0, random.uniform(-28, 37));
    const double r = random.uniform(), g = random.uniform(), b = i % 2 ? random.uniform() : 0.0;
    const glm::dvec3 c = glm::dvec3(r, g, b) * scale;
    const glm::dvec3 e = glm::abs(to_dvec3(rgbe_unpack(rgbe_pack(to_real3(c)))) - c);
    const double largest = std::max({c.x, c.y, c.z});
    worst = std::max(worst, std::max({e.x, e.y, e.z}) / largest);
  }
  std::printf("rgbe: worst error %.3g of the largest\n", worst);
  EXPECT_LE(worst, 1.0 / 255.5 + 1e-6);  // 255.5 counts of one exponent are 128 of the next
  EXPECT_EQ(rgbe_pack(REAL3(0, 0, 0)), 0u);
  EXPECT_TRUE(is_black(rgbe_unpack(rgbe_pack(REAL3(1e-37, 0, 0)))));
  EXPECT_EQ(rgbe_unpack(rgbe_pack(REAL3(1, 0.5, 0.25))).x, real(1));
  const real3 carried = rgbe_unpack(rgbe_pack(REAL3(0.999999, 0.5, 0)));  // rounds up to 1
  EXPECT_EQ(carried.x, real(1));
  EXPECT_EQ(carried.y, real(0.5));
}

}  // namespace
