// The device beside the twin (numerics A1): samples of `path` one by one. In float the twin has to
// have the device's very bits, so that what audits find out about it holds for the device; beside
// the one in double, paths that choose otherwise are counted by what they choose.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "integrators/registry.h"
#include "render/plan.h"
#include "render_harness.h"
#include "support/kernel_folder.h"
#include "support/path_log.h"

namespace pellucid::test {
namespace {

constexpr int side = 128;
constexpr uint passes = 6;  // about 1e5 paths
constexpr int twin_lanes = 8;

/// What is compared of one scene.
struct Tally {
  int paths = 0, other_bits = 0;
  int parted[partings] = {};        ///< by Parting
  double sum = 0, difference = 0, spread = 0;  ///< of paths that stay together: in double, signed,
                                               ///< absolute
  double per_million(int n) const { return 1e6 * n / paths; }
  int all_parted() const { return paths - parted[int(Parting::none)]; }
};

/// Samples of a pass as the device has them: radiance and number of rays.
class DeviceSamples {
 public:
  DeviceSamples(const PackedScene& packed, const RenderOptions& options)
      : plan_(test_device(), packed, find_integrator("path"), options,
              plan_memory(test_device().info(), packed, find_integrator("path"), options)) {}
  std::vector<F4> of_pass(const Launch& launch) {
    plan_.enqueue(launch);
    plan_.finish();
    const std::vector<uint> words = plan_.read_words("samples");
    std::vector<F4> samples(std::size_t(side) * side);
    std::memcpy(samples.data(), words.data(), samples.size() * sizeof(F4));
    return samples;
  }

 private:
  Plan plan_;
};

bool same_bits(const F4& device, const PathLog& twin) {
  const F4 ours{float(twin.radiance[0]), float(twin.radiance[1]), float(twin.radiance[2]),
                float(twin.rays)};
  return std::memcmp(&ours, &device, sizeof ours) == 0;
}

void compare_path(const F4& device, const PathLog& single, const PathLog& exact, Tally& tally) {
  ++tally.paths;
  tally.other_bits += !same_bits(device, single);
  const Parting why = parting_of(single, exact);
  ++tally.parted[int(why)];
  if (why != Parting::none) return;
  for (std::size_t c = 0; c < 3; ++c) {
    tally.sum += exact.radiance[c];
    tally.difference += single.radiance[c] - exact.radiance[c];
    tally.spread += std::abs(single.radiance[c] - exact.radiance[c]);
  }
}

Tally compare(const std::string& name) {
  Scene scene = scene_named(name);
  scene.settings.width = scene.settings.height = side;
  scene.settings.filter = PixelFilter::box;
  const PackedScene packed = pack_scene(scene, {twin_lanes});
  RenderOptions options;
  options.width = options.height = side;
  options.plan.sampler = Sampler::random;
  options.plan.extra_features = all_scene_features();  // as the twin; one program for all scenes
  options.plan.kernel_dir = kernel_folder();
  DeviceSamples device(packed, options);
  Launch launch = make_launch(packed, side, side, {0, 0, side, side});
  launch.seed = 20260801;
  launch.mis = MIS_BALANCE;
  Tally tally;
  for (launch.iteration = 0; launch.iteration < passes; ++launch.iteration) {
    const std::vector<F4> samples = device.of_pass(launch);
    for (uint y = 0; y < uint(side); ++y)
      for (uint x = 0; x < uint(side); ++x)
        compare_path(samples[y * uint(side) + x], path_log_float(packed, launch, x, y),
                     path_log_double(packed, launch, x, y), tally);
  }
  return tally;
}

void print(const std::string& name, const Tally& t) {
  std::printf("%s: %d of %d samples differ from the float twin\n", name.c_str(), t.other_bits, t.paths);
  std::printf("  %.0f of a million paths part from the double twin:", t.per_million(t.all_parted()));
  for (int i = 1; i < partings; ++i)
    std::printf(" %s %.0f", parting_name(Parting(i)), t.per_million(t.parted[i]));
  std::printf("\n  the others: mean off by %.1e, samples by %.1e of it\n", t.difference / t.sum,
              t.spread / t.sum);
}

class TwinDevice : public ::testing::TestWithParam<const char*> {};

TEST_P(TwinDevice, path) {
  const Tally t = compare(GetParam());
  print(GetParam(), t);
  EXPECT_EQ(t.other_bits, 0);
}

INSTANTIATE_TEST_SUITE_P(Scenes, TwinDevice, ::testing::Values("cornell-box", "everything", "gallery", "materials", "glass-lamp", "mixed-room"));

}  // namespace
}  // namespace pellucid::test
