// Functions of core/math.h against long double: the errors that their comments claim.
#include <gtest/gtest.h>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

#ifdef PELLUCID_REAL_IS_FLOAT

constexpr long double pi_l = 3.14159265358979323846264338327950288L;

/// Distance of x from exact in units of the last place of the float nearest to exact.
double ulps(float x, long double exact) {
  int exponent;
  std::frexp(double(exact), &exponent);
  const int smallest = -125;  // subnormals have the spacing of the smallest normal
  return double(std::abs((long double)x - exact)) /
         std::ldexp(1.0, std::max(exponent, smallest) - 24);
}

TEST(TwinMath, SincosOverAllArguments) {
  double worst = 0, worst_circle = 0;
  for (uint i = 0; i <= 1u << 24; i += 3) {  // every third argument, 0 and 1 - 2^-24 too
    const float u = float(i) * 0x1p-24f;
    const SinCos r = sincos_2pi(u);
    const long double angle = 2 * pi_l * u;
    worst = std::max(
        {worst, double(std::abs(r.s - std::sin(angle))), double(std::abs(r.c - std::cos(angle)))});
    worst_circle = std::max(worst_circle, std::abs(double(r.s) * r.s + double(r.c) * r.c - 1));
  }
  std::printf("sincos_2pi: %.3f * 2^-24\n", worst / 0x1p-24);
  EXPECT_LT(worst, 1.5 * 0x1p-24);             // the claim
  EXPECT_LT(worst_circle, 2 * 1.5 * 0x1p-24);  // and so |(s, c)| is 1 to twice that
}

TEST(TwinMath, SincosAtQuarters) {
  const float s[] = {0, 1, 0, -1, 0}, c[] = {1, 0, -1, 0, 1};
  for (int i = 0; i < 5; ++i) {
    const SinCos r = sincos_2pi(0.25f * float(i));
    EXPECT_EQ(r.s, s[i]) << i;
    EXPECT_EQ(r.c, c[i]) << i;
  }
}

double worst_pow(Random& random, int n, double low_y, double high_y, bool near_one) {
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    const float x =
        near_one ? float(1 - std::pow(10.0, random.uniform(-7.2, -1))) : float(random.unit24());
    const float y = float(std::pow(10.0, random.uniform(low_y, high_y)));
    if (x == 0.0f) continue;
    const long double exact = std::pow((long double)x, (long double)y);
    if (exact < 1.2e-38L) continue;  // flushed to 0 below the normal numbers
    const double error = ulps(pow_unit(x, y), exact);
    worst = std::max(worst, error);
  }
  return worst;
}

TEST(TwinMath, PowUnit) {
  Random random(1);
  const double lobes = worst_pow(random, 1000000, 0, 4, false);
  const double near_one = worst_pow(random, 1000000, 0, 6, true);
  const double roots = worst_pow(random, 1000000, -5, 0, false);
  // Where the logarithm's mantissa changes octave, and results are the smallest there are.
  double octave = 0;
  for (int i = 0; i < 3000000; ++i) {
    const float x = float(random.uniform(0.68, 0.73)), y = float(random.uniform(200, 270));
    const double exact = std::pow(double(x), double(y));
    if (exact > 1.2e-38) octave = std::max(octave, ulps(pow_unit(x, y), exact));
  }
  std::printf("pow_unit ulps: exponents > 1: %.2f, x near 1: %.2f, roots: %.2f, octave: %.2f\n",
              lobes, near_one, roots, octave);
  EXPECT_LT(std::max({lobes, near_one, roots, octave}), 4.0);  // the claim
}

TEST(TwinMath, AcosOverAllArguments) {
  double worst = 0;
  for (uint i = 0; i <= 1u << 24; i += 3) {
    const float x = float(i) * 0x1p-24f;
    worst = std::max(worst, std::abs(double(acos_unit(x)) - std::acos(double(x))));
  }
  std::printf("acos_unit: %.3f * 2^-24\n", worst / 0x1p-24);
  EXPECT_LT(worst, 4 * 0x1p-24);  // the claim
}

TEST(TwinMath, PowUnitEnds) {
  for (float y : {0.0f, 1e-4f, 0.5f, 1.0f, 3.0f, 1e4f, 1e6f})
    EXPECT_EQ(pow_unit(1.0f, y), 1.0f) << y;
  for (float x : {0.0f, 0x1p-24f, 0.5f, 1.0f}) EXPECT_EQ(pow_unit(x, 0.0f), 1.0f) << x;
  EXPECT_EQ(pow_unit(0.0f, 2.0f), 0.0f);
  EXPECT_EQ(pow_unit(0x1p-24f, 1e6f), 0.0f);  // far below the smallest number
  float before = 0.0f;
  for (float x = 0.9999f; x < 1.0f; x = std::nextafter(x, 2.0f)) {
    const float p = pow_unit(x, 1e4f);
    ASSERT_GE(p, before * (1 - 4 * 0x1p-24f)) << x;  // monotone up to its error
    ASSERT_LE(p, 1.0f);
    before = p;
  }
}

TEST(TwinMath, Log2Split) {
  Random random(2);
  double worst = 0, worst_near = 0;
  for (int i = 0; i < 1000000; ++i) {
    const float x = i & 1 ? float(std::pow(2.0, random.uniform(-126, 0)))
                          : float(1 - std::pow(2.0, random.uniform(-24, -1)));
    float low;
    const float high = log2_split(x, &low);
    const long double exact = std::log2((long double)x);
    const double error = double(std::abs((long double)high + low - exact));
    if (exact != 0) worst = std::max(worst, error / double(std::abs(exact)));
    if (x > 0.5f) worst_near = std::max(worst_near, error);
  }
  std::printf("log2_split: relative %.2e, absolute above 1/2 %.2e\n", worst, worst_near);
  EXPECT_LT(worst, 0x1p-27);  // the claim
}

TEST(TwinMath, Exp2Split) {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const float x = float(random.uniform(-126, 0));
    const float low = float(random.uniform(-0x1p-20, 0x1p-20));
    worst = std::max(worst, ulps(exp2_split(x, low), std::exp2((long double)x + low)));
  }
  std::printf("exp2_split: %.2f ulps\n", worst);
  EXPECT_LT(worst, 1.5);
  EXPECT_EQ(exp2_split(0.0f, 0.0f), 1.0f);
  EXPECT_EQ(exp2_split(-127.0f, 0.0f), 0.0f);
}

#else

TEST(TwinMath, DoubleIsTheStandardLibrary) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform();
    EXPECT_NEAR(sincos_2pi(u).s, std::sin(6.283185307179586477 * u), 1e-15);
    EXPECT_EQ(pow_unit(u, 3.5), std::pow(u, 3.5));
  }
}

#endif

}  // namespace
