// All methods converge to the same picture, path length by path length.
//
// scene          what it adds                                     by `light`, too
// equal-paint    diffuse, Phong, smooth normals, two-sided panel  yes
// equal-metal    mirror, smooth and rough metal, sphere, disk     no: mirrors in view
// equal-glass    smooth and rough glass, environment              no: glass in view
// equal-lights   five kinds of light at once, unequal powers      yes
// equal-coats    Oren-Nayar, plastics, thin glass, mixes          no: coats in view
// equal-caustic  light through glass on a floor                   yes
// equal-room     light that all comes by way of a ceiling         yes
// equal-keyhole  light through a hole                             yes
// equal-shading  normals far from the facets' own                 yes
#include "equality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace pellucid::test {
namespace {

constexpr int picture_size = 24, tile = 8, runs = 24, longest = 4;

struct Method {
  const char* name;
  uint mis;
};
using Methods = std::vector<Method>;

/// Which methods are compared with which on a scene: lengths 1 to 4 alone, and all together. The
/// baseline is the least noisy of them, where `naive` would take too long.
struct Comparison {
  const char* scene;
  Method baseline;
  Methods others;
};

Methods operator+(Methods a, const Methods& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Method naive{"naive", MIS_BALANCE}, path{"path", MIS_BALANCE}, both_ends{"bdpt", MIS_BALANCE};
const Methods from_camera{{"nee", MIS_BALANCE},
                          {"path", MIS_BALANCE},
                          {"path", MIS_POWER},
                          {"path", MIS_MAX},
                          {"reference", MIS_BALANCE}};
const Methods bdpt{{"bdpt", MIS_BALANCE}, {"bdpt", MIS_POWER}};
const Methods light{{"light", MIS_BALANCE}};

const std::vector<Comparison>& comparisons() {
  static const std::vector<Comparison> table{
      {"equal-paint", naive, from_camera + bdpt + light},
      {"equal-metal", naive, from_camera + bdpt},
      {"equal-glass", naive, from_camera + bdpt},
      {"equal-lights", naive, from_camera + bdpt + light},
      {"equal-coats", naive, from_camera + bdpt},
      {"equal-caustic", both_ends, Methods{path} + light},
      {"equal-room", path, bdpt + light},
      {"equal-keyhole", path, bdpt + light},
      {"equal-shading", path, bdpt + light},
  };
  return table;
}

/// Level of one verdict: of the pairs in the table, 3 channels, one image per length and one sum,
/// and the tiles of the sum. Bonferroni keeps the file at 1e-4.
double alpha() {
  std::size_t pairs = 0;
  for (const Comparison& c : comparisons()) pairs += c.others.size();
  return 1e-4 / double(pairs * 3 * (longest + 2));
}

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
  run.max_depth = long_enough;
  run.seed = seed + 99;
  // Two such errors, 6 sigma of Student and an error of 3 fit into the tolerance.
  const std::uint64_t most = std::uint64_t(100000 * tier_effort());
  const std::uint64_t needed = renderer.spp_for(run, tier_tolerance() / 13, most);
  run.spp = needed / runs + 1;
  Evidence e;
  for (int k = 0; k < runs; ++k) {
    run.seed = seed + std::uint64_t(k);
    run.max_depth = long_enough;
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
  for (const std::string& reason : compare_runs(a.total, b.total, alpha())) ADD_FAILURE() << reason;
  for (std::size_t c = 0; c < 3; ++c) {
    double energy = 0;
    for (double x : b.total.image[c]) energy += x / runs;
    for (std::size_t d = 0; d < longest; ++d)
      EXPECT_EQ(welch(a.length[d][c], b.length[d][c], alpha(), tier_tolerance() * energy), "")
          << "length " << d + 1 << ", channel " << c;
  }
}

class Equality : public testing::TestWithParam<Comparison> {};

TEST_P(Equality, all_methods) {
  const Comparison& c = GetParam();
  const Scene scene = scene_named(c.scene);
  Renderer known(scene, {c.baseline.name, picture_size, picture_size});
  const Evidence expected = collect(known, c.baseline.mis, 1000);
  std::uint64_t seed = 2000;
  for (const Method& m : c.others) {
    SCOPED_TRACE(std::string(m.name) + ", MIS rule " + std::to_string(m.mis));
    Renderer renderer(scene, {m.name, picture_size, picture_size});
    expect_equal(collect(renderer, m.mis, seed), expected);
    seed += 1000;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Equality, testing::ValuesIn(comparisons()), [](const auto& test) {
  std::string name = test.param.scene;
  name[name.find('-')] = '_';
  return name;
});

// Points of the default sampler, on whose scrambles eye and light paths must not agree: all other
// tests draw independent numbers. Runs of their own seeds are independent.
TEST(EqualitySobol, bdpt_has_the_mean_of_path) {
  constexpr std::uint64_t spp = 512;
  const Scene scene = scene_named("cornell-box");
  std::array<Runs, 2> methods{Runs(picture_size), Runs(picture_size)};
  for (std::size_t m = 0; m < methods.size(); ++m) {
    Build build{m ? "bdpt" : "path", picture_size, picture_size};
    build.sampler = Sampler::sobol;
    Renderer renderer(scene, build);
    Sampling run;
    run.spp = spp;
    for (int k = 0; k < runs; ++k) {
      run.seed = std::uint64_t(100 * m + k);
      methods[m].add(renderer.render(run));
    }
  }
  // Correlated scrambles once cost 0.2 % of the picture's energy.
  constexpr double within = 0.004;
  for (std::size_t c = 0; c < 3; ++c) {
    const Sample& expected = methods[0].image[c];
    const double energy = std::accumulate(expected.begin(), expected.end(), 0.0) / runs;
    EXPECT_EQ(welch(methods[1].image[c], expected, 1e-3, within * energy), "") << "channel " << c;
  }
}

// The judge itself: a difference it must see, noise it must refuse.
TEST(EqualityJudge, sees_what_it_should) {
  const Sample a{1.00, 1.01, 0.99, 1.00, 1.02, 0.98}, b{1.10, 1.11, 1.09, 1.10, 1.12, 1.08};
  EXPECT_EQ(welch(a, a, 1e-4, 0.1), "");
  EXPECT_EQ(welch(a, b, 1e-4, 0.5).substr(0, 5), "WRONG");
  EXPECT_EQ(welch(a, a, 1e-4, 0.01).substr(0, 12), "INCONCLUSIVE");
}

}  // namespace
}  // namespace pellucid::test
