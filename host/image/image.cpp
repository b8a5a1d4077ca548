// Loads the image library on first use and turns its answers into our errors.
#include "image/image.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "base/text.h"
#include "image/plugin.h"

namespace pellucid {
namespace {

constexpr const char* LIBRARY = "libpellucid_image.so";

/// Where it lies beside bin/: in a build tree lib/, installed lib/pellucid/.
std::vector<std::string> library_candidates() {
  const std::filesystem::path bin = std::filesystem::path(executable_path()).parent_path();
  const std::filesystem::path root = bin.parent_path();
  return {(root / "lib" / LIBRARY).string(), (root / "lib" / "pellucid" / LIBRARY).string()};
}

const ImagePlugin& load_plugin() {
  const std::vector<std::string> candidates = library_candidates();
  for (const std::string& path : candidates) {
    if (!std::filesystem::exists(path)) continue;
    // Never closed: the library keeps threads and caches until the process ends.
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
      throw InputError(fmt::format(
          "the image library cannot be loaded: {}. Is the package libopenimageio2.4 installed?",
          dlerror()));
    }
    const auto entry =
        reinterpret_cast<ImagePluginEntry>(dlsym(library, PELLUCID_IMAGE_PLUGIN_NAME));
    if (!entry) {
      throw InputError(fmt::format(
          "'{}' belongs to another version of pellucid; build or install both together", path));
    }
    return *entry();
  }
  throw InputError(
      fmt::format("the image library is missing: neither {} exists. Build the target "
                  "pellucid_image_oiio, or install pellucid with 'cmake --install'",
                  join(candidates, " nor ")));
}

const ImagePlugin& plugin() {
  static const ImagePlugin& loaded = load_plugin();
  return loaded;
}

}  // namespace

void load_image_library() {
  plugin();
}

namespace {

/// `read` is the plugin's own; what a file may be at all is found out before.
template <typename Read>
void read_file(const std::string& path, const Read& read) {
  const auto fail = [&](const std::string& reason) {
    throw InputError(fmt::format("cannot read image '{}': {}", path, reason));
  };
  struct stat info;
  if (stat(path.c_str(), &info) != 0) fail(system_reason(errno));
  if (S_ISDIR(info.st_mode)) fail(system_reason(EISDIR));
  if (!S_ISREG(info.st_mode)) fail("it is a pipe or a device; copy it to a file");
  if (info.st_size == 0) fail("the file is empty");
  const std::string reason = read();
  if (!reason.empty()) fail(reason);
}

template <typename Write>
void write_file(const std::string& path, const Write& write) {
  AtomicFile file(path);
  std::string reason = write(file.temporary());
  if (!reason.empty()) {
    // The library names the file it was given; the user knows it by another name.
    const std::size_t at = reason.find(file.temporary());
    if (at != std::string::npos) reason.replace(at, file.temporary().size(), path);
    throw OutputError(fmt::format("cannot write image '{}': {}", path, reason));
  }
  file.commit();
}

}  // namespace

Image read_image(const std::string& path, bool linearise, std::size_t most_pixels) {
  Image image;
  read_file(path, [&] { return plugin().read(path, linearise, most_pixels, image); });
  return image;
}

void write_image(const std::string& path, const Image& image) {
  const std::size_t values =
      std::size_t(image.width) * std::size_t(image.height) * image.channels.size();
  PELLUCID_CHECK(image.width > 0 && image.height > 0 && values > 0, "only real images are written");
  PELLUCID_CHECK(image.data.size() == values, "image data fit its size");
  write_file(path, [&](const std::string& name) { return plugin().write(name, image); });
}

void add_channels(Image& image, const std::vector<AovChannel>& channels) {
  if (channels.empty()) return;
  const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
  const std::size_t before = image.channels.size(), after = before + channels.size();
  std::vector<float> data;
  data.reserve(pixels * after);
  for (const AovChannel& c : channels) {
    PELLUCID_CHECK(c.data.size() == pixels, "AOV size");
    image.channels.push_back(c.name);
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    data.insert(data.end(), image.data.begin() + std::ptrdiff_t(i * before),
                image.data.begin() + std::ptrdiff_t((i + 1) * before));
    for (const AovChannel& c : channels) data.push_back(c.data[i]);
  }
  image.data = std::move(data);
}

WordImage read_words(const std::string& path) {
  WordImage words;
  read_file(path, [&] { return plugin().read_words(path, words); });
  return words;
}

bool holds_words(const std::string& path) {
  WordImage words;
  return plugin().read_words(path, words).empty();
}

void write_words(const std::string& path, const WordImage& words) {
  PELLUCID_CHECK(words.width > 0 && words.height > 0 &&
                     words.data.size() == std::size_t(words.width) * std::size_t(words.height) *
                                              words.channels.size(),
                 "data fit the size");
  write_file(path, [&](const std::string& name) { return plugin().write_words(name, words); });
}

}  // namespace pellucid
