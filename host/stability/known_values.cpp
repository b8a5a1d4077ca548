// Renders whose value is known, where naive code loses digits or energy.
//
// Light that no technique can sample (numerics 3) has no variance, so that noise cannot tell of it:
// the host knows from materials, lights and camera which classes of paths a method misses
// (integrators/reach.h), at no cost in kernels. Small lights (11): 1 - cos of a cone cancels, so it
// is made of sin^2, by a division more. Roughness near 0 (12): D of 1 - cos^2 has no digits, so it
// is made of tangents, at the same cost; below ALPHA_DELTA lobes are mirrors. Dielectrics (13):
// roots of negative numbers past the critical angle, half vectors of 0/0 at index 1, n^2 of
// radiance alone: clamps, a branch and a flag. Long paths (24): caps lose rho^(k + 1), and say so
// (depth_cut, an atomic for each path that a cap ends).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "integrators/reach.h"
#include "integrators/registry.h"
#include "stability/closed_forms.h"
#include "stability/estimates.h"
#include "stability/measurements.h"
#include "stability/quadrature.h"

namespace pellucid::stability {
namespace {

constexpr double pi = 3.14159265358979323846;

Material metal_without_loss(double alpha) {
  Material m;
  m.kind = MaterialKind::conductor;
  m.eta = Rgb(0.0);
  m.k = Rgb(1.0);
  m.alpha = alpha;
  return m;
}

Material glass(double alpha, double ior = 1.5) {
  Material m;
  m.kind = MaterialKind::dielectric;
  m.ior = ior;
  m.alpha = alpha;
  return m;
}

std::vector<std::string> unreachable(const std::string& method, const Scene& scene, uint depth,
                                     const Lab& lab) {
  const PackedScene packed = pack_scene(scene, {simd_width_for(lab.device.info())});
  return unreachable_paths(find_integrator(method), optics_of(packed, depth));
}

Shape& shape_named(Scene& scene, const std::string& name) {
  for (Shape& shape : scene.shapes)
    if (shape.name == name) return shape;
  throw InternalError("a scene of the suite has no shape " + name);
}

/// A pane seen at grazing angles, beyond those of the shipped scenes.
Scene pane_seen_at(const Lab& lab, double degrees) {
  Scene scene = lab.open_scene("slab-80");
  for (glm::vec3& p : std::get<Mesh>(shape_named(scene, "light").geometry).positions)
    p *= glm::vec3(10, 10, 1);  // to where rays come down
  const double angle = degrees * pi / 180;
  const glm::dvec3 there(std::sin(angle), 0, std::cos(angle));
  scene.camera.origin = 5.0 * there, scene.camera.forward = -there;
  scene.camera.right = {0, 1, 0};
  scene.camera.up = glm::cross(scene.camera.right, scene.camera.forward);
  scene.camera.fov = 0.01;
  return scene;
}

}  // namespace

void light_through_glass_is_found_or_told(const Lab& lab, Findings& findings) {
  // CF10 around its axis: a view 0.2 wide, and a spot that shines little beyond it.
  constexpr double h = 2, t = 0.5, n = 1.5, half = 0.1, radius = 0.02;
  constexpr uint depth = 4;
  Scene scene = pane_scene(lab.open_scene("slab"));
  SpotLight spot;
  spot.position = {0, 0, h};
  spot.direction = {0, 0, -1};
  spot.intensity = Rgb(1.0);
  spot.inner = 0.12, spot.outer = 0.13;
  scene.lights = {spot};
  scene.camera.fov = 2 * std::atan(half / scene.camera.origin.z) * 180 / pi;
  const auto irradiance = [&](double x, double y) {
    return irradiance_below_pane(std::hypot(x, y), h, t, n);
  };
  const double value = 0.5 / pi * integrate(irradiance, 0, half, 0, half, 1e-9) / (half * half);
  for (const char* method : {"light", "bdpt", "sppm", "bpm", "vcm"}) {
    Build build{method, 4, 4};
    build.light_paths = 1 << 10;
    build.radius = radius, build.radius_alpha = 1;
    constexpr double slack = 5 * radius * radius / (h * h);  // the mean over discs of it
    compare(lab, findings, fmt::format("floor lit through a pane, {}", method),
            measured_mean(lab, scene, build, {64, 1, depth, MIS_BALANCE}), value, slack);
  }
  findings.none("classes told as unreachable, vcm", unreachable("vcm", scene, depth, lab).size());
  for (const char* method : {"naive", "nee", "path", "reference"}) {
    const Picture picture =
        Renderer(lab, scene, {method, 4, 4}).render({64, 1, depth, MIS_BALANCE});
    findings.at_most(fmt::format("what a blind method makes up, {}", method), picture.image(0).mean,
                     0);
    findings.require(fmt::format("the blind method says so, {}", method),
                     !unreachable(method, scene, depth, lab).empty());
  }
}

/// CF4 with a light of side 0.02, 1 above the floor and turned until it is seen all but edge-on.
void measure_edge_on(const Lab& lab, Findings& findings) {
  constexpr double size = 0.01, angle = 89.99 * pi / 180;
  Scene scene = lab.open_scene("rectangle-light");
  Shape& light = shape_named(scene, "light");
  std::vector<glm::dvec3> corners;
  for (glm::vec3& p : std::get<Mesh>(light.geometry).positions) {
    p = {size * p.x, 1 - size * p.z * std::sin(angle), size * p.z * std::cos(angle)};
    corners.emplace_back(p);  // rounded: that turns it by a thousandth of what is left
  }
  light.emission->radiance /= size * size;
  scene.camera.fov = 2e-4;  // the value doubles within a ten-thousandth of a radian
  const double value = polygon_form_factor({0, 0, 0}, {0, 1, 0}, corners) / (size * size);
  for (const char* method : {"nee", "path", "bdpt"})
    compare(lab, findings, fmt::format("panel turned by 89.99 degrees, {}", method),
            measured_mean(lab, scene, {method, 16, 16}, {}), value, 2e-3);
}

/// CF5 with a smaller lamp of the same power.
Scene under_lamp(const Lab& lab, double radius) {
  Scene scene = lab.open_scene("sphere-light-offset");
  Shape& light = shape_named(scene, "light");
  Sphere& sphere = std::get<Sphere>(light.geometry);
  light.emission->radiance *= std::pow(sphere.radius / radius, 2);
  sphere.radius = radius;
  return scene;
}

void small_lights_keep_their_power(const Lab& lab, Findings& findings) {
  measure_edge_on(lab, findings);
  constexpr double resolution = 2e-3;
  const double value = 16 * 0.0447214;  // CF5 beside the light, at constant Le R^2
  for (const char* method : {"nee", "path", "bdpt"})
    for (int e = 1; e <= 6; ++e)
      compare(lab, findings, fmt::format("lamp of radius 1e-{}, {}", e, method),
              measured_means(lab, under_lamp(lab, std::pow(10.0, -e)), {method, 16, 16}, {},
                             resolution)[0],
              value, 1e-4, resolution);
  // Walks from the lamp find a square of the floor, from half its side beside the foot on.
  constexpr double h = 2, half = 0.5, x = 1, power = 8, rho = 0.5;  // power: Le R^2
  const auto floor = [](double u, double v) {
    return rho * power * h / std::pow(h * h + u * u + v * v, 1.5);
  };
  const double mean = integrate(floor, x - half, x + half, -half, half, 1e-9);
  for (const char* method : {"light", "sppm", "bpm", "vcm"})
    for (double radius : {1e-2, 1e-6}) {
      Scene scene = under_lamp(lab, radius);
      Camera& c = scene.camera;
      c.origin = {x, 1, 0}, c.forward = {0, -1, 0}, c.right = {1, 0, 0}, c.up = {0, 0, -1};
      c.fov = 2 * std::atan(half) * 180 / pi;
      Build build{method, 16, 16};
      build.light_paths = 1 << 12;
      build.radius = 0.01, build.radius_alpha = 1;  // its bias goes with its square
      compare(lab, findings, fmt::format("square under a lamp of radius {:g}, {}", radius, method),
              measured_mean(lab, scene, build, {}), mean, 1e-4);
    }
}

void roughness_goes_to_zero_smoothly(const Lab& lab, Findings& findings) {
  constexpr double cosine = 0.5;  // at which `sheet` is seen
  const double widths[] = {1, 0.5, 0.2, 0.1, 0.05, 0.01, 2e-3, 1.01e-3, 9.9e-4, 1e-4, 1e-5};
  const double matte = 0.05;  // from which on quadrature tells the value
  Scene scene = lab.open_scene("sheet");
  const double r = fresnel(cosine, 1, 1.5, 0), through = r + (1 - r) / 2.25;
  double step[2][2];  // [metal, glass][above, below the switch to a delta]
  for (double alpha : widths) {
    for (bool metal : {true, false}) {
      scene.materials.at(0) = metal ? metal_without_loss(alpha) : glass(alpha);
      const Estimate e = measured_mean(lab, scene, {"path", 16, 16}, {});
      const std::string name = fmt::format("{} of width {:g}", metal ? "metal" : "glass", alpha);
      const double limit = metal ? 1 : through;
      const double value = alpha < matte ? limit
                           : metal       ? ggx_reflected(cosine, alpha, 1, 0, 1)
                                         : ggx_reflected(cosine, alpha, 1, 1.5, 0) +
                                         ggx_transmitted(cosine, alpha, 1, 1.5);
      // Between the delta and the matte ones the loss to single scattering is of second order.
      compare(lab, findings, name, e, value, alpha < matte ? alpha * alpha + 1e-5 : 1e-5);
      findings.at_most("energy made, " + name, e.mean - limit - 4.5 * e.error(), 1e-5);
      if (alpha == 1.01e-3) step[!metal][0] = e.mean;
      if (alpha == 9.9e-4) step[!metal][1] = e.mean;
    }
  }
  for (const char* method : {"sppm", "vcm"})
    for (double alpha : {0.2, 0.01, 1e-4}) {
      scene.materials.at(0) = metal_without_loss(alpha);
      compare(lab, findings, fmt::format("metal of width {:g}, {}", alpha, method),
              measured_mean(lab, scene, {method, 16, 16}, {}),
              alpha < matte ? 1 : ggx_reflected(cosine, alpha, 1, 0, 1), alpha * alpha + 1e-5);
    }
  findings.at_most("step at the switch to a mirror", std::abs(step[0][0] - step[0][1]), 0.005);
  findings.at_most("step at the switch to clear glass",
                   std::abs(step[1][0] - step[1][1]) / step[1][1], 0.005);
}

void panes_let_through_what_they_must(const Lab& lab, Findings& findings) {
  constexpr uint depth = 1000;  // light that enters a pane by its edges never leaves it again
  for (int degrees : {0, 45, 60, 80})
    for (const char* method : {"path", "bdpt", "sppm", "vcm"}) {
      const Scene scene =
          lab.open_scene(degrees ? "slab-" + std::to_string(degrees) : std::string("slab"));
      compare(lab, findings, fmt::format("pane at {} degrees, {}", degrees, method),
              measured_mean(lab, scene, {method, 16, 16}, {64, 1, depth, MIS_BALANCE}),
              pane_transmission(degrees, 1.5), 1e-5);
    }
  for (const char* method : {"path", "bdpt", "sppm", "vcm"})
    compare(
        lab, findings, fmt::format("pane at 89 degrees, {}", method),
        measured_mean(lab, pane_seen_at(lab, 89), {method, 16, 16}, {64, 1, depth, MIS_BALANCE}),
        pane_transmission(89, 1.5), 1e-4);
  for (double ior : {1.0, 1.00005, 0.99995}) {
    Scene scene = lab.open_scene("slab-80");
    scene.materials.at(0).ior = ior;
    const Picture picture =
        Renderer(lab, scene, {"path", 8, 8}).render({64, 1, depth, MIS_BALANCE});
    double worst = 0;
    for (const auto& p : picture.pixels) worst = std::max(worst, std::abs(p[0].mean - 1));
    findings.at_most(fmt::format("pane of index {}: relative error", ior), worst, 1e-4);
  }
  compare(lab, findings, "sky seen from inside a ball of glass",
          measured_mean(lab, lab.open_scene("inside-glass"), {"path", 16, 16}, {}), 2.25, 1e-5);
}

/// What the program says that a cap has cut off is what it has: albedo^depth, in the mean of all
/// channels, of camera paths. Light paths start as the walls glow, and end a segment earlier.
static void caps_tell_what_they_cut(const Lab& lab, Findings& findings, const Scene& scene,
                                    const Rgb& rho) {
  for (const std::string method : {"naive", "path", "bdpt", "sppm", "vcm"}) {
    Renderer renderer(lab, scene, {method, 16, 16});
    for (uint depth : {2u, 11u}) {
      const std::uint64_t spp = std::uint64_t(1024 * lab.effort);
      const auto found = measured_cuts(renderer, {spp, 1, depth, MIS_BALANCE});
      const std::string what = fmt::format("cut off by a cap of {}, {}", depth, method);
      double camera = 0, light = 0, glow = 0;
      for (int c = 0; c < 3; ++c) {
        camera += std::pow(rho[c], depth) / 3;
        light += std::pow(rho[c], depth - 1) * (1 - rho[c]);
        glow += 1 - rho[c];
      }
      if (method == "sppm")  // gathers at the first wall: no cap ends its eye paths
        findings.at_most(what + ", camera", found[CUT_camera].mean, 0);
      else
        compare(lab, findings, what + ", camera", found[CUT_camera], camera, 1e-5);
      if (find_integrator(method).walks_from_lights())
        compare(lab, findings, what + ", light", found[CUT_light], light / glow, 1e-5);
    }
  }
}

void long_paths_lose_nothing(const Lab& lab, Findings& findings) {
  const Rgb rho(0.5, 0.9, 0.99);
  Scene scene = lab.open_scene("furnace");
  for (Material& m : scene.materials) m.reflectance = rho;
  for (Shape& s : scene.shapes) s.emission->radiance = 1.0 - rho;
  // Of merging in a room of radius 1, whose walls fill its discs but for their square.
  constexpr double radius = 0.02, slack = 1e-5 + radius * radius;
  struct View {
    const char* method;
    std::vector<uint> depths;  ///< 0: no cap
  };
  // Light samples alone are too noisy where facets of a wall that glows meet. `reference` survives
  // 9 times of 10: beyond some tens of bounces its variance has no bound where walls absorb less.
  // Paths of 100 vertices that meet light paths as long are too many connections.
  for (const View& view :
       {View{"naive", {1, 2, 11, 101, 0}}, View{"path", {1, 11, 101, 0}},
        View{"reference", {1, 11}}, View{"bdpt", {1, 11}}, View{"sppm", {11}}, View{"vcm", {11}}})
    for (uint depth : view.depths) {
      const Sampling run{64, 1, depth ? std::optional<uint>(depth) : std::nullopt, MIS_BALANCE};
      const bool long_ones = depth == 0 || depth > 11;  // a hundred times the work
      const double resolution = long_ones ? 2 * usual_resolution : usual_resolution;
      Build build{view.method, 8, 8};
      const bool merges = find_integrator(view.method).uses(Bundle::grid);
      if (merges) build.light_paths = 1 << 12, build.radius = radius, build.radius_alpha = 1;
      const std::array<Estimate, 3> means = measured_means(lab, scene, build, run, resolution);
      for (int c = 0; c < 3; ++c)
        compare(
            lab, findings,
            fmt::format("walls of {}, {}, {}", rho[c],
                        depth ? fmt::format("up to {} segments", depth) : "no cap", view.method),
            means[std::size_t(c)], depth ? 1 - std::pow(rho[c], depth) : 1, merges ? slack : 1e-5,
            resolution);
    }
  caps_tell_what_they_cut(lab, findings, scene, rho);
  roulette_changes_no_mean(lab, findings);
}

}  // namespace pellucid::stability
