// All causes are fitted; the one that leaves least for its number of unknowns is the answer.
#include "explain/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pellucid::explain {
namespace {

/// How much worse "no difference" must be, as a difference of squares over variances: 5.5 standard
/// errors of one unknown, beyond any cause's chance among a dozen.
constexpr double DIFFERENT = 30;
/// And from what misfit per observation on pictures differ although no cause fits.
constexpr double SCATTERED = 3;
/// Part of the difference that a cause must explain to be the cause, or one of several; or what it
/// leaves is no more than so many times noise, which has longer tails than variances tell.
constexpr double ENOUGH = 0.7, HALF = 0.5, AS_NOISE = 1.5;
/// Probability from which on another cause is named beside the best.
constexpr double LIKELY = 0.05;
/// Standard errors of the energy that are surely seen.
constexpr double SEEN = 4.5;
/// Part of the energy in the last layer from which on more layers would tell more.
constexpr double MUCH_REST = 0.1;

/// Part of the misfit `before` that a cause explains; noise leaves what observations are, or less.
double part(double misfit, double before, double noise) {
  return before > noise ? std::clamp((before - misfit) / (before - noise), 0.0, 1.0) : 0;
}

/// Sorted by what they leave, and what their unknowns cost [Schwarz78]. If even the best one leaves
/// more than noise, noise is larger than it seemed: `inflation` times.
std::vector<Ranked> rank(Causes causes, double before, double observations, double& inflation) {
  const double price = std::log(observations);
  double noise = observations;
  for (const Cause& cause : causes) noise = std::min(noise, cause.misfit);
  const auto score = [&](const Cause& c) { return c.misfit + double(c.parameters) * price; };
  std::stable_sort(causes.begin(), causes.end(),
                   [&](const Cause& a, const Cause& b) { return score(a) < score(b); });
  inflation = causes.empty() ? 1 : std::max(1.0, causes.front().misfit / observations);
  const double least = causes.empty() ? 0 : score(causes.front());
  std::vector<Ranked> ranked;
  double sum = 0;
  for (Cause& cause : causes) {
    Ranked r;
    r.explained = part(cause.misfit, before, noise);
    r.probability = std::exp(-(score(cause) - least) / inflation / 2);
    sum += r.probability;
    r.cause = std::move(cause);
    ranked.push_back(std::move(r));
  }
  for (Ranked& r : ranked) r.probability /= sum;
  return ranked;
}

/// Whether many cells bear out what a cause predicts, or the few that count agree, rather than a
/// few bright paths that came in the one picture and not in the other. Each cell is weighed by what
/// is predicted of its neighbours and by their noise, so that by chance it has either sign; sums of
/// such terms over the root of the sum of their squares have short tails, whatever the noise
/// [Efron69].
bool borne_out(const Evidence& e, const Layers& predicted) {
  constexpr double deviations = 4, one_way = 0.9;
  constexpr double few = 9;  // cells, as a lamp may have: their neighbours say nothing of them
  const Layers known = e.grouped(e.known), wanted = e.grouped(predicted);
  const int columns = e.grid.columns, rows = e.grid.rows;
  std::vector<double> share(e.grid.cells()), own(e.grid.cells());
  for (std::size_t g = 0; g < e.other.size(); ++g)
    for (std::size_t c = 0; c < COLOURS; ++c)
      for (int y = 0; y < rows; y += e.block[g])
        for (int x = 0; x < columns; x += e.block[g]) {
          double change = 0, noise = 0;
          for (int way = 0; way < 4; ++way) {
            const int step = way % 2 ? e.block[g] : -e.block[g];
            const int nx = x + (way < 2 ? step : 0), ny = y + (way < 2 ? 0 : step);
            if (nx < 0 || ny < 0 || nx >= columns || ny >= rows) continue;
            const std::size_t n = c * e.grid.cells() + std::size_t(ny * columns + nx);
            change += wanted[g][n] - known[g][n];
            noise += e.variance(g, n);
          }
          const std::size_t i = std::size_t(y * columns + x), j = c * e.grid.cells() + i;
          own[i] += std::abs(wanted[g][j] - known[g][j]);
          if (noise > 0) share[i] += (e.other[g][j] - known[g][j]) * change / noise;
        }
  double sum = 0, squares = 0, sizes = 0, all = 0, all_squares = 0;
  for (const double s : share) sum += s, squares += s * s, sizes += std::abs(s);
  for (const double change : own) all += change, all_squares += change * change;
  if (all * all < few * all_squares) return true;
  return sum > deviations * std::sqrt(squares) || sum > one_way * sizes;
}

std::string energy_words(const Evidence& e, const Names& names) {
  double known = 0, other = 0;
  for (const Sums& layer : e.known) known += energy(layer);
  for (const Sums& layer : e.other) other += energy(layer);
  if (!(known > 0)) return fmt::format("{} is black", names.known);
  return fmt::format("{} has {:.4f} times the energy of {}", names.other, other / known,
                     names.known);
}

double detectable_part(const Evidence& e) {
  double known = 0, deviation = 0;
  for (const Sums& layer : e.known) known += energy(layer);
  // Channels are made by the same paths: deviations add up.
  for (std::size_t c = 0; c < COLOURS; ++c) {
    double variance = 0;
    for (const Sums& noise : e.noise_known) variance += energy(e.grid, noise, c);
    for (const Sums& noise : e.noise_other) variance += energy(e.grid, noise, c);
    deviation += std::sqrt(variance);
  }
  return known > 0 ? SEEN * deviation / known : 0;
}

void conclude(const Evidence& e, double significance, double scatter, Explanation& x) {
  const Ranked* best = x.causes.empty() ? nullptr : &x.causes.front();
  const std::string energies = energy_words(e, x.names);
  const bool few_paths = significance >= DIFFERENT && !best->cause.predicted.empty() &&
                         !borne_out(e, best->cause.predicted);
  if (few_paths) x.notes.push_back("a few bright paths make the noise: more samples may show more");
  if (significance < DIFFERENT || few_paths) {
    x.finding = scatter < SCATTERED ? Finding::none : Finding::unexplained;
    x.words = x.finding == Finding::none
                  ? fmt::format(
                        "no difference beyond noise: a change of {:.2g} % of the energy "
                        "would have shown",
                        100 * x.detectable)
                  : energies +
                        ", and cells differ by more than noise, but in no pattern that a "
                        "known cause makes";
    return;
  }
  const double explained = best->explained;
  if (explained < HALF && x.remains > AS_NOISE) {
    x.finding = Finding::unexplained;
    x.words = fmt::format("{}, but no known cause explains it (the best, {}, explains {:.0f} %)",
                          energies, best->cause.id, 100 * explained);
    x.advice = "compare simpler variants of the scene: one light, one material, --max-depth 2";
    return;
  }
  const bool enough = explained >= ENOUGH || x.remains <= AS_NOISE;
  const bool several = x.causes.size() > 1 && x.causes[1].probability >= LIKELY;
  x.finding = !enough ? Finding::partly : several ? Finding::several : Finding::cause;
  x.words = fmt::format("{}: {}", energies, best->cause.words);
  if (!enough)
    x.words += fmt::format(
        ". That explains {:.0f} % of the squared difference; something else "
        "differs, too",
        100 * explained);
  for (std::size_t i = 1; i < x.causes.size() && x.causes[i].probability >= LIKELY; ++i)
    x.words +=
        fmt::format(". Or ({:.0f} %): {}", 100 * x.causes[i].probability, x.causes[i].cause.words);
  x.advice = best->cause.advice;
}

/// Which strategies differ, if others do not.
void note_strategies(Explanation& x) {
  std::vector<std::string> differ, agree;
  for (const Row& row : x.strategies) {
    if (!(row.all_known() > 0) || !(row.all_error() > 0)) continue;
    const double off = std::abs(row.all_other() / row.all_known() - 1);
    (off > SEEN * row.all_error() ? differ : agree).push_back(row.name);
  }
  if (!differ.empty() && !agree.empty())
    x.notes.push_back(fmt::format("of the strategies {} differ beyond noise, and {} do not",
                                  fmt::join(differ, ", "), fmt::join(agree, ", ")));
}

void add_notes(const Evidence& e, Explanation& x) {
  note_strategies(x);
  double all = 0;
  for (const Sums& layer : e.known) all += energy(layer);
  const double rest = all > 0 ? energy(e.known.back()) / all : 0;
  if (rest > MUCH_REST)
    x.notes.push_back(
        fmt::format("{:.0f} % of {}'s energy is in its last layer, of paths longer "
                    "than {} segments: a longer --aov-length tells more",
                    100 * rest, x.names.known, e.lengths() - 1));
  if (!x.by_regression) return;
  std::vector<std::string> together;
  for (const Row& row : x.lengths)
    if (row.name.find(' ') != std::string::npos &&
        row.name != fmt::format("{} and longer", e.lengths()))
      together.push_back(row.name);
  if (!together.empty())
    x.notes.push_back(fmt::format("lengths {} look too much alike to be told apart in {}",
                                  fmt::join(together, "; "), x.names.other));
}

}  // namespace

const char* finding_name(Finding finding) {
  switch (finding) {
    case Finding::none:
      return "none";
    case Finding::cause:
      return "cause";
    case Finding::several:
      return "several";
    case Finding::partly:
      return "partly";
    case Finding::unexplained:
      break;
  }
  return "unexplained";
}

Explanation explain(const Layered& known, const Layered& other, const Names& names,
                    bool use_layers) {
  const Case c{known, other, gather(known, other, use_layers), names};
  const Evidence& e = c.evidence;
  Causes causes;
  double at_edges = 0;
  try_factors(c, causes);
  try_albedo(c, causes);
  try_colour_space(c, causes);
  try_clamp(c, causes);
  try_local(c, causes);
  try_filter(c, causes, at_edges);
  for (Cause& cause : causes)
    if (cause.id != "filter") cause.misfit += at_edges;

  const double observations = double(e.observations());
  const double before = e.misfit(e.known) + at_edges;
  Explanation x;
  x.names = names;
  x.by_regression = !e.by_length();
  double inflation = 1;
  x.causes = rank(std::move(causes), before, observations, inflation);
  double significance = 0;
  if (!x.causes.empty()) {
    const Cause& best = x.causes.front().cause;
    x.remains = best.misfit / observations;
    significance =
        (before - best.misfit - double(best.parameters) * std::log(observations)) / inflation;
  }
  x.significance = std::sqrt(std::max(0.0, significance));
  x.detectable = detectable_part(e);
  x.lengths = length_rows(e, inflation);
  x.strategies = strategy_rows(known, other);
  conclude(e, significance, before / observations, x);
  add_notes(e, x);
  return x;
}

}  // namespace pellucid::explain
