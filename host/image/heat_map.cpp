// Scales of heat maps, and drawing.
#include "image/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/canvas.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

constexpr int gap = 6, bar = 8, tick = 3;  // pixels
constexpr int least_side = 180;            // of a picture; titles and scales fit

/// 1, 2, 5, 10, ... for i = 0, 1, 2, 3, ...
double series(int i) {
  constexpr double digits[] = {1, 2, 5};
  const int decade = int(std::floor(i / 3.0));
  return digits[i - 3 * decade] * std::pow(10.0, decade);
}

/// The last of the series that is not above a value > 0.
int series_below(double value) {
  int i = 3 * int(std::floor(std::log10(value))) + 3;
  while (series(i) > value) --i;
  return i;
}

std::array<float, 3> colour_at(float place) {
  constexpr float lowest = 0.15f;  // apart from black
  return heat_colour(lowest + (1 - lowest) * place);
}

/// Where everything goes.
struct Layout {
  int grow, panel_width, panel_height;
  bool beside;

  Layout(int w, int h, int maps)
      : grow((least_side + std::max(w, h) - 1) / std::max(w, h)),
        panel_width(std::max(w * grow, least_side) + gap),
        panel_height(line_height + h * grow + bar + tick + line_height + gap),
        beside(std::max(maps * panel_width, panel_height) <=
               std::max(panel_width, maps * panel_height)) {}
  int width(int maps) const { return gap + panel_width * (beside ? maps : 1); }
  int height(int maps) const { return gap + panel_height * (beside ? 1 : maps); }
  int left(int map) const { return gap + (beside ? map * panel_width : 0); }
  int top(int map) const { return gap + (beside ? 0 : map * panel_height); }
};

/// Neighbours differ by this much of the brightness.
float toned(float component, float parity) {
  constexpr float step = 0.15f;
  return (1 - step) * component + (parity > 1 ? step : 0.0f);
}

void draw_pixels(Canvas& canvas, int x0, int y0, int grow, int width, int height,
                 const HeatMap& map, const HeatScale& scale) {
  for (int y = 0; y < height * grow; ++y)
    for (int x = 0; x < width * grow; ++x) {
      const std::size_t i = std::size_t(y / grow) * std::size_t(width) + std::size_t(x / grow);
      if (!map.parity.empty() && map.parity[i] == 0) continue;
      const auto colour = scale.colour(map.values[i]);
      for (std::size_t c = 0; c < 3; ++c)
        canvas.pixel(x0 + x, y0 + y)[c] =
            map.parity.empty() ? colour[c] : toned(colour[c], map.parity[i]);
    }
}

/// The bar of colours, with ticks at the series and numbers where there is room for them.
void draw_scale(Canvas& canvas, int x0, int y0, int width, const HeatScale& scale) {
  const auto column = [&](double place) { return x0 + int(std::lround(place * (width - 1))); };
  for (int x = 0; x < width; ++x) {
    const auto colour = colour_at(float(x) / float(width - 1));
    for (int y = 0; y < bar; ++y)
      std::copy(colour.begin(), colour.end(), canvas.pixel(x0 + x, y0 + y));
  }
  int free = x0;  // the first column without a number
  for (const double value : scale.ticks()) {
    const int x = column(double(scale.place(float(value))));
    const std::string text = fmt::format("{:g}", value);
    const int wide = int(text.size()) * letter_pitch;
    const int from = std::clamp(x - wide / 2, x0, x0 + width - wide);
    for (int y = bar; y < bar + tick; ++y) std::fill_n(canvas.pixel(x, y0 + y), 3, 0.85f);
    if (from < free) continue;
    canvas.text(from, y0 + bar + tick + 1, text);
    free = from + wide + letter_pitch;
  }
}

}  // namespace

float HeatScale::place(float value) const {
  if (!(double(value) > low)) return 0.0f;
  return float(std::min(1.0, std::log(double(value) / low) / std::log(high / low)));
}

std::array<float, 3> HeatScale::colour(float value) const {
  return value > 0 ? colour_at(place(value)) : std::array<float, 3>{};
}

std::vector<double> HeatScale::ticks() const {
  std::vector<double> all;
  constexpr double rounding = 1 + 1e-9;  // powers of ten below 1 are inexact
  for (int i = series_below(low * rounding); series(i) <= high * rounding; ++i)
    all.push_back(series(i));
  return all;
}

HeatScale heat_scale(const std::vector<float>& values) {
  constexpr double outside = 0.01;
  std::vector<float> some;
  std::copy_if(values.begin(), values.end(), std::back_inserter(some),
               [](float v) { return v > 0; });
  if (some.empty()) return {1, 10};
  const auto ranked = [&](double part) {
    const auto place = some.begin() + std::ptrdiff_t(std::lround(part * double(some.size() - 1)));
    std::nth_element(some.begin(), place, some.end());
    return double(*place);
  };
  const int first = series_below(ranked(outside)), last = series_below(ranked(1 - outside)) + 1;
  return {series(first), series(last)};
}

Image draw_heat_maps(int width, int height, const std::vector<HeatMap>& maps) {
  const std::size_t pixels = std::size_t(width) * std::size_t(height);
  const int count = int(maps.size());
  const Layout layout(width, height, count);
  Canvas canvas(layout.width(count), layout.height(count));
  for (int m = 0; m < count; ++m) {
    const HeatMap& map = maps[std::size_t(m)];
    PELLUCID_CHECK(map.values.size() == pixels, "size of a heat map");
    PELLUCID_CHECK(map.parity.empty() || map.parity.size() == pixels, "size of its parity");
    const HeatScale scale = heat_scale(map.values);
    const int x = layout.left(m), y = layout.top(m) + line_height;
    canvas.text(x, layout.top(m), map.title);
    draw_pixels(canvas, x, y, layout.grow, width, height, map, scale);
    draw_scale(canvas, x, y + height * layout.grow + 2, layout.panel_width - gap, scale);
  }
  return canvas.take();
}

}  // namespace pellucid
