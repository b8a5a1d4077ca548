// Spawned rays never hit what they start on again (numerics 1): triangles of all sizes and places,
// planes that face each other a few ulps apart, and floors under a sun far from the origin.
//
// A point of a triangle is off its plane by some ulps of its coordinates, so half of all rays would
// start behind it; a fixed nudge is too small far away and too large close up. Here the point is
// rebuilt from its barycentrics, its error bounded and the start moved by that bound along the
// geometric normal (geom/triangle_point.h): some 20 operations and three vertices per hit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shared/limits.h"
#include "stability/measurements.h"
#include "stability/renderer.h"
#include "stability/robustness.h"

namespace pellucid::stability {
namespace {

constexpr std::size_t per_hit = 100;

struct Spawned {
  std::size_t rays = 0, again = 0;
  double lift = 0;  ///< largest offset over the largest coordinate of its triangle
};

double longest_edge(const TracedScene& scene, uint prim) {
  const glm::dvec3 a(scene.corner(prim, 0)), b(scene.corner(prim, 1)), c(scene.corner(prim, 2));
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

/// A ray to a random point of a random triangle, from between 0.1 and 100 of its edges away.
TraceRay ray_to_surface(const TracedScene& scene, Random& random) {
  for (;;) {
    const uint prim = random.below(scene.packed.info.triangle_count);
    const double edge = longest_edge(scene, prim);
    if (!(edge > 0)) continue;  // too small for its place: a point
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const glm::dvec3 a(scene.corner(prim, 0)), b(scene.corner(prim, 1)), c(scene.corner(prim, 2));
    const glm::dvec3 target = a + (b - a) * u + (c - a) * v;
    const glm::dvec3 o =
        target + random.direction() * (edge * std::pow(10.0, random.uniform(-1, 2)));
    if (glm::dvec3(glm::vec3(o)) != target) return ray_towards(o, target);
  }
}

/// Directions over both hemispheres; every third grazes the surface.
glm::vec3 spawn_direction(const Start& start, std::size_t k, Random& random) {
  const glm::dvec3 w = random.direction(), n(start.ng);
  return glm::vec3(k % 3 ? w : glm::normalize(w - n * (glm::dot(n, w) * 0.999)));
}

/// `naive`: rays start as naive code has it.
void spawn_batch(TracedScene& scene, Random& random, std::size_t n, bool naive, Spawned& result) {
  std::vector<TraceRay> first(2 * n / per_hit);
  for (TraceRay& ray : first) ray = ray_to_surface(scene, random);
  const std::vector<TraceHit> hits = scene.closest(first);
  std::vector<TraceRay> rays;
  std::vector<uint> own;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const TraceHit& hit = hits[i];
    if (hit.prim == NONE || rays.size() >= n) continue;
    const Start start = naive ? naive_start_at(scene, first[i], hit) : start_at(scene, hit);
    float largest = 0;
    for (int k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        largest = std::max(largest, std::abs(scene.corner(hit.prim, k)[axis]));
    result.lift = std::max(result.lift, double(start.offset) / largest);
    for (std::size_t k = 0; k < per_hit; ++k) {
      rays.push_back(start.towards(spawn_direction(start, k, random)));
      own.push_back(hit.prim);
    }
  }
  const std::vector<TraceHit> next = scene.closest(rays);
  result.rays += rays.size();
  for (std::size_t i = 0; i < next.size(); ++i) result.again += next[i].prim == own[i];
}

Spawned spawn(TracedScene& scene, std::size_t wanted, bool naive) {
  Random random(7);
  Spawned result;
  while (result.rays < wanted)
    spawn_batch(scene, random, std::min<std::size_t>(wanted - result.rays, 1000000), naive, result);
  return result;
}

Scene scene_of(Mesh mesh) {
  Scene scene = empty_scene();
  add_shape(scene, std::move(mesh));
  return scene;
}

/// A ninth of all rays: there are nine scenes.
void measure_rehits(const Lab& lab, Findings& findings, const std::string& name, Mesh mesh) {
  TracedScene traced(lab, scene_of(std::move(mesh)));
  // 1e8 in all, as the catalogue asks for, at an effort of 10.
  const std::size_t wanted = lab.count(1000008) * std::size_t(std::min(lab.effort, 10.0)) / 9;
  const Spawned result = spawn(traced, wanted, false);
  findings.none("re-hits of " + std::to_string(result.rays) + " rays, " + name, result.again);
  findings.none("counters of errors, " + name, traced.errors());
  // No more than rounding asks for.
  findings.at_most("lift in roundoffs of the largest coordinate, " + name,
                   result.lift / double(UNIT_ROUNDOFF), 64);
}

Mesh plane(double distance) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(0.8, 0.31, -0.4));
  const glm::dvec3 b = glm::normalize(glm::cross(a, glm::dvec3(0.2, 1.0, 0.3)));
  const glm::dvec3 corner = distance * glm::dvec3(0.6, -0.64, 0.48) - a - b;
  return baked(grid(40, corner, 2.0 * a, 2.0 * b, 2.0));
}

Mesh ball(double distance) {
  DisplacedSphere shape;
  shape.triangles = 5000;
  shape.amplitude = 0;
  return baked(generate(shape), distance * glm::dvec3(0.6, -0.64, 0.48));
}

/// The three planes of two axes, each `shift` off the origin: there the error of a point, which
/// follows its coordinates, is far below that of the distance to large triangles.
Mesh axis_planes(double shift) {
  RawMesh raw;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 a(0.0), b(0.0), n(0.0);
    a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1.0;
    n[axis] = shift;
    append(raw, grid(21, n - a - b, 2.0 * a, 2.0 * b));
  }
  return baked(raw);
}

/// Two facing planes around the point at distance P, of triangles about `cell` P wide.
struct Facing {
  const char* name;
  glm::dvec3 place, normal;  ///< unit
};
const Facing facing[] = {
    {"axis plane on its axis", {0, 0, 1}, {0, 0, 1}},
    {"axis plane off its axis", {0.6, -0.48, 0.64}, {0, 0, -1}},
    {"tilted towards the origin", {0.6, -0.64, 0.48}, {0.6, -0.64, 0.48}},
    {"tilted and edge-on", {0.6, -0.64, 0.48}, {0.8, 0.48, -0.36}},
    {"tilted at random", {0.6, -0.64, 0.48}, {0.36, 0.48, 0.8}},
};

/// A square of 6 x 6 cells, each two triangles, around `center`; the outermost are four times as
/// wide, so that no ray leaves past the border.
RawMesh sheet(const glm::dvec3& center, const glm::dvec3& n, double cell) {
  constexpr int cells = 6;
  const glm::dvec3 pick = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 a = glm::normalize(glm::cross(n, pick)), b = glm::cross(n, a);
  const double whole = cells * cell;
  RawMesh raw = grid(cells, center - 0.5 * whole * (a + b), whole * a, whole * b);
  for (glm::dvec3& p : raw.positions) {
    const glm::dvec3 d = p - center;
    for (const glm::dvec3& axis : {a, b})
      if (const double x = glm::dot(d, axis); std::abs(x) > 2.5 * cell)
        p += axis * std::copysign(3 * cell, x);
  }
  return raw;
}

double ulp(double x) {
  return double(std::nextafter(float(x), std::numeric_limits<float>::max())) - double(float(x));
}

Scene facing_planes(const Facing& f, double P, double cell, double gap) {
  Scene scene = empty_scene();
  for (double z : {0.0, gap})
    add_shape(scene, baked(sheet(P * f.place + z * f.normal, f.normal, cell * P)));
  return scene;
}

/// Rays from plane A towards B, `gap` away, that do not hit B; `of`: all rays.
std::size_t leaks(TracedScene& traced, std::size_t n, const Facing& f, double P, double cell,
                  double gap, bool naive = false, std::uint64_t* of = nullptr) {
  const glm::dvec3 center = P * f.place;
  const Scene scene = facing_planes(f, P, cell, gap);
  traced.set_scene(scene);
  const uint first_of_b = uint(std::get<Mesh>(scene.shapes[0].geometry).triangles.size());
  Random random(1);
  std::vector<TraceRay> rays(n);
  for (TraceRay& ray : rays) {  // onto A from behind; B is away then
    const glm::dvec3 up = f.normal, side = random.direction();
    const glm::dvec3 target = center + cell * P * (side - up * glm::dot(up, side));
    ray = ray_towards(target - cell * P * (up + 0.5 * random.direction()), target);
  }
  std::vector<TraceRay> next;
  const std::vector<TraceHit> hits = traced.closest(rays);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const TraceHit& hit = hits[i];
    if (hit.prim >= first_of_b) continue;  // none, or past the border of A
    glm::dvec3 w = random.direction();
    const double cosine = glm::dot(w, f.normal);
    if (cosine < 0) w -= 2 * cosine * f.normal;
    if (std::abs(cosine) < 0.05) continue;
    const Start start = naive ? naive_start_at(traced, rays[i], hit) : start_at(traced, hit);
    next.push_back(start.towards(glm::vec3(w)));
  }
  if (of) *of = next.size();
  std::size_t lost = 0;
  for (const TraceHit& hit : traced.closest(next))
    lost += hit.prim == NONE || hit.prim < first_of_b;
  return lost;
}

/// Smallest gap, in ulps of P, from which on nothing leaks.
double smallest_gap(TracedScene& traced, std::size_t rays, const Facing& f, double P, double cell) {
  double smallest = 512;
  for (double g : {128., 64., 32., 16., 8., 4., 2.}) {
    if (leaks(traced, rays, f, P, cell, g * ulp(P)) > 0) return smallest;
    smallest = g;
  }
  return smallest;
}

/// A sheet of 8 x 8 cells with edges a and b around `center`.
struct Sheet {
  glm::dvec3 center, a, b;
};

/// With coordinates in whole steps of `unit` of which floats know all.
Sheet lattice(double unit, double place) {
  return {std::round(place) * unit * glm::dvec3(3, -5, 4), unit * glm::dvec3(2, 1, 0),
          unit * glm::dvec3(0, 1, 2)};
}

/// In the plane of two axes, or `shift` off it.
Sheet axis_sheet(double unit, int axis, double shift) {
  Sheet sheet{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
  sheet.a[(axis + 1) % 3] = sheet.b[(axis + 2) % 3] = 2 * unit;
  sheet.center[axis] = shift;
  return sheet;
}

/// End to end: every sample of a floor under a sun is the same number, unless it shadows itself.
double worst_floor(const Lab& lab, const char* method, double unit, const Sheet& sheet) {
  const glm::dvec3 n = glm::normalize(glm::cross(sheet.a, sheet.b)),
                   along = glm::normalize(sheet.a);
  Scene scene = empty_scene();
  add_shape(scene,
            baked(grid(8, sheet.center - 4.0 * (sheet.a + sheet.b), 8.0 * sheet.a, 8.0 * sheet.b)));
  constexpr double cosine = 0.1;
  DirectionalLight sun;
  sun.direction = -(cosine * n + std::sqrt(1 - cosine * cosine) * along);
  sun.irradiance = Rgb(2 * 3.14159265358979323846 / cosine);
  scene.lights.push_back(sun);
  scene.camera.origin = sheet.center + 6 * unit * n;
  scene.camera.forward = -n, scene.camera.up = along;
  scene.camera.right = glm::cross(-n, along);
  scene.camera.fov = 60;
  double worst = 0;
  const Picture picture =
      Renderer(lab, scene, {method, 32, 32}).render({lab.count(16), 1, 2, MIS_BALANCE});
  for (const auto& pixel : picture.pixels) worst = std::max(worst, std::abs(pixel[0].mean - 1));
  return worst;
}

void measure_floors(const Lab& lab, Findings& findings) {
  for (const char* method : {"nee", "path", "sppm"}) {
    double worst = 0;
    for (double unit : {0x1p-10, 0x1p10})
      for (double place : {0.0, 1e2, 1e5})
        worst = std::max(worst, worst_floor(lab, method, unit, lattice(unit, place)));
    for (int axis : {0, 1, 2})
      for (double shift : {0.0, 1e-3, -1e-3})
        worst = std::max(worst, worst_floor(lab, method, 1, axis_sheet(1, axis, shift)));
    // Of 16 samples of a pixel, one in its own shadow would take a sixteenth; a few ulps of the
    // cosine, a tenth, are all that may remain.
    findings.at_most(std::string("a sunlit floor's relative error, ") + method, worst, 1e-5);
  }
}

/// The far end of shadow rays: pixels of a shell that a small lamp about the origin lights but for
/// what ends on the lamp itself. Its coordinates are small, their roundoffs next to nothing.
std::size_t dark_pixels(const Lab& lab, const glm::dvec3& normal, double size, double radius) {
  const glm::dvec3 n = glm::normalize(normal), s = glm::normalize(glm::cross(n, {0.3, 1, 0.2}));
  const glm::dvec3 t = glm::cross(n, s);
  Scene scene = empty_scene();
  Sphere shell;
  shell.radius = radius;
  add_shape(scene, shell);
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].reflectance = Rgb(0.0);
  Shape& lamp = add_shape(scene, baked(make_rectangle(-0.5 * size * (s + t), size * s, size * t)));
  lamp.material = 1;
  lamp.emission = Emission{};
  scene.camera.origin = 0.3 * radius * n;
  scene.camera.forward = n, scene.camera.right = s, scene.camera.up = glm::cross(s, n);
  scene.camera.fov = 150;
  const auto side = int(256 * std::sqrt(lab.effort));
  std::size_t dark = 0;
  for (const auto& p :
       Renderer(lab, scene, {"nee", side, side}).render({1, 1, 2, MIS_BALANCE}).pixels)
    dark += p[0].mean == 0;
  return dark;
}

void measure_lamps(const Lab& lab, Findings& findings) {
  std::size_t dark = 0;
  for (const glm::dvec3& n : {glm::dvec3(0, 0, 1), glm::dvec3(1, 2, 3), glm::dvec3(-3, 1, 0.2)})
    for (const auto& [size, radius] : {std::pair(0.03, 1.0), {1.0, 100.0}, {1e-4, 1.0}})
      dark += dark_pixels(lab, n, size, radius);
  findings.none("shadow rays that end on the lamp they are sent to, of 6e5", dark);
}

}  // namespace

void spawned_rays_leave(const Lab& lab, Findings& findings) {
  Random random(1);
  measure_rehits(lab, findings, "triangles of 10^-8..10^8", scattered(random, 400, -8, 8));
  measure_rehits(lab, findings, "of 10^-3..10^-1", scattered(random, 1000, -3, -1));
  measure_rehits(lab, findings, "of 10^3..10^4", scattered(random, 1000, 3, 4));
  measure_rehits(lab, findings, "plane at 0", plane(0));
  measure_rehits(lab, findings, "plane at 1e4", plane(1e4));
  measure_rehits(lab, findings, "sphere at 0", ball(0));
  measure_rehits(lab, findings, "sphere at 1e3", ball(1e3));
  measure_rehits(lab, findings, "axis planes", axis_planes(0));
  measure_rehits(lab, findings, "axis planes 1e-3 off", axis_planes(1e-3));
  TracedScene planes(lab, facing_planes(facing[0], 1, 1, 1));
  for (const Facing& f : facing) {
    double worst = 0;
    for (double P : {0.1, 1.0, 1e3, 1e6})
      for (double cell : {1e-3, 0.03, 0.3})
        worst = std::max(worst, smallest_gap(planes, lab.count(3000), f, P, cell));
    findings.at_most(std::string("g_min in ulp(P), ") + f.name, worst, 64);
  }
  measure_lamps(lab, findings);
  measure_floors(lab, findings);
}

void compare_rehits(const Lab& lab, std::vector<Faults>& faults) {
  const std::size_t rays = lab.count(200000);
  const auto compare = [&](const char* what, Mesh mesh) {
    const Scene scene = scene_of(std::move(mesh));
    TracedScene ours(lab, scene), naive(lab, scene, naive_rays);
    faults.push_back({fmt::format("rays that hit the triangle they start on, {}", what), rays,
                      spawn(ours, rays, false).again, spawn(naive, rays, true).again});
  };
  Random random(1);
  compare("triangles of 1e-3 to 1e-1 around the origin", scattered(random, 1000, -3, -1));
  compare("triangles of 1e3 to 1e4 around the origin", scattered(random, 1000, 3, 4));
  compare("a sphere of radius 1 at the origin", ball(0));
  compare("at 1e3", ball(1e3));
  compare("a plane of size 2 at 1e4", plane(1e4));
  for (double gap : {1e-3, 1e-4, 1e-5}) {
    const Facing& f = facing[4];
    const Scene scene = facing_planes(f, 1, 0.3, gap);
    TracedScene ours(lab, scene), naive(lab, scene, naive_rays);
    Faults row;
    row.what = fmt::format("rays between planes {:g} apart, at 1, that pass one", gap);
    row.ours = leaks(ours, rays, f, 1, 0.3, gap);
    row.naive = leaks(naive, rays, f, 1, 0.3, gap, true, &row.rays);
    faults.push_back(row);
  }
}

}  // namespace pellucid::stability
