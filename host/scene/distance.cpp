// Rounding of positions beside the size of what they make up.
#include "scene/distance.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/bounds.h"

namespace pellucid {
namespace {

/// What is rounded by more of its size differs in pictures that show it alone (stability case
/// far-away: 0.06 % at 1e4 sizes do not).
constexpr double visible = 0.01;

/// By how much of its size floats round what has these bounds, at most.
double rounding(const Bounds& b) {
  constexpr double roundoff = 0x1p-24;
  return b.size() > 0 ? roundoff * b.reach() / b.size() : 0;
}

std::string figures(const Bounds& b) {
  return fmt::format("{:.3g} wide and lies {:.3g} from", b.size(), b.reach());
}

bool is_float(const glm::dvec3& p) {
  return glm::dvec3(glm::vec3(p)) == p;
}

}  // namespace

std::string distance_warning(const Scene& scene) {
  std::string worst;
  double most = visible;
  for (const Shape& shape : scene.shapes) {
    const Bounds b = bounds_of(shape);
    if (!(rounding(b) > most)) continue;
    most = rounding(b);
    worst = fmt::format(
        "{} is {} where the scene's coordinates are counted from, so that they are rounded by up "
        "to "
        "{:.2g} % of its size; what lies far apart is better rendered as scenes of its own",
        shape.name, figures(b), 100 * most);
  }
  return worst;
}

std::string rounded_file_warning(const std::string& name, const RawMesh& mesh) {
  const Bounds b = bounds_of_points(mesh.positions);
  if (!(rounding(b) > visible) ||
      !std::all_of(mesh.positions.begin(), mesh.positions.end(), is_float))
    return "";
  return fmt::format(
      "{} is {} the origin of its file, which is written in floats: they round it by up to {:.2g} "
      "% of its size; write the file with the model nearer to its origin",
      name, figures(b), 100 * rounding(b));
}

}  // namespace pellucid
