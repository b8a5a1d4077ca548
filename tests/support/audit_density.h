// Densities of every strategy for a given path, by definition: the product over its vertices of
// the density with which each is drawn, in double. Of the kernels only a material's density for a
// pair of directions is used, never their recursion, weights or light densities.
#pragma once

#include "support/audit_paths.h"

namespace TWIN_NAMESPACE {

/// A path in double, and what each end draws.
class PathDensities {
 public:
  PathDensities(const TwinScene& twin, const Launch& launch, const FullPath& path)
      : twin_(twin), launch_(launch), path_(path), k_(path.nodes.size()) {}

  /// Density of strategy s = 0 .. k + 1 (k surfaces between light and camera), then of merging at
  /// each of them (merge_at), all in one measure: area at surfaces, solid angle at an environment,
  /// none at delta lights.
  std::vector<double> all() const {
    std::vector<double> p(k_ + 2 + (merges ? k_ : 0), 0.0);
    for (std::size_t s = 0; s <= k_ + 1; ++s)
      if (possible(s)) p[s] = density(s);
    // Light samples bring what comes straight, where there are any.
    for (std::size_t i = samples_lights ? 2 : 1; merges && i <= k_; ++i)
      if (spread(i)) p[merge_at(i)] = merge_density(i);
    return p;
  }
  /// Index of the strategy that merges at point i = 1 .. k.
  std::size_t merge_at(std::size_t i) const { return k_ + 1 + i; }
  /// Delta lobe at node i: density of drawing the point on the light's side over that of drawing
  /// the one on the camera's side, each [1/sr]: the inverse ratio of their solid angles.
  double delta_ratio(std::size_t i) const;
  double glass_index(const Surface& s) const;
  double distance2(std::size_t i) const {  ///< of edge i, which ends on node i
    const glm::dvec3 d = to_dvec3(point(i + 1)) - to_dvec3(point(i));
    return glm::dot(d, d);
  }
  /// |cosine| of edge `edge` at point `i`: 0 the light, i the node i - 1.
  double cosine(std::size_t i, std::size_t edge) const {
    const real3 ng = i == 0 ? path_.emitter.ng : path_.nodes[i - 1].surface.ng;
    return std::abs(glm::dot(to_dvec3(ng), to_dvec3(path_.edges[edge])));
  }
  const ::Light& light() const { return twin_.packed.lights[path_.light]; }
  bool light_at_infinity() const {
    return light().kind == LIGHT_DIRECTIONAL || light().kind == LIGHT_ENVIRONMENT;
  }
  bool light_is_surface() const { return light().kind <= LIGHT_DISK; }
  bool light_is_delta() const { return !light_is_surface() && light().kind != LIGHT_ENVIRONMENT; }

 private:
  real3 point(std::size_t i) const {
    if (i == 0) return path_.emitter.p;
    return i <= k_ ? path_.nodes[i - 1].surface.p : load3(twin_.packed.camera.origin);
  }
  bool spread(std::size_t i) const { return !path_.nodes[i - 1].delta; }  ///< point i

  /// Both ends of the edge that is not drawn may be anything but single directions.
  bool possible(std::size_t s) const {
    if (s == 0) return !light_is_delta();
    if (!connects) return false;
    if (s == 1) return k_ >= 1 && spread(1);
    return spread(s - 1) && (s == k_ + 1 || spread(s));
  }
  double density(std::size_t s) const {
    double p = s == k_ + 1 ? double(launch_.light_paths) : 1.0;
    for (std::size_t i = 0; i < s; ++i) p *= s == 1 ? nee() : from_light(i);
    for (std::size_t i = s; i <= k_; ++i) p *= from_eye(i);
    return p;
  }
  /// Both walks draw point i, and one of all light paths comes within the radius: its density is
  /// that of a connection times the chance of that [Georgiev12 eq. 11].
  double merge_density(std::size_t i) const {
    double p = double(launch_.mis_vm) * (merged_first(i) ? 1.0 : double(launch_.mis_deep));
    for (std::size_t j = 0; j <= i; ++j) p *= from_light(j);
    for (std::size_t j = i; j <= k_; ++j) p *= from_eye(j);
    return p;
  }
  /// Between point i and the camera there are delta scatterings alone.
  bool merged_first(std::size_t i) const {
    for (std::size_t j = i; j < k_; ++j)
      if (!path_.nodes[j].delta) return false;
    return true;
  }
  double from_light(std::size_t i) const;
  double from_eye(std::size_t i) const;
  double nee() const;
  double light_area() const;
  double scatter(std::size_t i, std::size_t towards, int importance) const;

  const TwinScene& twin_;
  const Launch& launch_;
  const FullPath& path_;
  std::size_t k_;
};

/// Density [1/sr, roulette included] with which a walk at point i draws the edge to point
/// `towards`, coming from the point on the other side; of a delta lobe: its factor beside what both
/// ways have in common.
inline double PathDensities::scatter(std::size_t i, std::size_t towards, int importance) const {
  const PathNode& node = path_.nodes[i - 1];
  const bool onward = towards == i + 1;
  const real3 from = onward ? -path_.edges[i - 1] : path_.edges[i];
  const real3 to = onward ? path_.edges[i] : -path_.edges[i - 1];
  const Vertex v = vertex_at(&twin_.data, node.surface, from, importance);
  const double survive = double(v.material.survive);
  if (node.delta) return onward ? survive : survive * delta_ratio(i - 1);
  if (v.black) return 0.0;
  return survive * double(vertex_eval(&twin_.data, &v, to).pdf_w);
}

/// Index of the smooth glass of this surface: its own, or of the one part of a mix that is smooth;
/// 1 if there is none, so that light goes straight on.
inline double PathDensities::glass_index(const Surface& s) const {
  const ::Material mix = twin_.packed.materials[s.material];
  const ::Material* glass = &twin_.packed.materials[s.material];
  if (mix.kind == MATERIAL_MIX)
    for (uint first = mix.first_part, j = 0; j < mix.part_count; ++j)
      if (twin_.packed.materials[first + j].kind == MATERIAL_DIELECTRIC)
        glass = &twin_.packed.materials[first + j];
  return glass->kind == MATERIAL_DIELECTRIC ? double(glass->ior) : 1.0;
}

inline double PathDensities::delta_ratio(std::size_t i) const {
  const Surface& s = path_.nodes[i].surface;
  const glm::dvec3 ns = to_dvec3(s.ns), ng = to_dvec3(s.ng), light = -to_dvec3(path_.edges[i]),
                   camera = to_dvec3(path_.edges[i + 1]);
  const auto mirrored = [](const glm::dvec3& w, const glm::dvec3& n) {
    return w - 2 * glm::dot(w, n) * n;
  };
  // By the sides of the facet; in front means outside.
  const double side_l = glm::dot(ng, light), side_c = glm::dot(ng, camera);
  const double n = side_l * side_c > 0 ? 1 : glass_index(s);
  const double n_l = side_l > 0 ? 1 : n, n_c = side_c > 0 ? 1 : n;
  const double turn = glm::dot(ns, ng) < 0 ? -1 : 1;
  const auto above = [&](const glm::dvec3& w, double side) {
    return turn * side * glm::dot(ns, w) > 0;
  };
  // To the camera leaves what the lobe has drawn or its image by the shading plane, if both can be
  // met in proportion to their cosines.
  const glm::dvec3 o = above(camera, side_c) ? camera : mirrored(camera, ns);
  const double met = std::max(glm::dot(ng, o) * side_c, 0.0) / std::abs(side_c),
               met_image = std::max(glm::dot(ng, mirrored(o, ns)) * side_c, 0.0) / std::abs(side_c);
  const double share = std::abs(side_c) / (met + met_image);
  // The lobe has met the light or its image by the facet: tangents tell which [Snell].
  const glm::dvec3 images[2] = {light, mirrored(light, ng)};
  double sum = 0, chosen = 0, least = 1e30;
  for (const glm::dvec3& l : images) {
    if (!above(l, side_l)) continue;
    const double z = std::abs(glm::dot(ns, l));
    const glm::dvec3 tangents = n_l * (l - glm::dot(ns, l) * ns) + n_c * (o - glm::dot(ns, o) * ns);
    sum += z;
    if (glm::length(tangents) < least) least = glm::length(tangents), chosen = z;
  }
  // n^2 |cos| dw is the same on both sides.
  return n_l * n_l * chosen / (n_c * n_c * std::abs(glm::dot(ns, o))) / (chosen / sum * share);
}

inline double PathDensities::light_area() const {
  const pellucid::PackedScene& packed = twin_.packed;
  const ::Light& l = light();
  if (l.kind == LIGHT_TRIANGLE) {
    const Triangle& t = packed.triangles[l.prim];
    const auto at = [&](uint i) { return to_dvec3(load3(packed.positions[i])); };
    return 0.5 * glm::length(glm::cross(at(t.v1) - at(t.v0), at(t.v2) - at(t.v0)));
  }
  const double r = packed.quadrics[l.prim - packed.info.triangle_count].center_radius.w;
  return (l.kind == LIGHT_SPHERE ? 4 : 1) * 3.14159265358979323846 * r * r;
}

/// Light samples: uniform by area, or in the cone under which point 1 sees a sphere.
inline double PathDensities::nee() const {
  constexpr double pi = 3.14159265358979323846;
  const ::Light& l = light();
  const double pick = l.prob_pick;
  if (l.kind == LIGHT_ENVIRONMENT) return pick / (4 * pi);
  if (!light_is_surface()) return pick;
  if (l.kind == LIGHT_SPHERE) {
    const F4& c = twin_.packed.quadrics[l.prim - twin_.packed.info.triangle_count].center_radius;
    const double away = glm::length(to_dvec3(load3(c)) - to_dvec3(point(1)));
    const double ratio = double(c.w) / away;
    if (1 / (ratio * ratio) > double(SPHERE_NEAR)) {
      const double angle = std::asin(ratio), half = std::sin(0.5 * angle);
      return pick / (4 * pi * half * half) * cosine(0, 0) / distance2(0);
    }
  }
  return pick / light_area();
}

/// Point i drawn by a walk from the light.
inline double PathDensities::from_light(std::size_t i) const {
  constexpr double pi = 3.14159265358979323846;
  const ::Light& l = light();
  if (i == 0) {
    const double pick = l.prob_pick;
    if (l.kind == LIGHT_ENVIRONMENT) return pick / (4 * pi);
    return light_is_surface() ? pick / light_area() : pick;
  }
  if (i >= 2) return scatter(i - 1, i, 1) * cosine(i, i - 1) / distance2(i - 1);
  if (light_at_infinity()) {
    const double r = twin_.packed.info.center_radius.w;
    return cosine(1, 0) / (pi * r * r);
  }
  double per_angle = 1 / (4 * pi);
  if (l.kind == LIGHT_SPOT) per_angle = 1 / (2 * pi * double(l.axis.w));
  if (light_is_surface()) {
    const uint both = SHAPE_EMIT_FRONT | SHAPE_EMIT_BACK;
    per_angle = cosine(0, 0) / ((path_.emitter.flags & both) == both ? 2 * pi : pi);
  }
  return per_angle * cosine(1, 0) / distance2(0);
}

/// Point i drawn by a walk from the camera, per pixel of area.
inline double PathDensities::from_eye(std::size_t i) const {
  const ::Camera& camera = twin_.packed.camera;
  if (i == k_) {
    const double d = camera.forward.w;
    const double c = glm::dot(to_dvec3(load3(camera.forward)), -to_dvec3(path_.edges[k_]));
    return d * d / (c * c * c) * cosine(k_, k_) / distance2(k_);
  }
  const double p = scatter(i + 1, i, 0);
  if (i == 0 && light_at_infinity()) return p;
  return p * cosine(i, i) / distance2(i);
}

/// Weight of each strategy by the heuristic, from densities of any scale.
inline std::vector<double> weights_of(uint heuristic, std::vector<double> p) {
  double sum = 0;
  for (double& x : p) sum += x = heuristic == MIS_POWER ? x * x : x;
  for (double& x : p) x /= sum;
  return p;
}

}  // namespace TWIN_NAMESPACE
