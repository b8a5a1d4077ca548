// Whole paths as the kernels' walks find them, vertex by vertex, with the strategy that found each
// and its weight. Needs TWIN_CONNECT or TWIN_MERGE; without the former connections and splats only
// make paths, and their weights mean nothing.
#pragma once

#include "support/test_scenes.h"
#include "support/twin.h"

namespace TWIN_NAMESPACE {

struct PathNode {
  Surface surface;
  bool delta = false;  ///< scatters by a delta lobe
};

/// light, nodes[0], ..., nodes.back(), camera.
struct FullPath {
  uint light = NONE;
  Surface emitter{};  ///< position; of surface lights also the normal and flags
  std::vector<PathNode> nodes;
  std::vector<real3> edges;  ///< nodes.size() + 1 unit vectors, from the light to the camera
  uint s = 0;                ///< vertices drawn from the light
  real weight = 0;
};

/// A walk's vertices in its order, and the directions it took; directions[i] leads to nodes[i].
struct SubPath {
  std::vector<PathNode> nodes;
  std::vector<real3> directions;
  std::vector<EndVertex> ends;
};

inline EndVertex end_vertex(const Vertex& v, const Walk& walk, uint depth) {
  return {v, walk.beta, walk.partials, depth};
}

#ifdef TWIN_MERGE
/// What the light's vertex, stored and made a photon, brings to the eye's in the same place.
inline int merge_ends(const TwinScene& twin, const Launch& launch, const EndVertex& eye,
                      const EndVertex& light, Merge* merge) {
  const StoredVertex s = vertex_pack(&light.v, light.beta, light.partials, light.depth);
  return merge_photon(&twin.data, launch, &eye, photon_of(&s), merge);
}
#endif

/// Runs both walks of one number through the kernels and hands every path found to `found`.
template <typename Found>
class PathFinder {
 public:
  PathFinder(const TwinScene& twin, const Launch& launch, Found found)
      : scene_(twin.data), camera_(twin.packed.camera), launch_(launch), found_(found) {}

  /// Returns what path_radiance should: emission and light samples.
  real3 run(uint path) {
    const Rng rng{path, launch_.iteration, launch_.seed};
    light_ = {}, eye_ = {};
    walk_light(rng);
    const real3 radiance = walk_eye(rng, path);
    connect_all();
    return radiance;
  }

  /// Vertices of the walks of the last run, from the camera or from the light.
  const std::vector<EndVertex>& ends(int importance) const {
    return importance ? light_.ends : eye_.ends;
  }

  Ray camera_ray_of(uint path) const {
    const Random4 u = rng4({path, launch_.iteration, launch_.seed}, DIM_PIXEL);
    const real x = real(path % launch_.width) + u.x, y = real(path / launch_.width) + u.y;
    return camera_ray(camera_, x, y);
  }

 private:
  void walk_light(Rng rng);
  real3 walk_eye(Rng rng, uint path);
  void connect_all();
  void light_sample_found(Rng rng, uint bounce, const Vertex& v, real3 gathered, const Walk& walk);
  /// Light vertices 1 .. s-1, then the eye's from number `eye_last` down, joined by `edge`.
  FullPath joined(uint s, int eye_last, real3 edge, real weight) const;

  SceneData scene_;
  Camera camera_;
  Launch launch_;
  Found found_;
  EmitSample start_{};
  SubPath light_, eye_;
};

/// Weight that turned `value` into `gathered`, from the largest channel.
inline real weight_of(real3 gathered, real3 value) {
  if (value.x >= value.y && value.x >= value.z) return gathered.x / value.x;
  return value.y >= value.z ? gathered.y / value.y : gathered.z / value.z;
}

template <typename Found>
FullPath PathFinder<Found>::joined(uint s, int eye_last, real3 edge, real weight) const {
  FullPath path;
  path.s = s;
  path.weight = weight;
  if (s >= 2u) {
    path.light = start_.light;
    const ::Light& light = scene_.lights[path.light];
    if (light.kind <= LIGHT_DISK) {
      const uint prim = light.prim, triangles = scene_.info.triangle_count;
      const uint shape =
          prim < triangles ? scene_.triangles[prim].shape : scene_.quadrics[prim - triangles].shape;
      surface_shape(&scene_, shape, prim, &path.emitter);
    }
    path.emitter.p = start_.p, path.emitter.ng = start_.ng;
    for (uint i = 0; i + 1u < s; ++i) {
      path.nodes.push_back(light_.nodes[i]);
      path.edges.push_back(light_.directions[i]);
    }
    path.nodes.back().delta = false;
  }
  path.edges.push_back(edge);
  for (int i = eye_last; i >= 0; --i) {
    path.nodes.push_back(eye_.nodes[std::size_t(i)]);
    if (i == eye_last && s > 0u) path.nodes.back().delta = false;
    path.edges.push_back(-eye_.directions[std::size_t(i)]);
  }
  return path;
}

template <typename Found>
void PathFinder<Found>::walk_light(Rng rng) {
  LightWalk w = light_walk_start(&scene_, rng);
  start_ = w.start;
  Vertex v;
  const uint limit = depth_limit(launch_);
  while (w.depth + 1u < limit) {
    const real3 d = w.walk.ray.d;
    if (!light_walk_next(&scene_, launch_, &w, &v)) return;
    light_.directions.push_back(d);
    light_.nodes.push_back({v.surface});
    light_.ends.push_back(end_vertex(v, w.walk, w.depth));
    CameraLink link;
    FilmPosition at;
    if (!bsdf_is_delta(v.material) && camera_project(camera_, v.surface.p, &at) &&
        camera_link(&scene_, launch_, camera_, &w, &v, &link) &&
        bvh_trace(&scene_, link.ray, 1).prim == NONE) {
      const real3 d_camera = normalize3(load3(camera_.origin) - v.surface.p);
      found_(joined(w.depth + 1u, -1, d_camera, link.weight));
    }
    if (!walk_scatter(&scene_, launch_, rng, DIM_LIGHT_WALK_BSDF(w.depth - 1u), &v, &w.walk))
      return;
    light_.nodes.back().delta = w.walk.pdf_w == real(0);
  }
}

template <typename Found>
void PathFinder<Found>::light_sample_found(Rng rng, uint bounce, const Vertex& v, real3 gathered,
                                           const Walk& walk) {
  if (is_black(gathered)) return;
  const U4 words = rng_words(rng, DIM_LIGHT(bounce));
  const LightSample light = light_sample(&scene_, v.surface.p, words);
  const BsdfEval e = vertex_eval(&scene_, &v, light.wi);
  const real3 value = walk.beta * e.f * light.radiance * (real(1) / light.pdf_w);
  FullPath path = joined(1, int(bounce), -light.wi, weight_of(gathered, value));
  path.light = light_pick(&scene_, words.x, words.w);
  const ::Light& info = scene_.lights[path.light];
  path.emitter.p = load3(info.position);
  if (!light.delta && !light.at_infinity) {
    // The point itself, which the target has left along the normal to clear it.
    const Ray ray = make_ray(spawn_origin(v.surface.p, v.surface.ng, v.surface.offset, light.wi),
                             light.wi, REAL_MAX);
    const Hit hit = bvh_trace(&scene_, ray, 0);
    if (hit.prim != info.prim) return;  // at the rim
    Surface& s = path.emitter = surface_at(&scene_, ray, hit);
    if (info.kind == LIGHT_SPHERE) {
      const F4& c = scene_.quadrics[info.prim - scene_.info.triangle_count].center_radius;
      s.ng = normalize3(light.target - load3(c));
      s.p = load3(c) + s.ng * real(c.w);
    } else {
      s.p = spawn_origin(light.target, s.ng, s.offset, light.wi);
    }
  }
  found_(path);
}

template <typename Found>
real3 PathFinder<Found>::walk_eye(Rng rng, uint path) {
  const Ray ray = camera_ray_of(path);
  Walk walk = walk_start(ray, REAL3(1, 1, 1));
  walk.partials = partials_from_camera(launch_, camera_pdf_w(camera_, ray.d));
  for (uint depth = 1; depth <= depth_limit(launch_); ++depth) {
    const Hit hit = bvh_trace(&scene_, walk.ray, 0);
    const real3 d = walk.ray.d, before = walk.radiance;
    walk.radiance = REAL3(0, 0, 0);
    Surface surface{};
    real3 emitted = REAL3(0, 0, 0);
    FullPath path_found = joined(0, int(depth) - 2, -d, 0);
    if (hit.prim == NONE) {
      path_found.light = scene_.info.environment;
      walk_escaped(&scene_, launch_, depth, &walk);
      if (path_found.light != NONE) emitted = load3(scene_.lights[path_found.light].value);
    } else {
      surface = surface_at(&scene_, walk.ray, hit);
      path_found.light = surface.light;
      path_found.emitter = surface;
      emitted = light_emitted(&scene_, &surface, -d);
      walk_emission(&scene_, launch_, &surface, depth, &walk);
    }
    if (!is_black(emitted)) {
      path_found.weight = weight_of(walk.radiance, walk.beta * emitted);
      found_(path_found);
    }
    walk.radiance = before + walk.radiance;
    if (hit.prim == NONE || depth == depth_limit(launch_)) break;
    const Vertex v = vertex_at(&scene_, surface, -d, 0);
    if (v.black) break;
    walk_arrive(&v, &walk);
    eye_.directions.push_back(d);
    eye_.nodes.push_back({surface});
    eye_.ends.push_back(end_vertex(v, walk, depth));
    if (!bsdf_is_delta(v.material)) {
      Walk aside = walk;
      aside.radiance = REAL3(0, 0, 0);
      walk_nee(&scene_, launch_, rng, depth - 1u, &v, &aside);
      light_sample_found(rng, depth - 1u, v, aside.radiance, walk);
      walk.radiance += aside.radiance;
    }
    if (!walk_scatter(&scene_, launch_, rng, DIM_BSDF(depth - 1u), &v, &walk)) break;
    eye_.nodes.back().delta = walk.pdf_w == real(0);
  }
  return walk.radiance;
}

template <typename Found>
void PathFinder<Found>::connect_all() {
  for (std::size_t i = 0; i < eye_.ends.size(); ++i)
    for (std::size_t j = 0; j < light_.ends.size(); ++j) {
      const EndVertex &eye = eye_.ends[i], &light = light_.ends[j];
      if (eye.depth + light.depth + 1u > launch_.max_depth) break;
      if (bsdf_is_delta(eye.v.material) || bsdf_is_delta(light.v.material)) continue;
      Connection link;
      if (!connect_vertices(&scene_, launch_, &eye, &light, &link)) continue;
      if (bvh_trace(&scene_, link.ray, 1).prim != NONE) continue;
      const real3 edge = normalize3(eye.v.surface.p - light.v.surface.p);
      found_(joined(light.depth + 1u, int(i), edge, link.weight));
    }
}

}  // namespace TWIN_NAMESPACE
