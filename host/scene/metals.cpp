// Complex indices of refraction of measured metals. Spectra: copper, silver and gold by Johnson and
// Christy, Phys. Rev. B 6 (1972) 4370; chromium and aluminium as in Palik, Handbook of Optical
// Constants of Solids (1985) and Rakic, Appl. Opt. 34 (1995) 4755. The reduction to three channels
// is the one in common use among renderers.
#include "scene/metals.h"

namespace pellucid {

const std::vector<Metal>& metals() {
  static const std::vector<Metal> table = {
      {"aluminium", {1.657460, 0.880369, 0.521229}, {9.223869, 6.269523, 4.837001}},
      {"chromium", {4.369683, 2.916703, 1.654701}, {5.206434, 4.231365, 3.754947}},
      {"copper", {0.200438, 0.924033, 1.102212}, {3.912949, 2.452848, 2.142188}},
      {"gold", {0.143119, 0.374957, 1.442479}, {3.983160, 2.385721, 1.603215}},
      {"silver", {0.155265, 0.116723, 0.138373}, {4.828370, 3.122497, 2.147043}},
  };
  return table;
}

std::vector<std::string> metal_names() {
  std::vector<std::string> names;
  for (const Metal& metal : metals()) names.emplace_back(metal.name);
  return names;
}

}  // namespace pellucid
