// References: read, agreed upon, or extrapolated.
#include "study/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <variant>

#include "base/error.h"
#include "base/statistics.h"
#include "base/timer.h"
#include "image/image.h"
#include "shared/limits.h"
#include "study/ladder.h"
#include "study/tiles.h"

namespace pellucid {
namespace {

/// Runs of each voice; their spread is all that is known of what they have in common.
constexpr int voice_runs = 8;

/// One method's runs, and what they say of the picture's light.
struct Voice {
  PictureStack stack;
  std::uint64_t spp = 0;
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
  voice.spp = whole_blocks(contender.spp_in(seconds / runs));
  for (int k = 0; k < runs; ++k) {
    tell(fmt::format("reference by {}, run {} of {}", contender.method().name, k + 1, runs));
    voice.stack.add(contender.run(seed + 1 + std::uint64_t(k), voice.spp).picture);
  }
  voice.finish();
  return voice;
}

void require_numbers(const Reference& r) {
  if (!all_finite(r.picture))
    throw InputError(
        fmt::format("the reference ({}) holds pixels that are no numbers; compare "
                    "counts them",
                    r.facts.source));
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

void doubt(StudyReference& facts, const std::string& why) {
  facts.doubt += (facts.doubt.empty() ? "" : "; ") + why;
}

/// Metadata as text; "" if there is none.
std::string told(const Image& image, const std::string& key) {
  const auto it = image.metadata.find(key);
  const std::string* text =
      it == image.metadata.end() ? nullptr : std::get_if<std::string>(&it->second);
  return text ? *text : "";
}

/// The word after `name` in settings such as "64x64 max-depth 5 filter box"; "" if it is not there.
std::string setting(const std::string& settings, const std::string& name) {
  std::istringstream words(settings);
  for (std::string word; words >> word;)
    if (word == name && words >> word) return word;
  return "";
}

/// What a file that pellucid rendered says of itself.
void check_origin(const Image& image, const std::string& file, const ReferenceWanted& wanted,
                  StudyReference& facts) {
  const std::string settings = told(image, "pellucid:settings");
  for (const char* name : {"max-depth", "filter"}) {
    const std::string its = setting(settings, name), ours = setting(wanted.settings, name);
    if (!its.empty() && !ours.empty() && its != ours)
      throw InputError(
          fmt::format("--ref {}: rendered with {} {}, and the study has {}: these are "
                      "pictures of different light",
                      file, name, its, ours));
  }
  const std::string seed = told(image, "pellucid:seed");
  if (!seed.empty()) {
    const std::uint64_t number = std::strtoull(seed.c_str(), nullptr, 10);
    if (number >= wanted.first_seed && number <= wanted.last_seed)
      throw InputError(
          fmt::format("--ref {}: its seed {} is one of the study's own, so errors would "
                      "be too small; render it with another, or give the study another "
                      "--seed",
                      file, seed));
  }
  const std::string hash = told(image, "pellucid:sceneHash");
  if (!hash.empty() && hash != wanted.scene_hash)
    doubt(facts, fmt::format("the file is of scene {}, the study of {}: only if these differ in "
                             "nothing that shows is it a reference",
                             hash, wanted.scene_hash));
  const std::string unseen = told(image, "pellucid:unreachable");
  if (unseen.empty() || unseen == "nothing") return;
  facts.trusted = false;
  doubt(facts, fmt::format("it was made by {}, which cannot see {}",
                           told(image, "pellucid:integrator"), unseen));
}

}  // namespace

Reference read_reference(const std::string& file, const ReferenceWanted& wanted) {
  const Image image = read_image(file, true);
  if (image.width != wanted.width || image.height != wanted.height)
    throw InputError(
        fmt::format("--ref {}: it has {}x{} pixels, and the study {}x{}; give both the same --size "
                    "and --crop",
                    file, image.width, image.height, wanted.width, wanted.height));
  Reference r;
  r.read = true;
  r.facts.source = file;
  check_origin(image, file, wanted, r.facts);
  const char* names[3] = {"R", "G", "B"};
  int at[3], of_variance[3];
  for (int c = 0; c < 3; ++c) {
    at[c] = image.channel(names[c]);
    of_variance[c] = image.channel(std::string("variance.") + names[c]);
    if (at[c] < 0) throw InputError(fmt::format("--ref {}: it has no channel {}", file, names[c]));
    if (of_variance[c] < 0) r.facts.variance_known = false;
  }
  const std::size_t n = image.channels.size(), pixels = image.data.size() / n;
  for (std::size_t i = 0; i < pixels; ++i)
    for (int c : at) r.picture.push_back(image.data[i * n + std::size_t(c)]);
  require_numbers(r);
  r.weights = relmse_weights(r.picture);
  double variance = 0, energy_variance = 0;
  for (std::size_t i = 0; i < pixels && r.facts.variance_known; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double v = double(image.data[i * n + std::size_t(of_variance[c])]);
      variance += r.weights[3 * i + c] * v / double(r.picture.size());
      energy_variance += v;
    }
  r.facts.variance_known = r.facts.variance_known && std::isfinite(variance);
  if (!r.facts.variance_known) {
    doubt(r.facts, "the file does not tell its variance (render --aov variance): taken as exact");
    return r;
  }
  r.facts.relmse = variance;
  const double energy = energy_of(r.picture);
  // As if pixels were independent; those of splats and merges are not, and their sum is less well
  // known than that.
  r.facts.energy_error = energy > 0 ? std::sqrt(energy_variance) / energy : 0;
  return r;
}

Reference make_reference(Contender& one, Contender& other, std::uint64_t seed, double seconds,
                         const std::function<void(const std::string&)>& tell) {
  constexpr std::uint64_t apart = 1000;
  const bool alone = one.method().name == other.method().name;
  const Window window = one.options().window();
  const Tiling tiling{window.width, window.height};
  const Voice a = listen(one, seed, 0.5 * seconds, voice_runs, tell);
  const Voice b = listen(other, seed + apart, 0.5 * seconds, voice_runs, tell);
  Reference r;
  r.facts.source = fmt::format("{} and {}, {} runs of {} and {} spp", one.method().name,
                               other.method().name, voice_runs, a.spp, b.spp);
  // Weights of the two by their variances over the picture, not pixel by pixel: a pixel's estimated
  // variance goes with its value, and weighing by it would make the sum dark.
  const Picture mean_a = a.stack.mean(), mean_b = b.stack.mean();
  const std::vector<double> rough = relmse_weights(combine({{0.5, mean_a}, {0.5, mean_b}}));
  const double va = a.stack.variance(rough) / voice_runs, vb = b.stack.variance(rough) / voice_runs;
  const double share = va + vb > 0 ? vb / (va + vb) : 0.5;
  r.picture = combine({{share, mean_a}, {1 - share, mean_b}});
  require_numbers(r);
  r.weights = relmse_weights(r.picture);
  r.facts.relmse = (share * share * a.stack.variance(r.weights) +
                    (1 - share) * (1 - share) * b.stack.variance(r.weights)) /
                   voice_runs;
  const double energy = energy_of(r.picture);
  const double error = std::hypot(a.energy_error, b.energy_error);
  r.facts.energy_error =
      energy > 0 ? std::hypot(share * a.energy_error, (1 - share) * b.energy_error) / energy : 0;
  r.facts.disagreement = error > 0 ? std::abs(a.energy - b.energy) / error : 0;
  constexpr double confidence = 0.999;
  const TileDifference worst = worst_tile(tiling, a.stack, b.stack);
  if (r.facts.disagreement > student_quantile(0.5 + 0.5 * confidence, 2 * (voice_runs - 1))) {
    r.facts.trusted = false;
    r.facts.doubt =
        fmt::format("its two methods disagree by {:.2g} % of the light, {:.1f} standard errors",
                    100 * std::abs(a.energy / b.energy - 1), r.facts.disagreement);
  } else if (worst.probability < 1 - confidence) {
    r.facts.trusted = false;
    r.facts.doubt =
        fmt::format("its two methods disagree at pixel {}, {} and around by {:.1f} standard errors",
                    worst.tile % tiling.columns() * STUDY_TILE,
                    worst.tile / tiling.columns() * STUDY_TILE, worst.t);
  } else if (alone) {
    r.facts.doubt = "one method alone could make it: nothing else confirms it";
  }
  return r;
}

Reference extrapolate_reference(const Contender& merging, double radius, std::uint64_t seed,
                                double seconds,
                                const std::function<void(const std::string&)>& tell) {
  // The intercept of the straight line through three points at r^2, r^2 / 2 and r^2 / 4.
  constexpr double weights[3] = {-0.5, 0.5, 1.0}, shares[3] = {1.0, 0.70710678118654752, 0.5};
  // Variance goes as the square of the weight, and a smaller radius has more of it.
  constexpr double time_shares[3] = {0.2, 0.2, 0.6};
  constexpr std::uint64_t apart = 1000;
  std::vector<Voice> voices;
  std::vector<std::pair<double, Picture>> parts;
  double energy_variance = 0;
  Reference r;
  r.facts.source = fmt::format("{} continued to radius 0 from", merging.method().name);
  for (std::size_t i = 0; i < 3; ++i) {
    Contender fixed = merging;
    fixed.options().radius = shares[i] * radius;
    fixed.options().radius_alpha = 1;
    voices.push_back(listen(fixed, seed + i * apart, time_shares[i] * seconds, voice_runs, tell));
    parts.emplace_back(weights[i], voices[i].stack.mean());
    energy_variance += std::pow(weights[i] * voices[i].energy_error, 2);
    r.facts.source += fmt::format("{} {:.3g} ({} runs of {} spp)", i ? "," : "", shares[i] * radius,
                                  voice_runs, voices[i].spp);
  }
  r.picture = combine(parts);
  require_numbers(r);
  r.weights = relmse_weights(r.picture);
  for (std::size_t i = 0; i < 3; ++i)
    r.facts.relmse += weights[i] * weights[i] * voices[i].stack.variance(r.weights) / voice_runs;
  const double energy = energy_of(r.picture);
  r.facts.energy_error = energy > 0 ? std::sqrt(energy_variance) / energy : 0;
  r.facts.doubt = fmt::format(
      "no unbiased method sees all: errors are relative to an extrapolated reference, uncertain by "
      "{:.2g} %, and what the straight line leaves of bias is not in that",
      100 * std::sqrt(r.facts.relmse));
  return r;
}

}  // namespace pellucid
