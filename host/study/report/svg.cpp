// SVG as text, a tenth of a pixel exact.
#include "study/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/report/markup.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

/// What is no number is drawn at the corner rather than printed.
double drawable(double x) {
  return std::isfinite(x) ? x : 0;
}

std::string number(double x) {
  const double tenths = std::round(10 * drawable(x));
  return tenths == 0 ? "0" : fmt::format("{:.1f}", tenths / 10);  // never "-0.0"
}

std::string points_text(const std::vector<SvgPoint>& points) {
  std::string text;
  for (const SvgPoint& p : points)
    text += (text.empty() ? "" : " ") + number(p.x) + "," + number(p.y);
  return text;
}

std::string tip_element(const std::string& tip) {
  return tip.empty() ? "" : text_element("title", "", tip);
}

}  // namespace

Svg::Svg(double width, double height, const std::string& label)
    : head_(fmt::format("viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\"", number(width),
                        number(height), escaped(label))) {}

void Svg::line(SvgPoint a, SvgPoint b, const std::string& classes) {
  body_ += element("line", fmt::format(R"(class="{}" x1="{}" y1="{}" x2="{}" y2="{}")", classes,
                                       number(a.x), number(a.y), number(b.x), number(b.y)));
}

void Svg::path(const std::vector<SvgPoint>& points, const std::string& classes) {
  if (points.size() < 2) return;
  body_ +=
      element("polyline", fmt::format(R"(class="{}" points="{}")", classes, points_text(points)));
}

void Svg::area(const std::vector<SvgPoint>& points, const std::string& classes) {
  if (points.size() < 3) return;
  body_ +=
      element("polygon", fmt::format(R"(class="{}" points="{}")", classes, points_text(points)));
}

void Svg::rect(SvgPoint at, double width, double height, const std::string& classes,
               const std::string& tip) {
  if (!(width > 0) || !(height > 0)) return;
  body_ += element("rect",
                   fmt::format(R"(class="{}" x="{}" y="{}" width="{}" height="{}")", classes,
                               number(at.x), number(at.y), number(width), number(height)),
                   tip_element(tip));
}

void Svg::mark(SvgPoint at, double radius, const MarkShape& shape, const std::string& classes,
               const std::string& tip) {
  if (shape.sides == 0) {
    body_ += element("circle",
                     fmt::format(R"(class="{}" cx="{}" cy="{}" r="{}")", classes, number(at.x),
                                 number(at.y), number(radius)),
                     tip_element(tip));
    return;
  }
  // The same area as the circle.
  const double pi = 3.14159265358979323846, corner = 2 * pi / shape.sides;
  const double reach = radius * std::sqrt(corner / std::sin(corner));
  std::vector<SvgPoint> points;
  for (int k = 0; k < shape.sides; ++k) {
    const double a = shape.turn * pi / 180 + k * corner;
    points.push_back({at.x + reach * std::cos(a), at.y - reach * std::sin(a)});
  }
  body_ +=
      element("polygon", fmt::format(R"(class="{}" points="{}")", classes, points_text(points)),
              tip_element(tip));
}

void Svg::text(SvgPoint at, const std::string& text, const std::string& classes) {
  body_ += text_element(
      "text", fmt::format(R"(class="{}" x="{}" y="{}")", classes, number(at.x), number(at.y)),
      text);
}

void Svg::begin_clip(SvgPoint at, double width, double height, const std::string& id) {
  const std::string frame =
      element("rect", fmt::format(R"(x="{}" y="{}" width="{}" height="{}")", number(at.x),
                                  number(at.y), number(width), number(height)));
  body_ += element("clipPath", "id=\"" + id + "\"", frame);
  body_ += "<g clip-path=\"url(#" + id + ")\">\n";
}

void Svg::end_clip() {
  body_ += "</g>\n";
}

std::string Svg::markup() const {
  return element("svg", head_, "\n" + body_);
}

double LogAxis::at(double value) const {
  if (!(value > 0) || !(high > low)) return start;
  return start + (end - start) * std::log(value / low) / std::log(high / low);
}

double LogAxis::cut(double value) const {
  return std::min(high, std::max(low, value));
}

std::vector<AxisTick> LogAxis::time_ticks() const {
  struct Time {
    double seconds;
    const char* label;
    bool coarse;  ///< also on long axes
  };
  static const Time times[] = {
      {1e-4, "0.1 ms", true},   {1e-3, "1 ms", true},    {0.01, "10 ms", true},
      {0.02, "20 ms", false},   {0.05, "50 ms", false},  {0.1, "0.1 s", true},
      {0.2, "0.2 s", false},    {0.5, "0.5 s", false},   {1, "1 s", true},
      {2, "2 s", false},        {5, "5 s", false},       {10, "10 s", true},
      {20, "20 s", false},      {60, "1 min", true},     {120, "2 min", false},
      {300, "5 min", false},    {600, "10 min", true},   {1200, "20 min", false},
      {3600, "1 h", true},      {7200, "2 h", false},    {18000, "5 h", false},
      {36000, "10 h", true},    {86400, "1 d", false},   {345600, "4 d", true},
      {864000, "10 d", false},  {2592000, "30 d", true}, {31557600, "1 y", true},
      {315576000, "10 y", true}};
  std::vector<AxisTick> ticks;
  for (const Time& time : times)
    if (holds(time.seconds) && (time.coarse || high / low < 200))
      ticks.push_back({time.seconds, time.label});
  return ticks;
}

std::vector<AxisTick> LogAxis::percent_ticks() const {
  std::vector<AxisTick> ticks;
  if (!(low > 0 && high >= low && std::isfinite(high))) return ticks;  // an axis without values
  const bool fine = high / low < 300;
  const int first = int(std::floor(std::log10(low))), last = int(std::ceil(std::log10(high)));
  const int step = 1 + (last - first) / 8;
  for (int e = first; e <= last; e += step)
    for (int m : {1, 2, 5}) {
      const double value = m * std::pow(10.0, e);
      if (holds(value) && (m == 1 || fine)) ticks.push_back({value, percent(value, 1)});
    }
  return ticks;
}

std::vector<double> spread(std::vector<double> wanted, double gap, double low, double high) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  double least = low;
  for (std::size_t i : order) {
    wanted[i] = std::max(wanted[i], least);
    least = wanted[i] + gap;
  }
  double most = high;
  for (auto i = order.rbegin(); i != order.rend(); ++i) {
    wanted[*i] = std::min(wanted[*i], most);
    most = wanted[*i] - gap;
  }
  return wanted;
}

double text_width(const std::string& text, double size) {
  return 0.56 * size * double(text.size());
}

}  // namespace pellucid
