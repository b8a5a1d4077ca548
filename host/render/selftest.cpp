// The layout probe and the tiny render of `devices --selftest`.
#include "render/selftest.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

#include "render/session.h"
#include "shared/probe.h"

namespace pellucid {
namespace {

struct Expectation {
  const char* what;
  uint value;
};

std::vector<Expectation> host_layout() {
#define PELLUCID_SIZE(T) {"sizeof(" #T ")", uint(sizeof(::T))},
#define PELLUCID_FIELD(T, field) {"offsetof(" #T ", " #field ")", uint(offsetof(::T, field))},
  return {LAYOUT_STRUCTS(PELLUCID_SIZE) LAYOUT_FIELDS(PELLUCID_FIELD)};
#undef PELLUCID_SIZE
#undef PELLUCID_FIELD
}

Scene emitting_sphere(double radiance, double reflectance) {
  Scene scene;
  scene.settings.width = scene.settings.height = 8;
  Material white;
  white.reflectance = Rgb(reflectance);
  scene.materials.push_back(white);
  Shape sphere;
  sphere.emission = Emission{Rgb(radiance), 2};
  sphere.geometry = Sphere{};
  scene.shapes.push_back(sphere);
  scene.camera.origin = {0.25, 0.0, 0.0};
  return scene;
}

}  // namespace

std::vector<std::string> probe_layout(Device& device) {
  const std::vector<Expectation> expected = host_layout();
  const std::string source = KernelFiles().expand("passes/probe_layout.cl", "");
  Kernel kernel = device.build("probe_layout", source, "-cl-std=CL1.2 -cl-kernel-arg-info");
  std::vector<uint> found(expected.size());
  const Buffer out = device.create_buffer("probe", found.size() * sizeof(uint));
  kernel.set_buffer(0, out);
  device.launch(kernel, 1, 1, nullptr);
  device.finish();
  device.read(out, found.data(), found.size() * sizeof(uint));
  std::vector<std::string> differences;
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (found[i] != expected[i].value)
      differences.push_back(fmt::format("{} is {} on the host and {} on the device",
                                        expected[i].what, expected[i].value, found[i]));
  return differences;
}

SelfTestRender selftest_render(const Device& device, const Integrator& integrator) {
  constexpr double radiance = 1.0, reflectance = 0.5;
  const Scene scene = emitting_sphere(radiance, reflectance);
  const PackedScene packed = pack_scene(scene, {simd_width_for(device.info())});
  RenderOptions options;
  options.width = scene.settings.width;
  options.height = scene.settings.height;
  options.passes = PassRange{0, 256};
  options.plan.sampler = Sampler::random;  // independent samples tell their own error best
  Session session(device, packed, integrator, options);
  session.run({});
  const Image image = film_image(session.film(), true, false);
  SelfTestRender result;
  result.expected = radiance / (1.0 - reflectance);
  double variance = 0;
  const std::size_t pixels = options.window().pixels();
  for (std::size_t i = 0; i < pixels; ++i) {
    result.mean += image.data[6 * i] / double(pixels);  // grey: one channel tells all
    variance += image.data[6 * i + 3] / double(pixels * pixels);
  }
  result.standard_error = std::sqrt(variance);
  // The sums themselves are good to a few units of float roundoff.
  const double tolerance = 5 * result.standard_error + 1e-6 * result.expected;
  result.passed =
      error_count(session.counters()) == 0 && std::abs(result.mean - result.expected) <= tolerance;
  return result;
}

}  // namespace pellucid
