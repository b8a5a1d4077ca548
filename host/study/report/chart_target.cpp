// Seconds to the target: a row for each option, its interval on a logarithmic axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/report/charts.h"
#include "study/report/facts.h"
#include "study/report/style.h"
#include "study/report/svg.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

constexpr double WIDTH = 780, LEFT = 160, RIGHT = 290, ROW = 24, TOP = 8, BOTTOM = 24;

bool timed(const Verdict& v) {
  return plausible(v.seconds) && v.kind != TargetKind::never && v.kind != TargetKind::unknown;
}

/// Ends of the interval, sound: around the value, within a factor of 1000.
double low_of(const Verdict& v) {
  return v.low > 0 && std::isfinite(v.low) ? std::clamp(v.low, v.seconds / 1000, v.seconds)
                                           : v.seconds;
}
double high_of(const Verdict& v) {
  return std::isfinite(v.high) ? std::clamp(v.high, v.seconds, 1000 * v.seconds) : 1000 * v.seconds;
}

void draw_row(Svg& svg, const LogAxis& axis, double y, const StudyOption& option,
              const Verdict& v) {
  const std::string method = method_class(option.integrator);
  const std::string classes = option_classes(option);
  if (!timed(v)) return;
  if (v.kind == TargetKind::beyond) {  // an arrow: at least
    svg.line({axis.at(v.seconds), y}, {axis.end, y}, "range guess " + method);
    svg.mark({axis.end, y}, 4, {3, 0}, "mark " + method);
    return;
  }
  svg.line({axis.at(low_of(v)), y}, {axis.at(high_of(v)), y},
           (v.kind == TargetKind::extrapolated ? "range guess " : "range ") + method);
  svg.mark({axis.at(v.seconds), y}, 4.6, method_mark(option.integrator), "mark " + classes,
           fmt::format("{}: {}", option.name(), duration_interval(v.seconds, v.low, v.high)));
}

}  // namespace

std::string target_chart(const Study& study) {
  double low = 0, high = 0;
  for (std::size_t i = 0; i < study.options.size(); ++i) {
    const Verdict v = verdict_of(study, i);
    if (!timed(v)) continue;
    const double to = v.kind == TargetKind::beyond ? 1.5 * v.seconds : high_of(v);
    low = low > 0 ? std::min(low, low_of(v)) : low_of(v);
    high = std::max(high, to);
  }
  if (!(low > 0)) return "";
  const std::vector<std::size_t> order = ranked(study);
  const double bottom = TOP + ROW * double(order.size());
  Svg svg(WIDTH, bottom + BOTTOM, "Seconds to the target with 90 % intervals, by option");
  const double margin = std::max(1.5, std::sqrt(10 * low / high));  // a decade at least
  const LogAxis axis{low / margin, high * margin, LEFT, WIDTH - RIGHT};
  for (const AxisTick& tick : axis.time_ticks()) {
    svg.line({axis.at(tick.value), TOP}, {axis.at(tick.value), bottom}, "grid");
    svg.text({axis.at(tick.value), bottom + 12}, tick.label, "soft mid");
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    const StudyOption& option = study.options[order[k]];
    const double y = TOP + ROW * (double(k) + 0.5);
    const bool best = int(order[k]) == study.recommended;
    svg.text({LEFT - 12, y}, option.name(), best ? "strong end" : "end");
    draw_row(svg, axis, y, option, verdict_of(study, order[k]));
    const bool flagged = !flags_of(study, order[k]).empty();
    svg.text({WIDTH - RIGHT + 14, y}, target_text(study, order[k]),
             best      ? "strong"
             : flagged ? "soft"
                       : "");
  }
  return svg.markup();
}

}  // namespace pellucid
