// A small writer of SVG to stand inside HTML, and the logarithmic axis of charts. Looks come from
// the page's style sheet by class names.
#pragma once

#include <string>
#include <vector>

namespace pellucid {

struct SvgPoint {
  double x = 0, y = 0;
};

/// A regular polygon, or a circle (0 sides); `turn` in degrees from a corner at the right.
struct MarkShape {
  int sides = 0;
  double turn = 0;
};

class Svg {
 public:
  /// `label`: what the picture shows, for those who cannot see it.
  Svg(double width, double height, const std::string& label);
  void line(SvgPoint a, SvgPoint b, const std::string& classes);
  void path(const std::vector<SvgPoint>& points, const std::string& classes);  ///< open
  void area(const std::vector<SvgPoint>& points, const std::string& classes);  ///< closed
  /// With `tip` shown where the mouse rests, if there is one; nothing is drawn of no width.
  void rect(SvgPoint at, double width, double height, const std::string& classes,
            const std::string& tip = "");
  void mark(SvgPoint at, double radius, const MarkShape& shape, const std::string& classes,
            const std::string& tip = "");
  void text(SvgPoint at, const std::string& text, const std::string& classes);
  /// What follows, until end_clip, is cut at this rectangle. `id` is unique on the page.
  void begin_clip(SvgPoint at, double width, double height, const std::string& id);
  void end_clip();
  std::string markup() const;

 private:
  std::string head_, body_;
};

struct AxisTick {
  double value = 0;
  std::string label;
};

/// A logarithmic axis from `low` to `high` (both > 0), drawn from `start` to `end`.
struct LogAxis {
  double low = 1, high = 10, start = 0, end = 1;
  double at(double value) const;
  bool holds(double value) const { return value >= low && value <= high; }
  /// The same value, cut at the ends.
  double cut(double value) const;
  std::vector<AxisTick> time_ticks() const;     ///< 1 s, 10 s, 1 min, ...; finer over short ranges
  std::vector<AxisTick> percent_ticks() const;  ///< decades; 1, 2, 5 over short ranges
};

/// Whether a chart can show such seconds or such an error: beyond lie mistakes alone.
inline bool plausible(double value) {
  return value >= 1e-9 && value <= 1e12;
}

/// Heights of labels, each as near to its own as may be, at least `gap` apart and within the range
/// (if that holds them all).
std::vector<double> spread(std::vector<double> wanted, double gap, double low, double high);

/// Rough width of text of so many pixels a letter's height: to know what fits.
double text_width(const std::string& text, double size);

}  // namespace pellucid
