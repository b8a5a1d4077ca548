// Replays are the samples of a render again, bit for bit, and what they tell of them fits together.
#include "render/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "integrators/registry.h"
#include "render/fireflies.h"
#include "render_harness.h"
#include "shared/limits.h"
#include "support/kernel_folder.h"

namespace pellucid::test {
namespace {

constexpr int side = 24;
constexpr std::uint64_t passes = 21;

/// All lobes, lights and shapes for `path`; for the others what kernels are built for quickly: a
/// diffuse room with gloss and glass.
const PackedScene& scene_for(const std::string& method) {
  static std::map<std::string, PackedScene> packed;
  const std::string name = method == "path" ? "everything" : "mixed-room";
  if (!packed.count(name)) {
    Scene scene = scene_named(name);
    scene.settings.width = scene.settings.height = side;
    packed[name] = pack_scene(scene, {simd_width_for(test_device().info())});
  }
  return packed[name];
}

RenderOptions options_for(std::uint64_t last) {
  RenderOptions o;
  o.width = o.height = side;
  o.passes = PassRange{0, last};
  o.seed = 11;
  o.plan.kernel_dir = kernel_folder();
  return o;
}

Film render(const Integrator& method, const RenderOptions& options) {
  Session session(test_device(), scene_for(method.name), method, options);
  EXPECT_TRUE(session.run({}));
  return session.film();
}

/// Of its kind and depth, or null.
const PathEvent* find(const std::vector<PathEvent>& walk, uint kind, uint depth) {
  for (const PathEvent& e : walk)
    if (e.kind == kind && e.depth == depth) return &e;
  return nullptr;
}

/// One part of a sample: its numbers fit each other and the walk that found it.
void expect_sound(const PathEvent& e, const Replay& r, const Integrator& method) {
  EXPECT_GE(e.p.w, 0.0f);
  EXPECT_LE(e.p.w, 1.0f + 1e-5f);  // weights are quotients of rounded sums
  for (const auto& [value, brought] :
       {std::pair{e.value.x, e.brought.x}, {e.value.y, e.brought.y}, {e.value.z, e.brought.z}})
    EXPECT_NEAR(brought, value * e.p.w, 1e-6f * std::abs(value));  // some roundings of a product
  if (e.on_light) {
    EXPECT_EQ(e.t, 1u);
    EXPECT_EQ(e.s, e.depth + 1);
    return;
  }
  EXPECT_EQ(e.path, uint(r.y * side + r.x));
  EXPECT_EQ(e.t, e.depth + 1);
  if (e.kind != EVENT_EMISSION) {
    EXPECT_NE(find(r.eye, EVENT_VERTEX, e.depth), nullptr) << "a vertex that found it";
  }
  if (e.kind == EVENT_CONNECT || e.kind == EVENT_MERGE) {
    EXPECT_GE(e.s, 2u);
    EXPECT_NE(e.partner, NONE);
  }
  EXPECT_TRUE(e.kind != EVENT_MERGE || method.wishes.has(INTG_MERGE));
}

/// The light path of the brightest part leads to where that part says.
void expect_light_path(const Replay& r) {
  ASSERT_FALSE(r.brought.empty());
  const PathEvent& e = r.brought.front();
  const bool has_light = e.on_light || e.partner != NONE;
  ASSERT_EQ(r.light.empty(), !has_light);
  if (!has_light) return;
  EXPECT_NE(find(r.light, EVENT_START, 0), nullptr);
  const PathEvent* vertex = find(r.light, EVENT_VERTEX, e.s - 1);
  ASSERT_NE(vertex, nullptr);
  EXPECT_EQ(vertex->p.x, e.p.x);
  EXPECT_EQ(vertex->p.y, e.p.y);
  EXPECT_EQ(vertex->p.z, e.p.z);
}

class ReplayOf : public ::testing::TestWithParam<const char*> {};

TEST_P(ReplayOf, brightest_samples_are_those_of_the_render) {
  const Integrator& method = find_integrator(GetParam());
  const RenderOptions options = options_for(passes);
  const Film film = render(method, options);
  const std::vector<Firefly> list = fireflies(film, 4);
  ASSERT_FALSE(list.empty());  // chance alone lights few pixels
  for (const Firefly& f : list) {
    const Replay r =
        replay(test_device(), scene_for(method.name), method, options, f.x, f.y, f.pass);
    const std::string where =
        std::to_string(f.x) + "," + std::to_string(f.y) + "," + std::to_string(f.pass);
    EXPECT_TRUE(r.adds_up()) << where;
    EXPECT_EQ(double(r.luminance), f.luminance) << where;
    for (std::size_t c = 0; c < 3; ++c)  // the film rounds to its step
      EXPECT_NEAR(double(r.sum[c]), r.film[c], std::ldexp(1.0, film.lsb)) << where;
    for (const PathEvent& e : r.brought) expect_sound(e, r, method);
    expect_light_path(r);
  }
}

/// Samples that nothing marks, with fewer light paths than pixels.
TEST_P(ReplayOf, any_sample_is_that_of_the_render) {
  const Integrator& method = find_integrator(GetParam());
  RenderOptions options = options_for(1);
  if (method.walks_from_lights()) options.light_paths = 333;
  const Film film = render(method, options);
  for (const auto& [x, y] : {std::pair{3, 20}, {12, 12}, {23, 0}}) {
    const Replay r = replay(test_device(), scene_for(method.name), method, options, x, y, 0);
    const FilmPixel& pixel = film.pixels[std::size_t(y * side + x)];
    EXPECT_EQ(r.luminance, pixel.peak) << x << "," << y;
    EXPECT_TRUE(r.adds_up()) << x << "," << y;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReplayOf,
                         ::testing::Values("naive", "nee", "path", "reference", "light", "bdpt",
                                           "sppm", "bpm", "vcm"),
                         [](const auto& method) { return std::string(method.param); });

TEST(Replay, compact_vertices_and_filters_change_nothing_of_that) {
  const Integrator& method = find_integrator("vcm");
  RenderOptions options = options_for(4);
  options.plan.compact_vertices = true;
  Scene scene = scene_named("mixed-room");
  scene.settings.width = scene.settings.height = side;
  scene.settings.filter = PixelFilter::gaussian;
  const PackedScene packed = pack_scene(scene, {simd_width_for(test_device().info())});
  Session session(test_device(), packed, method, options);
  ASSERT_TRUE(session.run({}));
  for (const Firefly& f : fireflies(session.film(), 4)) {
    const Replay r = replay(test_device(), packed, method, options, f.x, f.y, f.pass);
    EXPECT_TRUE(r.adds_up());
    EXPECT_EQ(double(r.luminance), f.luminance);
  }
}

}  // namespace
}  // namespace pellucid::test
