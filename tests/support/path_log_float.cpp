// Compiled with PELLUCID_REAL=float only; and what two logs have in common.
#include <algorithm>

#include "support/path_log_twin.h"

namespace pellucid::test {
namespace {

Parting parting_at(const PathStep& a, const PathStep& b) {
  if (a.rehit != b.rehit) return Parting::rehit;
  if (a.prim != b.prim) return Parting::surface;
  if (a.shines != b.shines) return Parting::emission;
  if (a.black != b.black) return Parting::end;
  if (a.light == b.light && a.sample != b.sample &&
      (a.sample == LightFate::rehit || b.sample == LightFate::rehit))
    return Parting::rehit;
  if (a.light != b.light || a.sample != b.sample) return Parting::light;
  if (a.survives != b.survives) return Parting::roulette;
  if (a.lobe != b.lobe) return Parting::lobe;
  if (a.goes_on != b.goes_on) return Parting::end;
  return a.through == b.through ? Parting::none : Parting::side;
}

}  // namespace

PathLog path_log_float(const PackedScene& packed, const Launch& launch, uint x, uint y) {
  return twin::logged_path(packed, launch, x, y);
}

const char* parting_name(Parting why) {
  constexpr const char* names[partings] = {"none",     "rehit", "surface", "emission", "light",
                                           "roulette", "lobe",  "end",     "side"};
  return names[int(why)];
}

Parting parting_of(const PathLog& a, const PathLog& b) {
  const std::size_t both = std::min(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < both; ++i) {
    const Parting why = parting_at(a.steps[i], b.steps[i]);
    if (why != Parting::none) return why;
  }
  return a.steps.size() == b.steps.size() ? Parting::none : Parting::end;
}

}  // namespace pellucid::test
