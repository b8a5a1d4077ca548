// Images in memory and the interface to the library that reads and writes them. OpenImageIO costs
// 260 shared objects at start-up, so it lives behind dlopen: only commands that touch images pay.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace pellucid {

using MetaValue =
    std::variant<int, float, std::string, std::vector<float>>;  ///< 16 floats = matrix

/// Float image, row-major, channels interleaved: data[(y * width + x) * channels.size() + c].
struct Image {
  int width = 0, height = 0;
  int x0 = 0, y0 = 0;                   ///< place in the whole picture, for a crop
  int full_width = 0, full_height = 0;  ///< of the whole picture; 0: this is the whole
  std::vector<std::string> channels;    ///< e.g. {"R","G","B","variance.R",...}
  std::vector<float> data;
  std::map<std::string, MetaValue> metadata;  ///< e.g. "samplesPerPixel", "pellucid:seed"

  /// Index of a channel, or -1.
  int channel(const std::string& name) const {
    for (size_t i = 0; i < channels.size(); ++i)
      if (channels[i] == name) return static_cast<int>(i);
    return -1;
  }
};

/// A further channel of a picture, by itself.
struct AovChannel {
  std::string name;
  std::vector<float> data;  ///< row by row
};
/// Appends channels of the image's size.
void add_channels(Image& image, const std::vector<AovChannel>& channels);

/// Whole numbers by channel, row-major and interleaved as in Image: data that must come back bit
/// for bit.
struct WordImage {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::vector<unsigned> data;
  std::map<std::string, MetaValue> metadata;

  /// Index of a channel, or -1.
  int channel(const std::string& name) const {
    for (size_t i = 0; i < channels.size(); ++i)
      if (channels[i] == name) return static_cast<int>(i);
    return -1;
  }
};

/// Metadata key: 8-bit values are linear; PNG files then say so instead of naming sRGB.
constexpr const char* LINEAR_PICTURE = "linearPicture";

/// Loads the image library now (0.2 s) instead of at the first read or write, so that a broken
/// installation shows before hours of rendering. Any thread may call it. Throws InputError with
/// what to do.
void load_image_library();

/// Reads any format the image library knows, the first picture in the file, all channels as float32
/// (8-bit files: stored value/255). `linearise` undoes the sRGB curve in the colour channels of
/// files with 8 or 16 bits that do not call themselves linear; floating-point files are linear
/// anyway. EXR channels come in the order they were given to write_image(). A file that claims more
/// than `most_pixels` is refused before memory is asked for. Throws InputError naming the file and
/// the reason.
Image read_image(const std::string& path, bool linearise = false,
                 std::size_t most_pixels = std::size_t{1} << 32);

/// Writes by suffix: .exr (float32, ZIP, all channels and metadata), .png (8 bit; data must already
/// be display-referred in [0,1], clipped otherwise, NaN becomes 0), others as the library can. A
/// format that cannot hold all channels gets R, G, B only (or the first channel where there are
/// none). Metadata is for EXR alone: 16 floats become a matrix (M44f), rows as given; lists of
/// other lengths are not kept. Atomic: a temporary name in the same folder, then rename. Throws
/// OutputError naming the file and the reason.
void write_image(const std::string& path, const Image& image);

/// OpenEXR with 32-bit whole-number channels, whatever the name; not compressed, since words of
/// sums have little to gain. Errors and atomicity as above; reading also fails where a channel is
/// of another type.
WordImage read_words(const std::string& path);
/// Whether the file is one of these, and whole.
bool holds_words(const std::string& path);
void write_words(const std::string& path, const WordImage& words);

}  // namespace pellucid
