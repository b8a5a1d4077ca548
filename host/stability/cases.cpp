// The table of hard cases. Numbers, mechanisms and what naive code makes of them: the catalogue of
// scenes/stability/README.md.
#include "stability/measurements.h"

namespace pellucid::stability {

const std::vector<Case>& cases() {
  static const std::vector<Case> table{
      {1, "rehits", "rays that hit the surface they start on", "all",
       "without an offset 50 % do; with one of 1e-4, 36 % at coordinates of 1e4",
       spawned_rays_leave, ""},
      {2, "leaks", "cracks between triangles", "all",
       "Moeller-Trumbore loses 9.7 % of rays at edges; watertight tests with contraction 1.1 %",
       closed_meshes_are_tight, ""},
      {3, "unreachable", "energy that no technique can sample: wrong without any noise", "all",
       "the caustic is lost, with a confidence interval of width 0",
       light_through_glass_is_found_or_told, ""},
      {4, "not-a-number", "NaN and infinity, and the bias of hiding them", "all",
       "one bad sample ruins a pixel, or is replaced in silence", nothing_is_dropped, ""},
      {10, "scale", "tiny and huge scenes: absolute epsilons", "all",
       "triangles with edges below 3e-4 are dropped, radii stop at 1e-7", scale_changes_no_bit, ""},
      {11, "small-lights", "small and distant lights", "nee, path, bdpt",
       "1 - cos(theta) has lost a third of its value at 3e-4 rad, all of it at 1e-4",
       small_lights_keep_their_power, ""},
      {12, "roughness", "roughness towards 0", "path",
       "D from 1 - cos^2 is off by 28 % at alpha = 3e-4, NaN at 1e-4",
       roughness_goes_to_zero_smoothly, ""},
      {13, "dielectrics", "total reflection, grazing angles, index 1, eta^2", "path, bdpt, vcm",
       "the square root of a negative number, half vectors of 0/0",
       panes_let_through_what_they_must, ""},
      {16, "thin-walls", "photons round corners and through walls", "sppm, bpm, vcm",
       "discs gather on the other side of a wall", merging_stays_on_its_side, ""},
      {18, "photon-grid", "cells that share a place, cells beyond 2^24", "sppm, bpm, vcm",
       "of 27 cells in a table of 1024, 2.7 % are visited twice", photons_are_found_once, ""},
      {19, "short-buffers", "more vertices than room", "bdpt, sppm, vcm",
       "what does not fit is dropped: darker by the scene", short_buffers_drop_nothing, ""},
      {21, "accumulators", "sums of 2^27 passes", "all",
       "a sum in float is 50 % short after 2^26, 75 % after 2^27", sums_never_stall, ""},
      {22, "determinism", "the same seed, the same bits", "all",
       "float atomics add in the order of arrival", work_groups_change_no_bit, ""},
      {24, "long-paths", "albedos near 1, depth caps, roulette",
       "naive, nee, path, reference, bdpt", "a cap of 10 at albedo 0.8 loses 8.6 %",
       long_paths_lose_nothing, ""},
      {26, "degenerate", "triangles without area, and needles", "all",
       "normals are NaN, densities infinite, needles are hit far away",
       degenerate_triangles_do_no_harm, ""},
      {28, "traversal", "rays along axes and in box planes, deep trees", "all",
       "0 x infinity misses boxes, a short stack loses subtrees", traversal_misses_nothing, ""},
      {29, "far-spheres", "spheres from afar", "all", "rings at 100 radii, small spheres missed",
       spheres_stay_round, ""},
      {30, "environment-maps", "images as environments, one bright texel", "-",
       "sums in float lose the tail of 1e7 texels", nullptr,
       "environments are constant: there are no images of them"},
      {32, "media", "participating media, thin and dense", "-", "1 - exp(-x) loses all digits",
       nullptr, "there are no participating media"},
      {34, "instances", "round trips through object space", "-",
       "offsets that leave out the transform's error hit again", nullptr,
       "there are no instances: shapes are transformed once, at load, in double"},
  };
  return table;
}

}  // namespace pellucid::stability
