// Scenes as they come from their files, all lengths in them times a power of two (numerics 10):
// parsing, generating, transforming, counting from the middle, warning and rendering have no length
// of their own.
//
// Naive code welds, drops or warns by constants in world units. Here all bounds are relative, and
// coordinates stay in double until they are placed and rounded once (scene/placement.cpp): twice
// the memory of positions while loading, nothing while rendering. The other half of case 10
// (exact.cpp) scales what is loaded already.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "base/error.h"
#include "scene/load.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"
#include "stability/temporary_file.h"

namespace pellucid::stability {
namespace {

/// Replaces <x> by x 2^k, and <<x>> by x 4^k: lengths and intensities (W/sr).
std::string with_lengths(const std::string& text, int k) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '<') {
      out += text[at++];
      continue;
    }
    const std::size_t power = text[at + 1] == '<' ? 2 : 1;
    const std::size_t end = text.find('>', at);
    const double value = std::stod(text.substr(at + power, end - at - power));
    out += fmt::format("{:.17g}", std::ldexp(value, int(power) * k));
    at = end + power;
  }
  return out;
}

/// A lump as OBJ, with normals.
std::string lump_file() {
  std::string text;
  const Mesh mesh = lump(300);
  for (const glm::vec3& p : mesh.positions)
    text += fmt::format("v <{:.9g}> <{:.9g}> <{:.9g}>\n", p.x, p.y, p.z);
  for (const glm::vec3& p : mesh.positions) text += fmt::format("vn {} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles)
    text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

/// Every kind of shape and of light that has a size or a place, around (x, 0, 0). Lamps are dim,
/// for intensities may be no more than 1e15.
std::string scene_file(const std::string& model, double x) {
  const auto at = [x](double dx, double y, double z) {
    return fmt::format("[<{}>, <{}>, <{}>]", x + dx, y, z);
  };
  return fmt::format(
      R"({{"version": 1, "camera": {{"origin": {0}, "target": {1}, "fov": 60}},
"materials": {{"white": {{"type": "diffuse"}}, "glass": {{"type": "dielectric"}},
  "gold": {{"type": "conductor", "metal": "gold", "alpha": 0.25}}}},
"shapes": [
  {{"type": "mesh", "file": "{2}", "material": "gold", "smooth": true, "transform": [{{"scale": 0.5}},
    {{"rotate": {{"axis": [1, 2, 3], "degrees": 30}}}}, {{"translate": {3}}}]}},
  {{"type": "displaced-sphere", "material": "white", "triangles": 1000, "radius": <0.5>,
    "transform": [{{"translate": {4}}}]}},
  {{"type": "sphere", "material": "glass", "center": {5}, "radius": <0.5>}},
  {{"type": "cube", "material": "white", "center": {6}, "size": [<6>, <0.5>, <6>]}},
  {{"type": "rectangle", "material": "white", "corner": {7}, "edges": [[<6>, 0, 0], [0, <4>, 0]]}},
  {{"type": "disk", "material": "white", "center": {8}, "normal": [0, -1, 0], "radius": <0.5>,
    "emission": {{"radiance": 0.002}}}}],
"lights": [{{"type": "point", "position": {9}, "intensity": <<0.0005>>}},
  {{"type": "spot", "position": {10}, "target": {1}, "intensity": <<0.0005>>, "angle": 40}}]}})",
      at(0, 0.5, 5), at(0, 0, 0), model, at(-1, 0, 0), at(1.25, 0, -0.5), at(0.25, -0.25, 1.25),
      at(0, -1.25, 0), at(-3, -1, -2), at(0, 2, 0), at(-1.5, 1.5, 1.5), at(2, 2, 2));
}

/// Nothing where loading refuses it.
std::optional<Scene> loaded(double x, int k) {
  const TemporaryFile model(".obj"), scene(".json");
  std::ofstream(model.path) << with_lengths(lump_file(), k);
  const std::string name = std::filesystem::path(model.path).filename().string();
  std::ofstream(scene.path) << with_lengths(scene_file(name, x), k);
  try {
    return load_scene(scene.path);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

void files_have_no_scale(const Lab& lab, Findings& findings) {
  // From `far` on a scene 6 wide is counted from its middle, and a note says so. Files hold
  // coordinates up to 1e11.
  constexpr double far = 1280;
  for (double x : {0.0, far}) {
    const char* place = x > 0 ? "far from 0" : "about 0";
    const std::size_t notes = x > 0 ? 1 : 0;
    std::vector<Film> films;
    for (int k : {0, -30, x > 0 ? 26 : 30}) {
      const std::optional<Scene> scene = loaded(x, k);
      findings.require(
          fmt::format("a file {}, lengths times 2^{}: {} notes, no warning", place, k, notes),
          scene && scene->warnings.empty() && scene->notes.size() == notes);
      if (!scene) break;
      for (const char* method : {"path", "bdpt"}) {
        const Picture picture = session_render(lab, *scene, build_of(method), short_run);
        if (k == 0) {
          films.push_back(picture.film);
          findings.require(fmt::format("a file {} is lit, {}", place, method),
                           picture.image(0).mean > 0);
          continue;
        }
        findings.none(
            fmt::format("pixels that differ, a file {}, lengths times 2^{}, {}", place, k, method),
            different_pixels(films[method == std::string("path") ? 0 : 1], picture.film));
      }
    }
  }
}

}  // namespace pellucid::stability
