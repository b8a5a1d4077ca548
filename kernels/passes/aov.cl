// aov: what camera rays meet first, for compositing and denoising.
// Reads: scene, filter. Writes: aovs [pixels], diag. Domain: pixels. Atomics: diag only. Next: the
// next iteration, then the host divides the sums.
// Flags: INTG_SOBOL, INTG_FILTER.
#include "passes/bundles.h"
#include "passes/tile.h"
#include "transport/vertex.h"

/// Position, depth and ids of the ray through the pixel's centre: means over an edge would lie on
/// no surface and name no object.
INLINE AovPixel aov_of_centre(PRIVATE const SceneData* scene, Camera camera, uint column,
                              uint row) {
  AovPixel a;
  a.position = (F4)(0.0f, 0.0f, 0.0f, INFINITY);
  a.normal = a.geometric = a.albedo = (F4)(0.0f);
  a.id = (U4)(NONE, NONE, 0u, 0u);
  Ray ray = camera_ray(camera, (real)column + 0.5f, (real)row + 0.5f);
  Hit hit = bvh_trace(scene, ray, 0);
  if (hit.prim == NONE) return a;
  Surface s = surface_at(scene, ray, hit);
  a.position = (F4)(s.p, dot3(s.p - load3(camera.origin), load3(camera.forward)));
  uint triangles = scene->info.triangle_count;
  a.id.x = hit.prim < triangles ? scene->triangles[hit.prim].shape
                                : scene->quadrics[hit.prim - triangles].shape;
  a.id.y = s.material;
  return a;
}

/// Adds one sample of normals (on the side that the camera sees) and colour.
INLINE void aov_add(PRIVATE const SceneData* scene, Ray ray, PRIVATE AovPixel* a) {
  Hit hit = bvh_trace(scene, ray, 0);
  if (hit.prim == NONE) return;
  Vertex v = vertex_at(scene, surface_at(scene, ray, hit), -ray.d, 0);
  a->normal += (F4)(v.frame.n, 0.0f);
  a->geometric += (F4)(v.surface.ng * v.side, 0.0f);
  if (!v.black)
    a->albedo += (F4)(material_albedo(scene, v.material, v.context, &v.surface, v.side), 0.0f);
}

__kernel void aov(SCENE_PARAMS FILTER_PARAMS AOV_PARAMS DIAG_PARAMS const Launch launch) {
  uint pixel = work_item(launch);
  if (pixel >= launch.tile_width * launch.tile_height) return;
  SCENE_FROM_PARAMS
  TileSample s = tile_sample(launch, camera, filter_table, pixel);
  AovPixel a = aovs[pixel];
  if (launch.iteration == 0u) a = aov_of_centre(&scene_data, camera, s.column, s.row);
  aov_add(&scene_data, s.ray, &a);
  aovs[pixel] = a;
}
