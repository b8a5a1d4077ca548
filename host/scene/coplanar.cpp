// Lights against all other surfaces, triangle by triangle where their boxes meet.
#include "scene/coplanar.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace pellucid {
namespace {

/// Surfaces nearer than this many roundoffs of their coordinates are hit in either order: at 4, as
/// many as a few of a thousand rays still went astray (stability case coplanar).
constexpr double tie = 16 * 0x1p-24;

/// Of a light that is looked at: panels and boxes. Round ones touch a plane in no more than a line.
constexpr std::size_t most_faces = 64;

using Flat = std::array<glm::dvec3, 3>;

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high = -low;
  void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
  /// Largest |coordinate|; 0 of an empty box.
  double reach() const {
    const glm::dvec3 far = glm::max(glm::abs(low), glm::abs(high));
    return low.x <= high.x ? std::max({far.x, far.y, far.z}) : 0;
  }
  bool meets(const Box& o, double margin) const {
    return glm::all(glm::lessThanEqual(low, o.high + margin)) &&
           glm::all(glm::lessThanEqual(o.low, high + margin));
  }
};

glm::dvec3 normal_of(const Flat& f) {
  return glm::normalize(glm::cross(f[1] - f[0], f[2] - f[0]));
}

Box box_of(const Shape& shape) {
  Box box;
  if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    for (const glm::vec3& p : mesh->positions) box.add(p);
  } else if (const Disk* disk = std::get_if<Disk>(&shape.geometry)) {
    box.add(disk->center - disk->radius), box.add(disk->center + disk->radius);
  }
  return box;  // a sphere is never flat
}

/// Its triangles within `box`, a disk as the square around it; none of a sphere.
std::vector<Flat> flats_in(const Box& box, double margin, const Shape& shape) {
  std::vector<Flat> flats;
  const auto add = [&](const Flat& f) {
    Box own;
    for (const glm::dvec3& p : f) own.add(p);
    if (own.meets(box, margin)) flats.push_back(f);
  };
  if (const Mesh* mesh = std::get_if<Mesh>(&shape.geometry)) {
    for (const glm::uvec3& t : mesh->triangles)
      add({mesh->positions[t.x], mesh->positions[t.y], mesh->positions[t.z]});
  } else if (const Disk* disk = std::get_if<Disk>(&shape.geometry)) {
    const glm::dvec3 u = disk->radius * disk->u_axis;
    const glm::dvec3 v = disk->radius * glm::cross(disk->normal, disk->u_axis);
    const glm::dvec3 c = disk->center;
    add({c - u - v, c + u - v, c + u + v}), add({c - u - v, c + u + v, c - u + v});
  }
  return flats;
}

bool in_plane(const Flat& f, const glm::dvec3& p, const glm::dvec3& n, double margin) {
  return std::all_of(f.begin(), f.end(),
                     [&](const glm::dvec3& q) { return std::abs(glm::dot(q - p, n)) <= margin; });
}

/// Whether two triangles in one plane share more than a border, by separating edges.
bool overlap(const Flat& a, const Flat& b, const glm::dvec3& n) {
  for (const auto* pair : {&a, &b})
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 edge = (*pair)[(i + 1) % 3] - (*pair)[i];
      const glm::dvec3 across = glm::cross(n, edge);
      double low[2], high[2];
      for (int k : {0, 1}) {
        const Flat& f = k ? b : a;
        const double x = glm::dot(f[0], across), y = glm::dot(f[1], across);
        const double z = glm::dot(f[2], across);
        low[k] = std::min({x, y, z}), high[k] = std::max({x, y, z});
      }
      constexpr double touching = 1e-6;  // of the smaller one's width
      const double width = std::min(high[0] - low[0], high[1] - low[1]);
      if (std::min(high[0], high[1]) - std::max(low[0], low[1]) <= touching * width) return false;
    }
  return true;
}

/// Whether a face of a light lies on one of another surface. A solid lamp may stand on a floor:
/// where its face shines into what it touches, nobody sees either.
bool lies_on(const std::vector<Flat>& light, const std::vector<Flat>& other, double margin) {
  const auto in_first = [&](const Flat& g) {
    return in_plane(g, light[0][0], normal_of(light[0]), margin);
  };
  const bool panel = std::all_of(light.begin(), light.end(), in_first);
  for (const Flat& f : light) {
    const glm::dvec3 n = normal_of(f);
    for (const Flat& g : other)
      if (in_plane(g, f[0], n, margin) && (panel || glm::dot(normal_of(g), n) > 0) &&
          overlap(f, g, n))
        return true;
  }
  return false;
}

}  // namespace

std::string coplanar_warning(const Scene& scene) {
  std::vector<Box> boxes;
  for (const Shape& shape : scene.shapes) boxes.push_back(box_of(shape));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!scene.shapes[i].emission) continue;
    const std::vector<Flat> light = flats_in(boxes[i], 0, scene.shapes[i]);
    if (light.empty() || light.size() > most_faces) continue;
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      const double margin = tie * std::max(boxes[i].reach(), boxes[j].reach());
      if (i == j || !boxes[i].meets(boxes[j], margin)) continue;
      if (lies_on(light, flats_in(boxes[i], margin, scene.shapes[j]), margin))
        return fmt::format(
            "the light {} lies on {}, in one plane: which of the two is hit is left to rounding, "
            "and methods differ in its brightness; move it off by {:.1g} or more",
            scene.shapes[i].name, scene.shapes[j].name, margin);
    }
  }
  return "";
}

}  // namespace pellucid
