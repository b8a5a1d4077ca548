// Which method is best where in the picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "study/report/charts.h"
#include "study/report/facts.h"
#include "study/report/style.h"
#include "study/report/svg.h"
#include "study/report/text.h"
#include "study/tiles.h"

namespace pellucid {
namespace {

constexpr double WIDTH = 780, MAP = 400, ROW = 22, KEY = 440;
/// A tile whose best two differ by less has no winner: such errors rest on a few runs.
constexpr double CLEAR = 1.25;

struct Winner {
  std::size_t option = 0;
  bool clear = false;
};

/// Whose error the map compares: all that were measured in full and see all.
std::vector<std::size_t> contestants(const Study& study, std::size_t tiles) {
  std::vector<std::size_t> out;
  for (std::size_t i : ranked(study)) {
    const StudyOption& option = study.options[i];
    if (option.state == OptionState::main && option.plain() && option.tiles.size() == tiles &&
        longest_run(option) > 0)
      out.push_back(i);
  }
  return out;
}

/// The least relMSE x seconds of a tile.
Winner winner_of(const Study& study, const std::vector<std::size_t>& who, std::size_t tile) {
  double best = std::numeric_limits<double>::infinity(), second = best;
  Winner winner;
  for (std::size_t i : who) {
    const double cost = study.options[i].tiles[tile] * longest_run(study.options[i]);
    if (cost < best) {
      second = best, best = cost;
      winner.option = i;
    } else {
      second = std::min(second, cost);
    }
  }
  winner.clear = second > CLEAR * best;
  return winner;
}

}  // namespace

std::string tile_chart(const Study& study) {
  const Tiling tiling{study.width, study.height};
  if (tiling.count() <= 0) return "";
  const std::vector<std::size_t> who = contestants(study, std::size_t(tiling.count()));
  if (who.size() < 2) return "";
  const double cell = MAP / std::max(tiling.columns(), tiling.rows());
  const double height = std::max(cell * tiling.rows(), ROW * double(who.size() + 1));
  Svg svg(WIDTH, height, "The method with the least error times seconds, tile by tile");
  std::vector<int> clear(study.options.size());
  int open = 0;
  for (int tile = 0; tile < tiling.count(); ++tile) {
    const Winner w = winner_of(study, who, std::size_t(tile));
    (w.clear ? clear[w.option] : open) += 1;
    const StudyOption& option = study.options[w.option];
    svg.rect(
        {cell * (tile % tiling.columns()), cell * (tile / tiling.columns())}, cell, cell,
        (w.clear ? "bar " : "bar s3 ") + method_class(option.integrator),
        fmt::format("{}: error {} after {}{}", option.name(),
                    percent(std::sqrt(std::max(0.0, option.tiles[std::size_t(tile)]))),
                    duration(longest_run(option)), w.clear ? "" : "; another is about as good"));
  }
  double y = ROW / 2;
  const auto key = [&](const std::string& classes, const std::string& text) {
    svg.rect({KEY, y - 6}, 12, 12, "bar " + classes);
    svg.text({KEY + 20, y}, text, "");
    y += ROW;
  };
  for (std::size_t i : who)
    key(method_class(study.options[i].integrator),
        fmt::format("{}: {} of {} tiles", study.options[i].name(), clear[i], tiling.count()));
  key("s3 key", fmt::format("pale, two within {:.0f} %: {} tiles", 100 * (CLEAR - 1), open));
  return svg.markup();
}

}  // namespace pellucid
