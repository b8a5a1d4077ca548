// Layout and drawing of the pyramid.
#include "image/atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/canvas.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

constexpr int gap = 4, line = line_height;                      // pixels
constexpr int most_side = 256, least_side = 10 * letter_pitch;  // of a cell; texts fit

/// Size of a picture in its cell: it shrinks by a whole number, or grows by one.
struct Scale {
  int shrink, grow, width, height;  ///< the latter two after scaling

  Scale(int w, int h)
      : shrink((std::max(w, h) + most_side - 1) / most_side),
        grow(std::max(1, least_side / std::max(w, h))),
        width((w + shrink - 1) / shrink * grow),
        height((h + shrink - 1) / shrink * grow) {}
};

/// Where everything goes.
struct Layout {
  Scale scale;
  int rows = 0, columns = 0;
  bool two = false, beside = false;
  int gutter = 0;  ///< width of the rows' labels

  int cell_x() const { return std::max(scale.width, least_side) + gap; }
  int cell_y() const { return line + std::max(scale.height, 2 * line) + gap; }
  int pyramid_width() const { return gutter + columns * cell_x(); }
  int pyramid_height() const { return line + rows * cell_y(); }
  int width() const { return gap + pyramid_width() * (two && beside ? 2 : 1); }
  int height() const { return gap + pyramid_height() * (two && !beside ? 2 : 1); }
  int left(bool weighted) const { return gap + (!weighted && beside ? pyramid_width() : 0); }
  int top(bool weighted) const { return gap + (!weighted && !beside ? pyramid_height() : 0); }
};

void draw_cell(Canvas& canvas, const Layout& layout, int width, int height, const AtlasCell& cell,
               double exposure) {
  const Scale& scale = layout.scale;
  const int x0 = layout.left(cell.weighted) + layout.gutter + cell.column * layout.cell_x();
  const int y0 = layout.top(cell.weighted) + line + cell.row * layout.cell_y();
  canvas.text(x0, y0 + 2, cell.label);
  for (int y = 0; y < scale.height; ++y)
    for (int x = 0; x < scale.width; ++x) {
      const int fx = x / scale.grow * scale.shrink, fy = y / scale.grow * scale.shrink;
      const int last_x = std::min(fx + scale.shrink, width);
      const int last_y = std::min(fy + scale.shrink, height);
      double sum[3] = {0, 0, 0};
      for (int v = fy; v < last_y; ++v)
        for (int u = fx; u < last_x; ++u)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] +=
                double(cell.rgb[(std::size_t(v) * std::size_t(width) + std::size_t(u)) * 3 + c]);
      const double unit = std::exp2(exposure) / ((last_x - fx) * (last_y - fy));
      float* pixel = canvas.pixel(x0 + x, y0 + line + y);
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = srgb_encode(float(sum[c] * unit));
    }
}

/// All that a row has weighted, or, where that is black, unweighted.
std::vector<float> row_sum(int row, const std::vector<AtlasCell>& cells) {
  for (const bool weighted : {true, false}) {
    std::vector<float> sum;
    for (const AtlasCell& cell : cells) {
      if (cell.row != row || cell.weighted != weighted) continue;
      sum.resize(cell.rgb.size());
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += cell.rgb[i];
    }
    if (std::any_of(sum.begin(), sum.end(), [](float v) { return v > 0; })) return sum;
  }
  return {};
}

}  // namespace

double row_exposure(const std::vector<float>& rgb) {
  constexpr double bright_part = 0.9, bright_value = 0.7;
  std::vector<float> peaks;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const float peak = std::max({rgb[i], rgb[i + 1], rgb[i + 2]});
    if (peak > 0) peaks.push_back(peak);
  }
  if (peaks.empty()) return 0;
  const auto place = peaks.begin() + std::ptrdiff_t(bright_part * double(peaks.size() - 1));
  std::nth_element(peaks.begin(), place, peaks.end());
  return std::round(2 * std::log2(bright_value / double(*place))) / 2;
}

Image draw_atlas(int width, int height, const std::vector<std::string>& rows,
                 const std::vector<AtlasCell>& cells) {
  Layout layout{Scale(width, height)};
  layout.rows = int(rows.size());
  for (const AtlasCell& cell : cells) {
    PELLUCID_CHECK(cell.row < layout.rows, "every row has a label");
    PELLUCID_CHECK(cell.rgb.size() == 3 * std::size_t(width) * std::size_t(height),
                   "size of a cell");
    layout.columns = std::max(layout.columns, cell.column + 1);
    layout.two |= !cell.weighted;
  }
  std::vector<double> exposures;
  std::vector<std::string> stops;
  for (int row = 0; row < layout.rows; ++row) {
    exposures.push_back(row_exposure(row_sum(row, cells)));
    stops.push_back(fmt::format("{:+.1f} EV", exposures.back()));
  }
  for (const auto& texts : {rows, stops})
    for (const std::string& text : texts)
      layout.gutter = std::max(layout.gutter, int(text.size()) * letter_pitch + gap);
  const int w = layout.pyramid_width(), h = layout.pyramid_height();
  layout.beside = std::max(2 * w, h) <= std::max(w, 2 * h);

  Canvas canvas(layout.width(), layout.height());
  for (const bool weighted : {true, false}) {
    if (!weighted && !layout.two) continue;
    const int x = layout.left(weighted), y = layout.top(weighted);
    canvas.text(x + layout.gutter, y, weighted ? "weighted" : "unweighted");
    for (int row = 0; row < layout.rows; ++row) {
      const int under = y + line + row * layout.cell_y() + line;
      canvas.text(x, under, rows[std::size_t(row)]);
      canvas.text(x, under + line, stops[std::size_t(row)]);
    }
  }
  for (const AtlasCell& cell : cells)
    draw_cell(canvas, layout, width, height, cell, exposures[std::size_t(cell.row)]);
  return canvas.take();
}

}  // namespace pellucid
