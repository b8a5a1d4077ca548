// What the loader (image.cpp) and the library behind dlopen (oiio_plugin.cpp) agree on. Failures
// come back as text instead of exceptions, since the two are linked apart; running out of memory
// throws.
#pragma once

#include <string>

#include "image/image.h"

namespace pellucid {

struct ImagePlugin {
  /// Each returns "" or the reason of failure, without the file name.
  std::string (*read)(const std::string& path, bool linearise, std::size_t most_pixels,
                      Image& image);
  /// `path` exists and may be overwritten; its suffix selects the format.
  std::string (*write)(const std::string& path, const Image& image);
  std::string (*read_words)(const std::string& path, WordImage& words);
  std::string (*write_words)(const std::string& path, const WordImage& words);
};

/// Layout version of ImagePlugin and Image, part of the symbol's name: a stale library left over
/// from another build then fails to load instead of crashing.
#define PELLUCID_IMAGE_PLUGIN pellucid_image_plugin_3
#define PELLUCID_IMAGE_PLUGIN_NAME "pellucid_image_plugin_3"

using ImagePluginEntry = const ImagePlugin* (*)();

}  // namespace pellucid
