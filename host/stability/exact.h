// Renders whose bits are compared: one way to build for all, so that they share programs.
#pragma once

#include "stability/renderer.h"

namespace pellucid::stability {

inline constexpr const char* methods[] = {"naive", "nee",  "path", "reference", "light",
                                          "bdpt",  "sppm", "bpm",  "vcm"};
/// One for each set of passes, for what every method would be compiled anew for: `naive`, `nee` and
/// `reference` are the pass of `path`, and trace rays and number work items by the same lines.
inline constexpr const char* one_per_pass[] = {"path", "light", "bdpt", "sppm", "vcm"};
/// A block and a half of Sobol points.
inline constexpr Sampling short_run{24, 7, {}, MIS_BALANCE};
/// Whole blocks, as Renderer makes them.
inline constexpr Sampling whole_run{16, 7, {}, MIS_BALANCE};

inline Build build_of(const char* method) {
  Build b;
  b.method = method;
  b.width = b.height = 24;
  b.sampler = Sampler::sobol;  // what the program does unless told otherwise
  b.filter = PixelFilter::gaussian;
  return b;
}

}  // namespace pellucid::stability
