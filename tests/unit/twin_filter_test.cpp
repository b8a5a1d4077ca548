// Pixel filters: offsets from the table against the filters' integrals in closed form.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::PixelFilter;

constexpr double pi_d = 3.14159265358979323846;

/// Share of a filter left of x, by its antiderivative: nothing of it is shared with the host's
/// formulas.
double share_below(PixelFilter filter, double x) {
  const double a = std::abs(x);
  double half = 0;
  if (filter == PixelFilter::tent) {
    half = a - 0.5 * a * a;
  } else if (filter == PixelFilter::gaussian) {
    const double edge = std::exp(-4.5);
    const auto integral = [&](double t) {
      return std::sqrt(pi_d / 8) * std::erf(std::sqrt(2.0) * t) - edge * t;
    };
    half = 0.5 * integral(a) / integral(1.5);
  } else {
    const double w = pi_d * a / 1.5;
    half = 0.5 * a / 1.5 +
           (0.48829 * std::sin(w) + 0.14128 / 2 * std::sin(2 * w) + 0.01168 / 3 * std::sin(3 * w)) /
               (2 * pi_d * 0.35875);
  }
  return x < 0 ? 0.5 - half : 0.5 + half;
}

const PixelFilter tabulated[] = {PixelFilter::tent, PixelFilter::gaussian,
                                 PixelFilter::blackman_harris};

std::vector<float> table_of(PixelFilter filter) {
  pellucid::Scene scene = empty_scene(0.5);
  scene.settings.filter = filter;
  return pellucid::pack_scene(scene, {SIMD_WIDTH}).filter_table;
}

real unit(uint step) {
  return rng_unit(step << 8);
}

TEST(TwinFilter, IntegralToAMillionth) {
  for (PixelFilter filter : tabulated) {
    const std::vector<float> table = table_of(filter);
    double worst = 0, previous = -2;
    const auto look = [&](uint step) {
      const double x = double(filter_offset(table.data(), unit(step)));
      EXPECT_LE(std::abs(x), pellucid::pixel_filter_info(filter).radius);
      EXPECT_GE(x, previous) << "offsets keep the order of u, and so its strata";
      previous = x;
      worst = std::max(worst, std::abs(share_below(filter, x) - (step + 0.5) * 0x1p-24));
    };
    for (uint step = 0; step < 5000; ++step) look(step);  // the edge, where filters fade
    for (uint step = 5000; step < 1u << 24; step += 97) look(step);
    std::printf("%s: integral off by %.1e\n", pellucid::pixel_filter_info(filter).name, worst);
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(TwinFilter, Symmetric) {
  for (PixelFilter filter : tabulated) {
    const std::vector<float> table = table_of(filter);
    for (uint step = 0; step < 1u << 23; step += 61)
      ASSERT_EQ(filter_offset(table.data(), unit(step)),
                -filter_offset(table.data(), unit((1u << 24) - 1 - step)));
  }
}

TEST(TwinFilter, DensityOfRandomOffsets) {
  constexpr int cells = 60;
  constexpr uint draws = 1000000;
  const double alpha = sidak(family_alpha, 6);
  for (PixelFilter filter : tabulated) {
    const std::vector<float> table = table_of(filter);
    const double radius = pellucid::pixel_filter_info(filter).radius;
    std::vector<double> observed(cells, 0.0), expected(cells, 0.0);
    Moments mean;
    for (uint i = 0; i < draws; ++i) {
      const double x = double(filter_offset(table.data(), rng4({i, 0, 9}, DIM_PIXEL).x));
      mean.add(x);
      ++observed[size_t(std::min(cells - 1, int((x / radius + 1) * 0.5 * cells)))];
    }
    for (int c = 0; c < cells; ++c) {
      const auto edge = [&](int k) { return (2.0 * k / cells - 1) * radius; };
      expected[size_t(c)] =
          draws * (share_below(filter, edge(c + 1)) - share_below(filter, edge(c)));
    }
    const ChiSquare test = chi_square(observed, expected);
    EXPECT_TRUE(accepted(test, alpha)) << test.describe();
    EXPECT_GT(z_test(mean, 0.0, 0.0), alpha) << mean.mean;
  }
}

/// Standard deviations, known to 1e-4 by this many points.
TEST(TwinFilter, FourDifferentWidths) {
  std::vector<double> deviations{1 / std::sqrt(12.0)};  // the box
  for (PixelFilter filter : tabulated) {
    const std::vector<float> table = table_of(filter);
    double square = 0;
    for (uint k = 0; k < 4096; ++k)
      square += std::pow(double(filter_offset(table.data(), unit(4096 * k + 2048))), 2) / 4096;
    deviations.push_back(std::sqrt(square));
  }
  EXPECT_NEAR(deviations[1], 1 / std::sqrt(6.0), 1e-4);
  for (size_t a = 0; a < 4; ++a)
    for (size_t b = 0; b < a; ++b) EXPECT_GT(std::abs(deviations[a] - deviations[b]), 0.005);
  EXPECT_EQ(table_of(PixelFilter::box), std::vector<float>{0.0f}) << "the box needs no table";
}

}  // namespace
