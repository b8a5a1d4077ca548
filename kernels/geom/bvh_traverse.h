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
  real safe = sign_of(r_max(r_abs(d), (real)DIRECTION_MIN), d);
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

/// Tests a quadric and improves `hit`; ties go to the lowest id, as with triangles.
INLINE void leaf_quadric(PRIVATE const SceneData* scene, uint index, Ray ray, PRIVATE Hit* hit) {
  uint prim = scene->info.triangle_count + index;
  if (prim + 1u == ray.aim) return;
  ray.t_max = hit->t;
  real t = quadric_hit(scene->quadrics[index], ray);
  if (t > REAL(0.0) && (t < hit->t || prim < hit->prim)) {
    hit->t = t;
    hit->b1 = hit->b2 = REAL(0.0);
    hit->prim = prim;
  }
}

/// Tests what a leaf reference points to and improves `hit`.
INLINE void leaf_test(PRIVATE const SceneData* scene, uint ref, RayShear shear, Ray ray,
                      PRIVATE Hit* hit) {
#if FEAT_SPHERES || FEAT_DISKS
  if (((ref >> REF_KIND_SHIFT) & REF_KIND_MASK) == LEAF_QUADRICS) {
    leaf_quadric(scene, ref & REF_INDEX_MASK, ray, hit);
    return;
  }
#endif
#if FEAT_TRIANGLES
  uint first = ref & REF_INDEX_MASK;
  uint last = first + ((ref >> REF_COUNT_SHIFT) & REF_COUNT_MASK);
  for (uint i = first; i <= last; ++i)
    triangle_block(scene->leaves + (size_t)i * BLOCK_STRIDE, scene->leaf_prims + i * SIMD_WIDTH,
                   shear, hit);
#endif
}

/// Children still to be visited, nearest on top. The host computed BVH_STACK from the tree.
typedef struct Pending {
  uint ref[BVH_STACK];
  real entry[BVH_STACK];
  int count;
} Pending;

/// Puts a child above `base`, keeping what lies there sorted by distance.
INLINE void push_sorted(PRIVATE const SceneData* scene, PRIVATE Pending* stack, int base, uint ref,
                        real entry) {
  if (stack->count >= BVH_STACK) {  // cannot happen; losing geometry in silence would be worse
    diag_count(scene, DIAG_stack_overflow);
    return;
  }
  int i = stack->count++;
  for (; i > base && stack->entry[i - 1] < entry; --i) {
    stack->entry[i] = stack->entry[i - 1];
    stack->ref[i] = stack->ref[i - 1];
  }
  stack->entry[i] = entry;
  stack->ref[i] = ref;
}

/// Next reference nearer than t_max, or REF_EMPTY when nothing is left.
INLINE uint pop_nearer(PRIVATE Pending* stack, real t_max) {
  while (stack->count > 0) {
    int i = --stack->count;
    if (stack->entry[i] <= t_max) return stack->ref[i];
  }
  return REF_EMPTY;
}

/// Visits a node: returns the nearest child that the ray meets and pushes the others.
INLINE uint node_descend(PRIVATE const SceneData* scene, uint ref, RaySlabs slabs, real t_max,
                         PRIVATE Pending* stack) {
  GLOBAL const float* node = scene->nodes + (size_t)ref * NODE_STRIDE;
  GLOBAL const uint* children = (GLOBAL const uint*)(node + 6 * SIMD_WIDTH);
  vreal entries;
  uint mask = node_hits(node, slabs, t_max, &entries);
  if (mask == 0u) return pop_nearer(stack, t_max);
  uint nearest = lowest_bit(mask);
  mask &= mask - 1u;
  uint result = children[nearest];
  if (mask == 0u) return result;
  SIMD_ALIGNED real entry[SIMD_WIDTH];
  v_store(entries, entry);
  real nearest_entry = entry[nearest];
  int base = stack->count;
  do {
    uint i = lowest_bit(mask);
    mask &= mask - 1u;
    if (entry[i] < nearest_entry) {
      push_sorted(scene, stack, base, result, nearest_entry);
      nearest_entry = entry[i];
      result = children[i];
    } else {
      push_sorted(scene, stack, base, children[i], entry[i]);
    }
  } while (mask);
  return result;
}

/// Traces `ray`; with `any` set it stops at the first hit found. hit.prim is NONE on a miss.
INLINE Hit bvh_trace(PRIVATE const SceneData* scene, Ray ray, int any) {
  Pending stack;
  stack.count = 0;
  Hit hit;
  hit.t = ray.t_max;
  hit.b1 = hit.b2 = REAL(0.0);
  hit.prim = NONE;
  RaySlabs slabs = ray_slabs(ray, scene->info.bounds_reach);
  RayShear shear = ray_shear(ray);
  uint ref = scene->info.root;
  while (ref != REF_EMPTY) {
    if (ref & REF_LEAF) {
      leaf_test(scene, ref, shear, ray, &hit);
      if (any && hit.prim != NONE) break;
      ref = pop_nearer(&stack, hit.t);
    } else {
      ref = node_descend(scene, ref, slabs, hit.t, &stack);
    }
  }
  return hit;
}

#endif
