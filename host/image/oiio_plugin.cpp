// The only file that knows OpenImageIO: reads and writes images behind the interface of plugin.h.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>

#include "image/plugin.h"

namespace pellucid {
namespace {

/// The library renames these two of OpenEXR's standard attributes when it reads.
constexpr std::pair<const char*, const char*> RENAMED[] = {{"worldtocamera", "worldToCamera"},
                                                           {"worldtoscreen", "worldToNDC"}};

/// OpenEXR sorts channels by name; this attribute keeps the order they were declared in.
constexpr const char* ORDER_ATTRIBUTE = "pellucid:channels";
constexpr char ORDER_SEPARATOR = ' ';

/// The library adds the time of writing unless there is a date: it would make equal images differ.
constexpr const char* DATE_ATTRIBUTE = "DateTime";

std::string reason_or(const std::string& reason, const char* otherwise) {
  if (reason.empty()) return otherwise;
  // Messages may have several lines and name our temporary file: the first line tells enough.
  return reason.substr(0, reason.find('\n'));
}

/// Runs `f`; anything the library throws becomes a reason, except that memory ran out.
template <typename F>
std::string guarded(F&& f) {
  try {
    return f();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return reason_or(e.what(), "the image library failed");
  } catch (...) {
    return "the image library failed";
  }
}

// ---- metadata --------------------------------------------------------------------------------

void set_attribute(OIIO::ImageSpec& spec, const std::string& name, const MetaValue& value) {
  if (const int* number = std::get_if<int>(&value)) {
    spec.attribute(name, *number);
  } else if (const float* real = std::get_if<float>(&value)) {
    spec.attribute(name, *real);
  } else if (const std::string* text = std::get_if<std::string>(&value)) {
    spec.attribute(name, *text);
  } else {
    const std::vector<float>& values = std::get<std::vector<float>>(value);
    const bool matrix = values.size() == 16;
    spec.attribute(name,
                   matrix ? OIIO::TypeMatrix
                          : OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, static_cast<int>(values.size())),
                   values.data());
  }
}

/// Attributes of types we have no use for (e.g. rationals) are left out.
void get_attribute(const OIIO::ParamValue& p, std::map<std::string, MetaValue>& metadata) {
  std::string name = p.name().string();
  for (const auto& [theirs, standard] : RENAMED)
    if (name == theirs) name = standard;
  const OIIO::TypeDesc type = p.type();
  const std::size_t count = type.numelements() * type.aggregate;
  if (type == OIIO::TypeInt) {
    metadata[name] = p.get_int();
  } else if (type == OIIO::TypeFloat) {
    metadata[name] = p.get_float();
  } else if (type == OIIO::TypeString) {
    metadata[name] = p.get_string();
  } else if (type.basetype == OIIO::TypeDesc::FLOAT && p.nvalues() == 1) {
    const float* values = static_cast<const float*>(p.data());
    metadata[name] = std::vector<float>(values, values + count);
  }
}

// ---- channels --------------------------------------------------------------------------------

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(ORDER_SEPARATOR, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += (text.empty() ? std::string() : std::string(1, ORDER_SEPARATOR)) + word;
  return text;
}

/// Channels of `image` named in `names`, in that order; all of them must exist.
Image select_channels(const Image& image, const std::vector<std::string>& names) {
  Image out;
  out.width = image.width;
  out.height = image.height;
  out.channels = names;
  out.metadata = image.metadata;
  std::vector<std::size_t> from;
  for (const std::string& name : names) from.push_back(std::size_t(image.channel(name)));
  const std::size_t pixels = std::size_t(image.width) * std::size_t(image.height);
  out.data.reserve(pixels * names.size());
  for (std::size_t p = 0; p < pixels; ++p)
    for (const std::size_t c : from) out.data.push_back(image.data[p * image.channels.size() + c]);
  return out;
}

/// Undoes the sorting of OpenEXR, if the file says how.
void restore_order(Image& image) {
  const auto found = image.metadata.find(ORDER_ATTRIBUTE);
  if (found == image.metadata.end()) return;
  const std::string* text = std::get_if<std::string>(&found->second);
  const std::vector<std::string> order = text ? split(*text) : std::vector<std::string>();
  image.metadata.erase(found);
  if (order != image.channels &&
      std::is_permutation(order.begin(), order.end(), image.channels.begin(), image.channels.end()))
    image = select_channels(image, order);
}

std::vector<std::string> colour_channels(const Image& image) {
  if (image.channel("R") >= 0 && image.channel("G") >= 0 && image.channel("B") >= 0)
    return {"R", "G", "B"};
  return {image.channels.front()};
}

// ---- reading ---------------------------------------------------------------------------------

/// IEC 61966-2-1; tonemap.cpp has the same curve, which this library cannot link.
float srgb_to_linear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

bool is_srgb(const OIIO::ImageSpec& spec) {
  const bool integer = spec.format == OIIO::TypeUInt8 || spec.format == OIIO::TypeUInt16;
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return integer && space != "Linear" && space != "linear" && space != "scene_linear";
}

void linearise_colours(const OIIO::ImageSpec& spec, Image& image) {
  const std::size_t channels = image.channels.size();
  for (std::size_t i = 0; i < image.data.size(); ++i)
    if (static_cast<int>(i % channels) != spec.alpha_channel)
      image.data[i] = srgb_to_linear(image.data[i]);
}

/// Why a header cannot be believed, or "": one changed byte can ask for terabytes. No compression
/// of rendered pictures comes near the ratio, which leaves deflate's limit of 1032 far behind.
std::string doubt(const OIIO::ImageSpec& spec, const std::string& path) {
  constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28, most_channels = 4096;
  constexpr std::uint64_t most_ratio = 1 << 16;
  if (spec.image_pixels() <= most_pixels && std::uint64_t(spec.nchannels) <= most_channels &&
      spec.image_bytes(true) <= OIIO::Filesystem::file_size(path) * most_ratio)
    return "";
  return "its header asks for " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
         " pixels of " + std::to_string(spec.nchannels) +
         " channels, which the file cannot hold; it is damaged";
}

/// All pixels as floats. Asked for floats, the library converts through a buffer of 64 MiB even for
/// the smallest picture, which under AddressSanitizer takes 0.1 s; so it converts where all is
/// read.
bool read_floats(OIIO::ImageInput& file, const OIIO::ImageSpec& spec, float* floats) {
  const bool one_type = spec.channelformats.empty();
  if (!one_type || spec.format == OIIO::TypeFloat)
    return file.read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, floats);
  std::vector<unsigned char> stored(spec.image_bytes(true));
  return file.read_image(0, 0, 0, spec.nchannels, OIIO::TypeUnknown, stored.data()) &&
         OIIO::parallel_convert_image(spec.nchannels, spec.width, spec.height, spec.depth,
                                      stored.data(), spec.format, OIIO::AutoStride,
                                      OIIO::AutoStride, OIIO::AutoStride, floats, OIIO::TypeFloat,
                                      OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride);
}

std::string read_file(const std::string& path, bool linearise, std::size_t most_pixels,
                      Image& image) {
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // stored values, not multiplied by alpha
  auto file = OIIO::ImageInput::open(path, &config);
  if (!file) return reason_or(OIIO::geterror(), "unknown format");
  const OIIO::ImageSpec& spec = file->spec();
  if (spec.deep) return "deep images are not supported";
  if (spec.width <= 0 || spec.height <= 0 || spec.depth != 1 || spec.nchannels <= 0)
    return "not a flat picture with at least one pixel";
  if (spec.image_pixels() > most_pixels)
    return std::to_string(spec.width) + " x " + std::to_string(spec.height) +
           " pixels are too many; the most is " + std::to_string(most_pixels) + " in all";

  if (const std::string why = doubt(spec, path); !why.empty()) return why;

  image.width = spec.width;
  image.height = spec.height;
  const bool crop = spec.x != spec.full_x || spec.y != spec.full_y ||
                    spec.width != spec.full_width || spec.height != spec.full_height;
  if (crop) {
    image.x0 = spec.x - spec.full_x;
    image.y0 = spec.y - spec.full_y;
    image.full_width = spec.full_width;
    image.full_height = spec.full_height;
  }
  image.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
  image.data.resize(spec.image_pixels() * std::size_t(spec.nchannels));
  const bool read = read_floats(*file, spec, image.data.data());
  if (!read || file->has_error())  // the reader of TIFF says so only by its error
    return reason_or(file->geterror(), "pixels cannot be read");
  for (const OIIO::ParamValue& p : spec.extra_attribs) get_attribute(p, image.metadata);
  if (linearise && is_srgb(spec)) linearise_colours(spec, image);
  restore_order(image);
  file->close();
  return "";
}

// ---- writing ---------------------------------------------------------------------------------

OIIO::ImageSpec make_spec(const Image& image, const std::string& format) {
  const bool exr = format == "openexr";
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()),
                       format == "png" ? OIIO::TypeUInt8 : OIIO::TypeFloat);
  spec.channelnames.assign(image.channels.begin(), image.channels.end());
  const bool linear = image.metadata.count(LINEAR_PICTURE) > 0;
  if (format == "png") spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
  if (!exr) return spec;
  if (image.full_width > 0) {
    spec.x = image.x0;
    spec.y = image.y0;
    spec.full_width = image.full_width;
    spec.full_height = image.full_height;
  }
  spec.attribute("compression", "zip");
  for (const auto& [name, value] : image.metadata) set_attribute(spec, name, value);
  if (image.metadata.count(DATE_ATTRIBUTE) == 0) spec.attribute(DATE_ATTRIBUTE, "");
  spec.attribute(ORDER_ATTRIBUTE, joined(image.channels));
  return spec;
}

/// Quantisation of the library leaves NaN undefined.
void prepare_for_8_bit(Image& image) {
  for (float& value : image.data) value = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
}

std::string write_bytes(const std::string& path, const std::vector<unsigned char>& bytes) {
  errno = 0;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return std::strerror(errno);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int error = errno;
  if (std::fclose(file) != 0) return std::strerror(errno);
  return written ? "" : std::strerror(error);
}

/// Opens, writes, closes.
std::string encode(OIIO::ImageOutput& file, const std::string& path, const OIIO::ImageSpec& spec,
                   const Image& image) {
  if (!file.open(path, spec)) return reason_or(file.geterror(), "the file cannot be opened");
  if (!file.write_image(OIIO::TypeFloat, image.data.data()))
    return reason_or(file.geterror(), "pixels cannot be written");
  if (!file.close()) return reason_or(file.geterror(), "the file cannot be completed");
  return "";
}

std::string write_file(const std::string& path, const Image& original) {
  auto file = OIIO::ImageOutput::create(path);
  if (!file) return reason_or(OIIO::geterror(), "no format has this suffix");
  const std::string format = file->format_name();

  Image changed;  // only what has to change is copied: an EXR may be gigabytes
  const std::vector<std::string> colours = colour_channels(original);
  const bool holds_any = file->supports("nchannels") && file->supports("channelformats");
  const bool too_many = !holds_any && original.channels.size() > colours.size();
  const bool has_8_bits = format == "png" || format == "jpeg";
  if (too_many || has_8_bits)
    changed = select_channels(original, too_many ? colours : original.channels);
  if (has_8_bits) prepare_for_8_bit(changed);
  const Image& image = changed.data.empty() ? original : changed;

  const OIIO::ImageSpec spec = make_spec(image, format);
  // The writers of PNG and JPEG do not notice a full disk, so these are encoded in memory.
  if (format == "openexr" || !file->supports("ioproxy")) return encode(*file, path, spec, image);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  if (!file->set_ioproxy(&memory)) return encode(*file, path, spec, image);
  const std::string reason = encode(*file, path, spec, image);
  return reason.empty() ? write_bytes(path, bytes) : reason;
}

// ---- words -----------------------------------------------------------------------------------

constexpr const char* WORD_FORMAT = "openexr";

std::string read_word_file(const std::string& path, WordImage& words) {
  auto file = OIIO::ImageInput::create(WORD_FORMAT);
  OIIO::ImageSpec spec;
  if (!file || !file->open(path, spec)) return reason_or(OIIO::geterror(), "no OpenEXR file");
  if (spec.deep || spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0)
    return "not a flat picture with at least one pixel";
  for (int c = 0; c < spec.nchannels; ++c)
    if (spec.channelformat(c) != OIIO::TypeUInt32)
      return "not a checkpoint: channel " + spec.channelnames[std::size_t(c)] +
             " holds no whole numbers";
  if (const std::string why = doubt(spec, path); !why.empty()) return why;
  words.width = spec.width;
  words.height = spec.height;
  words.channels.assign(spec.channelnames.begin(), spec.channelnames.end());
  words.data.resize(spec.image_pixels() * std::size_t(spec.nchannels));
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeUInt32, words.data.data()))
    return reason_or(file->geterror(), "pixels cannot be read");
  for (const OIIO::ParamValue& p : spec.extra_attribs) get_attribute(p, words.metadata);
  file->close();
  return "";
}

std::string write_word_file(const std::string& path, const WordImage& words) {
  auto file = OIIO::ImageOutput::create(WORD_FORMAT);
  if (!file) return reason_or(OIIO::geterror(), "no OpenEXR writer");
  OIIO::ImageSpec spec(words.width, words.height, static_cast<int>(words.channels.size()),
                       OIIO::TypeUInt32);
  spec.channelnames.assign(words.channels.begin(), words.channels.end());
  spec.attribute("compression", "none");
  for (const auto& [name, value] : words.metadata) set_attribute(spec, name, value);
  spec.attribute(DATE_ATTRIBUTE, "");
  if (!file->open(path, spec)) return reason_or(file->geterror(), "the file cannot be opened");
  if (!file->write_image(OIIO::TypeUInt32, words.data.data()))
    return reason_or(file->geterror(), "pixels cannot be written");
  return file->close() ? "" : reason_or(file->geterror(), "the file cannot be completed");
}

std::string guarded_read_words(const std::string& path, WordImage& words) {
  return guarded([&] { return read_word_file(path, words); });
}
std::string guarded_write_words(const std::string& path, const WordImage& words) {
  return guarded([&] { return write_word_file(path, words); });
}
std::string guarded_read(const std::string& path, bool linearise, std::size_t most_pixels,
                         Image& image) {
  return guarded([&] { return read_file(path, linearise, most_pixels, image); });
}
std::string guarded_write(const std::string& path, const Image& image) {
  return guarded([&] { return write_file(path, image); });
}

const ImagePlugin plugin = {guarded_read, guarded_write, guarded_read_words, guarded_write_words};

}  // namespace
}  // namespace pellucid

extern "C" __attribute__((visibility("default"))) const pellucid::ImagePlugin*
PELLUCID_IMAGE_PLUGIN() {
  return &pellucid::plugin;
}
