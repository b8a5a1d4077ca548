// The choice of methods that speak for the truth.
#include "study/referee.h"

#include <algorithm>

#include "base/error.h"
#include "base/text.h"

namespace pellucid {
namespace {

using Ranking = std::vector<std::pair<double, Entry*>>;

/// The best but one of the voices, if possible one of other kernels: a fault that both have would
/// not show.
Entry* other_voice(const Ranking& voices) {
  const auto kernels = [](const Entry* e) { return e->contender->method().kernels(); };
  for (const auto& [cost, entry] : voices)
    if (kernels(entry) != kernels(voices[0].second)) return entry;
  return voices.size() > 1 ? voices[1].second : voices[0].second;
}

/// relMSE x seconds of the pilots' runs, by their spread.
double cost_of(const Entry& entry, const std::vector<double>& weights) {
  PictureStack own;
  for (const LadderStep& p : entry.pilots) own.add(p.picture);
  return own.variance(weights) * entry.pilot_seconds();
}

/// Methods that see all, the quickest of each kind first.
struct Voices {
  Ranking unbiased, lucky, merging;  ///< aiming at all; finding some by chance alone

  Voices(std::vector<Entry>& entries, const std::vector<double>& weights) {
    for (Entry& entry : entries) {
      if (!entry.voice || entry.option.state == OptionState::refused) continue;
      Ranking& kind = entry.option.merges           ? merging
                      : entry.option.chance.empty() ? unbiased
                                                    : lucky;
      kind.emplace_back(cost_of(entry, weights), &entry);
    }
    for (Ranking* kind : {&unbiased, &lucky, &merging})
      std::sort(kind->begin(), kind->end(),
                [](const auto& a, const auto& b) { return a.first < b.first; });
  }
};

/// The method that merges whose bias is least: one that also connects, if there is one.
const Contender& witness_of(const Ranking& merging) {
  for (const auto& [cost, entry] : merging)
    if (entry->contender->method().wishes.has(INTG_CONNECT)) return *entry->contender;
  return *merging[0].second->contender;
}

/// The mean of all pilots of methods that aim at all paths, or else of all that see them.
std::vector<double> pilot_weights(const std::vector<Entry>& entries) {
  PictureStack aimed, all;
  for (const Entry& entry : entries)
    for (const LadderStep& p : entry.pilots) {
      if (!entry.voice || entry.option.state == OptionState::refused) continue;
      all.add(p.picture);
      if (entry.option.chance.empty()) aimed.add(p.picture);
    }
  if (all.size() == 0) throw UsageError("no method can make a reference; give one with --ref FILE");
  return relmse_weights((aimed.size() > 0 ? aimed : all).mean());
}

}  // namespace

Reference choose_reference(std::vector<Entry>& entries, std::uint64_t seed, double seconds,
                           const std::function<void(const std::string&)>& tell) {
  const Voices voices(entries, pilot_weights(entries));
  if (!voices.unbiased.empty())
    return make_reference(*voices.unbiased[0].second->contender,
                          *other_voice(voices.unbiased)->contender, seed, seconds, tell);
  if (voices.merging.empty())
    throw UsageError("no method can make a reference; give one with --ref FILE");
  // That it has no bias is worth some noise: merging's cost here is its spread alone. Where chance
  // serves badly it is dozens of times dearer (bdpt in glass-caustic: 41).
  constexpr double worth = 3;
  if (!voices.lucky.empty() && voices.lucky[0].first < worth * voices.merging[0].first) {
    const Entry& lucky = *voices.lucky[0].second;
    const Contender& witness = witness_of(voices.merging);
    constexpr double of_radius = 0.5;  // less noise than truth is asked of a witness
    return confirm_reference(*lucky.contender, join(lucky.option.chance), witness,
                             of_radius * witness.radius(), seed, seconds, tell);
  }
  const Contender& best = *voices.merging[0].second->contender;
  return extrapolate_reference(best, best.radius(), seed, seconds, tell);
}

}  // namespace pellucid
