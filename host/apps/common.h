// What commands share: option values as people write them, and results on stdout or in a file.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "render/film.h"

namespace pellucid {

/// All parsers name `option` in the UsageError they throw, say what is accepted, and take the whole
/// text or nothing.

/// A finite number: "1e-3".
double parse_number(std::string_view option, const std::string& text);
/// A number or a percentage: "1%" is 0.01.
double parse_fraction(std::string_view option, const std::string& text);
/// Seconds from "90", "60s", "500ms", "10m", "1h", "1.5d", "1h30m"; not negative.
double parse_duration(std::string_view option, const std::string& text);
/// Width and height in pixels from "640x480", within the limits of a film.
std::pair<int, int> parse_size(std::string_view option, const std::string& text);

/// Pixels "x0,x1,y0,y1", half-open, of a picture of that size.
Window parse_crop(std::string_view option, const std::string& text, int width, int height);
/// One sample of a picture.
struct SamplePlace {
  int x = 0, y = 0;
  std::uint64_t pass = 0;
};
/// "X,Y,PASS", of a pixel in the window and a pass below 2^32.
SamplePlace parse_sample(std::string_view option, const std::string& text, const Window& window);
/// Global passes "A:B", A < B <= 2^32.
PassRange parse_passes(std::string_view option, const std::string& text);
/// Bytes from "2G", "512M", "1.5GiB", "1000000"; suffixes are powers of 1024; positive.
std::uint64_t parse_bytes(std::string_view option, const std::string& text);

/// Writes to stdout at once. Throws OutputError if it is full or closed.
void print_result(std::string_view text);

/// The document with "schema": 1 put in front, indented, into a file (atomically) or, for "-", to
/// stdout; does nothing for "". Non-finite numbers become null. Throws OutputError.
void write_json(const std::string& destination, const nlohmann::json& document);

}  // namespace pellucid
