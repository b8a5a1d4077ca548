// Causes that multiply path lengths: by the same factor, by one for every bounce, or by a matrix.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "explain/causes.h"
#include "explain/least_squares.h"

namespace pellucid::explain {
namespace {

using Colours = std::array<double, COLOURS>;

/// Standard errors from which a value counts as another one.
constexpr double SURE = 4;
/// No entry of a matrix between colour spaces of pictures is as large (XYZ to Rec.709 has 3.24).
constexpr double LARGEST_ENTRY = 4;
/// Part of the light of long paths that is as good as none.
constexpr double NOTHING = 0.01;

/// Values of a factor, the same in all channels or not.
struct Factors {
  Colours value;
  double error;  ///< the largest
  bool by_channel;

  std::string text() const {
    if (!by_channel) return fmt::format("{:.4g}", value[0]);
    return fmt::format("{:.4g}, {:.4g}, {:.4g} (R, G, B)", value[0], value[1], value[2]);
  }
};

/// Layers first ... last - 1 times the factors; the others as they are.
Layers scaled(const Evidence& e, std::size_t first, std::size_t last, const Colours& factor) {
  Layers layers = e.known;
  const std::size_t cells = e.grid.cells();
  for (std::size_t layer = first; layer < last; ++layer)
    for (std::size_t j = 0; j < layers[layer].size(); ++j) layers[layer][j] *= factor[j / cells];
  return layers;
}

/// Whether there is light of these lengths to be multiplied.
bool has_light(const Evidence& e, std::size_t first, std::size_t last) {
  for (std::size_t layer = first; layer < last; ++layer)
    if (energy(e.known[layer]) > 0) return true;
  return false;
}

/// Other over known energy in the channels: of these lengths, where both tell it.
double energy_ratio(const Evidence& e, std::size_t first, std::size_t last, Channels channels) {
  double known = 0, other = 0;
  for (std::size_t c = channels.first; c < channels.last; ++c) {
    for (std::size_t layer = e.by_length() ? first : 0;
         layer < (e.by_length() ? last : e.lengths()); ++layer)
      known += energy(e.grid, e.known[layer], c);
    for (std::size_t g = e.by_length() ? first : 0; g < (e.by_length() ? last : 1); ++g)
      other += energy(e.grid, e.other[g], c);
  }
  return known > 0 ? std::max(0.0, other / known) : 0;
}

/// The best factor of layers first ... last - 1.
Factor fit_factor(const Evidence& e, std::size_t first, std::size_t last, Channels channels) {
  bool lit = false;
  for (std::size_t layer = first; layer < last; ++layer)
    for (std::size_t c = channels.first; c < channels.last; ++c)
      lit = lit || energy(e.grid, e.known[layer], c) > 0;
  if (!lit) return {};
  const auto misfit = [&](double f) {
    return e.misfit(scaled(e, first, last, {f, f, f}), channels);
  };
  return least(misfit, 0, 2 + 2 * energy_ratio(e, first, last, channels));
}

struct Fitted {
  Factors factors;
  double misfit;
  std::size_t parameters;
};

/// One factor for all channels, or three where that is worth their number.
Fitted fit_range(const Evidence& e, std::size_t first, std::size_t last) {
  const Factor one = fit_factor(e, first, last, {});
  Fitted common{{{one.value, one.value, one.value}, one.error, false}, 0, 1};
  common.misfit = e.misfit(scaled(e, first, last, common.factors.value));
  Fitted each{{{}, 0, true}, 0, COLOURS};
  for (std::size_t c = 0; c < COLOURS; ++c) {
    const Factor of_channel = fit_factor(e, first, last, {c, c + 1});
    // Where a channel has no light nothing tells its factor.
    each.factors.value[c] = std::isfinite(of_channel.error) ? of_channel.value : one.value;
    if (std::isfinite(of_channel.error))
      each.factors.error = std::max(each.factors.error, of_channel.error);
  }
  each.misfit = e.misfit(scaled(e, first, last, each.factors.value));
  const double inflation = std::max(1.0, each.misfit / double(e.observations()));
  const double price = double(COLOURS - 1) * std::log(double(e.observations()));
  return (common.misfit - each.misfit) / inflation > SURE * SURE + price ? each : common;
}

void add_figures(const Factors& f, const std::string& name, Cause& cause) {
  if (f.by_channel)
    for (std::size_t c = 0; c < COLOURS; ++c)
      cause.figures.emplace_back(fmt::format("{}_{}", name, "rgb"[c]), f.value[c]);
  else
    cause.figures.emplace_back(name, f.value[0]);
  cause.figures.emplace_back(name + "_error", f.error);
}

void add_range(const Case& c, std::size_t first, std::size_t last, const char* id,
               const char* words, const char* by_channel, const char* advice, Causes& causes) {
  const Evidence& e = c.evidence;
  if (!has_light(e, first, last)) return;
  const Fitted fit = fit_range(e, first, last);
  Cause cause;
  cause.id = id;
  cause.words =
      fmt::format(words, fmt::arg("known", c.names.known), fmt::arg("other", c.names.other),
                  fmt::arg("factor", fit.factors.text()));
  if (fit.factors.by_channel) cause.words += by_channel;
  cause.advice = advice;
  add_figures(fit.factors, "factor", cause);
  cause.predicted = scaled(e, first, last, fit.factors.value);
  cause.misfit = fit.misfit;
  cause.parameters = fit.parameters;
  causes.push_back(std::move(cause));
}

/// Part of the light of one length and all longer ones that longer ones have: by that they decay,
/// if they go on as they began. 0: nothing tells it.
double decay_of(double length, double longer) {
  return length > 0 && longer > 0 ? longer / (length + longer) : 0;
}

/// What a factor on all that is longer than the lengths with layers says of a cap: the share of a
/// geometric tail that is below it.
std::string guess_cap(const Evidence& e, double factor) {
  const std::size_t n = e.lengths();
  const double decay = decay_of(energy(e.known[n - 2]), energy(e.known[n - 1]));
  if (!(factor > 0 && factor < 1 && decay > 0)) return "";
  const double more = std::log1p(-factor) / std::log(decay);
  return fmt::format("; a cap at about {:.0f} segments would do that", double(n - 1) + more);
}

Cause late(const Case& c, std::size_t cut) {
  const Evidence& e = c.evidence;
  const Factor f = fit_factor(e, cut, e.lengths(), {});
  Cause cause;
  cause.id = "late-paths";
  cause.figures = {{"longest_equal", double(cut)}, {"factor", f.value}, {"factor_error", f.error}};
  cause.words = fmt::format(
      "{} has {:.4g} times {}'s light in paths of more than {} segments, and "
      "the same in shorter ones: ",
      c.names.other, f.value, c.names.known, cut);
  if (f.value < 1) {
    cause.words += "a depth cap farther out, or roulette that ends paths without making up for it";
    if (cut + 1 == e.lengths()) cause.words += guess_cap(e, f.value);
  } else {
    cause.words +=
        fmt::format("roulette that makes up for too much, or a depth cap of {}", c.names.known);
  }
  cause.advice = fmt::format(
      "render {} with a longer --aov-length, and switch roulette off in the "
      "program that made {}",
      c.names.known, c.names.other);
  cause.predicted = scaled(e, cut, e.lengths(), {f.value, f.value, f.value});
  cause.misfit = e.misfit(cause.predicted);
  cause.parameters = 2;
  return cause;
}

/// `ends` has no light beyond, and `goes_on` does.
Cause cap(const Evidence& e, const std::string& ends, const std::string& goes_on, std::size_t cut,
          Layers predicted) {
  Cause cause;
  cause.id = "depth-cap";
  cause.figures = {{"max_depth", double(cut)}};
  cause.words = fmt::format(
      "{} has no light from paths of more than {} segments, and the same as "
      "{} in shorter ones: a depth cap",
      ends, cut, goes_on);
  cause.advice = fmt::format(
      "render {} with --max-depth {} and compare again, or lift the cap of {}", goes_on, cut, ends);
  cause.predicted = std::move(predicted);
  cause.misfit = e.misfit(cause.predicted);
  cause.parameters = 1;
  return cause;
}

/// Paths of more than `cut` segments, for all cuts: the best cap and the best factor.
void try_late(const Case& c, Causes& causes) {
  const Evidence& e = c.evidence;
  Cause best_cap, best_late;
  for (std::size_t cut = 2; cut < e.lengths(); ++cut) {
    if (!has_light(e, cut, e.lengths())) break;
    Cause capped =
        cap(e, c.names.other, c.names.known, cut, scaled(e, cut, e.lengths(), {0, 0, 0}));
    if (best_cap.id.empty() || capped.misfit < best_cap.misfit) best_cap = std::move(capped);
    Cause part = late(c, cut);
    if (best_late.id.empty() || part.misfit < best_late.misfit) best_late = std::move(part);
  }
  if (best_cap.id.empty()) return;
  // A factor of nothing is the cap.
  const double factor = best_late.figures[1].second, error = best_late.figures[2].second;
  causes.push_back(std::move(best_cap));
  if (factor > std::max(NOTHING, SURE * error)) causes.push_back(std::move(best_late));
}

/// The known picture is the one that ends.
void try_known_cap(const Case& c, Causes& causes) {
  const Evidence& e = c.evidence;
  std::size_t cut = e.lengths();
  while (cut > 2 && !has_light(e, cut - 1, e.lengths())) --cut;
  if (!e.by_length() || cut == e.lengths()) return;
  Layers predicted = e.known;
  double beyond = 0;
  for (std::size_t layer = cut; layer < e.lengths(); ++layer) {
    predicted[layer] = e.other[layer];
    beyond += energy(e.other[layer]);
  }
  if (beyond > 0) causes.push_back(cap(e, c.names.known, c.names.other, cut, std::move(predicted)));
}

double tail_decay(const Evidence& e, std::size_t c) {
  const std::size_t n = e.lengths();
  return decay_of(energy(e.grid, e.known[n - 2], c), energy(e.grid, e.known[n - 1], c));
}

/// Layers times q^(segments - 1). The last layer holds all longer paths: if they decay as they did
/// from the length before, by g, they are sum A g^i, and with q for every bounce sum A (g q)^i.
Layers per_bounce(const Evidence& e, const Colours& q) {
  Layers layers = e.known;
  const std::size_t n = e.lengths();
  for (std::size_t c = 0; c < COLOURS; ++c) {
    const double decay = tail_decay(e, c);
    for (std::size_t layer = 0; layer < n; ++layer) {
      double factor = std::pow(q[c], double(layer));
      if (layer == n - 1) factor *= (1 - decay) / (1 - decay * q[c]);
      for (std::size_t i = 0; i < e.grid.cells(); ++i)
        layers[layer][c * e.grid.cells() + i] *= factor;
    }
  }
  return layers;
}

Factor fit_per_bounce(const Evidence& e, Channels channels) {
  // What may be called an albedo's change, and keeps the tail's sum finite.
  constexpr double least_change = 0.5, most_change = 1.5, of_tail = 0.99;
  double most = most_change;
  bool lit = false;
  for (std::size_t c = channels.first; c < channels.last; ++c) {
    lit = lit || energy(e.grid, e.known[1], c) > 0;
    if (tail_decay(e, c) > 0) most = std::min(most, std::max(1.0, of_tail / tail_decay(e, c)));
  }
  if (!lit) return {};
  const auto misfit = [&](double q) { return e.misfit(per_bounce(e, {q, q, q}), channels); };
  return least(misfit, least_change, most);
}

}  // namespace

void try_factors(const Case& c, Causes& causes) {
  const std::size_t n = c.evidence.lengths();
  add_range(c, 0, n, "exposure",
            "{other} is {known} times {factor} at every path length: power of the lights, film or "
            "exposure",
            "; the channels differ, so the lights' colour or the picture's white is another",
            "compare the lights' values and units, and the exposure of both pictures", causes);
  add_range(c, 1, n, "illumination",
            "what lights show of themselves is the same, but all that they light is {factor} times "
            "as bright in {other} as in {known}, at every path length: the lights' area or units, "
            "or how light is sampled",
            "; the channels differ", "render both with emission found by chance alone (-i naive)",
            causes);
  add_range(c, 0, 1, "visible-lights",
            "lights and background seen directly are {factor} times as bright in {other} as in "
            "{known}, and what they light is the same",
            "; the channels differ",
            "look whether lights are hidden from the camera, or the background is replaced",
            causes);
  try_late(c, causes);
  try_known_cap(c, causes);
}

void try_albedo(const Case& c, Causes& causes) {
  const Evidence& e = c.evidence;
  if (!has_light(e, 1, e.lengths())) return;
  const Factor one = fit_per_bounce(e, {});
  Fitted best{{{one.value, one.value, one.value}, one.error, false}, 0, 1};
  best.misfit = e.misfit(per_bounce(e, best.factors.value));
  Fitted each{{{1, 1, 1}, 0, true}, 0, COLOURS};
  for (std::size_t channel = 0; channel < COLOURS; ++channel) {
    const Factor f = fit_per_bounce(e, {channel, channel + 1});
    if (!std::isfinite(f.error)) continue;
    each.factors.value[channel] = f.value;
    each.factors.error = std::max(each.factors.error, f.error);
  }
  each.misfit = e.misfit(per_bounce(e, each.factors.value));
  const double inflation = std::max(1.0, each.misfit / double(e.observations()));
  const double price = double(COLOURS - 1) * std::log(double(e.observations()));
  if ((best.misfit - each.misfit) / inflation > SURE * SURE + price) best = each;
  Cause cause;
  cause.id = "albedo";
  cause.words =
      fmt::format("{} is {} times {} for every bounce: surfaces reflect so many times as much",
                  c.names.other, c.names.known, best.factors.text());
  if (best.factors.by_channel)
    cause.words +=
        "; the channels differ, so reflectances may be taken in another colour space (sRGB for "
        "linear, or other primaries)";
  cause.advice = fmt::format(
      "look at the reflectances of {}, and whether its colours and textures "
      "are sRGB or linear",
      c.names.other);
  add_figures(best.factors, "per_bounce", cause);
  cause.predicted = per_bounce(e, best.factors.value);
  cause.misfit = best.misfit;
  cause.parameters = best.parameters;
  causes.push_back(std::move(cause));
}

void try_colour_space(const Case& c, Causes& causes) {
  const Evidence& e = c.evidence;
  const std::size_t cells = e.grid.cells();
  const Layers known = e.grouped(e.known);
  Layers predicted = e.known;
  Cause cause;
  cause.id = "colour-space";
  std::string matrix;
  for (std::size_t to = 0; to < COLOURS; ++to) {
    LeastSquares fit(COLOURS);
    for (std::size_t g = 0; g < known.size(); ++g)
      for (std::size_t i = 0; i < cells; ++i) {
        const std::size_t j = to * cells + i;
        const double variance = e.variance(g, j);
        if (variance > 0)
          fit.add({known[g][i], known[g][cells + i], known[g][2 * cells + i]}, e.other[g][j],
                  1 / variance);
      }
    const std::vector<double> row = fit.solve().value;
    for (const double entry : row)
      if (!(std::abs(entry) < LARGEST_ENTRY)) return;
    for (std::size_t layer = 0; layer < e.lengths(); ++layer)
      for (std::size_t i = 0; i < cells; ++i) {
        double& value = predicted[layer][to * cells + i];
        value = 0;
        for (std::size_t from = 0; from < COLOURS; ++from)
          value += row[from] * e.known[layer][from * cells + i];
      }
    matrix += fmt::format("{}[{:.4f}, {:.4f}, {:.4f}]", to ? ", " : "", row[0], row[1], row[2]);
    for (std::size_t from = 0; from < COLOURS; ++from)
      cause.figures.emplace_back(fmt::format("{}_from_{}", "rgb"[to], "rgb"[from]), row[from]);
  }
  cause.misfit = e.misfit(predicted);
  cause.predicted = std::move(predicted);
  cause.words = fmt::format("{} is {} times the matrix {}: another colour space of the picture",
                            c.names.other, c.names.known, matrix);
  cause.advice = "write both pictures in linear Rec.709";
  cause.parameters = COLOURS * COLOURS;
  causes.push_back(std::move(cause));
}

}  // namespace pellucid::explain
