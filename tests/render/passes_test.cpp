// Passes and pixels divided in any way give the bits of the undivided render: ranges, resumption,
// merging, crops, and bands that fit a small memory.
#include <gtest/gtest.h>

#include <cstring>

#include "base/error.h"
#include "integrators/registry.h"
#include "render_harness.h"
#include "support/kernel_folder.h"

namespace pellucid::test {
namespace {

constexpr int side = 24;
constexpr std::uint64_t all_passes = 37;  // neither a power of two nor whole blocks

const PackedScene& everything() {
  static const PackedScene packed = [] {
    Scene scene = scene_named("everything");
    scene.settings.width = scene.settings.height = side;
    return pack_scene(scene, {simd_width_for(test_device().info())});
  }();
  return packed;
}

RenderOptions options_for(PassRange passes) {
  RenderOptions o;
  o.width = o.height = side;
  o.passes = passes;
  o.seed = 11;
  o.plan.extra_features = all_scene_features();  // one program for all tests
  o.plan.kernel_dir = kernel_folder();
  return o;
}

Film render(const Integrator& method, const RenderOptions& options,
            std::optional<Film> start = {}) {
  Session session(test_device(), everything(), method, options, std::move(start));
  EXPECT_TRUE(session.run({}));
  EXPECT_EQ(error_count(session.counters()), 0u);
  Film film = session.film();
  film.set_aside();
  return film;
}

TEST(Passes, resumed_or_merged_is_uninterrupted) {
  for (const Integrator& method : integrators()) {
    const Film whole = render(method, options_for({0, all_passes}));
    const Film first = render(method, options_for({0, 13}));
    const Film resumed = render(method, options_for({0, all_passes}), first);
    EXPECT_TRUE(same_film(whole, resumed)) << method.name << " resumed";
    Film merged = render(method, options_for({20, all_passes}));
    merged.merge(first);
    merged.merge(render(method, options_for({13, 20})));
    EXPECT_TRUE(same_film(whole, merged)) << method.name << " merged";
    EXPECT_FALSE(same_film(first, merged));
  }
}

TEST(Passes, gaps_are_filled) {
  const Integrator& method = find_integrator("path");
  Film islands = render(method, options_for({5, 9}));
  islands.merge(render(method, options_for({20, 30})));
  EXPECT_TRUE(same_film(render(method, options_for({0, all_passes})),
                        render(method, options_for({0, all_passes}), islands)));
}

TEST(Passes, a_film_that_has_them_all_stays) {
  const Integrator& method = find_integrator("path");
  const Film whole = render(method, options_for({0, all_passes}));
  EXPECT_TRUE(same_film(whole, render(method, options_for({0, all_passes}), whole)));
}

/// But for rays: those of light paths belong to no pixel, and are booked somewhere in the window.
bool same_but_for_rays(FilmPixel a, FilmPixel b) {
  a.count[1] = b.count[1] = a.count[2] = b.count[2] = 0;
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(Passes, a_crop_is_a_part_of_the_whole) {
  const Window crop{5, 3, 11, 17};
  for (const Integrator& method : integrators()) {
    const Film whole = render(method, options_for({0, all_passes}));
    RenderOptions o = options_for({0, all_passes});
    o.crop = crop;
    const Film part = render(method, o);
    for (int y = 0; y < crop.height; ++y)
      for (int x = 0; x < crop.width; ++x) {
        const FilmPixel& a = part.pixels[std::size_t(y * crop.width + x)];
        const FilmPixel& b = whole.pixels[std::size_t((y + crop.y0) * side + x + crop.x0)];
        const bool same = method.uses(Bundle::splat) ? same_but_for_rays(a, b)
                                                     : std::memcmp(&a, &b, sizeof a) == 0;
        ASSERT_TRUE(same) << method.name << " at " << x << ", " << y;
      }
    const Image image = film_image(part, false, false);
    EXPECT_EQ(image.x0, crop.x0);
    EXPECT_EQ(image.full_width, side);
  }
}

TEST(Passes, bands_are_a_matter_of_memory_only) {
  for (const Integrator& method : integrators()) {
    const Film whole = render(method, options_for({0, all_passes}));
    RenderOptions o = options_for({0, all_passes});
    o.memory = 0;
    for (const auto& [name, size] : buffer_sizes(everything(), method, o, 5)) *o.memory += size;
    const MemoryPlan plan = plan_memory(test_device().info(), everything(), method, o);
    EXPECT_EQ(plan.tiles.size(), 5u);
    EXPECT_LE(plan.device_bytes(), *o.memory);
    EXPECT_TRUE(same_film(whole, render(method, o))) << method.name;
  }
}

TEST(Passes, what_does_not_fit_is_refused_with_figures) {
  const Integrator& method = find_integrator("path");
  RenderOptions o = options_for({0, 1});
  o.memory = 1000;
  try {
    Session(test_device(), everything(), method, o);
    FAIL();
  } catch (const DeviceError& e) {
    EXPECT_NE(std::string(e.what()).find("--memory allows"), std::string::npos) << e.what();
  }
  o.memory.reset();
  o.host_bytes = std::uint64_t{1} << 60;  // a checkpoint that no machine holds
  EXPECT_THROW(Session(test_device(), everything(), method, o), DeviceError);
  // Buffers above what one may hold: as many bands as that takes.
  DeviceInfo small = test_device().info();
  small.max_buffer = 1 << 20;
  const PackedScene nothing = pack_scene(Scene(), {8});
  RenderOptions large;
  large.width = large.height = 1000;
  const MemoryPlan plan = plan_memory(small, nothing, method, large);
  for (const auto& [name, bytes] : plan.buffers) EXPECT_LE(bytes, small.max_buffer) << name;
  int rows = 0;
  for (const Window& tile : plan.tiles) {
    EXPECT_EQ(tile.y0, rows);
    rows += tile.height;
  }
  EXPECT_EQ(rows, 1000);
  large.width = 30000;
  EXPECT_THROW(plan_memory(small, nothing, method, large), DeviceError);
}

}  // namespace
}  // namespace pellucid::test
