// What the files that make closed_form_cases.h's table share.
#pragma once

#include <functional>
#include <utility>

#include "closed_form_cases.h"

namespace pellucid::test {

using Table = std::vector<std::pair<std::string, std::function<Case()>>>;

inline const Methods all{"naive", "nee", "path", "reference", "bdpt"};
/// No roulette where the albedo is 1.
inline const Methods material_only{"naive", "nee", "path", "bdpt"};

inline Rgb grey(double v) {
  return Rgb(v);
}

/// The same by merging methods, too, where all light is direct: at their default radius. These take
/// it from light samples or by chance.
inline Case merged(Case c) {
  c.methods.insert(c.methods.end(), {"sppm", "vcm"});
  return c;
}

/// By all methods, where mirrors and glass are all there is, so that nothing is splatted and
/// nothing merges: `bpm` merges direct light as well, of which a view as narrow as most here holds
/// too little, and `light` splats it (both in footprint_test.cpp).
inline Case by_every_method(Case c) {
  c = merged(std::move(c));
  c.methods.insert(c.methods.end(), {"light", "bpm"});
  Methods& constant = c.targets.at(0).constant;
  if (!constant.empty()) constant.insert(constant.end(), {"light", "sppm", "bpm", "vcm"});
  return c;
}

/// closed_form_sheets.cpp: CF17.
Table sheets();

}  // namespace pellucid::test
