// path_radiance (kernels/transport/path.h) step by step on the twin, with every choice written
// down. That it is the same walk is for tests to see: it has to have the same bits.
#pragma once

#include "support/path_log.h"
#include "support/twin.h"

namespace TWIN_NAMESPACE {

using pellucid::test::LightFate;
using pellucid::test::PathLog;
using pellucid::test::PathStep;

inline bool same_direction(const BsdfSample& a, const BsdfSample& b) {
  return a.wi.x == b.wi.x && a.wi.y == b.wi.y && a.wi.z == b.wi.z && a.delta == b.delta;
}

/// PathStep.lobe for the numbers u, the mix searched as mix_sample does. No material has more than
/// two lobes by the number that chooses between them, and 0 chooses the first.
inline uint lobe_chosen(const SceneData& scene, const Vertex& v, Random4 u) {
  BsdfContext context = v.context;
  uint i = 0;
  Material part = mix_part(&scene, v.material, i, &v.surface, v.side, &context);
  real rest = u.x;
  while (i + 1u < mix_count(v.material) && rest >= real(part.weight)) {
    rest -= real(part.weight);
    part = mix_part(&scene, v.material, ++i, &v.surface, v.side, &context);
  }
  rest = r_min(rest / real(part.weight), real(1.0f - UNIT_ROUNDOFF));
  const BsdfSample chosen = bsdf_sample(part, context, rest, u.y, u.z);
  const BsdfSample first = bsdf_sample(part, context, real(0), u.y, u.z);
  return 2u * i + (same_direction(chosen, first) ? 0u : 1u);
}

/// Where the ray to the light sample of `words` ends up, which walk_nee asks for any hit alone.
inline uint blocker_of(const SceneData& scene, const Vertex& v, U4 words) {
  const Surface& s = v.surface;
  const LightSample light = light_sample(&scene, s.p, words);
  Ray ray = make_ray(spawn_origin(s.p, s.ng, s.offset, light.wi), light.wi, REAL_MAX);
  if (!light.at_infinity && !shadow_ray(&s, light.wi, light.target, &ray)) return NONE;
  ray.aim = light.aim;
  return bvh_trace(&scene, ray, 0).prim;
}

inline bool is_triangle(const SceneData& scene, uint prim) {
  return prim < scene.info.triangle_count;
}

/// The light sample of a vertex, as a part of its own so that it shows whether it brought anything.
inline void log_light_sample(const SceneData& scene, const Launch& launch, Rng rng, uint bounce,
                             const Vertex& v, Walk& walk, PathStep& step) {
  if (bsdf_is_delta(v.material)) return;
  const U4 words = rng_words(rng, DIM_LIGHT(bounce));
  if (scene.info.light_count) step.light = light_pick(&scene, words.x, words.w);
  Walk aside = walk;
  aside.radiance = REAL3(0, 0, 0);
  walk_nee(&scene, launch, rng, bounce, &v, &aside);
  if (!is_black(aside.radiance)) {
    step.sample = LightFate::seen;
  } else if (aside.rays > walk.rays) {
    const bool rehit = is_triangle(scene, step.prim) && blocker_of(scene, v, words) == step.prim;
    step.sample = rehit ? LightFate::rehit : LightFate::hidden;
  }
  walk.rays = aside.rays;
  walk.radiance += aside.radiance;
}

/// One segment, which leaves the primitive `before`; whether there is another.
inline bool log_step(const SceneData& scene, const Launch& launch, Rng rng, uint depth, uint before,
                     Walk& walk, PathStep& step) {
  ++walk.rays;
  const Hit hit = bvh_trace(&scene, walk.ray, 0);
  step.prim = hit.prim;
  step.rehit = hit.prim == before && is_triangle(scene, before);
  if (hit.prim == NONE) {
    walk_escaped(&scene, launch, depth, &walk);
    return false;
  }
  const Surface surface = surface_at(&scene, walk.ray, hit);
  step.shines = !is_black(light_emitted(&scene, &surface, -walk.ray.d));
  walk_emission(&scene, launch, &surface, depth, &walk);
  if (depth == depth_limit(launch)) return false;
  const Vertex v = vertex_at(&scene, surface, -walk.ray.d, 0);
  step.black = v.black;
  if (v.black) return false;
  const uint bounce = depth - 1u;
  log_light_sample(scene, launch, rng, bounce, v, walk, step);
  const Random4 u = rng4(rng, DIM_BSDF(bounce));
  step.survives = u.w < real(v.material.survive);
  step.lobe = lobe_chosen(scene, v, u);
  step.goes_on = walk_scatter(&scene, launch, rng, DIM_BSDF(bounce), &v, &walk);
  if (step.goes_on) step.through = dot3(surface.ng, walk.ray.d) * v.side < real(0);
  return step.goes_on;
}

inline PathLog logged_path(const pellucid::PackedScene& packed, const Launch& launch, uint x,
                           uint y) {
  std::vector<uint> diag;
  const SceneData scene = scene_data(packed, diag);
  const Rng rng{y * launch.width + x, launch.iteration, launch.seed};
  const FilmPosition at = film_position(nullptr, x, y, rng4(rng, DIM_PIXEL));
  Walk walk = walk_start(camera_ray(packed.camera, at.x, at.y), REAL3(1, 1, 1));
  PathLog log;
  for (uint depth = 1, before = NONE; depth <= depth_limit(launch); ++depth) {
    PathStep& step = log.steps.emplace_back();
    if (!log_step(scene, launch, rng, depth, before, walk, step)) break;
    before = step.prim;
  }
  log.radiance = {double(walk.radiance.x), double(walk.radiance.y), double(walk.radiance.z)};
  log.rays = walk.rays;
  return log;
}

}  // namespace TWIN_NAMESPACE
