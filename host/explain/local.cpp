// Light in places where the other picture has none: lamps that emit on another side; and whatever
// else differs in one place alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/statistics.h"
#include "explain/causes.h"
#include "explain/least_squares.h"

namespace pellucid::explain {
namespace {

/// Segments of light that comes straight from a lamp: what cells of the place may show freely.
constexpr std::size_t DIRECT = 2;

/// From how many standard errors on, and from what part of its light on, a cell is out of line.
constexpr double SURE = 3, NOTABLE = 0.1;
/// How many times as bright makes light where the other has as good as none.
constexpr double ANEW = 2;
/// Of the cells' differences: how much must go one way, and how much must be light anew.
constexpr double ONE_WAY = 0.9, MOSTLY_ANEW = 0.5;
/// A place has up to this part of the picture.
constexpr double LOCAL = 0.5;
/// It is near the lights if the mean distance to what shows them is below this part of the mean of
/// all cells.
constexpr double NEAR = 0.6;

/// All channels of a cell in the groups of direct light (or in all there is).
struct CellLight {
  double other = 0, predicted = 0, variance = 0;
  double off() const { return other - predicted; }
};

/// The model: known layers, and what indirect light is added to them.
struct Model {
  std::vector<char> place;  ///< by cell
  Layers predicted;
  std::size_t factors = 0;
};

double total(const Layers& layers, std::size_t first) {
  double sum = 0;
  for (std::size_t l = first; l < layers.size(); ++l) sum += energy(layers[l]);
  return sum;
}

/// Where lengths are not told apart: lit surfaces are lamps of their own, and show at a length what
/// the others show one shorter. So what indirect light is more (or less, in all) outside the place
/// is a sum of the short known layers, in every channel.
void add_indirect(const Evidence& e, Model& m) {
  m.predicted = e.known;
  m.factors = 0;
  if (e.by_length() || e.lengths() <= DIRECT) return;
  constexpr std::size_t first = 1, most = 4;
  const std::size_t cells = e.grid.cells(), count = std::min(e.lengths() - first, most);
  const double sign = total(e.other, 0) < total(e.known, 0) ? -1 : 1;
  const Sums base = e.grouped(e.known).front();
  for (std::size_t c = 0; c < COLOURS; ++c) {
    LeastSquares fit(count);
    std::vector<double> x(count);
    for (std::size_t j = c * cells; j < (c + 1) * cells; ++j) {
      for (std::size_t k = 0; k < count; ++k) x[k] = e.known[first + k][j];
      const double noise = e.variance(0, j);
      if (!m.place[j % cells] && noise > 0) fit.add(x, sign * (e.other[0][j] - base[j]), 1 / noise);
    }
    const std::vector<double> factor = fit.solve_non_negative().value;
    for (std::size_t j = c * cells; j < (c + 1) * cells; ++j)
      for (std::size_t k = 0; k < count; ++k)
        m.predicted[DIRECT][j] += sign * factor[k] * e.known[first + k][j];
    m.factors += count;
  }
}

/// Indirect over known indirect light.
double indirect_factor(const Evidence& e, const Model& m) {
  const double before = total(e.known, DIRECT);
  const double after = total(e.by_length() ? e.other : m.predicted, DIRECT);
  return before > 0 ? after / before : 1;
}

std::size_t direct_groups(const Evidence& e) {
  return e.by_length() ? DIRECT : 1;
}

std::vector<CellLight> direct_light(const Evidence& e, const Layers& predicted) {
  const Layers groups = e.grouped(predicted);
  std::vector<CellLight> light(e.grid.cells());
  for (std::size_t g = 0; g < direct_groups(e); ++g)
    for (std::size_t j = 0; j < groups[g].size(); ++j) {
      CellLight& cell = light[j % e.grid.cells()];
      cell.other += e.other[g][j];
      cell.predicted += groups[g][j];
      // The same paths make all channels of a cell: deviations add up.
      const double deviation = std::sqrt(cell.variance) + std::sqrt(e.variance(g, j));
      cell.variance = deviation * deviation;
    }
  return light;
}

std::vector<char> out_of_line(const std::vector<CellLight>& light) {
  double mean = 0;
  for (const CellLight& cell : light) mean += std::abs(cell.predicted) / double(light.size());
  std::vector<char> place;
  for (const CellLight& cell : light)
    place.push_back(std::abs(cell.off()) > SURE * std::sqrt(cell.variance) &&
                    std::abs(cell.off()) >
                        NOTABLE * std::max(std::abs(cell.predicted), NOTABLE * mean));
  return place;
}

/// Cells whose ratio is another than that of most, by far: what to begin with.
std::vector<char> apart_from_most(const Evidence& e) {
  std::vector<double> ratios;
  for (const CellLight& cell : direct_light(e, e.known))
    ratios.push_back(cell.predicted > 0 ? cell.other / cell.predicted : 1);
  const double middle = median_of(ratios);
  std::vector<char> apart;
  for (const double r : ratios) apart.push_back(r > ANEW * middle || ANEW * r < middle);
  return apart;
}

/// Mean distance, in cells, from cells to the nearest one that shows a light, weighted; 0 if none
/// does.
double distance_to_lights(const Evidence& e, const std::vector<double>& weight) {
  const Grid& g = e.grid;
  std::vector<std::size_t> lights;
  for (std::size_t i = 0; i < g.cells(); ++i)
    for (std::size_t c = 0; c < COLOURS; ++c)
      if (e.known.front()[c * g.cells() + i] > 0) {
        lights.push_back(i);
        break;
      }
  if (lights.empty()) return 0;
  const std::size_t columns = std::size_t(g.columns);
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < g.cells(); ++i) {
    if (weight[i] == 0) continue;
    double nearest = double(g.cells());
    for (const std::size_t l : lights)
      nearest = std::min(nearest, std::hypot(double(i % columns) - double(l % columns),
                                             double(i / columns) - double(l / columns)));
    sum += weight[i] * nearest;
    total += weight[i];
  }
  return total > 0 ? sum / total : 0;
}

/// By cell: direct light that one picture has and the other has as good as none of.
std::vector<double> light_anew(const Evidence& e, const Layers& predicted) {
  const Layers groups = e.grouped(predicted);
  std::vector<double> light(e.grid.cells());
  for (std::size_t g = 0; g < direct_groups(e); ++g)
    for (std::size_t j = 0; j < groups[g].size(); ++j) {
      const double a = std::abs(groups[g][j]), b = std::abs(e.other[g][j]);
      if (std::max(a, b) >= ANEW * std::min(a, b)) light[j % e.grid.cells()] += std::abs(b - a);
    }
  return light;
}

/// What the place is like.
struct Place {
  std::size_t cells = 0;
  double brighter = 0, darker = 0;  ///< what it has more and less
  double anew = 0;                  ///< of these: where one picture has as good as none
  double near = 0;                  ///< distance to lights over that of all cells; 0: none is seen
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< pixels around it

  double all() const { return brighter + darker; }
  bool sided() const {
    return std::max(brighter, darker) >= ONE_WAY * all() && anew >= MOSTLY_ANEW * all();
  }
};

Place describe(const Evidence& e, const Model& m) {
  Place p;
  const std::vector<CellLight> light = direct_light(e, m.predicted);
  const std::vector<double> anew = light_anew(e, m.predicted);
  std::vector<double> weight(light.size());
  p.x0 = e.grid.width, p.y0 = e.grid.height;
  for (std::size_t i = 0; i < light.size(); ++i) {
    if (!m.place[i]) continue;
    const double off = light[i].off();
    ++p.cells;
    (off > 0 ? p.brighter : p.darker) += std::abs(off);
    p.anew += anew[i];
    weight[i] = std::abs(off);
    const int x = int(i % std::size_t(e.grid.columns)) * e.grid.side;
    const int y = int(i / std::size_t(e.grid.columns)) * e.grid.side;
    p.x0 = std::min(p.x0, x), p.x1 = std::max(p.x1, std::min(x + e.grid.side, e.grid.width));
    p.y0 = std::min(p.y0, y), p.y1 = std::max(p.y1, std::min(y + e.grid.side, e.grid.height));
  }
  const double everywhere = distance_to_lights(e, std::vector<double>(light.size(), 1));
  if (everywhere > 0) p.near = distance_to_lights(e, weight) / everywhere;
  return p;
}

/// What the misfit of known indirect light has beyond noise: what comes of another lamp takes the
/// scene to foretell, so that it may be as it is.
double beyond_noise(const Evidence& e) {
  const std::vector<char> all(e.grid.cells(), 1);
  double observations = double(e.observations());
  for (std::size_t g = 0; g < DIRECT; ++g) observations -= double(e.observations(g));
  return std::max(0.0, e.misfit(e.known, {}, all, DIRECT) - observations);
}

}  // namespace

void try_local(const Case& c, Causes& causes) {
  const Evidence& e = c.evidence;
  Model m;
  m.place = apart_from_most(e);
  constexpr int rounds = 8;  // the place and the factors outside it find each other in a few
  for (int round = 0; round < rounds; ++round) {
    add_indirect(e, m);
    std::vector<char> place = out_of_line(direct_light(e, m.predicted));
    if (place == m.place) break;
    m.place = std::move(place);
  }
  const Place p = describe(e, m);
  if (p.cells == 0 || double(p.cells) > LOCAL * double(e.grid.cells())) return;
  const double indirect = indirect_factor(e, m);
  const bool same_way = (indirect - 1) * (p.brighter - p.darker) >= 0;
  const bool light_of_a_lamp =
      p.sided() && same_way && (e.by_length() || (p.near > 0 && p.near < NEAR));
  const std::string& more = p.brighter > p.darker ? c.names.other : c.names.known;
  const std::string& less = p.brighter > p.darker ? c.names.known : c.names.other;
  Cause cause;
  cause.id = light_of_a_lamp ? "sidedness" : "local";
  const std::string where = fmt::format("x {} to {}, y {} to {}", p.x0, p.x1 - 1, p.y0, p.y1 - 1);
  if (light_of_a_lamp) {
    cause.words = fmt::format("{} has light straight from a lamp where {} has as good as none ({}",
                              more, less, where);
    if (p.near > 0 && p.near < NEAR) cause.words += ", around the lights";
    cause.words += fmt::format(
        "), and indirect light from it: its lamps emit on two sides, those of "
        "{} on one (or it has a lamp more)",
        less);
    cause.advice = fmt::format("look at which sides lamps emit (emission.sides) in {} and {}",
                               c.names.known, c.names.other);
  } else {
    cause.words = fmt::format(
        "the difference is in one place alone ({}): a surface, texture or light "
        "there",
        where);
    cause.advice = "look there in both pictures, and at the map by --map signed";
  }
  cause.figures = {
      {"cells", double(p.cells)}, {"indirect_factor", indirect}, {"distance_to_lights", p.near}};
  // Another surface shows in all lengths there.
  const std::size_t free = light_of_a_lamp ? direct_groups(e) : e.other.size();
  cause.parameters = p.cells * free + m.factors;
  cause.misfit = e.misfit(m.predicted, {}, m.place, free);
  if (light_of_a_lamp && e.by_length()) cause.misfit -= beyond_noise(e);
  causes.push_back(std::move(cause));
}

}  // namespace pellucid::explain
