// Random numbers (numerics 23): noise of two seeds, of neighbouring pixels and of passes that
// follow each other does not correlate, and the mean of K renders has a Kth of the variance.
//
// Every number is a hash of pixel, pass, kind of path and dimension (core/rng.h), of 24 bits, so
// that 1 never comes: some ten integer operations each.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "shared/limits.h"
#include "stability/measurements.h"
#include "stability/renderer.h"

namespace pellucid::stability {
namespace {

constexpr int size = 64;

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

}  // namespace

void noise_is_independent(const Lab& lab, Findings& findings) {
  // Every pixel sees the same value, so that what differs is noise.
  const Scene scene = lab.open_scene("rectangle-light");
  const double most = 4 / std::sqrt(double(size * size));
  for (Sampler sampler : {Sampler::random, Sampler::sobol})
    for (const char* method : {"path", "bdpt"}) {
      Build build{method, size, size};
      build.sampler = sampler;
      Renderer renderer(lab, scene, build);
      const bool blocks = sampler == Sampler::sobol;
      const std::uint64_t spp = blocks ? SOBOL_BLOCK : 1;
      const auto render = [&](std::uint64_t passes, std::uint64_t seed) {
        return values(renderer.render({passes, seed, {}, MIS_BALANCE}));
      };
      const std::string name = fmt::format("{}, {}", blocks ? "sobol" : "random", method);
      const std::vector<double> first = render(spp, 1), both = render(2 * spp, 1);
      std::vector<double> second(first.size());
      for (std::size_t i = 0; i < first.size(); ++i) second[i] = 2 * both[i] - first[i];
      const auto check = [&](const std::string& what, double r) {
        findings.at_most(fmt::format("correlation of {}, {}", what, name), std::abs(r), most);
      };
      check("two seeds", correlation(first, render(spp, 2)));
      check("passes that follow each other", correlation(first, second));
      check("pixels side by side", neighbours(first, 1));
      check("pixels one above the other", neighbours(first, size));
      constexpr int runs = 16;
      std::vector<double> mean(first.size());
      double single = 0;
      for (int k = 0; k < runs; ++k) {
        const std::vector<double> x = render(spp, std::uint64_t(100 + k));
        single += moments(x).variance / runs;
        for (std::size_t i = 0; i < x.size(); ++i) mean[i] += x[i] / runs;
      }
      // 4096 pixels tell a variance to 2 %, four times that is allowed, and as much for samples
      // whose distribution has tails.
      findings.at_most(fmt::format("variance of a mean of 16, times 16, off 1, {}", name),
                       std::abs(runs * moments(mean).variance / single - 1), 0.15);
    }
}

}  // namespace pellucid::stability
