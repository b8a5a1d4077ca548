// Faces that lie in one plane (numerics 27): of duplicates the lowest id is hit, in any tree, and a
// light panel a few ulps below a ceiling lights the floor as if there were none.
//
// Equal distances go to the lowest id, which costs one comparison per hit. But distances to two
// triangles of one plane differ by their rounding: a light that lies on another surface is hit or
// not, `path` loses 22 % of it. Loading warns of that (scene/coplanar.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/coplanar.h"
#include "stability/estimates.h"
#include "stability/exact.h"
#include "stability/measurements.h"
#include "stability/small_scenes.h"

namespace pellucid::stability {
namespace {

/// CF4's floor with a black ceiling so many ulps above its light, before or behind it in the list.
Scene under_ceiling(const Scene& plain, int ulps, bool first) {
  Scene scene = plain;
  const auto y = float(1 + ulps * 0x1p-23);
  Mesh ceiling;
  ceiling.positions = {{-5, y, -5}, {5, y, -5}, {5, y, 5}, {-5, y, 5}};
  ceiling.triangles = {{0, 1, 2}, {0, 2, 3}};
  Material black;
  black.reflectance = Rgb(0.0);
  scene.materials.push_back(black);
  Shape& shape = add_shape(scene, std::move(ceiling));
  shape.material = int(scene.materials.size() - 1);
  if (first) std::rotate(scene.shapes.begin(), scene.shapes.end() - 1, scene.shapes.end());
  return scene;
}

Film film_of(const Lab& lab, const Scene& scene, const char* method) {
  return session_render(lab, scene, build_of(method), short_run).film;
}

/// Every face that gives no light, twice.
Scene doubled(Scene scene) {
  for (Shape& shape : scene.shapes) {
    Mesh* mesh = std::get_if<Mesh>(&shape.geometry);
    if (!mesh || shape.emission) continue;
    const std::vector<glm::uvec3> once = mesh->triangles;
    mesh->triangles.insert(mesh->triangles.end(), once.begin(), once.end());
  }
  return scene;
}

void measure_doubles(const Lab& lab, Findings& findings) {
  const Scene scene = lab.open_scene("equal-shading");
  for (const char* method : {"path", "light", "bdpt", "vcm"}) {
    findings.none(
        fmt::format("pixels that differ with all faces twice, {}", method),
        different_pixels(film_of(lab, scene, method), film_of(lab, doubled(scene), method)));
  }
}

/// The same shapes and triangles in another order. Of faces in one plane the first listed is hit,
/// so that such a picture may change with it where they differ in what is seen: here a lamp's
/// underside and the floor it stands on, which nobody sees. Lights are picked by other numbers, so
/// that it is means that stay.
Scene reordered(Scene scene, Random& random) {
  const auto shuffle = [&](auto& list) {
    for (std::size_t i = list.size(); i > 1; --i)
      std::swap(list[i - 1], list[random.below(unsigned(i))]);
  };
  for (Shape& shape : scene.shapes)
    if (Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) shuffle(mesh->triangles);
  shuffle(scene.shapes);
  return scene;
}

void measure_order(const Lab& lab, Findings& findings) {
  const Scene scene = lab.open_scene("equal-lights");
  Random random(27);
  for (const char* method : {"path", "bdpt"}) {
    constexpr double each = 0.8 * usual_resolution;  // their difference is noisier by the root of 2
    const Build build{method, 16, 16};
    const auto listed = measured_means(lab, scene, build, {}, each);
    for (std::uint64_t k : {1, 2})
      compare_means(
          lab, findings, fmt::format("triangles in order {}, {}", k, method),
          measured_means(lab, reordered(scene, random), build, {64, 1 + k, {}, MIS_BALANCE}, each),
          listed);
  }
}

constexpr const char* seeing[] = {"naive", "nee", "path", "bdpt"};

/// A panel below a ceiling: the user is warned of it, or it lights the floor to the last bit as if
/// there were no ceiling. Nearer than 16 roundoffs of the ceiling's coordinates, which reach to 5,
/// that is 40 ulps of its height, either may be hit.
void measure_panel(const Lab& lab, const Scene& plain, Findings& findings) {
  constexpr int ties = 4, clear = 41;  // ulps that must be warned of, and that must not
  std::vector<Film> films;
  for (const char* method : seeing) {
    films.push_back(film_of(lab, plain, method));
    compare(lab, findings, fmt::format("panel without a ceiling, {}", method),
            measured_means(lab, plain, {method, 16, 16}, {}, 2 * usual_resolution)[0], 0.554126,
            1e-5, 2 * usual_resolution);
  }
  for (bool first : {true, false})
    for (int ulps : {0, 1, 2, ties, 8, 16, 32, 39, clear, 64}) {
      const Scene scene = under_ceiling(plain, ulps, first);
      const std::string what =
          fmt::format("{} ulps below a ceiling listed {}", ulps, first ? "first" : "last");
      const bool warned = !coplanar_warning(scene).empty();
      if (ulps <= ties) findings.require("a warning of a panel " + what, warned);
      if (ulps >= clear) findings.require("no warning of a panel " + what, !warned);
      if (warned) continue;
      for (std::size_t i = 0; i < films.size(); ++i)
        findings.none(fmt::format("pixels that differ by a panel {}, {}", what, seeing[i]),
                      different_pixels(films[i], film_of(lab, scene, seeing[i])));
    }
}

}  // namespace

void coplanar_faces_do_no_harm(const Lab& lab, Findings& findings) {
  lowest_of_duplicates_wins(lab, findings, {});
  measure_doubles(lab, findings);
  measure_order(lab, findings);
  const Scene plain = lab.open_scene("rectangle-light");
  measure_panel(lab, plain, findings);
  findings.warning = coplanar_warning(under_ceiling(plain, 0, true));
  // A lamp that stands on the floor is none of that.
  findings.require("no warning of a lamp on a floor",
                   coplanar_warning(lab.open_scene("equal-lights")).empty());
}

}  // namespace pellucid::stability
