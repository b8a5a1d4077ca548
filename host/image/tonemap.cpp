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

/// Every sixteenth colour of matplotlib's magma, by S. van der Walt and N. Smith (CC0).
constexpr std::array<Rgb, 17> MAGMA = {{{0.001462f, 0.000466f, 0.013866f},
                                        {0.039608f, 0.031090f, 0.133515f},
                                        {0.113094f, 0.065492f, 0.276784f},
                                        {0.211718f, 0.061992f, 0.418647f},
                                        {0.316654f, 0.071690f, 0.485380f},
                                        {0.414709f, 0.110431f, 0.504662f},
                                        {0.512831f, 0.148179f, 0.507648f},
                                        {0.613617f, 0.181811f, 0.498536f},
                                        {0.716387f, 0.214982f, 0.475290f},
                                        {0.816914f, 0.255895f, 0.436461f},
                                        {0.904281f, 0.319610f, 0.388137f},
                                        {0.960949f, 0.418323f, 0.359630f},
                                        {0.986700f, 0.535582f, 0.382210f},
                                        {0.996096f, 0.653659f, 0.446213f},
                                        {0.996898f, 0.769591f, 0.534892f},
                                        {0.992440f, 0.884330f, 0.640099f},
                                        {0.987053f, 0.991438f, 0.749504f}}};
/// Too dark, right, too bright.
constexpr std::array<Rgb, 5> BALANCE = {
    {{0, 0.1f, 0.5f}, {0.2f, 0.5f, 0.9f}, {1, 1, 1}, {0.9f, 0.4f, 0.2f}, {0.5f, 0, 0}}};
constexpr float MOST_DEVIATIONS = 5.0f;

template <std::size_t N>
Rgb colour_at(const std::array<Rgb, N>& scale, float t) {
  if (std::isnan(t)) return NOT_A_NUMBER;
  const float place = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(N - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), N - 2);
  const float part = place - static_cast<float>(below);
  Rgb colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = (1 - part) * scale[below][c] + part * scale[below + 1][c];
  return colour;
}

Rgb error_colour(float value, ErrorScale scale) {
  switch (scale) {
    case ErrorScale::relative:
      return heat_colour((std::log10(value) - LOWEST_DECADE) / DECADES);
    case ErrorScale::perceived:
      return colour_at(MAGMA, value);
    case ErrorScale::deviations:
      return colour_at(BALANCE, 0.5f + 0.5f * value / MOST_DEVIATIONS);
    case ErrorScale::signed_relative:
      break;
  }
  const float size = 1 + std::log10(std::abs(value)) / -LOWEST_DECADE;  // 0 at 0.001, 1 at 1
  return colour_at(BALANCE, 0.5f + std::copysign(0.5f * std::max(size, 0.0f), value));
}

/// The fit of ACES's reference curves for displays [Narkowicz15]: f(0) = 0, f(1) = 0.8038; it
/// reaches 1 near 7.2.
double filmic(double v) {
  if (v > 1e8) return 1.0;  // long since white, and squares stay finite
  return (v * (2.51 * v + 0.03)) / (v * (2.43 * v + 0.59) + 0.14);
}

}  // namespace

std::array<float, 3> heat_colour(float t) {
  return colour_at(SCALE, t);
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

Image false_colour(const Image& error, ErrorScale scale) {
  Image out = rgb_like(error);
  for (const float value : error.data)
    for (const float component : error_colour(value, scale)) out.data.push_back(component);
  return out;
}

}  // namespace pellucid
