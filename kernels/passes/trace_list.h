// One ray of a list: rays [n][2] are (origin, t_max), (unit direction, unused); a hit is (t, b1,
// b2, primitive id as bits).
#ifndef PELLUCID_PASSES_TRACE_LIST_H
#define PELLUCID_PASSES_TRACE_LIST_H

#include "geom/bvh_traverse.h"
#include "passes/bundles.h"

INLINE F4 trace_listed(PRIVATE const SceneData* scene, __global const F4* rays, uint i, int any) {
  F4 o = rays[2 * i];
  Ray ray = make_ray(load3(o), load3(rays[2 * i + 1]), o.w);
  Hit hit = bvh_trace(scene, ray, any);
  return (F4)(hit.t, hit.b1, hit.b2, as_float(hit.prim));
}

#endif
