// The kernels' recursion replayed over the vertices of a given path, for every strategy that could
// have found it.
#pragma once

#include "support/audit_density.h"

namespace TWIN_NAMESPACE {

/// The path with edges exactly between its points: rays start a little beside them. Photons keep
/// directions as floats; where there are any, all strategies are judged by these.
inline FullPath straightened(const TwinScene& twin, FullPath path) {
  const bool at_infinity = PathDensities(twin, {}, path).light_at_infinity();
  const std::size_t k = path.nodes.size();
  for (std::size_t i = at_infinity ? 1 : 0; i <= k; ++i) {
    const real3 a = i == 0 ? path.emitter.p : path.nodes[i - 1].surface.p;
    const real3 b = i == k ? load3(twin.packed.camera.origin) : path.nodes[i].surface.p;
    path.edges[i] = normalize3(b - a);
  }
  if (merges)
    for (real3& edge : path.edges) edge = REAL3(float(edge.x), float(edge.y), float(edge.z));
  return path;
}

class Replay {
 public:
  Replay(const TwinScene& twin, const Launch& launch, const FullPath& path)
      : twin_(twin),
        launch_(launch),
        path_(path),
        exact_(twin, launch, path),
        k_(path.nodes.size()) {
    walk_from_light();
    walk_from_eye();
  }
  /// Weight of strategy s (PathDensities::all), 0 where it cannot find the path.
  real weight(std::size_t s) const {
    if (s == 0) return by_chance();
    if (s >= k_ + 2) return by_merge(s - k_ - 2);
    if (!connects) return real(0);
    if (path_.nodes[s == 1 ? 0 : s - 2].delta) return real(0);
    if (s == 1) return by_light_sample();
    if (s == k_ + 1) return by_splat();
    return path_.nodes[s - 1].delta ? real(0) : by_connection(s);
  }

 private:
  EmitSample start() const;
  /// What the kernels would have drawn at node i towards w.
  BsdfSample drawn(const Vertex& v, std::size_t i, real3 w, bool onward) const {
    BsdfSample s = bsdf_sample_none();
    s.wi = w;
    s.delta = path_.nodes[i].delta;
    const double ratio = s.delta ? exact_.delta_ratio(i) : 1.0;
    s.reverse = real(onward ? ratio : 1 / ratio);
    s.pdf_w = s.delta ? real(0) : vertex_eval(&twin_.data, &v, w).pdf_w;
    return s;
  }
  void leave(const Vertex& v, std::size_t i, real3 w, bool onward, Walk& walk) const {
    const BsdfSample s = drawn(v, i, w, onward);
    walk.pdf_w = s.pdf_w * real(v.material.survive);
    walk_leave(&twin_.data, launch_, &v, s, &walk);
    walk.p_prev = v.surface.p;
    walk.ray.d = w;
  }
  void walk_from_light() {
    LightWalk w = light_walk_from(start());
    for (std::size_t i = 0; i < k_; ++i) {
      const Vertex v = vertex_at(&twin_.data, path_.nodes[i].surface, -path_.edges[i], 1);
      ++w.depth;
      light_walk_arrive(&twin_.data, launch_, &w, &v);
      light_.push_back(end_vertex(v, w.walk, w.depth));
      leave(v, i, path_.edges[i + 1], true, w.walk);
    }
  }
  void walk_from_eye() {
    const ::Camera& camera = twin_.packed.camera;
    eye_walk_ =
        walk_start(make_ray(load3(camera.origin), -path_.edges[k_], REAL_MAX), REAL3(1, 1, 1));
    eye_walk_.partials = partials_from_camera(launch_, camera_pdf_w(camera, eye_walk_.ray.d));
    eye_.resize(k_);
    for (std::size_t i = k_; i-- > 0;) {
      const Vertex v = vertex_at(&twin_.data, path_.nodes[i].surface, path_.edges[i + 1], 0);
      walk_arrive(&v, &eye_walk_);
      eye_[i] = end_vertex(v, eye_walk_, uint(k_ - i));
      leave(v, i, -path_.edges[i], false, eye_walk_);
    }
  }
  real by_chance() const {
    if (exact_.light_is_delta()) return real(0);
    Walk walk = eye_walk_;
    const uint depth = uint(k_) + 1u;
    if (exact_.light_is_surface()) {
      const real3 emitted = light_emitted(&twin_.data, &path_.emitter, path_.edges[0]);
      if (is_black(emitted)) return real(0);
      walk_emission(&twin_.data, launch_, &path_.emitter, depth, &walk);
      return weight_of(walk.radiance, emitted);
    }
    walk_escaped(&twin_.data, launch_, depth, &walk);
    return weight_of(walk.radiance, load3(exact_.light().value));
  }
  real by_light_sample() const {
#ifdef TWIN_CONNECT
    const Vertex& v = eye_[0].v;
    Walk walk = eye_walk_;
    walk.partials = eye_[0].partials;
    LightSample light = light_sample_towards(v.surface.p);
    const BsdfEval e = vertex_eval(&twin_.data, &v, light.wi);
    return nee_weight(&twin_.data, launch_, &v, &walk, &light, e);
#else
    return real(0);
#endif
  }
  LightSample light_sample_towards(real3 p) const;
  real by_splat() const {
    LightWalk w = light_walk_from(start());
    w.walk.partials = light_[k_ - 1].partials;
    w.depth = light_[k_ - 1].depth;
    CameraLink link;
    return camera_link(&twin_.data, launch_, twin_.packed.camera, &w, &light_[k_ - 1].v, &link)
               ? link.weight
               : real(0);
  }
  real by_connection(std::size_t s) const {
    Connection link;
    return connect_vertices(&twin_.data, launch_, &eye_[s - 1], &light_[s - 2], &link) ? link.weight
                                                                                       : real(0);
  }

  /// At node i.
  real by_merge(std::size_t i) const {
#ifdef TWIN_MERGE
    Merge merge;
    if ((i > 0 || !samples_lights) && !path_.nodes[i].delta &&
        merge_ends(twin_, launch_, eye_[i], light_[i], &merge))
      return merge.weight;
#endif
    return real(0);
  }

  const TwinScene& twin_;
  const Launch& launch_;
  const FullPath& path_;
  PathDensities exact_;
  std::size_t k_;
  std::vector<EndVertex> light_, eye_;
  Walk eye_walk_{};
};

inline EmitSample Replay::start() const {
  const ::Light& light = exact_.light();
  EmitSample e = emit_none(path_.light);
  e.p = path_.emitter.p, e.ng = path_.emitter.ng;
  e.ray.d = path_.edges[0];
  e.beta = REAL3(1, 1, 1);
  e.delta = exact_.light_is_delta();
  e.at_infinity = exact_.light_at_infinity();
  if (exact_.light_is_surface()) {
    e.cos_light = r_abs(dot3(e.ng, e.ray.d));
    e.pdf = e.cos_light * light_pdf_emit_surface(&twin_.data, path_.light, path_.emitter.flags);
  } else if (e.at_infinity) {
    const real direction = e.delta ? real(1) : INV_FOUR_PI;
    e.pdf = real(light.prob_pick) * direction * light_pdf_disc(&twin_.data);
  } else {
    e.pdf = real(light.prob_pick) / point_light_angle(light);
  }
  return e;
}

#ifdef TWIN_CONNECT
/// The light sample that light_sample would have drawn there.
inline LightSample Replay::light_sample_towards(real3 p) const {
  const ::Light& light = exact_.light();
  LightSample out{};
  out.wi = -path_.edges[0];
  if (exact_.light_is_surface()) {
    out.pdf_w =
        light_pdf_surface(&twin_.data, path_.light, path_.emitter.p, path_.emitter.ng, p, out.wi);
    out.emit = light_pdf_emit_surface(&twin_.data, path_.light, path_.emitter.flags) / out.pdf_w;
    return out;
  }
  // What samples of these lights are told does not depend on chance.
  out.pdf_w = real(light.prob_pick);
  out.delta = exact_.light_is_delta();
  out.at_infinity = exact_.light_at_infinity();
  if (light.kind == LIGHT_ENVIRONMENT) out.pdf_w = light_pdf_environment(&twin_.data);
  const real3 d = path_.emitter.p - p;
  out.emit = out.at_infinity ? light_pdf_disc(&twin_.data)
                             : REAL(1.0) / (point_light_angle(light) * dot3(d, d));
  return out;
}
#endif

}  // namespace TWIN_NAMESPACE
