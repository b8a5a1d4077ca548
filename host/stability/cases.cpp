// The table of hard cases, by their numbers in the catalogue of 38, worst for users first.
// README.md sets what is measured here beside what naive code gives.
#include <algorithm>
#include <iterator>

#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

const Case table[] = {
    {1, "rehits", "rays that hit the surface they start on", "all",
     "without an offset 50 % do; with one of 1e-4, 36 % at coordinates of 1e4", spawned_rays_leave,
     ""},
    {2, "leaks", "cracks between triangles", "all",
     "Moeller-Trumbore loses 9.7 % of rays at edges; watertight tests with contraction 1.1 %",
     closed_meshes_are_tight, ""},
    {3, "unreachable", "energy that no technique can sample: wrong without any noise", "all",
     "the caustic is lost, with a confidence interval of width 0",
     light_through_glass_is_found_or_told, ""},
    {4, "not-a-number", "NaN and infinity, and the bias of hiding them", "all",
     "one bad sample ruins a pixel, or is replaced in silence", nothing_is_dropped, ""},
    {5, "float-modes", "relaxed arithmetic", "path, bdpt, vcm",
     "88.5 % wrong pixels for 7 % of speed (LuxMark 3 on ROCm)", relaxed_modes_keep_the_picture,
     ""},
    {6, "densities", "densities that disagree with what is sampled", "bdpt",
     "weights that do not add up to 1 look plausible: a measured ratio of 0.93", strategies_agree,
     ""},
    {7, "wild-weights", "weights whose squares overflow", "path, bdpt, vcm",
     "a^2 / (a^2 + b^2) is NaN above 1.8e19, 0/0 below 1e-19", weights_stay_in_range, ""},
    {8, "shading-normals", "normals that disagree with the facets",
     "nee, path, bdpt, light, sppm, vcm",
     "light tracing converges to another picture than path tracing", shading_normals_are_symmetric,
     ""},
    {9, "far-away", "far from the origin", "path, bdpt, vcm",
     "a decal turns black 100 to 400 m away; dark rings at 8e5", far_away_is_as_near, ""},
    {10, "scale", "tiny and huge scenes: absolute epsilons", "all",
     "triangles with edges below 3e-4 are dropped, radii stop at 1e-7", scale_changes_no_bit, ""},
    {11, "small-lights", "small and distant lights", "nee, path, light, bdpt, sppm, bpm, vcm",
     "1 - cos(theta) has lost a third of its value at 3e-4 rad, all of it at 1e-4",
     small_lights_keep_their_power, ""},
    {12, "roughness", "roughness towards 0", "path, sppm, vcm",
     "D from 1 - cos^2 is off by 28 % at alpha = 3e-4, NaN at 1e-4",
     roughness_goes_to_zero_smoothly, ""},
    {13, "dielectrics", "total reflection, grazing angles, index 1, eta^2", "path, bdpt, sppm, vcm",
     "the square root of a negative number, half vectors of 0/0", panes_let_through_what_they_must,
     ""},
    {14, "fireflies", "vertices that almost coincide", "nee, path, light, bdpt, sppm, bpm, vcm",
     "a pixel 80000 times the median beside a lamp without size", near_vertices_make_no_fireflies,
     ""},
    {15, "thin-glass", "thin glass, and media in each other (not solids that overlap)",
     "naive, path, bdpt, vcm", "shells 4e-5 apart vanish", thin_panes_let_light_through, ""},
    {16, "thin-walls", "photons round corners and through walls", "sppm, bpm, vcm",
     "discs gather on the other side of a wall", merging_stays_on_its_side, ""},
    {17, "merge-radius", "scale, schedule and floor of the radius", "sppm, bpm, vcm",
     "with alpha 0.95 it is still 0.84 of itself after 1000 passes", radius_shrinks_by_its_law, ""},
    {18, "photon-grid", "cells that share a place, cells beyond 2^24", "sppm, bpm, vcm",
     "of 27 cells in a table of 1024, 2.7 % are visited twice", photons_are_found_once, ""},
    {19, "short-buffers", "more vertices than room", "bdpt, sppm, bpm, vcm",
     "what does not fit is dropped: darker by the scene", short_buffers_drop_nothing, ""},
    {20, "splats", "splats: corners of wide pictures, crops", "path, light, bdpt, vcm",
     "dark corners and borders, crops of another brightness", splats_fall_where_rays_come_from, ""},
    {21, "accumulators", "sums of 2^27 passes", "all",
     "a sum in float is 50 % short after 2^26, 75 % after 2^27", sums_never_stall, ""},
    {22, "determinism", "the same seed, the same bits", "all",
     "float atomics add in the order of arrival", work_groups_change_no_bit, ""},
    {23, "noise", "random numbers that are not independent", "path, light, bdpt, vcm",
     "1 is drawn once in 3.4e7; equal seeds on several devices", noise_is_independent, ""},
    {24, "long-paths", "albedos near 1, depth caps, roulette", "all",
     "a cap of 10 at albedo 0.8 loses 8.6 %", long_paths_lose_nothing, ""},
    {25, "explain", "pictures that are not equally bright, and nobody knows why", "path",
     "a cap of 10, a clamp, 2 % of albedo or a light's back, unseen for years", faults_are_named,
     ""},
    {26, "degenerate", "triangles without area, and needles", "all",
     "normals are NaN, densities infinite, needles are hit far away",
     degenerate_triangles_do_no_harm, ""},
    {27, "coplanar", "faces in one plane, a light panel on the ceiling",
     "naive, nee, path, bdpt, vcm",
     "which of two is hit depends on the tree; shadow rays to the panel are cut",
     coplanar_faces_do_no_harm, ""},
    {28, "traversal", "rays along axes and in box planes, deep trees", "all",
     "0 x infinity misses boxes, a short stack loses subtrees", traversal_misses_nothing, ""},
    {29, "far-spheres", "spheres from afar", "all", "rings at 100 radii, small spheres missed",
     spheres_stay_round, ""},
    {30, "environment-maps", "images as environments, one bright texel", "-",
     "sums in float lose the tail of 1e7 texels", nullptr,
     "environments are constant: there are no images of them"},
    {31, "mirrored", "mirroring, and the sides of emission", "path, bdpt",
     "a negative scale turns normals and lights inside out", mirrored_is_the_same, ""},
    {32, "media", "participating media, thin and dense", "-", "1 - exp(-x) loses all digits",
     nullptr, "there are no participating media"},
    {33, "frames", "frames around normals, drift of directions", "all",
     "bases break near -z; without normalising, |d| walks away", frames_and_directions_do_not_drift,
     ""},
    {34, "instances", "round trips through object space", "-",
     "offsets that leave out the transform's error hit again", nullptr,
     "there are no instances: shapes are transformed once, at load, in double"},
    {35, "cameras", "fields of view from 0.001 to 170 degrees", "all",
     "directions quantised to whole pixels", cameras_keep_their_rays, ""},
    {36, "image-files", "what files make of values", "-",
     "halfs overflow at 65504 and step by 4.9e-4, sRGB is applied twice", files_keep_values, ""},
    {37, "hangs", "walks that never end, kernels that watchdogs kill", "all",
     "a NaN direction loops for ever; launches of seconds are ended by the driver", everything_ends,
     ""},
    {38, "many-lights", "picking a lamp that gives little", "nee, path, light, bdpt, vcm",
     "a visible light has probability 0, or the last one is never picked", lights_add_up, ""},
};

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> all(std::begin(table), std::end(table));
  return all;
}

std::vector<int> missing_cases() {
  constexpr int catalogue = 38;
  std::vector<int> missing;
  for (int number = 1; number <= catalogue; ++number)
    if (std::none_of(std::begin(table), std::end(table),
                     [&](const Case& c) { return c.number == number; }))
      missing.push_back(number);
  return missing;
}

}  // namespace pellucid::stability
