// Parsers of option values; strict, because a typing error must not become another render.
#include "apps/common.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "scene/scene.h"

namespace pellucid {
namespace {

[[noreturn]] void refuse(std::string_view option, const std::string& text, const char* accepted) {
  throw UsageError(fmt::format("{} takes {}, not '{}'", option, accepted, text));
}

/// Reads a finite number from the front of `rest` and removes it. from_chars knows no locale and
/// takes no leading space or plus sign.
bool take_number(std::string_view& rest, double& value) {
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return true;
}

/// Removes and returns the letters at the front of `rest`.
std::string_view take_letters(std::string_view& rest) {
  std::size_t count = 0;
  while (count < rest.size() && std::isalpha(static_cast<unsigned char>(rest[count]))) ++count;
  const std::string_view letters = rest.substr(0, count);
  rest.remove_prefix(count);
  return letters;
}

/// Seconds per unit; 0 for an unknown one.
double seconds_of(std::string_view unit) {
  if (unit == "ms") return 1e-3;
  if (unit == "s") return 1.0;
  if (unit == "m" || unit == "min") return 60.0;
  if (unit == "h") return 3600.0;
  if (unit == "d") return 86400.0;
  return 0.0;
}

}  // namespace

double parse_number(std::string_view option, const std::string& text) {
  std::string_view rest = text;
  double value = 0;
  if (!take_number(rest, value) || !rest.empty()) refuse(option, text, "a number such as 1e-3");
  return value;
}

double parse_fraction(std::string_view option, const std::string& text) {
  std::string_view rest = text;
  double value = 0;
  if (!take_number(rest, value) || !(rest.empty() || rest == "%"))
    refuse(option, text, "a number such as 0.01 or 1%");
  return rest.empty() ? value : value / 100.0;
}

double parse_duration(std::string_view option, const std::string& text) {
  const char* accepted = "a time such as 90, 60s, 10m or 1h30m";
  std::string_view rest = text;
  double total = 0;
  do {
    double value = 0;
    if (!take_number(rest, value) || value < 0 || std::signbit(value))
      refuse(option, text, accepted);
    if (rest.empty() && total == 0) return value;  // a bare number means seconds
    const double unit = seconds_of(take_letters(rest));
    if (unit == 0) refuse(option, text, accepted);
    total += value * unit;
  } while (!rest.empty());
  if (!std::isfinite(total)) refuse(option, text, accepted);
  return total;
}

std::pair<int, int> parse_size(std::string_view option, const std::string& text) {
  const char* accepted =
      "a size in pixels such as 640x480 (each side 1 to 32768, at most 2^28 pixels)";
  const auto side = [&](std::string_view part) {
    int value = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    const bool whole = error == std::errc() && end == part.data() + part.size();
    if (!whole || value < 1 || value > largest_side) refuse(option, text, accepted);
    return value;
  };
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) refuse(option, text, accepted);
  const std::string_view view = text;
  const std::pair<int, int> size{side(view.substr(0, cross)), side(view.substr(cross + 1))};
  if (std::int64_t{size.first} * size.second > largest_film) refuse(option, text, accepted);
  return size;
}

/// Reads whole numbers with commas between them: all of the text, or false.
template <typename T, std::size_t N>
static bool read_list(const std::string& text, std::array<T, N>& numbers) {
  const char *at = text.data(), *const end = at + text.size();
  for (T& number : numbers) {
    if (&number != numbers.data() && (at == end || *at++ != ',')) return false;
    const auto result = std::from_chars(at, end, number);
    if (result.ec != std::errc()) return false;
    at = result.ptr;
  }
  return at == end;
}

constexpr std::uint64_t most_passes = std::uint64_t{1} << 32;

Window parse_crop(std::string_view option, const std::string& text, int width, int height) {
  const char* accepted = "pixels x0,x1,y0,y1 with x0 < x1 and y0 < y1, such as 0,128,64,128";
  std::array<int, 4> edges{};
  if (!read_list(text, edges)) refuse(option, text, accepted);
  const auto [x0, x1, y0, y1] = edges;
  if (x0 >= x1 || y0 >= y1) refuse(option, text, accepted);
  if (x0 < 0 || y0 < 0 || x1 > width || y1 > height)
    throw UsageError(
        fmt::format("{} {} reaches outside the picture of {}x{}", option, text, width, height));
  return {x0, y0, x1 - x0, y1 - y0};
}

SamplePlace parse_sample(std::string_view option, const std::string& text, const Window& w) {
  std::array<std::uint64_t, 3> numbers{};
  if (!read_list(text, numbers))
    refuse(option, text, "column, row and pass X,Y,PASS, such as 12,40,7");
  const auto [x, y, pass] = numbers;
  const auto inside = [](std::uint64_t at, int from, int size) {
    return at >= std::uint64_t(from) && at < std::uint64_t(from + size);
  };
  if (!inside(x, w.x0, w.width) || !inside(y, w.y0, w.height))
    throw UsageError(fmt::format("{} {}: the picture has columns {} to {} and rows {} to {}",
                                 option, text, w.x0, w.x0 + w.width - 1, w.y0,
                                 w.y0 + w.height - 1));
  if (pass >= most_passes) refuse(option, text, "a pass below 2^32");
  return {int(x), int(y), pass};
}

PassRange parse_passes(std::string_view option, const std::string& text) {
  const char* accepted = "a range A:B of passes with A < B, such as 0:64";
  PassRange range;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, range.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ':')
    refuse(option, text, accepted);
  const auto last = std::from_chars(first.ptr + 1, end, range.last);
  if (last.ec != std::errc() || last.ptr != end || range.first >= range.last ||
      range.last > most_passes)
    refuse(option, text, accepted);
  return range;
}

std::uint64_t parse_bytes(std::string_view option, const std::string& text) {
  const char* accepted = "a number of bytes such as 2G, 512M or 1000000";
  std::string_view rest = text;
  double value = 0;
  if (!take_number(rest, value) || value <= 0) refuse(option, text, accepted);
  if (!rest.empty() && rest != "B") {
    const std::size_t power = std::string_view("KMGT").find(char(std::toupper(rest[0])));
    rest.remove_prefix(1);
    if (power == std::string_view::npos || !(rest.empty() || rest == "B" || rest == "iB"))
      refuse(option, text, accepted);
    value *= std::pow(1024.0, double(power + 1));
  }
  constexpr double most = 1e18;
  if (value < 1 || value > most) refuse(option, text, accepted);
  return std::uint64_t(value);
}

void print_result(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0)
    throw OutputError("cannot write to standard output: " + system_reason(errno));
}

void write_json(const std::string& destination, const nlohmann::json& document) {
  if (destination.empty()) return;
  nlohmann::ordered_json whole;
  whole["schema"] = 1;
  for (const auto& [key, value] : document.items()) whole[key] = value;
  const std::string text =
      whole.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
  if (destination == "-") return print_result(text);
  write_text_atomic(destination, text);
}

}  // namespace pellucid
