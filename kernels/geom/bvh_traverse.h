// Closest hit and occlusion through a wide BVH: children visited nearest first, stack bound known
// from the build.
#ifndef PELLUCID_GEOM_BVH_TRAVERSE_H
#define PELLUCID_GEOM_BVH_TRAVERSE_H

#include "geom/boxes.h"
#include "geom/quadric.h"
#include "geom/scene_data.h"
#include "geom/triangle.h"

#define NODE_STRIDE (7 * SIMD_WIDTH)
#define BLOCK_STRIDE (9 * SIMD_WIDTH)

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
  int needles = ((ref >> REF_KIND_SHIFT) & REF_KIND_MASK) == LEAF_NEEDLES;
  uint first = ref & REF_INDEX_MASK;
  uint last = first + ((ref >> REF_COUNT_SHIFT) & REF_COUNT_MASK);
  for (uint i = first; i <= last; ++i)
    triangle_block(scene->leaves + (size_t)i * BLOCK_STRIDE, scene->leaf_prims + i * SIMD_WIDTH,
                   shear, needles, hit);
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
