// Methods that walk from the lights, too.
#include "integrators/registry.h"

namespace pellucid {

std::vector<Integrator> bidirectional_integrators() {
  using B = Bundle;
  return {
      {"light",
       "light tracing; the camera itself sees emitters only",
       {INTG_SPLAT},
       false,
       {{"light_trace", {B::scene, B::filter, B::splat, B::diag}, Domain::light_paths, true},
        {"camera_trace", {B::scene, B::filter, B::film, B::diag}, Domain::slice, true},
        {"film_add", {B::film, B::splat, B::diag}}},
       LAYER_LENGTH_MAX},
      {"bdpt",
       "eye and light paths, joined in every way",
       {INTG_NEE, INTG_MIS, INTG_SPLAT, INTG_CONNECT},
       true,
       {{"light_trace",
         {B::scene, B::filter, B::splat, B::light_vertices, B::vertex_counts, B::diag},
         Domain::light_paths,
         true},
        {"camera_trace",
         {B::scene, B::filter, B::film, B::eye_vertices, B::vertex_counts, B::diag},
         Domain::slice,
         true},
        {"vertex_scan", {B::light_vertices, B::eye_vertices}, Domain::sides},
        {"vertex_order", {B::light_vertices, B::eye_vertices}, Domain::sub_paths},
        {"connect",
         {B::scene, B::film, B::light_vertices, B::eye_vertices, B::diag},
         Domain::slice,
         true},
        {"film_add", {B::film, B::splat, B::diag}}},
       LAYER_LENGTH_MAX},
  };
}

}  // namespace pellucid
