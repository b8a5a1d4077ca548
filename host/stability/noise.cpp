// Random numbers (numerics 23): noise of two seeds, of neighbouring pixels and of passes that
// follow each other does not correlate, and the mean of K renders has a Kth of the variance.
//
// Every number is a hash of pixel, pass, kind of path and dimension (core/rng.h), of 24 bits, so
// that 1 never comes: some ten integer operations each.
//
// Pixels of `light` and `vcm` share walks from the lights, so that their number does not say how
// well a correlation is known: the spread of repeats does.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "integrators/registry.h"
#include "shared/limits.h"
#include "stability/measurements.h"
#include "stability/renderer.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

constexpr int size = 64;
/// Of pictures that are rendered over and over.
constexpr int small = 32;

std::vector<double> values(const Picture& picture) {
  std::vector<double> out;
  for (const auto& pixel : picture.pixels) out.push_back(pixel[0].mean);
  return out;
}

struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(const std::vector<double>& x) {
  Moments m;
  for (double v : x) m.mean += v / double(x.size());
  for (double v : x) m.variance += (v - m.mean) * (v - m.mean) / double(x.size());
  return m;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Moments ma = moments(a), mb = moments(b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - ma.mean) * (b[i] - mb.mean);
  return sum / double(a.size()) / std::sqrt(ma.variance * mb.variance);
}

/// Each pixel beside the one that is `step` further on.
double neighbours(const std::vector<double>& x, std::size_t step) {
  return correlation({x.begin(), x.end() - std::ptrdiff_t(step)},
                     {x.begin() + std::ptrdiff_t(step), x.end()});
}

/// Kernels and how many passes of them make one picture.
struct Method {
  Renderer renderer;
  std::string name;
  std::uint64_t spp;
  std::vector<double> render(std::uint64_t passes, std::uint64_t seed) {
    return values(renderer.render({passes * spp, seed, 4, MIS_BALANCE}));
  }
  /// What the passes after the first ones alone give.
  std::vector<double> second(const std::vector<double>& first, std::uint64_t seed) {
    std::vector<double> x = render(2, seed);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 2 * x[i] - first[i];
    return x;
  }
};

Method method_of(const Lab& lab, const Scene& scene, Build build, Sampler sampler) {
  build.sampler = sampler;
  const bool blocks = sampler == Sampler::sobol;
  return {Renderer(lab, scene, build),
          fmt::format("{}, {}", blocks ? "sobol" : "random", build.method),
          blocks ? std::uint64_t{SOBOL_BLOCK} : 1};
}

constexpr int group = 16;  // renders whose mean is looked at

/// Variance of the mean of a group over that of one, times their number.
double variance_ratio(Method& method, std::uint64_t seed) {
  std::vector<double> mean;
  double single = 0;
  for (int k = 0; k < group; ++k) {
    const std::vector<double> x = method.render(1, seed + std::uint64_t(k));
    mean.resize(x.size());
    single += moments(x).variance / group;
    for (std::size_t i = 0; i < x.size(); ++i) mean[i] += x[i] / group;
  }
  return group * moments(mean).variance / single;
}

// 4096 pixels, or four times 1024, tell a variance to 2 %; four times that is allowed, and as much
// for samples whose distribution has tails.
constexpr double variance_bound = 0.15;
constexpr double correlation_bound = 4.0 / size;

void check_variance(Findings& findings, const std::string& name, double ratio) {
  findings.at_most(fmt::format("variance of a mean of {}, times {}, off 1, {}", group, group, name),
                   std::abs(ratio - 1), variance_bound);
}

/// Pixels that are independent of each other.
void measure_pixels(Method method, Findings& findings) {
  const std::vector<double> first = method.render(1, 1);
  const auto check = [&](const std::string& what, double r) {
    findings.at_most(fmt::format("correlation of {}, {}", what, method.name), std::abs(r),
                     correlation_bound);
  };
  check("two seeds", correlation(first, method.render(1, 2)));
  check("passes that follow each other", correlation(first, method.second(first, 1)));
  check("pixels side by side", neighbours(first, 1));
  check("pixels one above the other", neighbours(first, size));
  check_variance(findings, method.name, variance_ratio(method, 100));
}

/// The mean correlation of repeats: within its noise, and known as well as that of `size` by `size`
/// pixels.
void check_repeats(Findings& findings, const std::string& what,
                   const std::vector<double>& repeats) {
  constexpr double sigmas = 4.5;
  const Moments m = moments(repeats);
  const double noise = sigmas * std::sqrt(m.variance / double(repeats.size() - 1));
  findings.at_most("correlation of " + what, std::abs(m.mean), std::min(noise, correlation_bound));
  findings.at_most("noise of the correlation of " + what, noise, correlation_bound);
}

/// Pixels that share walks from the lights. Those side by side are none of each other's neighbours
/// in `light`; merging makes them so by intent.
void measure_repeats(Method method, bool merges, Findings& findings) {
  constexpr std::uint64_t repeats = 32;
  std::vector<double> seeds, passes, beside, above;
  for (std::uint64_t k = 0; k < repeats; ++k) {
    const std::uint64_t seed = 1000 + 2 * k;
    const std::vector<double> first = method.render(1, seed);
    seeds.push_back(correlation(first, method.render(1, seed + 1)));
    passes.push_back(correlation(first, method.second(first, seed)));
    beside.push_back(neighbours(first, 1)), above.push_back(neighbours(first, small));
  }
  check_repeats(findings, "two seeds, " + method.name, seeds);
  check_repeats(findings, "passes that follow each other, " + method.name, passes);
  if (!merges) {
    check_repeats(findings, "pixels side by side, " + method.name, beside);
    check_repeats(findings, "pixels one above the other, " + method.name, above);
  }
  constexpr int groups = 4;
  double ratio = 0;
  for (std::uint64_t k = 0; k < groups; ++k)
    ratio += variance_ratio(method, 100 + group * k) / groups;
  check_variance(findings, method.name, ratio);
}

/// A glowing ball from its middle: merging, too, makes no pixel brighter than another.
Scene glowing_ball() {
  Scene scene = empty_scene();
  add_shape(scene, Sphere{}).emission = Emission{Rgb(1.0), 2};
  scene.camera.fov = 60;
  return scene;
}

}  // namespace

void noise_is_independent(const Lab& lab, Findings& findings) {
  // Every pixel sees the same value, so that what differs is noise.
  const Scene floor = lab.open_scene("rectangle-light"), ball = glowing_ball();
  for (Sampler sampler : {Sampler::random, Sampler::sobol}) {
    for (const char* method : {"path", "bdpt"})
      measure_pixels(method_of(lab, floor, {method, size, size}, sampler), findings);
    for (const char* method : {"light", "vcm"}) {
      Build build{method, small, small};
      const bool merges = find_integrator(method).uses(Bundle::grid);
      // Discs of a pixel, that do not shrink from pass to pass.
      if (merges) build.radius = 0.02, build.radius_alpha = 1;
      measure_repeats(method_of(lab, ball, build, sampler), merges, findings);
    }
  }
}

}  // namespace pellucid::stability
