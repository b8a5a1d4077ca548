// Pixel filters of another width: the same energy, and edges that are softer or harder.
#include <fmt/format.h>

#include <cmath>

#include "explain/causes.h"

namespace pellucid::explain {
namespace {

/// A wider filter adds its variance (pixels^2) times half the Laplacian. Least standard errors of
/// that, and least part of the differences at edges that it must explain.
constexpr double SURE = 8, LEAST_PART = 0.3;
/// What energies may differ by: deviations of their noise, or a part for what leaves at the border.
constexpr double DEVIATIONS = 5, AT_BORDER = 0.003;

bool same_energy(const Evidence& e) {
  const Layers known = e.grouped(e.known);
  for (std::size_t c = 0; c < COLOURS; ++c) {
    double of_known = 0, of_other = 0, variance = 0;
    for (std::size_t g = 0; g < known.size(); ++g) {
      of_known += energy(e.grid, known[g], c);
      of_other += energy(e.grid, e.other[g], c);
      variance += energy(e.grid, e.noise_other[g], c);
    }
    for (const Sums& noise : e.noise_known) variance += energy(e.grid, noise, c);
    if (std::abs(of_other - of_known) >
        std::max(DEVIATIONS * std::sqrt(variance), AT_BORDER * of_known))
      return false;
  }
  return true;
}

/// Sum of four neighbours less four times the pixel; at the border the picture goes on as it ends.
template <typename Value>
double laplacian(const Grid& g, int x, int y, const Value& value) {
  const auto at = [&](int nx, int ny) {
    nx = nx < 0 ? 0 : nx >= g.width ? g.width - 1 : nx;
    ny = ny < 0 ? 0 : ny >= g.height ? g.height - 1 : ny;
    return value(std::size_t(ny * g.width + nx));
  };
  return at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1) - 4 * at(x, y);
}

/// Visits every pixel and channel with the difference and the Laplacian of the mean of both
/// pictures: of equal noise, so that noise makes no edge that both share.
template <typename Visit>
void for_each_edge(const Case& c, const Visit& visit) {
  const Grid& g = c.evidence.grid;
  for (std::size_t ch = 0; ch < COLOURS; ++ch)
    for (int y = 0; y < g.height; ++y)
      for (int x = 0; x < g.width; ++x) {
        const std::size_t p = std::size_t(y * g.width + x);
        const double edge = laplacian(
            g, x, y, [&](std::size_t i) { return (c.known.all(i, ch) + c.other.all(i, ch)) / 2; });
        visit(c.other.all(p, ch) - c.known.all(p, ch), edge);
      }
}

Layers blurred(const Case& c, double h) {
  const Evidence& e = c.evidence;
  const Grid& g = e.grid;
  Layers layers = e.known;
  const std::size_t lengths = e.by_length() ? e.lengths() : 1;
  for (std::size_t length = 0; length < lengths; ++length)
    for (std::size_t ch = 0; ch < COLOURS; ++ch)
      for (int y = 0; y < g.height; ++y)
        for (int x = 0; x < g.width; ++x) {
          const double edge = laplacian(g, x, y, [&](std::size_t i) {
            if (!e.by_length()) return c.known.all(i, ch);
            // The last of fewer layers than there are is the sum of what is longer.
            double sum = c.known.at(length, i, ch);
            for (std::size_t l = length + 1; length + 1 == lengths && l < c.known.layers(); ++l)
              sum += c.known.at(l, i, ch);
            return sum;
          });
          layers[length][ch * g.cells() + e.cell(length, x, y)] += h * edge;
        }
  return layers;
}

}  // namespace

void try_filter(const Case& c, Causes& causes, double& unexplained) {
  unexplained = 0;
  if (!same_energy(c.evidence)) return;
  double xx = 0, xy = 0;
  for_each_edge(c, [&](double off, double edge) { xx += edge * edge, xy += edge * off; });
  if (!(xx > 0)) return;
  const double h = xy / xx;
  double scatter = 0, before = 0, after = 0;
  for_each_edge(c, [&](double off, double edge) {
    const double left = off - h * edge, w = edge * edge;
    scatter += left * left * w;
    before += off * off * w;
    after += left * left * w;
  });
  const double error = std::sqrt(scatter) / xx, part = before > 0 ? 1 - after / before : 0;
  if (!(std::abs(h) > SURE * error) || part < LEAST_PART) return;
  unexplained =
      error > 0 ? h * h / (error * error) / double(COLOURS) : double(c.evidence.observations());
  Cause cause;
  cause.id = "filter";
  cause.words = fmt::format(
      "the energy is the same, but edges in {} are {} than in {}: a {} pixel "
      "filter (its variance differs by {:.3g} pixels^2)",
      c.names.other, h > 0 ? "softer" : "harder", c.names.known, h > 0 ? "wider" : "narrower",
      2 * std::abs(h));
  cause.advice =
      fmt::format("render {} with the filter of {} (--filter)", c.names.known, c.names.other);
  cause.figures = {
      {"variance_pixels2", 2 * h}, {"variance_error", 2 * error}, {"edges_explained", part}};
  cause.misfit = c.evidence.misfit(blurred(c, h));
  cause.parameters = 1;
  causes.push_back(std::move(cause));
}

}  // namespace pellucid::explain
