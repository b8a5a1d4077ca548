// Widths and builtins: one scene must look the same through every layout of nodes and leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "integrators/registry.h"
#include "render/session.h"

namespace pellucid {
namespace {

/// Triangles, a sphere and a disk, some of them duplicated so that ties decide.
Scene mixed_scene() {
  Scene scene;
  scene.settings.width = scene.settings.height = 32;
  scene.camera.origin = {0.1, 0.2, 6.0};
  scene.materials.push_back(Material{});
  scene.lights.push_back(ConstantEnvironment{});
  Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    // A fan of slivers at irrational angles: many shared edges and one shared vertex.
    const double a = 0.7548776662466927 * i, b = a + 0.3;
    const auto base = static_cast<uint>(mesh.positions.size());
    mesh.positions.push_back({0, 0, 0});
    mesh.positions.push_back({std::cos(a), std::sin(a), 0.01 * (i % 7)});
    mesh.positions.push_back({std::cos(b), std::sin(b), 0.01 * (i % 5)});
    mesh.triangles.push_back({base, base + 1, base + 2});
    if (i % 10 == 0) mesh.triangles.push_back({base, base + 1, base + 2});
  }
  Shape fan;
  fan.geometry = mesh;
  Shape sphere;
  sphere.geometry = Sphere{{0.8, -0.8, 0.3}, 0.5};
  Shape disk;
  disk.geometry = Disk{{-0.8, 0.8, 0.3}, {0, 0, 1}, 0.6};
  scene.shapes = {fan, sphere, disk, sphere};
  return scene;
}

std::vector<FilmPixel> film_of(int width, bool builtins) {
  const Device device = Device::open("");
  const PackedScene packed = pack_scene(mixed_scene(), {width});
  RenderOptions options;
  options.width = options.height = 32;
  options.passes = PassRange{0, 4};
  options.plan.simd_builtins = builtins;
  Session session(device, packed, find_integrator("path"), options);
  session.run({});
  EXPECT_EQ(error_count(session.counters()), 0u);
  return session.film().pixels;
}

bool same_bits(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b) {
  return std::memcmp(a.data(), b.data(), a.size() * sizeof(FilmPixel)) == 0;
}

TEST(LayoutTest, BuiltinsAndPortableCodeGiveTheSameBits) {
  for (int width : {4, 8, 16})
    EXPECT_TRUE(same_bits(film_of(width, true), film_of(width, false))) << width;
}

TEST(LayoutTest, EveryWidthGivesTheSameBits) {
  const std::vector<FilmPixel> four = film_of(4, true);
  EXPECT_TRUE(same_bits(four, film_of(8, true)));
  EXPECT_TRUE(same_bits(four, film_of(16, true)));
}

}  // namespace
}  // namespace pellucid
