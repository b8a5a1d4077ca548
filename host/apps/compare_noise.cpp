// By the channels and attributes that `render` writes.
#include "apps/compare_noise.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "image/image_pair.h"
#include "image/variances.h"
#include "integrators/registry.h"
#include "render/pass_set.h"

namespace pellucid {
namespace {

double samples_of(const NamedImage& named) {
  const auto found = named.image.metadata.find("samplesPerPixel");
  const int* count =
      found == named.image.metadata.end() ? nullptr : std::get_if<int>(&found->second);
  if (count && *count > 0) return *count;
  throw InputError(
      fmt::format("--ztest: '{}' does not tell how many samples a pixel has (attribute "
                  "samplesPerPixel); render it anew",
                  named.name));
}

/// Whether both are of the same scene, method and seed, and of passes that overlap.
bool share_samples(const Image& a, const Image& b) {
  for (const char* name : {"pellucid:seed", "pellucid:sceneHash", "pellucid:integrator"}) {
    const std::string value = text_attribute(a, name);
    if (value.empty() || value != text_attribute(b, name)) return false;
  }
  const std::string passes_a = text_attribute(a, "pellucid:passes");
  const std::string passes_b = text_attribute(b, "pellucid:passes");
  return passes_a == passes_b || PassSet::parse(passes_a).overlaps(PassSet::parse(passes_b));
}

}  // namespace

std::string text_attribute(const Image& image, const char* name) {
  const auto found = image.metadata.find(name);
  if (found == image.metadata.end()) return "";
  const std::string* text = std::get_if<std::string>(&found->second);
  return text ? *text : "";
}

bool pixels_are_independent(const Image& image) {
  const std::string name = text_attribute(image, "pellucid:integrator");
  const auto& known = integrators();
  const auto method =
      std::find_if(known.begin(), known.end(), [&](const Integrator& i) { return i.name == name; });
  return method != known.end() && !method->walks_from_lights();
}

void check_variances(const NamedImage& named) {
  const Variances variances(named.image);
  if (colour_channels(named.image).size() != 3 || !variances.stored())
    throw UsageError(
        fmt::format("'{}' does not tell its noise: it has no channels variance.R, variance.G, "
                    "variance.B; render it with '--aov variance -o FILE.exr'",
                    named.name));
  if (!variances.known())
    throw InputError(
        fmt::format("'{}' does not know its noise: it has pixels whose variance is no finite "
                    "number >= 0; that takes 32 samples per pixel, or 2 with '--sampler random', "
                    "and no pixel that is not finite",
                    named.name));
}

NoisyImage noisy_image(const NamedImages& runs) {
  NoisyImage noisy;
  noisy.independent_pixels = true;
  for (const NamedImage* run : runs) {
    check_variances(*run);
    const double samples = samples_of(*run);
    if (!noisy.runs.empty() && samples != noisy.samples)
      throw InputError(
          fmt::format("--ztest: '{}' has {} samples per pixel, but '{}' {}; runs must "
                      "be of the same length",
                      run->name, samples, runs.front()->name, noisy.samples));
    noisy.samples = samples;
    noisy.runs.push_back(&run->image);
    noisy.independent_pixels = noisy.independent_pixels && pixels_are_independent(run->image);
  }
  return noisy;
}

void refuse_shared_samples(const NamedImages& images) {
  for (std::size_t i = 0; i < images.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (images[i]->name == images[j]->name || share_samples(images[i]->image, images[j]->image))
        throw InputError(
            fmt::format("'{}' and '{}' are made of the same samples, so what they differ by says "
                        "nothing of their noise; render one of them with another --seed",
                        images[j]->name, images[i]->name));
}

}  // namespace pellucid
