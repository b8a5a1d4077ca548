// What pixels show of the photon grid, on a floor in the sun where all of it is known: the photons
// that merge, the cells, the radius.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "integrators/registry.h"
#include "render/layers.h"
#include "render_harness.h"
#include "support/kernel_folder.h"
#include "support/test_scenes.h"

namespace pellucid::test {
namespace {

constexpr int side = 96;  // pixels
constexpr double height = 3, view = 2.4, first_radius = 0.1;
constexpr double pixel = view / side;  // on the floor
constexpr std::size_t pixels = std::size_t(side) * side;

/// A square from -1 to 1 in the light of a sun above it; the camera at `height` sees `view` of its
/// plane, so cells of 2 `first_radius` have borders between pixels.
Scene sunny_floor() {
  Scene scene = empty_scene();
  Mesh floor;
  floor.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_shape(scene, floor);
  scene.lights.push_back(DirectionalLight{{0, 0, -1}, Rgb(1.0)});
  scene.camera.origin = {0, 0, height};
  scene.camera.fov = 2 * std::atan(0.5 * view / height) * 180 / 3.14159265358979323846;
  scene.settings.width = scene.settings.height = side;
  scene.settings.filter = PixelFilter::box;
  return scene;
}

RenderOptions options_for(PassRange passes, double radius = first_radius) {
  RenderOptions o;
  o.width = o.height = side;
  o.passes = passes;
  o.radius = radius;
  o.plan.sampler = Sampler::random;
  o.plan.kernel_dir = kernel_folder();
  return o;
}

/// `bpm`, which merges light straight from the sun, too; its light vertices are splatted besides.
Integrator photons_and_vertices() {
  Integrator method = find_integrator("bpm");
  method.wishes.set(INTG_SPLAT);
  return with_layers(method, LAYERS_VERTICES | LAYERS_GRID, 1);
}

/// With light vertices beside the layers of the grid: the camera sees all of the floor's.
Film render(const Scene& scene, const RenderOptions& options, std::optional<Film> start = {}) {
  const PackedScene packed = pack_scene(scene, {simd_width_for(test_device().info())});
  const Integrator method = photons_and_vertices();
  Session session(test_device(), packed, method, options, std::move(start));
  EXPECT_TRUE(session.run({}));
  EXPECT_EQ(error_count(session.counters()), 0u) << describe_counters(session.counters());
  return session.film();
}

std::map<std::string, std::vector<float>> images(const Film& film) {
  std::map<std::string, std::vector<float>> by_name;
  for (AovChannel& image : layer_images(film.layers, film.passes.count()))
    by_name[image.name] = std::move(image.data);
  return by_name;
}

double sum(const std::vector<float>& values) {
  double total = 0;
  for (float v : values) total += double(v);
  return total;
}

bool on_floor(std::size_t x, std::size_t y) {
  const auto inside = [](std::size_t i) { return std::abs((double(i) + 0.5) * pixel - 1.2) < 1; };
  return inside(x) && inside(y);
}

// A radius as large as the floor: every pixel of it finds all that light brought there.
TEST(Photons, all_of_them) {
  const auto of = images(render(sunny_floor(), options_for({0, 1}, 3.0)));
  const double photons = sum(of.at("light.vertices"));
  // The sun's disc is as wide as the scene: 2 / pi of it is the floor's, 4.5 sigma.
  const double share = 2 / 3.14159265358979323846, n = double(pixels);
  EXPECT_NEAR(photons, n * share, 4.5 * std::sqrt(n * share * (1 - share)));
  for (std::size_t i = 0; i < pixels; ++i)
    ASSERT_EQ(of.at("photons")[i], on_floor(i % side, i / side) ? float(photons) : 0.0f) << i;
}

// N photons spread evenly over the sun's disc of radius R: N (r / R)^2 within a radius r.
TEST(Photons, as_many_as_their_density_says) {
  constexpr uint passes = 16;
  const auto of = images(render(sunny_floor(), options_for({0, passes})));
  double expected = 0;
  for (uint pass = 0; pass < passes; ++pass)  // [Knaus11] with the default alpha of 0.75
    expected += double(pixels) * std::pow(first_radius, 2) * std::pow(pass + 1, -0.25) / 2 / passes;
  double found = 0, count = 0;
  const auto border = std::size_t((0.2 + first_radius) / pixel) + 1;
  for (std::size_t y = border; y < side - border; ++y)
    for (std::size_t x = border; x < side - border; ++x, ++count)
      found += double(of.at("photons")[y * side + x]);
  // Photons of the inner part count many times; the spread is that of their number.
  const double inner = count * pixel * pixel / (2 * 3.14159265358979323846);
  const double error = 1 / std::sqrt(inner * double(pixels) * passes);
  std::printf("%.3f photons per pixel, expected %.3f +- %.3f\n", found / count, expected,
              error * expected);
  EXPECT_NEAR(found / count, expected, 4.5 * error * expected);
  EXPECT_LT(error, 0.005);
}

// Cells show what the grid of the first pass holds, whatever comes later: all photons once.
TEST(Photons, cells_hold_them_all) {
  constexpr std::size_t cell = 8;  // pixels
  ASSERT_NEAR(double(cell) * pixel, 2 * first_radius, 1e-12) << "borders between pixels";
  const auto first = images(render(sunny_floor(), options_for({0, 1})));
  const auto of = images(render(sunny_floor(), options_for({0, 3})));
  double all = 0, in_buckets = 0;
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      const std::size_t i = y * side + x, corner = (y - y % cell) * side + x - x % cell;
      for (const char* name : {"cells.photons", "cells.bucket", "cells.parity"})
        ASSERT_EQ(of.at(name)[i], of.at(name)[corner]) << name << ": a cell has one colour";
      ASSERT_GE(of.at("cells.bucket")[i], of.at("cells.photons")[i]);
      const float parity = of.at("cells.parity")[i];
      ASSERT_EQ(parity != 0, on_floor(x, y));
      if (i != corner || !on_floor(x, y)) continue;
      all += double(of.at("cells.photons")[i]), in_buckets += double(of.at("cells.bucket")[i]);
      for (const auto& [dx, dy] : {std::pair<std::size_t, std::size_t>{cell, 0}, {0, cell}}) {
        if (!on_floor(x + dx, y + dy)) continue;
        EXPECT_EQ(parity + of.at("cells.parity")[i + dy * side + dx], 3) << "a chess board";
      }
    }
  EXPECT_EQ(all, sum(first.at("light.vertices")));
  EXPECT_GE(in_buckets, all);
}

TEST(Photons, radius_in_pixels) {
  // At an angle a to the axis the floor is height / cos a away, where a pixel of area cos^3 a / D^2
  // in solid angle is height sqrt(cos a) / D wide, across the ray.
  const auto of = images(render(sunny_floor(), options_for({0, 1})));
  const auto wide = [&](double x, double y) {
    const double cos_a = height / std::sqrt(x * x + y * y + height * height);
    return first_radius / pixel / std::sqrt(cos_a);
  };
  for (std::size_t y = 0; y < side; ++y)
    for (std::size_t x = 0; x < side; ++x) {
      const double found = double(of.at("radius")[y * side + x]);
      if (!on_floor(x, y)) {
        ASSERT_EQ(found, 0);
        continue;
      }
      // Somewhere in the pixel, whose inner and outer corners have the extremes; roundings of
      // floats, of which some 10 are in it.
      const double u = std::abs((double(x) + 0.5) * pixel - 1.2) - 0.5 * pixel;
      const double v = std::abs((double(y) + 0.5) * pixel - 1.2) - 0.5 * pixel;
      const double a = wide(u, v), b = wide(u + pixel, v + pixel);
      ASSERT_GE(found, std::min(a, b) * (1 - 1e-6)) << x << " " << y;
      ASSERT_LE(found, std::max(a, b) * (1 + 1e-6)) << x << " " << y;
    }
}

// Seen in a mirror, a floor is as far away as the path is long.
TEST(Photons, radius_in_a_mirror) {
  Scene scene = sunny_floor();
  Material mirror;
  mirror.kind = MaterialKind::mirror;
  mirror.reflectance = Rgb(1.0);
  scene.materials.push_back(mirror);
  add_shape(scene, Disk{{0, 0, 2}, {0, 0, -1}, 0.2}).material = 1;
  scene.camera.origin = {0, 0, 1};
  scene.camera.forward = {0, 0, 1}, scene.camera.right = {-1, 0, 0};
  scene.camera.fov = 5;
  const auto of = images(render(scene, options_for({0, 1})));
  const double distance = 1 + 2, tan = std::tan(2.5 * 3.14159265358979323846 / 180);
  const double there = 2 * distance * tan / side;
  // cos a is 0.998 in the corners.
  for (float found : of.at("radius")) ASSERT_NEAR(double(found), first_radius / there, 0.1);
}

TEST(Photons, split_any_way) {
  const Scene scene = sunny_floor();
  const Film whole = render(scene, options_for({0, 5}));
  const Film first = render(scene, options_for({0, 2}));
  EXPECT_FALSE(whole.layers == first.layers);
  EXPECT_TRUE(whole.layers == render(scene, options_for({0, 5}), first).layers) << "resumed";
  Film merged = render(scene, options_for({2, 5}));
  EXPECT_EQ(sum(images(merged).at("cells.parity")), 0) << "pass 0 alone paints cells";
  merged.merge(first);
  EXPECT_TRUE(whole.layers == merged.layers) << "merged";
  RenderOptions o = options_for({0, 5});
  o.plan.group = 8;
  o.plan.vertices_per_path = 0.01;  // eye paths are traced anew for want of room
  EXPECT_TRUE(whole.layers == render(scene, o).layers) << "groups of 8, little room";
  o = options_for({0, 5});
  o.crop = Window{10, 20, 40, 30};
  const auto part = images(render(scene, o)), all = images(whole);
  for (const auto& [name, values] : part)
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(values[i], all.at(name)[(i / 40 + 20) * side + i % 40 + 10]) << name;
}

}  // namespace
}  // namespace pellucid::test
