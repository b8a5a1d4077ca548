// The types of pictures, by suffix.
#include "apps/outputs.h"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>

#include "apps/common.h"
#include "base/error.h"
#include "base/text.h"

namespace pellucid {
namespace {

const std::vector<std::string> LINEAR_TYPES = {"exr", "hdr", "tif", "tiff"};
const std::vector<std::string> DISPLAY_TYPES = {"png", "jpg", "jpeg", "bmp", "tga", "ppm", "webp"};

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

/// In small letters, without the dot; "" if there is none.
std::string suffix_of(const std::string& name) {
  const std::size_t slash = name.rfind('/'), dot = name.rfind('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return "";
  std::string suffix = name.substr(dot + 1);
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return suffix;
}

void check_type(const std::string& option, const std::string& name,
                const std::vector<std::string>& types) {
  const std::string suffix = suffix_of(name);
  if (contains(types, suffix)) return;
  const std::string what = suffix.empty() ? "the suffix tells the type, but there is none"
                           : contains(LINEAR_TYPES, suffix) ? "this is drawn for display"
                                                            : "unknown type of picture";
  throw UsageError(fmt::format("{} '{}': {}; there are {}.{}", option, name, what, join(types),
                               did_you_mean(suffix, types)));
}

}  // namespace

void check_picture_types(const std::vector<std::string>& names) {
  std::vector<std::string> types = LINEAR_TYPES;
  types.insert(types.end(), DISPLAY_TYPES.begin(), DISPLAY_TYPES.end());
  for (const std::string& name : names) check_type("-o", name, types);
}

void check_display_type(const std::string& option, const std::string& name) {
  check_type(option, name, DISPLAY_TYPES);
}

bool is_picture_name(const std::string& name) {
  const std::string suffix = suffix_of(name);
  return contains(LINEAR_TYPES, suffix) || contains(DISPLAY_TYPES, suffix) || suffix == "pfm";
}

ToneCurve parse_tone_curve(const std::string& option, const std::string& name) {
  static const std::vector<std::string> names = {"srgb", "filmic", "none"};  // as in ToneCurve
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw UsageError(fmt::format("{}: '{}' is none of {}.{}", option, name, join(names),
                                 did_you_mean(name, names)));
  return static_cast<ToneCurve>(found - names.begin());
}

void write_pictures(const std::vector<std::string>& names, const Image& linear,
                    const DisplayTransform& display) {
  std::exception_ptr first;
  for (const std::string& name : names) {
    try {
      const bool shown = contains(DISPLAY_TYPES, suffix_of(name));
      write_image(name, shown ? to_display(linear, display) : linear);
    } catch (const OutputError&) {
      if (!first) first = std::current_exception();
    }
  }
  if (first) std::rethrow_exception(first);
}

void DisplayFlags::declare(CLI::App& app) {
  app.add_option("--exposure", exposure,
                 "brighter by so many stops (negative: darker); display pictures only")
      ->type_name("EV");
  app.add_option(
         "--tonemap", tonemap,
         "curve of display pictures: the sRGB one alone, filmic highlights before it, or none "
         "(linear values, clipped)")
      ->type_name("srgb|filmic|none");
}

DisplayTransform DisplayFlags::transform() const {
  constexpr double most = 100;  // 2^100 is beyond the range between float's black and white
  DisplayTransform d;
  d.curve = parse_tone_curve("--tonemap", tonemap);
  if (!exposure.empty()) d.exposure = parse_number("--exposure", exposure);
  if (std::abs(d.exposure) > most)
    throw UsageError(fmt::format("--exposure takes stops from -100 to 100, not '{}'", exposure));
  return d;
}

}  // namespace pellucid
