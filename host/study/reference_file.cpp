// References from files, and whether they are of what is studied.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <variant>

#include "base/error.h"
#include "image/image.h"
#include "study/reference.h"

namespace pellucid {
namespace {

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

void require_numbers(const Reference& r) {
  if (!all_finite(r.picture))
    throw InputError(
        fmt::format("the reference ({}) holds pixels that are no numbers; compare "
                    "counts them",
                    r.facts.source));
}

Reference read_reference(const std::string& file, const ReferenceWanted& wanted) {
  const Image image = read_image(file, true);
  if (image.width != wanted.width || image.height != wanted.height)
    throw InputError(
        fmt::format("--ref {}: it has {}x{} pixels, and the study {}x{}; give both the same --size "
                    "and --crop",
                    file, image.width, image.height, wanted.width, wanted.height));
  Reference r;
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

}  // namespace pellucid
