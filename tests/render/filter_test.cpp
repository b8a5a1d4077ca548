// Pixel filters and the Sobol sampler in whole renders: edges as wide as the filter says, energy
// kept, and the same values as by independent numbers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "equality.h"
#include "render_harness.h"
#include "support/statistics.h"

namespace pellucid::test {
namespace {

constexpr int width = 12, height = 4;
constexpr double edge_at = 6.25;  // film x left of which the picture shines

/// Camera on the z axis, a screen at z = -1 that ends at film x = edge_at.
Scene edge_scene() {
  Scene scene;
  scene.camera.fov = 90;  // along x: a pixel is 2/width of the screen's units
  scene.materials.push_back(Material{});
  const float x = float(2 * edge_at / width - 1);
  Mesh mesh;
  mesh.positions = {{-9, -9, -1}, {x, -9, -1}, {x, 9, -1}, {-9, 9, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Shape screen;
  screen.geometry = mesh;
  screen.emission = Emission{Rgb(1.0), 2};
  scene.shapes = {screen};
  return scene;
}

/// Share of the filter left of x pixels from its centre, by the trapezoidal rule.
double share_below(const PixelFilterInfo& f, double x) {
  constexpr int steps = 20000;
  const auto integral = [&](double to) {
    double sum = 0;
    for (int i = 0; i < steps; ++i)
      sum += 0.5 * to / steps * (f.value(to * i / steps) + f.value(to * (i + 1) / steps));
    return sum;
  };
  const double half = 0.5 * integral(std::min(std::abs(x), f.radius)) / integral(f.radius);
  return x < 0 ? 0.5 - half : 0.5 + half;
}

TEST(Filter, edges_are_blurred_by_it) {
  for (const PixelFilterInfo& f : pixel_filters()) {
    Build build{"naive", width, height, true};
    build.filter = f.filter;
    Renderer renderer(edge_scene(), build);
    Sampling run;
    run.spp = 16384;
    run.max_depth = 1;
    const Picture picture = renderer.render(run);
    for (int x = 0; x < width; ++x) {
      const double expected = share_below(f, edge_at - (x + 0.5));
      double mean = 0;
      for (int y = 0; y < height; ++y)
        mean += picture.pixels[std::size_t(y * width + x)][0].mean / height;
      // 65536 yes-or-no samples; 1e-5 for float sums and the edge's own place in float.
      const double error = std::sqrt(expected * (1 - expected) / (double(run.spp) * height));
      EXPECT_NEAR(mean, expected, 4.5 * error + 1e-5) << f.name << " column " << x;
    }
  }
}

TEST(Filter, value_of_a_uniform_scene_stays) {
  for (const PixelFilterInfo& f : pixel_filters())
    for (Sampler sampler : {Sampler::sobol, Sampler::random}) {
      Build build{"path", 16, 16, true};
      build.filter = f.filter;
      build.sampler = sampler;
      Renderer renderer(scene_named("white-furnace-mirror"), build);
      const Picture picture = renderer.render({16, 3, {}, MIS_BALANCE});
      for (const auto& pixel : picture.pixels)
        ASSERT_NEAR(pixel[0].mean, 1.0, 2e-6) << f.name << ", " << sampler_name(sampler);
    }
}

/// Runs of their own seeds, so that nothing is asked of samples within a run.
Runs runs_by(Sampler sampler, const char* method) {
  constexpr int runs = 16, tile = 8;
  Build build{method, 32, 32};
  build.sampler = sampler;
  Renderer renderer(scene_named("equal-lights"), build);
  Runs out(tile);
  for (int k = 0; k < runs; ++k)
    out.add(renderer.render({std::uint64_t(256 * tier_effort()), std::uint64_t(100 + k), {}}));
  return out;
}

TEST(Sobol, gives_what_random_numbers_give) {
  for (const char* method : {"nee", "path"}) {
    const auto reasons = compare_runs(runs_by(Sampler::sobol, method),
                                      runs_by(Sampler::random, method), family_alpha);
    for (const std::string& reason : reasons) ADD_FAILURE() << method << ": " << reason;
  }
}

}  // namespace
}  // namespace pellucid::test
