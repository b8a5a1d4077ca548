// What seconds and errors are made of: passes, and variance beside bias.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "study/report/charts.h"
#include "study/report/facts.h"
#include "study/report/markup.h"
#include "study/report/style.h"
#include "study/report/svg.h"
#include "study/report/text.h"

namespace pellucid {
namespace {

std::vector<PassSeconds> dearest_first(const StudyOption& option) {
  std::vector<PassSeconds> passes;
  for (const PassSeconds& pass : option.passes)
    if (pass.seconds > 0 && std::isfinite(pass.seconds)) passes.push_back(pass);
  std::stable_sort(passes.begin(), passes.end(), [](const PassSeconds& a, const PassSeconds& b) {
    return a.seconds > b.seconds;
  });
  return passes;
}

double sum(const std::vector<PassSeconds>& passes) {
  double total = 0;
  for (const PassSeconds& pass : passes) total += pass.seconds;
  return total;
}

/// As many passes, by share, as fit into a line.
std::string shares(const std::vector<PassSeconds>& passes, std::size_t letters) {
  const double total = sum(passes);
  std::string text;
  for (const PassSeconds& pass : passes) {
    const std::string part =
        fmt::format("{}{} {}", text.empty() ? "" : ", ", pass.name, percent(pass.seconds / total));
    if (text.size() + part.size() > letters) return text + ", ...";
    text += part;
  }
  return text;
}

constexpr double SPLIT_WIDTH = 230, SPLIT_HEIGHT = 150, SPLIT_TOP = 8, SPLIT_BOTTOM = 112;
constexpr double SPLIT_LEFT = 42;

std::string split_chart(const StudyOption& option) {
  const std::string method = method_class(option.integrator);
  Svg svg(SPLIT_WIDTH, SPLIT_HEIGHT, "Shares of variance and squared bias, " + option.name());
  const auto height_of = [](double share) {
    return SPLIT_BOTTOM - (SPLIT_BOTTOM - SPLIT_TOP) * std::clamp(share, 0.0, 1.0);
  };
  for (double share : {0.0, 0.5, 1.0}) {
    svg.line({SPLIT_LEFT, height_of(share)}, {SPLIT_WIDTH, height_of(share)}, "grid");
    svg.text({SPLIT_LEFT - 6, height_of(share)}, fmt::format("{:.0f} %", 100 * share),
             "soft small end");
  }
  const double step = (SPLIT_WIDTH - SPLIT_LEFT) / double(option.splits.size());
  const double bar = std::min(30.0, 0.7 * step);
  const std::size_t every = option.splits.size() > 4 ? 2 : 1;
  for (std::size_t k = 0; k < option.splits.size(); ++k) {
    const Split& s = option.splits[k];
    const double middle = SPLIT_LEFT + step * (double(k) + 0.5), left = middle - bar / 2;
    const double variance = std::max(0.0, s.variance), bias2 = std::max(0.0, s.bias2);
    const double total = variance + bias2;
    const double edge = total > 0 ? height_of(bias2 / total) : SPLIT_BOTTOM;
    const std::string tip =
        fmt::format("{} spp: relMSE {} = variance {} + bias^2 {} (<= {})", s.spp,
                    digits(s.variance + s.bias2, 3), digits(s.variance, 3), digits(s.bias2, 3),
                    digits(s.bias2_upper90, 3));
    if (total > 0 && std::isfinite(total)) {
      svg.rect({left, SPLIT_TOP}, bar, edge - SPLIT_TOP, "bar s4 " + method, tip);
      svg.rect({left, edge}, bar, SPLIT_BOTTOM - edge, "bar " + method, tip);
      const double bound = height_of(s.bias2_upper90 / total);
      svg.line({middle, bound}, {middle, edge}, "whisker");
      svg.line({middle - 5, bound}, {middle + 5, bound}, "whisker");
    }
    if (k % every != (option.splits.size() - 1) % every) continue;
    svg.text({middle, SPLIT_BOTTOM + 13}, fmt::format("{}", s.spp), "soft small mid");
    svg.text({middle, SPLIT_BOTTOM + 28}, total > 0 ? percent(std::sqrt(total)) : std::string("-"),
             "soft small mid");
  }
  return svg.markup();
}

}  // namespace

std::string pass_chart(const Study& study) {
  constexpr double WIDTH = 780, LEFT = 160, RIGHT = 90, ROW = 40, BAR = 14;
  double most = 0;
  std::vector<const StudyOption*> shown;
  for (std::size_t i : ranked(study)) {
    const double total = sum(dearest_first(study.options[i]));
    if (total > 0) shown.push_back(&study.options[i]), most = std::max(most, total);
  }
  if (shown.empty()) return "";
  Svg svg(WIDTH, ROW * double(shown.size()), "Seconds of a sample per pixel, by pass and option");
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const StudyOption& option = *shown[k];
    const std::vector<PassSeconds> passes = dearest_first(option);
    const double y = ROW * double(k) + 4, scale = (WIDTH - LEFT - RIGHT) / most;
    svg.text({LEFT - 12, y + BAR / 2}, option.name(), "end");
    double x = LEFT;
    for (std::size_t p = 0; p < passes.size(); ++p) {
      const double width = scale * passes[p].seconds;
      svg.rect(
          {x, y}, width, BAR,
          fmt::format("bar s{} {}", std::min<std::size_t>(p, 4), method_class(option.integrator)),
          passes[p].name + ": " + duration(passes[p].seconds, 3));
      x += width;
    }
    svg.text({x + 8, y + BAR / 2}, duration(sum(passes), 3), "strong");
    svg.text({LEFT, y + BAR + 10}, shares(passes, 80), "soft small");
  }
  return svg.markup();
}

std::string split_charts(const Study& study) {
  std::string charts;
  for (std::size_t i : ranked(study)) {
    const StudyOption& option = study.options[i];
    if (option.splits.empty()) continue;
    charts +=
        element("figure", "", text_element("figcaption", "", option.name()) + split_chart(option));
  }
  return charts.empty() ? "" : element("div", "class=\"multiples\"", charts);
}

}  // namespace pellucid
