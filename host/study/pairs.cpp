// Paired runs: bias of the precision, paths that turned elsewhere, ratio of times.
#include "study/pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/timer.h"
#include "study/ladder.h"

namespace pellucid {
namespace {

constexpr int pairs = 5;

/// Pixels of one sample each whose values differ by more than rounding along a path explains.
double divergent_share(const Picture& a, const Picture& b) {
  constexpr double rounding = 1e-3;  // thousands of roundoffs: some hundred operations at worst
  std::size_t divergent = 0;
  for (std::size_t i = 0; i + 2 < a.size(); i += 3) {
    bool differs = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = double(a[i + c]), y = double(b[i + c]);
      differs |= std::abs(x - y) > rounding * std::max(std::abs(x), std::abs(y));
    }
    divergent += differs;
  }
  return double(divergent) / double(a.size() / 3);
}

Picture difference(const Picture& a, const Picture& b) {
  Picture out(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out[i] = a[i] - b[i];
  return out;
}

}  // namespace

std::optional<PrecisionPair> compare_precision(
    const StudyStage& stage, const PairJob& job, const std::vector<double>& weights,
    std::uint64_t seed, double seconds, const std::function<void(const std::string&)>& tell) {
  const Integrator& method = job.strict->method();
  const Timer timer;
  Contender strict(stage, method, "strict"), relaxed(stage, method, job.precision);
  PrecisionPair pair;
  pair.integrator = method.name, pair.precision = job.precision, pair.runs = pairs;
  tell(fmt::format("precision: {} {}", method.name, job.precision));
  double divergent = 0;
  for (int k = 0; k < pairs; ++k)
    divergent += divergent_share(relaxed.run(seed + std::uint64_t(k), 1).picture,
                                 strict.run(seed + std::uint64_t(k), 1).picture);
  pair.divergent_per_million = 1e6 * divergent / pairs;
  // By what runs of the contender in the race have cost: those of one sample say too little.
  const double spp = job.strict->spp_in((seconds - timer.seconds()) / (2 * pairs));
  if (spp < double(SOBOL_BLOCK)) return std::nullopt;
  pair.spp = ladder_to(spp).back();
  PictureStack differences;
  std::vector<double> ratios;
  for (int k = 0; k < pairs; ++k) {
    tell(fmt::format("precision: {} {}, pair {} of {}", method.name, job.precision, k + 1, pairs));
    const std::uint64_t its = seed + std::uint64_t(pairs + k);
    LadderStep a, b;
    if (k % 2) a = relaxed.run(its, pair.spp);  // nobody is always first
    b = strict.run(its, pair.spp);
    if (k % 2 == 0) a = relaxed.run(its, pair.spp);
    differences.add(difference(a.picture, b.picture));
    ratios.push_back(a.rung.seconds / b.rung.seconds);
  }
  const Picture zero(differences.pictures().front().size(), 0.0f);
  const Split split = differences.split(zero, weights, 0);
  pair.bias2 = split.bias2, pair.bias2_upper90 = split.bias2_upper90;
  std::sort(ratios.begin(), ratios.end());
  pair.time_low = ratios.front(), pair.time_ratio = ratios[pairs / 2],
  pair.time_high = ratios.back();
  StudyOption facts;
  relaxed.describe(facts);
  pair.wrong = facts.wrong;
  return pair;
}

}  // namespace pellucid
