// References that are agreed upon, or extrapolated.
#include "study/reference.h"

#include <fmt/format.h>

#include <cmath>

#include "base/statistics.h"
#include "shared/limits.h"
#include "study/ladder.h"
#include "study/tiles.h"

namespace pellucid {
namespace {

/// Runs of each voice; their spread is all that is known of what they have in common.
constexpr int voice_runs = 8;

/// One method's runs, and what they say of the picture's light.
struct Voice {
  std::string name;  ///< the method, its runs and their length
  PictureStack stack;
  double energy = 0, energy_error = 0;

  void finish() {
    std::vector<double> energies;
    for (const Picture& p : stack.pictures()) energies.push_back(energy_of(p));
    const double n = double(energies.size());
    for (double e : energies) energy += e / n;
    double squares = 0;
    for (double e : energies) squares += (e - energy) * (e - energy);
    energy_error = std::sqrt(squares / (n - 1) / n);
  }
};

Voice listen(Contender& contender, std::uint64_t seed, double seconds, int runs,
             const std::function<void(const std::string&)>& tell) {
  Voice voice;
  contender.run(seed, SOBOL_BLOCK);  // to know its cost
  const std::uint64_t spp = whole_blocks(contender.spp_in(seconds / runs));
  for (int k = 0; k < runs; ++k) {
    tell(fmt::format("reference by {}, run {} of {}", contender.method().name, k + 1, runs));
    voice.stack.add(contender.run(seed + 1 + std::uint64_t(k), spp).picture);
  }
  voice.name = fmt::format("{} ({} runs of {} spp)", contender.method().name, runs, spp);
  voice.finish();
  return voice;
}

/// sum of weight[i] * pictures[i].
Picture combine(const std::vector<std::pair<double, Picture>>& parts) {
  Picture out(parts.front().second.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    double sum = 0;
    for (const auto& [weight, picture] : parts) sum += weight * double(picture[i]);
    out[i] = float(sum);
  }
  return out;
}

/// Shares of light that voices may differ by beyond chance, in all and in a tile (relative to its
/// own light and to that of a mean tile): 0 where both are unbiased.
struct Allowance {
  double energy = 0, tile = 0;
};
/// For a voice whose radius was continued to 0 along a straight line, which is not quite straight.
constexpr Allowance for_extrapolation{0.01, 0.05};

/// In words, how two voices differ beyond chance; "" if they do not.
std::string difference(const Tiling& tiling, const Voice& a, const Voice& b,
                       const Allowance& allowed, StudyReference& facts) {
  constexpr double confidence = 0.999;
  const double error = std::hypot(a.energy_error, b.energy_error);
  const double apart = std::abs(a.energy - b.energy);
  facts.disagreement = error > 0 ? apart / error : 0;
  const double limit = student_quantile(0.5 + 0.5 * confidence, 2 * (voice_runs - 1));
  if (apart > limit * error + allowed.energy * b.energy)
    return fmt::format("its two methods disagree by {:.2g} % of the light, {:.1f} standard errors",
                       100 * std::abs(a.energy / b.energy - 1), facts.disagreement);
  const TileDifference worst = worst_tile(tiling, a.stack, b.stack, allowed.tile);
  if (worst.probability >= 1 - confidence) return "";
  return fmt::format(
      "its two methods disagree at pixel {}, {} and around by {:.1f} standard errors",
      worst.tile % tiling.columns() * STUDY_TILE, worst.tile / tiling.columns() * STUDY_TILE,
      worst.t);
}

Tiling tiling_of(Contender& contender) {
  const Window window = contender.options().window();
  return {window.width, window.height};
}

/// What one voice alone says.
Reference reference_by(const Voice& voice) {
  Reference r;
  r.facts.source = voice.name;
  r.picture = voice.stack.mean();
  require_numbers(r);
  r.weights = relmse_weights(r.picture);
  r.facts.relmse = voice.stack.variance(r.weights) / voice_runs;
  const double energy = energy_of(r.picture);
  r.facts.energy_error = energy > 0 ? voice.energy_error / energy : 0;
  return r;
}

/// A method that merges with radii r, r / sqrt 2, r / 2: the intercept of the straight line through
/// three points at r^2, r^2 / 2 and r^2 / 4, run by run.
struct Continued {
  Voice voice;
  double curvature = 0;  ///< relMSE that the intercept is off by if the line is a parabola; may be
                         ///< negative
};

constexpr std::uint64_t voices_apart = 1000;  // seeds

Continued continue_to_zero(const Contender& merging, double radius, std::uint64_t seed,
                           double seconds, const std::function<void(const std::string&)>& tell) {
  constexpr double weights[3] = {-0.5, 0.5, 1.0}, shares[3] = {1.0, 0.70710678118654752, 0.5};
  // Variance goes as the square of the weight, and a smaller radius has more of it.
  constexpr double time_shares[3] = {0.2, 0.2, 0.6};
  // Of c r^4 the second difference holds 0.375 c, and the intercept is off by -0.3125 c.
  constexpr double bends[3] = {1.0, -3.0, 2.0}, off = 0.3125 / 0.375;
  std::vector<Voice> radii;
  Continued result;
  result.voice.name = fmt::format("{} continued to radius 0 from", merging.method().name);
  for (std::size_t i = 0; i < 3; ++i) {
    Contender fixed = merging;
    fixed.options().radius = shares[i] * radius;
    fixed.options().radius_alpha = 1;
    radii.push_back(
        listen(fixed, seed + i * voices_apart, time_shares[i] * seconds, voice_runs, tell));
    result.voice.name += fmt::format("{} {:.3g}{}", i ? "," : "", shares[i] * radius,
                                     radii[i].name.substr(radii[i].name.find(' ')));
  }
  PictureStack bend;
  for (std::size_t k = 0; k < std::size_t(voice_runs); ++k) {
    std::vector<std::pair<double, Picture>> line, second;
    for (std::size_t i = 0; i < 3; ++i) {
      line.emplace_back(weights[i], radii[i].stack.pictures()[k]);
      second.emplace_back(bends[i], radii[i].stack.pictures()[k]);
    }
    result.voice.stack.add(combine(line));
    bend.add(combine(second));
  }
  result.voice.finish();
  const std::vector<double> relative = relmse_weights(result.voice.stack.mean());
  const Picture zero(bend.pictures().front().size(), 0.0f);
  result.curvature =
      off * off *
      (weighted_distance(bend.mean(), zero, relative) - bend.variance(relative) / voice_runs);
  return result;
}

}  // namespace

Reference make_reference(Contender& one, Contender& other, std::uint64_t seed, double seconds,
                         const std::function<void(const std::string&)>& tell) {
  const bool alone = one.method().name == other.method().name;
  const Voice a = listen(one, seed, 0.5 * seconds, voice_runs, tell);
  const Voice b = listen(other, seed + voices_apart, 0.5 * seconds, voice_runs, tell);
  // Weights of the two by their variances over the picture, not pixel by pixel: a pixel's estimated
  // variance goes with its value, and weighing by it would make the sum dark.
  const Picture mean_a = a.stack.mean(), mean_b = b.stack.mean();
  const std::vector<double> rough = relmse_weights(combine({{0.5, mean_a}, {0.5, mean_b}}));
  const double va = a.stack.variance(rough) / voice_runs, vb = b.stack.variance(rough) / voice_runs;
  const double share = va + vb > 0 ? vb / (va + vb) : 0.5;
  Reference r;
  r.facts.source = a.name + " and " + b.name;
  r.picture = combine({{share, mean_a}, {1 - share, mean_b}});
  require_numbers(r);
  r.weights = relmse_weights(r.picture);
  r.facts.relmse = (share * share * a.stack.variance(r.weights) +
                    (1 - share) * (1 - share) * b.stack.variance(r.weights)) /
                   voice_runs;
  const double energy = energy_of(r.picture);
  r.facts.energy_error =
      energy > 0 ? std::hypot(share * a.energy_error, (1 - share) * b.energy_error) / energy : 0;
  r.facts.doubt = difference(tiling_of(one), a, b, {}, r.facts);
  r.facts.trusted = r.facts.doubt.empty();
  if (r.facts.trusted && alone)
    r.facts.doubt = "one method alone could make it: nothing else confirms it";
  return r;
}

Reference confirm_reference(Contender& unbiased, const std::string& by_chance,
                            const Contender& merging, double radius, std::uint64_t seed,
                            double seconds, const std::function<void(const std::string&)>& tell) {
  constexpr double most = 0.6;  // of the time: it is the picture, the other one its witness
  const Voice a = listen(unbiased, seed, most * seconds, voice_runs, tell);
  const Voice b =
      continue_to_zero(merging, radius, seed + voices_apart, (1 - most) * seconds, tell).voice;
  Reference r = reference_by(a);
  r.facts.doubt = difference(tiling_of(unbiased), a, b, for_extrapolation, r.facts);
  r.facts.trusted = r.facts.doubt.empty();
  if (r.facts.trusted)
    r.facts.doubt = fmt::format(
        "{} finds {} by chance alone; {} confirms the light of the picture "
        "to {:.0f} % and that of its tiles to {:.0f} %, beyond noise",
        unbiased.method().name, by_chance, b.name, 100 * for_extrapolation.energy,
        100 * for_extrapolation.tile);
  return r;
}

Reference extrapolate_reference(const Contender& merging, double radius, std::uint64_t seed,
                                double seconds,
                                const std::function<void(const std::string&)>& tell) {
  const Continued c = continue_to_zero(merging, radius, seed, seconds, tell);
  Reference r = reference_by(c.voice);
  r.facts.doubt = fmt::format(
      "no unbiased method sees all: errors are relative to an extrapolated reference, uncertain by "
      "{:.2g} %, and what the straight line leaves of bias is not in that",
      100 * std::sqrt(r.facts.relmse));
  if (c.curvature > r.facts.relmse) {
    r.facts.trusted = false;
    r.facts.doubt = fmt::format(
        "no unbiased method sees all, and the three radii that it is continued from lie on no "
        "straight line: it may be off by {:.2g} %; try a smaller --radius",
        100 * std::sqrt(c.curvature));
  }
  return r;
}

}  // namespace pellucid
