// All methods converge to the same picture, path length by path length.
//
// scene         what it adds                                      lengths
// equal-paint   diffuse, Phong, smooth normals, two-sided panel   1 2 3 4, all
// equal-metal   mirror, smooth and rough metal, sphere, disk      1 2 3 4, all
// equal-glass   smooth and rough glass, environment               1 2 3 4, all
// equal-lights  five kinds of light at once, unequal powers       1 2 3 4, all
// equal-coats   Oren-Nayar, plastics, thin glass, mixes           1 2 3 4, all
// Each of nee, reference and path under balance, power and max is compared with naive.
#include "equality.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pellucid::test {
namespace {

constexpr int picture_size = 24, tile = 8, runs = 24, longest = 4;
/// Verdicts of this file: 5 scenes, 5 pairs, 3 channels, one image per length and one sum, and
/// tiles of the sum (Sidak inside). Bonferroni keeps the file at 1e-4.
constexpr double alpha = 1e-4 / (5 * 5 * 3 * (longest + 2));

struct Method {
  const char* name;
  uint mis;
};
const Method baseline{"naive", MIS_BALANCE};
const Method others[] = {{"nee", MIS_BALANCE},
                         {"path", MIS_BALANCE},
                         {"path", MIS_POWER},
                         {"path", MIS_MAX},
                         {"reference", MIS_BALANCE}};

/// Runs of one method: the sum of all lengths, and each of the first lengths alone as a difference
/// of two renders with the same random numbers.
struct Evidence {
  Runs total{tile};
  std::array<std::array<Sample, 3>, longest> length;
};

std::array<double, 3> image_means(const Picture& picture) {
  return {picture.image(0).mean, picture.image(1).mean, picture.image(2).mean};
}

Evidence collect(Renderer& renderer, uint mis, std::uint64_t seed) {
  Sampling run;
  run.mis = mis;
  run.seed = seed + 99;
  // Two such errors, 6 sigma of Student and an error of 3 fit into the tolerance.
  const std::uint64_t most = std::uint64_t(100000 * tier_effort());
  const std::uint64_t needed = renderer.spp_for(run, tier_tolerance() / 13, most);
  run.spp = needed / runs + 1;
  Evidence e;
  for (int k = 0; k < runs; ++k) {
    run.seed = seed + std::uint64_t(k);
    run.max_depth.reset();
    e.total.add(renderer.render(run));
    Sampling ladder = run;
    std::array<double, 3> shorter{};
    for (int d = 1; d <= longest; ++d) {
      ladder.max_depth = uint(d);
      const std::array<double, 3> up_to = image_means(renderer.render(ladder));
      for (std::size_t c = 0; c < 3; ++c)
        e.length[std::size_t(d - 1)][c].push_back(up_to[c] - shorter[c]);
      shorter = up_to;
    }
  }
  return e;
}

void expect_equal(const Evidence& a, const Evidence& b) {
  for (const std::string& reason : compare_runs(a.total, b.total, alpha)) ADD_FAILURE() << reason;
  for (std::size_t c = 0; c < 3; ++c) {
    double energy = 0;
    for (double x : b.total.image[c]) energy += x / runs;
    for (std::size_t d = 0; d < longest; ++d)
      EXPECT_EQ(welch(a.length[d][c], b.length[d][c], alpha, tier_tolerance() * energy), "")
          << "length " << d + 1 << ", channel " << c;
  }
}

class Equality : public testing::TestWithParam<const char*> {};

TEST_P(Equality, all_methods) {
  const Scene scene = scene_named(GetParam());
  Renderer chance(scene, {baseline.name, picture_size, picture_size});
  const Evidence expected = collect(chance, baseline.mis, 1000);
  std::uint64_t seed = 2000;
  for (const Method& m : others) {
    SCOPED_TRACE(std::string(m.name) + ", MIS rule " + std::to_string(m.mis));
    Renderer renderer(scene, {m.name, picture_size, picture_size});
    expect_equal(collect(renderer, m.mis, seed), expected);
    seed += 1000;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Equality,
                         testing::Values("equal-paint", "equal-metal", "equal-glass",
                                         "equal-lights", "equal-coats"),
                         [](const auto& test) {
                           std::string name = test.param;
                           name[name.find('-')] = '_';
                           return name;
                         });

// The judge itself: Student's table, a difference it must see, noise it must refuse.
TEST(EqualityJudge, sees_what_it_should) {
  EXPECT_NEAR(student_t(0.05, 10), 2.228, 1e-3);
  EXPECT_NEAR(student_t(0.001, 30), 3.646, 1e-3);
  const Sample a{1.00, 1.01, 0.99, 1.00, 1.02, 0.98}, b{1.10, 1.11, 1.09, 1.10, 1.12, 1.08};
  EXPECT_EQ(welch(a, a, 1e-4, 0.1), "");
  EXPECT_EQ(welch(a, b, 1e-4, 0.5).substr(0, 5), "WRONG");
  EXPECT_EQ(welch(a, a, 1e-4, 0.01).substr(0, 12), "INCONCLUSIVE");
}

}  // namespace
}  // namespace pellucid::test
