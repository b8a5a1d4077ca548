// Throughput that --max-depth cuts off: by closed form, in the same bits however passes, pixels and
// work are divided, and nothing where nothing is cut.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "integrators/registry.h"
#include "render_harness.h"
#include "stability/estimates.h"
#include "stability/exact.h"
#include "support/kernel_folder.h"

namespace pellucid::test {
namespace {

/// A closed room, all walls of one albedo.
Scene furnace(double albedo) {
  Scene scene = scene_named("furnace");
  for (Material& m : scene.materials) m.reflectance = Rgb(albedo);
  return scene;
}

/// A white ball under an even sky: paths leave after one bounce.
Scene open_scene() {
  Scene scene = scene_named("white-furnace-diffuse");
  scene.shapes.erase(scene.shapes.begin(), scene.shapes.end() - 1);
  return scene;
}

bool walks_from_lights(const std::string& method) {
  return find_integrator(method).walks_from_lights();
}

/// Eye paths of these end by design, before any cap.
bool eye_ends(const std::string& method) {
  return method == "light" || method == "sppm";
}

void expect_share(const std::string& what, const Estimate& e, double expected) {
  const double noise = 4.5 * e.error();
  EXPECT_LT(std::abs(e.mean - expected), noise + 1e-5 * expected)
      << what << ": " << e.mean << " +- " << e.error() << ", expected " << expected;
  EXPECT_LT(noise, 0.06 * expected) << what << ": too noisy to see an error";
}

TEST(DepthCut, is_albedo_to_the_power_of_the_cap) {
  for (double albedo : {0.5, 0.9})
    for (const char* method : methods) {
      Renderer renderer(furnace(albedo), build_of(method));
      for (uint depth : {1u, 2u, 5u}) {
        const std::array<Estimate, CUT_COUNT> found = measured_cuts(renderer, {512, 3, depth});
        const std::string what = fmt::format("{}, albedo {}, cap {}", method, albedo, depth);
        if (eye_ends(method))
          EXPECT_EQ(found[CUT_camera].mean, 0.0) << what;
        else
          expect_share(what + ", camera", found[CUT_camera], std::pow(albedo, depth));
        // The last segment is that to the camera.
        if (walks_from_lights(method))
          expect_share(what + ", light", found[CUT_light], std::pow(albedo, depth - 1));
      }
    }
}

TEST(DepthCut, is_nothing_where_paths_end_by_themselves) {
  for (const char* method : methods) {
    Renderer open(open_scene(), build_of(method));
    open.render({16, 7, 3u});
    const DepthCuts none = open.take_cuts();
    EXPECT_EQ(none[CUT_camera].paths, 16u * 24 * 24) << method;
    for (const DepthCut& cut : none) EXPECT_EQ(cut.share(), 0.0) << method;
    Renderer endless(furnace(0.5), build_of(method));
    endless.render({16, 7, {}});
    const DepthCuts uncapped = endless.take_cuts();
    for (const DepthCut& cut : uncapped) {
      EXPECT_EQ(cut.paths, 0u) << method << ": no cap, nothing to tell";
      EXPECT_EQ(cut.whole, 0u) << method;
      EXPECT_EQ(cut.part, 0u) << method;
    }
    EXPECT_EQ(cuts_verdict(none) + cuts_verdict(uncapped), "");
  }
}

/// All bits.
std::string text(const DepthCuts& cuts) {
  std::string all;
  for (const DepthCut& c : cuts) all += fmt::format("{} {} {}; ", c.whole, c.part, c.paths);
  return all;
}

TEST(DepthCut, is_a_sum_in_any_order) {
  const Scene scene = scene_named("everything");
  const auto cuts_of = [&](const Build& build) {
    Renderer renderer(scene, build);
    renderer.render({16, 7, 4u});
    return text(renderer.take_cuts());
  };
  for (const char* method : one_per_pass) {
    const Build b = build_of(method);
    const std::string whole = cuts_of(b);
    EXPECT_NE(whole.find_first_of("123456789"), std::string::npos);
    Build groups = b, parts = b, no_int64 = b, slices = b, retraced = b;
    groups.group = 8;
    parts.launch_items = 100;
    no_int64.int64_atomics = false;
    slices.slice_rows = 5;
    retraced.vertices_per_path = 0.1;  // all are traced again, with more room
    retraced.slice_rows = 8;
    Build tight = retraced;  // and in smaller slices
    tight.slice_rows = 0;
    tight.growth = 150000;
    EXPECT_EQ(whole, cuts_of(groups)) << method << ", work-groups";
    EXPECT_EQ(whole, cuts_of(parts)) << method << ", parts of launches";
    if (find_integrator(method).name == "light") {  // one is enough to compile anew
      EXPECT_EQ(whole, cuts_of(no_int64)) << method << ", without 64-bit atomics";
    }
    EXPECT_EQ(whole, cuts_of(slices)) << method << ", slices";
    EXPECT_EQ(whole, cuts_of(retraced)) << method << ", traced again";
    if (find_integrator(method).uses(Bundle::vertex_counts)) {
      EXPECT_EQ(whole, cuts_of(tight)) << method << ", tight";
    }
  }
}

TEST(DepthCut, passes_and_bands_add_up) {
  Scene scene = scene_named("everything");
  scene.settings.width = scene.settings.height = 24;
  const PackedScene packed = pack_scene(scene, {simd_width_for(test_device().info())});
  for (const char* name : one_per_pass) {
    const Integrator& method = find_integrator(name);
    RenderOptions o;
    o.width = o.height = 24;
    o.max_depth = 4;
    o.plan.extra_features = all_scene_features();
    o.plan.kernel_dir = kernel_folder();
    const auto cuts_of = [&](PassRange passes, const RenderHooks& hooks = {}) {
      o.passes = passes;
      Session session(test_device(), packed, method, o);
      session.run(hooks);
      return session.cuts();
    };
    const DepthCuts whole = cuts_of({0, 37});
    DepthCuts sum = cuts_of({20, 37});
    add_cuts(sum, cuts_of({0, 20}));
    EXPECT_EQ(text(whole), text(sum)) << name << ", in two parts";
    RenderHooks looks;
    looks.wants_film = [] { return true; };
    looks.film = [](const Film&) {};
    EXPECT_EQ(text(whole), text(cuts_of({0, 37}, looks))) << name << ", looked at";
    o.memory = 0;
    for (const auto& [buffer, bytes] : buffer_sizes(packed, method, o, 5)) *o.memory += bytes;
    EXPECT_EQ(text(whole), text(cuts_of({0, 37}))) << name << ", in bands";
  }
}

}  // namespace
}  // namespace pellucid::test
