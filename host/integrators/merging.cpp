// Methods that merge eye paths with the light vertices around them.
#include "integrators/registry.h"
#include "render/photon_grid.h"

namespace pellucid {
namespace {

using B = Bundle;

/// Light paths, and their vertices sorted by the cell of space that they lie in.
std::vector<Pass> photon_passes() {
  std::vector<Pass> passes{
      {"light_trace",
       {B::scene, B::filter, B::splat, B::light_vertices, B::vertex_counts, B::diag},
       Domain::light_paths,
       true},
      {"vertex_scan", {B::light_vertices, B::eye_vertices}, Domain::sides},
      {"vertex_order", {B::light_vertices, B::eye_vertices}, Domain::sub_paths}};
  for (const Pass& pass : grid_passes()) passes.push_back(pass);
  return passes;
}

/// Eye paths, one slice after the other, and what becomes of them.
void add_eye_passes(bool connects, std::vector<Pass>& passes) {
  passes.push_back({"camera_trace",
                    {B::scene, B::filter, B::film, B::eye_vertices, B::vertex_counts, B::diag},
                    Domain::slice,
                    true});
  passes.push_back({"vertex_scan", {B::light_vertices, B::eye_vertices}, Domain::sides});
  passes.push_back({"vertex_order", {B::light_vertices, B::eye_vertices}, Domain::sub_paths});
  if (connects)
    passes.push_back({"connect",
                      {B::scene, B::film, B::light_vertices, B::eye_vertices, B::diag},
                      Domain::slice,
                      true});
  passes.push_back(
      {"merge", {B::scene, B::film, B::eye_vertices, B::grid, B::diag}, Domain::slice, true});
  passes.push_back({"film_add", {B::film, B::splat, B::diag}});
}

Integrator merging(const std::string& name, const std::string& summary, FeatureSet wishes,
                   uint most_s) {
  std::vector<Pass> passes = photon_passes();
  add_eye_passes(wishes.has(INTG_CONNECT), passes);
  return {name, summary, wishes, true, passes, most_s};
}

}  // namespace

/// One code under flags: `vcm` without merging is `bdpt`, without connections `bpm`.
std::vector<Integrator> merging_integrators() {
  return {
      merging("sppm", "stochastic progressive photon mapping", {INTG_NEE, INTG_MIS, INTG_MERGE}, 1),
      merging("bpm", "bidirectional photon mapping: the merging of vcm alone", {INTG_MERGE}, 0),
      merging("vcm", "vertex connection and merging",
              {INTG_NEE, INTG_MIS, INTG_SPLAT, INTG_CONNECT, INTG_MERGE}, LAYER_LENGTH_MAX)};
}

}  // namespace pellucid
