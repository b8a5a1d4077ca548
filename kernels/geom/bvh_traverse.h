// Closest hit and occlusion through a wide BVH: boxes padded so that a hit is never lost to
// rounding, children visited nearest first, stack bound known from the build.
#ifndef PELLUCID_GEOM_BVH_TRAVERSE_H
#define PELLUCID_GEOM_BVH_TRAVERSE_H

#include "geom/quadric.h"
#include "geom/scene_data.h"
#include "geom/triangle.h"

#define NODE_STRIDE (7 * SIMD_WIDTH)
#define BLOCK_STRIDE (9 * SIMD_WIDTH)

/// Per-ray constants of the slab test: t_near = bound * inv + near_add, and so for the far side;
/// the additions carry the padding, so padded boxes cost nothing per node.
typedef struct RaySlabs {
  real3 inv, inv_far, near_add, far_add;
  uint sx, sy,
      sz;  // lane offset of the near plane: 0, or SIMD_WIDTH where the ray goes down the axis
} RaySlabs;

INLINE void slab_axis(real o, real d, real reach, PRIVATE real* inv, PRIVATE real* inv_far,
                      PRIVATE real* near_add, PRIVATE real* far_add) {
  real safe = sign_of(r_max(r_abs(d), REAL(1e-18) /* DIRECTION_MIN */), d);
  real i = REAL(1.0) / safe;
  real pad = (real)(BOX_PAD_ULPS * UNIT_ROUNDOFF) * (r_abs(o) + reach) * r_abs(i);
  *inv = i;
  *inv_far = i * (real)BOX_FAR_SCALE;
  *near_add = -o * i - pad;
  *far_add = -o * *inv_far + pad;
}

INLINE RaySlabs ray_slabs(Ray ray, F4 reach) {
  RaySlabs s;
  real inv, inv_far, near_add, far_add;
  slab_axis(ray.o.x, ray.d.x, reach.x, &inv, &inv_far, &near_add, &far_add);
  s.inv.x = inv, s.inv_far.x = inv_far, s.near_add.x = near_add, s.far_add.x = far_add;
  slab_axis(ray.o.y, ray.d.y, reach.y, &inv, &inv_far, &near_add, &far_add);
  s.inv.y = inv, s.inv_far.y = inv_far, s.near_add.y = near_add, s.far_add.y = far_add;
  slab_axis(ray.o.z, ray.d.z, reach.z, &inv, &inv_far, &near_add, &far_add);
  s.inv.z = inv, s.inv_far.z = inv_far, s.near_add.z = near_add, s.far_add.z = far_add;
  s.sx = ray.d.x < REAL(0.0) ? SIMD_WIDTH : 0u;
  s.sy = ray.d.y < REAL(0.0) ? SIMD_WIDTH : 0u;
  s.sz = ray.d.z < REAL(0.0) ? SIMD_WIDTH : 0u;
  return s;
}

/// Bit mask of the children of `node` whose box the ray meets in [0, t_max]; their entry distances.
INLINE uint node_hits(GLOBAL const float* node, RaySlabs s, real t_max, PRIVATE vreal* entry) {
  vreal nx = v_fma(v_load(node + s.sx), v_splat(s.inv.x), v_splat(s.near_add.x));
  vreal ny = v_fma(v_load(node + 2 * SIMD_WIDTH + s.sy), v_splat(s.inv.y), v_splat(s.near_add.y));
  vreal nz = v_fma(v_load(node + 4 * SIMD_WIDTH + s.sz), v_splat(s.inv.z), v_splat(s.near_add.z));
  vreal fx = v_fma(v_load(node + SIMD_WIDTH - s.sx), v_splat(s.inv_far.x), v_splat(s.far_add.x));
  vreal fy =
      v_fma(v_load(node + 3 * SIMD_WIDTH - s.sy), v_splat(s.inv_far.y), v_splat(s.far_add.y));
  vreal fz =
      v_fma(v_load(node + 5 * SIMD_WIDTH - s.sz), v_splat(s.inv_far.z), v_splat(s.far_add.z));
  vreal tn = v_max(v_max(nx, ny), v_max(nz, v_splat(REAL(0.0))));
  vreal tf = v_min(v_min(fx, fy), v_min(fz, v_splat(t_max)));
  *entry = tn;
  return v_mask_le(tn, tf);
}

/// Tests what a leaf reference points to and improves `hit`.
INLINE void leaf_test(PRIVATE const SceneData* scene, uint ref, RayShear shear, Ray ray,
                      PRIVATE Hit* hit) {
  uint count = ((ref >> REF_COUNT_SHIFT) & REF_COUNT_MASK) + 1u;
  uint index = ref & REF_INDEX_MASK;
#if FEAT_SPHERES || FEAT_DISKS
  if (((ref >> REF_KIND_SHIFT) & REF_KIND_MASK) == LEAF_QUADRICS) {
    for (uint i = index; i < index + count; ++i) {
      ray.t_max = hit->t;
      real t = quadric_hit(scene->quadrics[i], ray);
      uint prim = scene->info.triangle_count + i;
      if (t > REAL(0.0) && (t < hit->t || prim < hit->prim)) {
        hit->t = t;
        hit->b1 = hit->b2 = REAL(0.0);
        hit->prim = prim;
      }
    }
    return;
  }
#endif
#if FEAT_TRIANGLES
  for (uint i = index; i < index + count; ++i)
    triangle_block(scene->leaves + (size_t)i * BLOCK_STRIDE, scene->leaf_prims + i * SIMD_WIDTH,
                   shear, hit);
#endif
}

/// Traces `ray`; with `any` set it stops at the first hit found. hit.prim is NONE on a miss.
INLINE Hit bvh_trace(PRIVATE const SceneData* scene, Ray ray, int any) {
  uint stack_ref[BVH_STACK];
  real stack_t[BVH_STACK];
  SIMD_ALIGNED real entry[SIMD_WIDTH];
  int sp = 0;
  Hit hit;
  hit.t = ray.t_max;
  hit.b1 = hit.b2 = REAL(0.0);
  hit.prim = NONE;
  RaySlabs slabs = ray_slabs(ray, scene->info.bounds_reach);
  RayShear shear = ray_shear(ray);
  uint ref = scene->info.root;
  if (ref == REF_EMPTY) return hit;
  for (;;) {
    int pop = 1;
    if (ref & REF_LEAF) {
      leaf_test(scene, ref, shear, ray, &hit);
      if (any && hit.prim != NONE) return hit;
    } else {
      GLOBAL const float* node = scene->nodes + (size_t)ref * NODE_STRIDE;
      GLOBAL const uint* children = (GLOBAL const uint*)(node + 6 * SIMD_WIDTH);
      vreal tn;
      uint mask = node_hits(node, slabs, hit.t, &tn);
      if (mask) {
        uint first = lowest_bit(mask);
        mask &= mask - 1u;
        ref = children[first];
        pop = 0;
        if (mask) {
          v_store(tn, entry);
          real near_t = entry[first];
          int base = sp;
          // Insertion sort above `base`, farthest lowest; the nearest child stays in `ref`.
          do {
            uint i = lowest_bit(mask);
            mask &= mask - 1u;
            uint child = children[i];
            real t = entry[i];
            if (t < near_t) {
              real swap_t = near_t;
              uint swap_ref = ref;
              near_t = t, ref = child;
              t = swap_t, child = swap_ref;
            }
            if (sp >= BVH_STACK) {  // cannot happen: the host computed the bound from the tree
              diag_count(scene, DIAG_stack_overflow);
              continue;
            }
            int j = sp++;
            for (; j > base && stack_t[j - 1] < t; --j) {
              stack_t[j] = stack_t[j - 1];
              stack_ref[j] = stack_ref[j - 1];
            }
            stack_t[j] = t;
            stack_ref[j] = child;
          } while (mask);
        }
      }
    }
    if (pop) {
      do {
        if (sp == 0) return hit;
        --sp;
      } while (stack_t[sp] > hit.t);
      ref = stack_ref[sp];
    }
  }
}

#endif
