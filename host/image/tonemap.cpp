// Curves and colour scales; none of them needs the image library.
#include "image/tonemap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pellucid {
namespace {

using Rgb = std::array<float, 3>;

Image rgb_like(const Image& image) {
  Image out;
  out.width = image.width;
  out.height = image.height;
  out.channels = {"R", "G", "B"};
  out.data.reserve(std::size_t(image.width) * std::size_t(image.height) * 3);
  return out;
}

/// From low to high.
constexpr std::array<Rgb, 5> SCALE = {
    {{0, 0, 0}, {0.1f, 0.2f, 0.9f}, {0.9f, 0.1f, 0.1f}, {1, 0.9f, 0}, {1, 1, 1}}};
constexpr Rgb NOT_A_NUMBER = {0, 1, 0};
constexpr float LOWEST_DECADE = -3.0f, DECADES = 4.0f;  // of errors

/// The fit of ACES's reference curves for displays [Narkowicz15]: f(0) = 0, f(1) = 0.8038; it
/// reaches 1 near 7.2.
double filmic(double v) {
  if (v > 1e8) return 1.0;  // long since white, and squares stay finite
  return (v * (2.51 * v + 0.03)) / (v * (2.43 * v + 0.59) + 0.14);
}

}  // namespace

std::array<float, 3> heat_colour(float t) {
  if (std::isnan(t)) return NOT_A_NUMBER;
  const float place = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(SCALE.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), SCALE.size() - 2);
  const float part = place - static_cast<float>(below);
  Rgb colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = (1 - part) * SCALE[below][c] + part * SCALE[below + 1][c];
  return colour;
}

float srgb_encode(float linear) {
  if (!(linear > 0.0f)) return 0.0f;
  if (linear >= 1.0f) return 1.0f;
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

float srgb_decode(float encoded) {
  if (!(encoded > 0.0f)) return 0.0f;
  if (encoded >= 1.0f) return 1.0f;
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float display_value(float linear, const DisplayTransform& display) {
  const double scaled = linear * std::exp2(display.exposure);
  if (!(scaled > 0.0)) return 0.0f;
  if (display.curve == ToneCurve::srgb) return srgb_encode(float(scaled));
  if (display.curve == ToneCurve::none) return float(std::min(scaled, 1.0));
  return srgb_encode(float(filmic(scaled)));
}

Image to_display(const Image& linear, const DisplayTransform& display) {
  Image out = rgb_like(linear);
  std::array<int, 3> from = {linear.channel("R"), linear.channel("G"), linear.channel("B")};
  if (*std::min_element(from.begin(), from.end()) < 0) from = {0, 0, 0};
  const std::size_t channels = linear.channels.size();
  for (std::size_t first = 0; first < linear.data.size(); first += channels)
    for (const int c : from)
      out.data.push_back(display_value(linear.data[first + std::size_t(c)], display));
  if (display.curve == ToneCurve::none) out.metadata[LINEAR_PICTURE] = 1;
  return out;
}

Image false_colour(const Image& error) {
  Image out = rgb_like(error);
  for (const float value : error.data)
    for (const float component : heat_colour((std::log10(value) - LOWEST_DECADE) / DECADES))
      out.data.push_back(component);
  return out;
}

}  // namespace pellucid
