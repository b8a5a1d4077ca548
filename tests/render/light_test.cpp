// What walks from the lights alone can get wrong: the camera's importance over the picture (CF14),
// light through glass that no other method sees (CF10), pixel filters of splats, and the number of
// paths. Both ends of a path (CF16): reciprocity_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "closed_form_cases.h"
#include "equality.h"
#include "render_harness.h"
#include "stability/closed_forms.h"
#include "stability/small_scenes.h"
#include "support/statistics.h"

namespace pellucid::test {
namespace {

constexpr double pi = 3.14159265358979323846;
const char* const from_light[] = {"light", "bdpt"};

// What the camera pass of `light` leaves to walks from the lights is nothing where all that is seen
// is emitters by way of mirrors, glass and coats: the very bits of `naive`, which it draws alike.
TEST(Light, camera_sees_emitters_through_delta_surfaces) {
  for (const char* material : {"mirror", "glass", "coat"}) {
    Scene scene = scene_named("ball");
    scene.materials.clear();
    scene.shapes.clear();
    scene.lights.clear();
    Material m;
    m.reflectance = Rgb(0.75);
    m.kind = material == std::string("mirror")  ? MaterialKind::mirror
             : material == std::string("glass") ? MaterialKind::dielectric
                                                : MaterialKind::plastic;
    if (m.kind == MaterialKind::plastic) m.reflectance = Rgb(0.0);  // a coat over black
    scene.materials.push_back(m);
    Shape ball;
    ball.geometry = Sphere{{0, 0, 0}, 1.0};
    scene.shapes.push_back(ball);
    scene.lights.push_back(ConstantEnvironment{Rgb(0.5, 1, 2)});
    scene.camera.origin = {0, 0, 4};
    Sampling run;
    run.spp = 64;
    run.max_depth = 8;
    Renderer light(scene, {"light", 16, 16}), naive(scene, {"naive", 16, 16});
    const Picture seen = light.render(run), expected = naive.render(run);
    EXPECT_GT(expected.image(0).mean, 0.01) << material;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(seen.pixels[i][c].mean, expected.pixels[i][c].mean) << material << " " << i;
  }
}

/// Mean of a block of pixels over runs.
struct Block {
  int x0, y0, size;
  Sample sample = {};

  void add(const Picture& p) { sample.push_back(p.block_mean(0, x0, y0, size)); }
};

/// Blocks as runs of `spp` samples give them; lengths up to `depth`, without those up to `without`
/// (drawn by the same numbers).
void render_blocks(Renderer& renderer, std::vector<Block>& blocks, int runs, std::uint64_t spp,
                   uint depth, uint without = 0) {
  Sampling run;
  run.spp = spp;
  for (int k = 0; k < runs; ++k) {
    run.seed = std::uint64_t(500 + k);
    run.max_depth = depth;
    const Picture all = renderer.render(run);
    run.max_depth = without;
    const Picture shorter = without ? renderer.render(run) : all;
    for (Block& b : blocks) {
      b.add(all);
      if (without) b.sample.back() -= shorter.block_mean(0, b.x0, b.y0, b.size);
    }
  }
}

/// The furnace as a long box of which the camera at one end frames the other: so walks end in
/// narrow views, too.
Scene furnace_corridor(double fov) {
  Scene scene = scene_named("furnace");
  const float far = float(-1 / std::tan(0.5 * fov * pi / 180)), near = 0.25f;
  Mesh& mesh = std::get<Mesh>(scene.shapes.at(0).geometry);
  mesh.positions = {{-1, -1, far},  {1, -1, far},  {1, 1, far},  {-1, 1, far},
                    {-1, -1, near}, {1, -1, near}, {1, 1, near}, {-1, 1, near}};
  mesh.normals.clear();
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {5, 4, 7}, {5, 7, 6}, {4, 0, 3}, {4, 3, 7},
                    {1, 5, 6}, {1, 6, 2}, {3, 2, 6}, {3, 6, 7}, {4, 5, 1}, {4, 1, 0}};
  scene.camera.origin = {0, 0, 0};
  scene.camera.right = {1, 0, 0}, scene.camera.up = {0, 1, 0}, scene.camera.forward = {0, 0, -1};
  scene.camera.fov = fov;
  return scene;
}

// CF14: in a furnace, light of one path length is rho^k Le in every pixel, whatever angle the
// camera sees it under: a wrong power of the cosine darkens or lightens corners.
TEST(Light, corners_are_as_bright_as_the_centre) {
  constexpr int size = 24, block = 6, runs = 32;
  constexpr double value = 0.5 * 0.5;  // rho Le of the red channel, at 2 segments
  struct View {
    double fov;
    Scene scene;
    std::uint64_t walks;  ///< millions; the narrower the view, the fewer end in it
  };
  Scene wide = scene_named("furnace"), widest = wide;
  wide.camera.fov = 60;
  widest.camera.fov = 150;
  for (const View& view :
       {View{10, furnace_corridor(10), 24}, View{60, wide, 16}, View{150, widest, 16}}) {
    constexpr uint paths = 1 << 14;
    Build build{"light", size, size};
    build.light_paths = paths;
    Renderer renderer(view.scene, build);
    const int end = size - block, middle = size / 2 - block;
    std::vector<Block> blocks{{0, 0, block},
                              {end, 0, block},
                              {0, end, block},
                              {end, end, block},
                              {middle, middle, 2 * block}};
    const double spp = double(view.walks) * 1e6 * tier_effort() / paths / runs;
    render_blocks(renderer, blocks, runs, std::uint64_t(spp), 2, 1);
    Sample corners(runs, 0.0);
    for (std::size_t k = 0; k < runs; ++k)
      for (std::size_t i = 0; i < 4; ++i) corners[k] += blocks[i].sample[k] / 4;
    EXPECT_EQ(judge(estimate(corners), value, 1e-5), "") << "corners, fov " << view.fov;
    EXPECT_EQ(judge(estimate(blocks[4].sample), value, 1e-5), "") << "centre, fov " << view.fov;
  }
}

// CF10. Views of a parallel plane are affine, so blocks of pixels average over it evenly.
TEST(Light, through_glass_is_seen_by_walks_from_the_light_alone) {
  EXPECT_NEAR(irradiance_below_pane(0, 2, 0.5, 1.5), 0.274195, 1e-6);
  constexpr int size = 16, runs = 32;
  constexpr double half = 0.75;  // of the picture on the floor
  const Scene scene = pane_scene(scene_named("slab"));
  for (const char* method : from_light) {
    Build build{method, size, size};
    build.light_paths = 1 << 13;
    Renderer renderer(scene, build);
    std::vector<Block> blocks{{0, 0, size}, {size / 4, size / 4, size / 2}};
    render_blocks(renderer, blocks, runs, std::uint64_t(64 * tier_effort()), 4);
    for (const Block& b : blocks) {
      const double edge = half * b.size / size;  // the same on either side of the axis
      const auto irradiance = [](double x, double y) {
        return irradiance_below_pane(std::hypot(x, y), 2, 0.5, 1.5);
      };
      const double mean = integrate(irradiance, 0, edge, 0, edge, 1e-9) / (edge * edge);
      EXPECT_EQ(judge(estimate(b.sample), 0.5 * mean / pi, 1e-5), "")
          << method << ", block of " << b.size;
    }
  }
  for (const char* method : {"naive", "nee", "path", "reference"}) {
    Renderer renderer(scene, {method, size, size});
    Sampling run;
    run.max_depth = 4;
    for (const auto& pixel : renderer.render(run).pixels)
      for (const Estimate& e : pixel) ASSERT_EQ(e.mean, 0.0) << method;
  }
}

/// Runs of a method, whose image's mean is known to `relative`.
Runs runs_of(const Scene& scene, Build build, std::uint64_t seed, double relative) {
  constexpr int count = 24;
  constexpr int tile = 8;
  Renderer renderer(scene, build);
  Sampling run;
  run.max_depth = long_enough;
  run.seed = seed + 99;
  run.spp = renderer.spp_for(run, relative, std::uint64_t(100000 * tier_effort())) /
                std::uint64_t(count) +
            1;
  Runs runs(tile);
  for (int k = 0; k < count; ++k) {
    run.seed = seed + std::uint64_t(k);
    runs.add(renderer.render(run));
  }
  return runs;
}

/// The picture's border as a tile of its own: light that a filter brings in from outside belongs
/// to it.
Sample border_of(const std::vector<Picture>& pictures) {
  Sample s;
  for (const Picture& p : pictures) {
    double sum = 0;
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        if (x == 0 || y == 0 || x == p.width - 1 || y == p.height - 1)
          sum += p.pixels[std::size_t(y * p.width + x)][0].mean;
    s.push_back(sum / (2 * (p.width + p.height) - 4));
  }
  return s;
}

// Splats are given to pixels by the filter that camera rays are drawn from, over edges and over the
// border of the picture.
TEST(Light, splats_are_filtered_like_samples) {
  constexpr int size = 16, tile = 2, runs = 24;
  const Scene scene = scene_named("equal-shading");
  for (PixelFilter filter : {PixelFilter::tent, PixelFilter::gaussian}) {
    Runs tiles[2] = {Runs(tile), Runs(tile)};
    Sample border[2];
    for (int side : {0, 1}) {
      Build build{side ? "light" : "path", size, size};
      build.filter = filter;
      Renderer renderer(scene, build);
      std::vector<Picture> pictures;
      for (int k = 0; k < runs; ++k) {
        pictures.push_back(renderer.render({std::uint64_t((side ? 1024 : 512) * tier_effort()),
                                            std::uint64_t(700 + 50 * side + k),
                                            {}}));
        tiles[side].add(pictures.back());
      }
      border[side] = border_of(pictures);
    }
    for (const std::string& reason : compare_runs(tiles[1], tiles[0], family_alpha / 4))
      ADD_FAILURE() << pixel_filter_info(filter).name << ": " << reason;
    EXPECT_EQ(
        welch(border[1], border[0], family_alpha / 4, tier_tolerance() * estimate(border[0]).mean),
        "")
        << pixel_filter_info(filter).name << ": border";
  }
}

TEST(Light, number_of_paths_does_not_change_the_mean) {
  const double relative = tier_tolerance() / 13;
  const Scene scene = scene_named("equal-paint");
  for (const char* method : from_light) {
    Build build{method, 24, 24};
    const Runs one_per_pixel = runs_of(scene, build, 100, relative);
    for (uint paths : {100u, 2000u}) {
      build.light_paths = paths;
      for (const std::string& reason : compare_runs(runs_of(scene, build, 100 + paths, relative),
                                                    one_per_pixel, family_alpha / 4))
        ADD_FAILURE() << method << ", " << paths << " light paths: " << reason;
    }
  }
}

}  // namespace
}  // namespace pellucid::test
