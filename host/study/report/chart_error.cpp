// Error over seconds.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/analyse.h"
#include "study/report/charts.h"
#include "study/report/facts.h"
#include "study/report/style.h"
#include "study/report/svg.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

constexpr double WIDTH = 780, LEFT = 58, RIGHT = 190, TOP = 12, BOTTOM = 64;
constexpr double LABEL_GAP = 17, LINE_NAME_GAP = 14;

struct Floor {
  const StudyOption* option;
  double error;
};

/// Also of options that were only measured in pairs and have no curve.
std::vector<Floor> all_floors(const Study& study) {
  std::vector<Floor> all;
  for (std::size_t i = 0; i < study.options.size(); ++i)
    if (const std::optional<double> floor = error_floor(study, i))
      all.push_back({&study.options[i], *floor});
  return all;
}

struct Series {
  const StudyOption* option;
  Verdict verdict;
  std::vector<ErrorPoint> points;  ///< those with an error
  double fit_to = 0;               ///< seconds; 0: no fit is drawn

  double last() const { return points.back().seconds; }
  double end_seconds() const { return std::max(last(), fit_to); }
  double end_error() const {
    return fit_to > 0 ? *fitted_error(*option, verdict, fit_to) : *points.back().error;
  }
  std::string classes() const { return option_classes(*option); }
};

/// Where the drawn fit ends: at the target, or as far as one may extrapolate; 0 where the target is
/// met by measurement, and where nobody vouches for the fit.
double fit_end(const Series& s) {
  double end = EXTRAPOLATION_MOST * s.last();
  switch (s.verdict.kind) {
    case TargetKind::extrapolated:
      end = std::min(end, s.verdict.seconds);
      break;
    case TargetKind::beyond:
    case TargetKind::never:
      break;
    default:
      return 0;
  }
  return end > s.last() && plausible(fitted_error(*s.option, s.verdict, end).value_or(0)) ? end : 0;
}

std::vector<Series> all_series(const Study& study) {
  std::vector<Series> all;
  for (std::size_t i = 0; i < study.options.size(); ++i) {
    Series s{&study.options[i], verdict_of(study, i), {}, 0};
    for (const ErrorPoint& p : error_curve(study.options[i]))
      if (p.error && plausible(*p.error) && plausible(p.seconds)) s.points.push_back(p);
    if (s.points.empty()) continue;
    s.fit_to = fit_end(s);
    all.push_back(s);
  }
  return all;
}

struct Chart {
  Svg svg;
  LogAxis x, y;
  SvgPoint at(double seconds, double error) const { return {x.at(seconds), y.at(error)}; }
};

Chart empty_chart(const Study& study, const std::vector<Series>& all) {
  double low_x = all[0].points[0].seconds, high_x = low_x, low_y = study.target, high_y = low_y;
  for (const Series& s : all) {
    low_x = std::min(low_x, s.points[0].seconds), high_x = std::max(high_x, s.end_seconds());
    low_y = std::min(low_y, s.end_error());
    for (const ErrorPoint& p : s.points)
      low_y = std::min(low_y, *p.error), high_y = std::max(high_y, *p.error);
  }
  const double lowest = low_y / 5;  // farther down, floors would press the curves together
  for (const Floor& floor : all_floors(study))
    if (floor.error > lowest) low_y = std::min(low_y, floor.error);
  const double height = std::max(430.0, TOP + BOTTOM + LABEL_GAP * double(all.size()));
  return {Svg(WIDTH, height, "Error over seconds, both on logarithmic scales, by option"),
          {low_x / 1.25, high_x * 1.25, LEFT, WIDTH - RIGHT},
          {low_y / 1.3, high_y * 1.3, height - BOTTOM, TOP}};
}

void draw_grid(Chart& c, double target) {
  for (const AxisTick& tick : c.x.time_ticks()) {
    c.svg.line({c.x.at(tick.value), c.y.start}, {c.x.at(tick.value), c.y.end}, "grid");
    c.svg.text({c.x.at(tick.value), c.y.start + 14}, tick.label, "soft mid");
  }
  for (const AxisTick& tick : c.y.percent_ticks()) {
    c.svg.line({c.x.start, c.y.at(tick.value)}, {c.x.end, c.y.at(tick.value)}, "grid");
    c.svg.text({c.x.start - 8, c.y.at(tick.value)}, tick.label, "soft end");
  }
  c.svg.line({c.x.start, c.y.start}, {c.x.end, c.y.start}, "axis");
  if (c.y.holds(target))
    c.svg.line({c.x.start, c.y.at(target)}, {c.x.end, c.y.at(target)}, "target");
}

void draw_band(Chart& c, const Series& s) {
  std::vector<SvgPoint> lower, upper;
  for (const ErrorPoint& p : s.points)
    if (p.low && p.high) {
      upper.push_back(c.at(p.seconds, std::min(*p.high, 100 * c.y.high)));
      lower.push_back(c.at(p.seconds, std::max(*p.low, c.y.low / 100)));
    }
  upper.insert(upper.end(), lower.rbegin(), lower.rend());
  c.svg.area(upper, "band " + s.classes());
}

void draw_curve(Chart& c, const Series& s) {
  std::vector<SvgPoint> curve, fit;
  for (const ErrorPoint& p : s.points) curve.push_back(c.at(p.seconds, *p.error));
  for (int k = 0; s.fit_to > 0 && k <= 24; ++k) {
    const double t = s.last() * std::pow(s.fit_to / s.last(), k / 24.0);
    if (const std::optional<double> error = fitted_error(*s.option, s.verdict, t))
      fit.push_back(c.at(t, *error));
  }
  c.svg.path(fit, "fit " + s.classes());
  c.svg.path(curve, "curve " + s.classes());
  for (const ErrorPoint& p : s.points) {
    std::string tip = fmt::format("{}, {} spp, {}: {}", s.option->name(), p.spp,
                                  duration(p.seconds, 3), percent(*p.error, 3));
    if (p.low && p.high) tip += fmt::format(" [{}, {}]", percent(*p.low), percent(*p.high));
    tip += fmt::format(", {} run{}", p.runs, p.runs == 1 ? "" : "s");
    c.svg.mark(c.at(p.seconds, *p.error), 3.6, method_mark(s.option->integrator),
               "mark " + s.classes(), tip);
  }
}

void draw_labels(Chart& c, const std::vector<Series>& all) {
  std::vector<double> wanted;
  for (const Series& s : all) wanted.push_back(c.y.at(c.y.cut(s.end_error())));
  const std::vector<double> heights = spread(wanted, LABEL_GAP, c.y.end + 6, c.y.start - 6);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Series& s = all[k];
    const double label = c.x.end + 22;
    c.svg.path({c.at(s.end_seconds(), c.y.cut(s.end_error())),
                {c.x.end + 4, wanted[k]},
                {label - 8, heights[k]}},
               "leader " + s.classes());
    c.svg.mark({label, heights[k]}, 4.2, method_mark(s.option->integrator), "mark " + s.classes());
    c.svg.text({label + 10, heights[k]}, s.option->name(), "strong");
  }
}

/// The floors, and at the left the names of target and floors, just above their lines.
void draw_floors(Chart& c, const Study& study) {
  std::vector<double> heights;
  std::vector<std::string> names;
  const auto name_line = [&](double error, const std::string& name) {
    if (!c.y.holds(error)) return;
    heights.push_back(c.y.at(error) - 8);
    names.push_back(fmt::format("{} {}", name, percent(error, error == study.target ? 1 : 2)));
  };
  name_line(study.target, "target");
  for (const Floor& floor : all_floors(study)) {
    name_line(floor.error, "floor of " + floor.option->name());
    if (c.y.holds(floor.error))
      c.svg.line({c.x.start, c.y.at(floor.error)}, {c.x.end, c.y.at(floor.error)},
                 "floor " + option_classes(*floor.option));
  }
  heights = spread(heights, LINE_NAME_GAP, c.y.end, c.y.start - 8);
  for (std::size_t k = 0; k < names.size(); ++k)
    c.svg.text({c.x.start + 6, heights[k]}, names[k],
               names[k].rfind("target", 0) == 0 ? "strong halo" : "soft small halo");
}

/// What the kinds of lines mean, below the axis.
void draw_key(Chart& c) {
  const double y = c.y.start + 44;
  double x = c.x.start;
  const auto entry = [&](const std::string& classes, const std::string& name) {
    if (classes == "band")
      c.svg.rect({x, y - 5}, 26, 10, "band key");
    else
      c.svg.line({x, y}, {x + 26, y}, classes + " key");
    c.svg.text({x + 32, y}, name, "soft small");
    x += 32 + text_width(name, 13) + 16;
  };
  entry("curve", "measured");
  entry("band", "90 % over runs");
  entry("fit", "extrapolated by the fit");
  entry("floor", "floor");
}

}  // namespace

std::string error_chart(const Study& study) {
  const std::vector<Series> all = all_series(study);
  if (all.empty()) return "";
  Chart c = empty_chart(study, all);
  draw_grid(c, study.target);
  c.svg.begin_clip({c.x.start, c.y.end}, c.x.end - c.x.start, c.y.start - c.y.end, "plot");
  for (const Series& s : all) draw_band(c, s);
  for (const Series& s : all) draw_curve(c, s);
  c.svg.end_clip();
  draw_floors(c, study);
  draw_labels(c, all);
  draw_key(c);
  return c.svg.markup();
}

}  // namespace pellucid
