// The traversal finds what brute force in double finds, and deep trees do not overflow its stack
// (numerics 28).
//
// Rays along axes and in the planes of boxes make 0 x infinity; directions are kept from 0
// (DIRECTION_MIN), boxes padded by a few ulps (BOX_PAD_ULPS), and the stack is as deep as the tree
// that was built. The padding is part of a ray's constants, so it costs some operations per ray and
// axis, none per box (geom/boxes.h); the stack, 8 bytes of private memory per level that is needed.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "stability/brute_force.h"
#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

constexpr double half = 4.0;  ///< the scene lies in [-half, half]^3

/// A knot, loose triangles, and axis-aligned grids whose box planes rays can meet exactly.
Scene judged_scene() {
  Random random(1);
  Scene scene = empty_scene();
  TorusKnot knot;
  knot.triangles = 600;
  add_shape(scene, baked(generate(knot), {}, 2.0));
  add_shape(scene, soup(random, 300, 3.0, 1.0));
  RawMesh grids = grid(8, {-4, -4, -3.5}, {8, 0, 0}, {0, 8, 0});
  append(grids, grid(6, {-3, 2, -4}, {6, 0, 0}, {0, 0, 8}));
  append(grids, grid(4, {3.5, -2, -2}, {0, 4, 0}, {0, 0, 4}));
  add_shape(scene, baked(grids));
  return scene;
}

enum Kind { random_rays, far_rays, axis_rays, box_plane_rays, face_plane_rays, kinds };
const char* const kind_names[] = {"random", "far", "axis-parallel", "from box planes",
                                  "in face planes"};

/// A point that shares every coordinate with some vertex, hence with planes of boxes.
glm::dvec3 box_point(const TracedScene& scene, Random& random) {
  glm::dvec3 p;
  for (int axis = 0; axis < 3; ++axis)
    p[axis] = scene.corner(random.below(scene.packed.info.triangle_count), 0)[axis];
  return p;
}

TraceRay make(Kind kind, const TracedScene& scene, Random& random) {
  if (kind == random_rays) return ray_along(random.in_box(half), random.direction());
  if (kind == far_rays) {
    const glm::dvec3 target = random.in_box(half);
    return ray_towards(target + 300.0 * random.direction(), target);
  }
  const auto axis = int(random.below(3));
  glm::dvec3 o = box_point(scene, random), d(0.0);
  d[axis] = random.below(2) ? 1 : -1;
  if (kind == axis_rays) {
    if (random.below(2)) o[(axis + 1) % 3] = random.uniform(-half, half);
    if (random.below(2)) o[axis] -= 20 * d[axis];
    return ray_along(o, d);
  }
  if (kind == box_plane_rays) {
    if (random.below(2)) return ray_along(o, random.direction());
    d[(axis + 1) % 3] = random.uniform(-1, 1);
    return ray_along(o, glm::normalize(d));
  }
  const uint prim = random.below(scene.packed.info.triangle_count);
  const glm::dvec3 a(scene.corner(prim, 0)), b(scene.corner(prim, 1)), c(scene.corner(prim, 2));
  const glm::dvec3 along = (b - a) * random.uniform(-1, 1) + (c - a) * random.uniform(-1, 1);
  return ray_along(a - along * random.uniform(0, 5), glm::normalize(along));
}

std::vector<TraceRay> make_rays(Kind kind, const TracedScene& scene, std::size_t n) {
  Random random(unsigned(kind) + 11);
  std::vector<TraceRay> rays(n);
  for (TraceRay& ray : rays) ray = make(kind, scene, random);
  return rays;
}

struct Judged {
  std::size_t hits = 0, excused = 0, wrong = 0;
};

/// Cosine between ray and plane of a triangle: a distance is known to roundoff over it.
double cosine_to(const TracedScene& scene, uint prim, const glm::dvec3& d) {
  const glm::dvec3 a(scene.corner(prim, 0)), b(scene.corner(prim, 1)), c(scene.corner(prim, 2));
  return std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), d));
}

/// Whether the triangle is seen edge-on and the hit lies in it up to `margin`: its distance in
/// double, where the ray crosses its plane, then says nothing.
bool meets_edge_on(const TracedScene& scene, const TraceRay& ray, const TraceHit& hit,
                   double margin) {
  if (cosine_to(scene, hit.prim, direction_of(ray)) > 1e-5) return false;
  const glm::dvec3 a(scene.corner(hit.prim, 0)), b(scene.corner(hit.prim, 1));
  const glm::dvec3 c(scene.corner(hit.prim, 2));
  const glm::dvec3 p = origin_of(ray) + double(hit.t) * direction_of(ray);
  const glm::dvec3 n = glm::normalize(glm::cross(b - a, c - a));
  const glm::dvec3 low = glm::min(a, glm::min(b, c)) - margin;
  const glm::dvec3 high = glm::max(a, glm::max(b, c)) + margin;
  return std::abs(glm::dot(p - a, n)) <= margin && glm::clamp(p, low, high) == p;
}

/// Where hits differ, moving the outlines by rounding must be able to explain it, or both lie at
/// the same distance: what the device hits must be possible, and what it passes by must be unsure.
void judge(const TracedScene& scene, const TraceRay& ray, const TraceHit& hit, Judged& verdict) {
  constexpr double roundoffs = 64 * 0x1p-24;
  const glm::dvec3 o = origin_of(ray), d = direction_of(ray);
  const BruteHit truth = brute_force_trace(scene.packed, o, d);
  verdict.hits += truth.prim != NONE;
  const bool hits = hit.prim != NONE, should = truth.prim != NONE;
  if (!hits && !should) return;
  const double reach = std::max(should ? truth.t : 0.0, hits ? double(hit.t) : 0.0);
  const double margin = roundoffs * (half + glm::length(o) + reach);
  const bool same_place =
      hits && should && std::abs(double(hit.t) - truth.t) <= margin / cosine_to(scene, hit.prim, d);
  if (hits && hit.prim == truth.prim) {
    verdict.wrong += !same_place;
    return;
  }
  const bool possible = !hits || distance_to(scene.packed, hit.prim, o, d, margin) > 0 ||
                        meets_edge_on(scene, ray, hit, margin);
  const bool passed_by = should && (!hits || double(hit.t) > truth.t);
  const bool sure = passed_by && distance_to(scene.packed, truth.prim, o, d, -margin) > margin;
  // The origin lies in the plane of what was hit, up to rounding: 0 and just above it are both
  // right.
  const bool leaves_it = hits && double(hit.t) <= margin / cosine_to(scene, hit.prim, d) &&
                         distance_to(scene.packed, hit.prim, o - d, d, margin) > 0;
  if (same_place || leaves_it || (possible && !sure)) {
    ++verdict.excused;
  } else {
    ++verdict.wrong;
  }
}

void measure_brute_force(const Lab& lab, Findings& findings) {
  TracedScene scene(lab, judged_scene());
  // Rays along axes and in planes run along edges by intent, those from box planes start on faces;
  // the others meet none to speak of.
  const double excusable[kinds] = {1e-4, 3e-3, 0.01, 0.06, 0.12};
  for (int k = 0; k < kinds; ++k) {
    const std::vector<TraceRay> rays = make_rays(Kind(k), scene, lab.count(1000000) / kinds);
    const std::vector<TraceHit> hits = scene.closest(rays);
    Judged verdict;
    for (std::size_t i = 0; i < rays.size(); ++i) judge(scene, rays[i], hits[i], verdict);
    const std::string name = std::string(", rays ") + kind_names[k];
    findings.none("hits that brute force refutes" + name, verdict.wrong);
    findings.at_most("share of hits at edges that either may have" + name,
                     double(verdict.excused) / double(rays.size()), excusable[k]);
    findings.require("a quarter hits" + name, verdict.hits > rays.size() / 4);
  }
  findings.none("counters of errors, brute force", scene.errors());
}

Scene nested_octahedra(int shells) {
  RawMesh raw;
  for (int s = 0; s < shells; ++s) {
    const auto base = unsigned(raw.positions.size());
    const double r = 1 + 1e-3 * s;
    for (int axis = 0; axis < 3; ++axis)
      for (double sign : {-r, r}) {
        glm::dvec3 p(0.0);
        p[axis] = sign;
        raw.positions.push_back(p);
      }
    for (unsigned i = 0; i < 8; ++i)
      raw.triangles.emplace_back(base + (i & 1), base + 2 + (i >> 1 & 1), base + 4 + (i >> 2 & 1));
  }
  Scene scene = empty_scene();
  add_shape(scene, baked(raw));
  return scene;
}

Scene nested_spheres(int shells) {
  Scene scene = empty_scene();
  for (int s = 0; s < shells; ++s) add_shape(scene, Sphere{{0, 0, 0}, 1 + 1e-3 * s});
  return scene;
}

/// From the centre the innermost shell is hit, from outside the outermost.
void measure_shells(const Lab& lab, Findings& findings, const std::string& name, const Scene& scene,
                    uint shells, uint per_shell) {
  Random random(6);
  std::vector<TraceRay> rays(lab.count(200));
  const double away = 10 * (1 + 1e-3 * shells);
  for (std::size_t i = 0; i < rays.size(); ++i)
    rays[i] = i % 2 ? ray_along({}, random.direction())
                    : ray_towards(away * random.direction(), random.in_box(0.1));
  TracedScene traced(lab, scene);
  const BothHits hits = traced.both(rays);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const uint shell = hits.closest[i].prim / per_shell;
    wrong += shell != (i % 2 ? 0 : shells - 1) || hits.any[i].prim == NONE;
  }
  findings.none("wrong hits in nested " + name, wrong);
  findings.none("stack overflows in nested " + name, traced.errors());
}

}  // namespace

void layouts_agree(const Lab& lab, Findings& findings) {
  std::vector<TraceRay> rays;
  std::vector<TraceHit> expected;
  for (const RayConfig& config : all_configs()) {
    TracedScene scene(lab, judged_scene(), config);
    if (rays.empty())
      for (int k = 0; k < kinds; ++k)
        for (const TraceRay& ray : make_rays(Kind(k), scene, lab.count(20000) / kinds))
          rays.push_back(ray);
    const BothHits hits = scene.both(rays);
    if (expected.empty()) expected = hits.closest;
    std::size_t differing = 0, inconsistent = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      differing += std::memcmp(&hits.closest[i], &expected[i], sizeof(TraceHit)) != 0;
      inconsistent += (hits.any[i].prim == NONE) != (hits.closest[i].prim == NONE) ||
                      hits.any[i].t < hits.closest[i].t;
    }
    findings.none("hits that differ, " + name_of(config), differing);
    findings.none("any-hits that contradict, " + name_of(config), inconsistent);
    findings.none("counters of errors, " + name_of(config), scene.errors());
  }
}

void traversal_misses_nothing(const Lab& lab, Findings& findings) {
  measure_brute_force(lab, findings);
  constexpr int octahedra = 125000, spheres = 1000000;  // as many triangles
  measure_shells(lab, findings, "octahedra", nested_octahedra(octahedra), octahedra, 8);
  measure_shells(lab, findings, "spheres", nested_spheres(spheres), spheres, 1);
}

}  // namespace pellucid::stability
