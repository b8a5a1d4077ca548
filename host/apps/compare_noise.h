// What `compare` has to know of its images' noise before statistics may be done with them.
#pragma once

#include <string>
#include <vector>

#include "image/ztest.h"

namespace pellucid {

/// An image and the name of its file.
struct NamedImage {
  std::string name;
  Image image;
};
using NamedImages = std::vector<const NamedImage*>;

/// An attribute that is a text; "" without it.
std::string text_attribute(const Image& image, const char* name);

/// Whether the noise of one pixel tells nothing of its neighbours', as far as the file tells its
/// method: an unknown one may do anything.
bool pixels_are_independent(const Image& image);

/// Throws UsageError if the image has no colours with variances, InputError if these are unknown.
void check_variances(const NamedImage& named);

/// Several runs, or one, of one method with their variances. Throws as check_variances(), and
/// InputError if the file does not tell how many samples it is of.
NoisyImage noisy_image(const NamedImages& runs);

/// Throws InputError if two of the images are made of the same samples, as far as they tell:
/// such noise is shared, so that their difference says too little of it.
void refuse_shared_samples(const NamedImages& images);

}  // namespace pellucid
