// probe_walk: walks through the scene from a list of rays, as eye paths go, for tests of what is
// left of a direction after many bounces, and of where walks end that begin with a broken one.
// Reads: scene, rays [n][2]: origin and longest distance, direction. Writes: ends [n]: direction,
// number of bounces (as bits); diag. Domain: n rays. Atomics: diag only. Next: nothing.
#include "passes/bundles.h"
#include "transport/walk.h"

__kernel void probe_walk(SCENE_PARAMS DIAG_PARAMS __global const F4* rays, __global F4* ends,
                         const uint n, const Launch launch) {
  uint i = (uint)get_global_id(0);
  if (i >= n) return;
  SCENE_FROM_PARAMS
  Rng rng;
  rng.path = i;
  rng.iteration = launch.iteration;
  rng.seed = launch.seed;
  F4 o = rays[2 * i];
  Walk walk = walk_start(make_ray(load3(o), load3(rays[2 * i + 1]), o.w), (float3)(1.0f));
  uint bounces = 0u;
  while (bounces < depth_limit(launch)) {
    Hit hit = bvh_trace(&scene_data, walk.ray, 0);
    if (hit.prim == NONE) break;
    Vertex v = vertex_at(&scene_data, surface_at(&scene_data, walk.ray, hit), -walk.ray.d, 0);
    if (v.black || !walk_scatter(&scene_data, launch, rng, DIM_BSDF(bounces), &v, &walk)) break;
    walk.ray.t_max = REAL_MAX;
    ++bounces;
  }
  ends[i] = (F4)(walk.ray.d.x, walk.ray.d.y, walk.ray.d.z, as_float(bounces));
}
