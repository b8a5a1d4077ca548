// Why two pictures are not equally bright (numerics 25): faults that renderers differ by are
// planted in a Cornell box, and explain::explain() must name each, from the picture alone as if it
// came from another program, and from its layers by path length where there are some.
//
// The lamp hangs below the ceiling, so that its back has something to light, and walls are whiter
// than measured, so that long paths matter. What it costs is one picture with layers: 24 bytes per
// pixel and length on the device.
#include "explain/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "integrators/registry.h"
#include "render/layers.h"
#include "stability/measurements.h"
#include "stability/renderer.h"

namespace pellucid::stability {
namespace {

constexpr int side = 64;

Scene box(const Lab& lab) {
  constexpr double whiter = 1.1, hung = 30;
  Scene scene = lab.open_scene("cornell-box");
  for (Material& m : scene.materials) m.reflectance *= whiter;
  for (Shape& shape : scene.shapes)
    if (shape.emission)
      for (glm::vec3& p : std::get<Mesh>(shape.geometry).positions) p.y -= float(hung);
  scene.settings.width = scene.settings.height = side;
  scene.settings.filter = PixelFilter::box;
  return scene;
}

/// With layers by path length.
Image picture(const Lab& lab, const Scene& scene, std::uint64_t seed, std::size_t spp,
              std::optional<uint> max_depth = {}) {
  constexpr uint longest = 14;
  const PackedScene packed = pack_scene(scene, {simd_width_for(lab.device.info())});
  RenderOptions options;
  options.width = options.height = side;
  options.passes = PassRange{0, lab.count(spp)};
  options.seed = seed;
  options.max_depth = max_depth;
  options.plan.kernel_dir = lab.kernel_dir;
  Session session(lab.device, packed, with_layers(find_integrator("path"), LAYERS_LENGTH, longest),
                  options);
  session.run({});
  return film_image(session.film(), false, false);
}

Image without_layers(const Image& image) {
  Image bare;
  bare.width = image.width, bare.height = image.height;
  bare.channels = {"R", "G", "B"};
  const std::size_t stride = image.channels.size();
  for (std::size_t i = 0; i < image.data.size(); i += stride)
    bare.data.insert(bare.data.end(), {image.data[i], image.data[i + 1], image.data[i + 2]});
  return bare;
}

/// No sample above `most`: the mean of pictures of one sample per pixel.
Image clamped_picture(const Lab& lab, const Scene& scene, float most, std::size_t spp) {
  Renderer renderer(lab, scene, {"path", side, side});
  Image sum;
  sum.width = sum.height = side;
  sum.channels = {"R", "G", "B"};
  sum.data.assign(std::size_t(side) * side * 3, 0.0f);
  const auto n = lab.count(spp);
  for (std::size_t k = 0; k < n; ++k) {
    const Image one = without_layers(
        film_image(renderer.render({1, 1000 + k, {}, MIS_BALANCE}).film, false, false));
    for (std::size_t i = 0; i < sum.data.size(); ++i)
      sum.data[i] += std::min(one.data[i], most) / float(n);
  }
  return sum;
}

void judge(Findings& findings, const Image& known, const Image& other, const std::string& fault,
           const std::string& cause) {
  const explain::Layered a(known), b(other);
  const explain::Explanation x = explain::explain(a, b, {"A", "B"}, b.layers() > 0);
  const bool named = cause.empty() ? x.finding == explain::Finding::none
                                   : (x.finding == explain::Finding::cause ||
                                      x.finding == explain::Finding::several) &&
                                         x.causes.front().cause.id == cause;
  findings.require(
      fmt::format("{}{} is named{}", fault, b.layers() ? ", with layers," : "",
                  named ? "" : ": " + std::string(finding_name(x.finding)) + ", " + x.words),
      named);
}

}  // namespace

void faults_are_named(const Lab& lab, Findings& findings) {
  // Enough for light beyond 10 segments to show in the sum of all lengths.
  constexpr std::size_t many = 1024, some = 256;
  const Scene scene = box(lab);
  const Image known = picture(lab, scene, 1, many);
  const auto judge_both = [&](const Image& other, const char* fault, const char* cause) {
    judge(findings, known, other, fault, cause);
    judge(findings, known, without_layers(other), fault, cause);
  };
  judge_both(picture(lab, scene, 2, some), "no fault", "");
  Scene whiter = scene, two_sided = scene;
  for (Material& m : whiter.materials) m.reflectance *= 1.02;
  judge_both(picture(lab, whiter, 2, some), "albedo + 2 %", "albedo");
  judge_both(picture(lab, scene, 2, many, 10), "a depth cap of 10", "depth-cap");
  for (Shape& shape : two_sided.shapes)
    if (shape.emission) shape.emission->sides = 2;
  judge_both(picture(lab, two_sided, 2, some), "a light that shines on both sides", "sidedness");
  judge(findings, known, clamped_picture(lab, scene, 10, some), "a clamp at 10", "clamp");
}

}  // namespace pellucid::stability
