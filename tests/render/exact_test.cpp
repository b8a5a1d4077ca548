// Exact invariances: the film must have the same bits (numerics.md A3, A5). No tolerance to argue
// about.
#include <gtest/gtest.h>

#include <cmath>

#include "render_harness.h"
#include "stability/exact.h"

namespace pellucid::test {
namespace {

const Scene& everything() {
  static const Scene scene = scene_named("everything");
  return scene;
}

Film film_of(const Scene& scene, const Build& build) {
  return session_render(scene, build, short_run).film;
}

TEST(Exact, twice_the_same) {
  for (const char* m : methods) {
    const auto film = film_of(everything(), build_of(m));
    EXPECT_TRUE(same_film(film, film_of(everything(), build_of(m)))) << m;
    Sampling other = short_run;
    other.seed = 8;
    EXPECT_FALSE(same_film(film, session_render(everything(), build_of(m), other).film))
        << m << ": the seed must matter";
  }
}

TEST(Exact, features_auto_or_all) {
  for (const char* m : methods) {
    const auto film = film_of(everything(), build_of(m));
    Build b = build_of(m);
    b.specialised = true;
    EXPECT_TRUE(same_film(film, film_of(everything(), b))) << m;
  }
  for (const char* name :
       {"rectangle-light", "sphere-light", "white-furnace-glass", "equal-metal"}) {
    const Scene scene = scene_named(name);
    Build b = build_of("path");
    const auto film = film_of(scene, b);
    b.specialised = true;
    EXPECT_TRUE(same_film(film, film_of(scene, b))) << name;
  }
}

TEST(Exact, compare_instructions_of_the_processor) {
  for (int lanes : {4, 8, 16}) {
    Build b = build_of("path");
    b.simd_width = lanes;
    const auto film = film_of(everything(), b);
    b.simd_builtins = false;
    EXPECT_TRUE(same_film(film, film_of(everything(), b))) << lanes << " lanes";
  }
}

// Another width is another tree, but a triangle's hit is computed alike in any lane and ties go to
// the lowest id, so the closest hits, and with them all bits, are the same.
TEST(Exact, width_of_the_tree) {
  for (const char* m : one_per_pass) {
    Build b = build_of(m);
    b.simd_width = 4;
    const auto film = film_of(everything(), b);
    for (int lanes : {8, 16}) {
      b.simd_width = lanes;
      const auto wider = film_of(everything(), b);
      EXPECT_TRUE(same_film(film, wider))
          << m << ", " << lanes << " lanes: " << different_pixels(film, wider) << " pixels";
    }
  }
}

// What a render has after n iterations is what a render of n iterations gives, whatever the
// batches.
TEST(Exact, shorter_render_is_the_beginning_of_a_longer_one) {
  std::vector<Film> stages;
  RenderHooks hooks;
  hooks.wants_film = [] { return true; };
  hooks.film = [&](const Film& film) { stages.push_back(film); };
  Sampling long_run = short_run;
  long_run.spp = 2000;
  long_run.max_depth = long_enough;
  session_render(everything(), build_of("path"), long_run, hooks);
  ASSERT_GE(stages.size(), 2u);
  for (const Film& stage : stages) {
    Sampling run = long_run;
    run.spp = stage.passes.count();
    EXPECT_TRUE(same_film(stage, session_render(everything(), build_of("path"), run).film))
        << run.spp << " iterations";
  }
}

}  // namespace
}  // namespace pellucid::test
