// Splats get the filter that samples are drawn from: the pixel drawn for a point of the film, times
// its weight, has the filter's value as its mean, and that value is the density of film positions.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using namespace pellucid::test;
using pellucid::PixelFilter;

const PixelFilter tabulated[] = {PixelFilter::tent, PixelFilter::gaussian,
                                 PixelFilter::blackman_harris};

pellucid::PackedScene packed_with(PixelFilter filter) {
  pellucid::Scene scene = empty_scene(0.5);
  scene.settings.filter = filter;
  return pellucid::pack_scene(scene, {SIMD_WIDTH});
}

double integral_of(const pellucid::PixelFilterInfo& info) {
  return 2 * integrate([&](double t, double) { return info.value(t); }, 0, info.radius, 0, 1, 1e-9);
}

TEST(AuditFilter, SplatsHaveTheFiltersValue) {
  Random random(1);
  for (PixelFilter filter : tabulated) {
    const pellucid::PackedScene packed = packed_with(filter);
    const pellucid::PixelFilterInfo& info = pellucid::pixel_filter_info(filter);
    const double whole = integral_of(info);
    const auto exact = [&](double x) {
      return std::abs(x) <= info.radius ? info.value(std::abs(x)) / whole : 0.0;
    };
    for (int i = 0; i < 200; ++i) {
      const double x = random.uniform(-3, 100);
      constexpr uint strata = 1 << 14;
      std::vector<double> mean(120, 0.0);  // of pixels -10 .. 109
      for (uint k = 0; k < strata; ++k) {
        real weight;
        const int j = filter_pixel(packed.filter_table.data(), packed.filter_values.data(), real(x),
                                   real((k + 0.5) / strata), &weight);
        mean.at(std::size_t(j + 10)) += double(weight) / strata;
      }
      for (int j = -10; j < 110; ++j)
        // A share is known to one stratum; the table of values to (radius/1024)^2 of its bend, and
        // x in float to 4e-6.
        ASSERT_NEAR(mean[std::size_t(j + 10)], exact(x - (j + 0.5)), 1.5 / strata + 2e-5)
            << info.name << " at " << x << ", pixel " << j;
    }
  }
}

TEST(AuditFilter, ValuesAreTheDensityOfFilmPositions) {
  for (PixelFilter filter : tabulated) {
    const pellucid::PackedScene packed = packed_with(filter);
    const double radius = pellucid::pixel_filter_info(filter).radius;
    // The share of samples below an offset is the integral of the values up to there.
    for (int i = 1; i < 200; ++i) {
      const double u = i / 200.0;
      const double x = double(filter_offset(packed.filter_table.data(), real(u)));
      constexpr int parts = 4096;
      double below = 0.5;
      for (int k = 0; k < parts; ++k) {
        const double at = std::abs(x) * (k + 0.5) / parts;
        below +=
            x / parts *
            double(filter_value(packed.filter_values.data(), real(at * FILTER_STEPS / radius)));
      }
      // The table of offsets is good for 1e-6 of the integral, that of values for a little more.
      EXPECT_NEAR(below, u, 1e-5) << pellucid::pixel_filter_info(filter).name;
    }
  }
}

}  // namespace
