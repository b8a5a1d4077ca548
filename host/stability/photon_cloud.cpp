// The photon grid finds each photon once, whatever the extent of a scene (numerics 18).
//
// Two of the cells around a point may share a place in the hash table, and a cell's number may
// exceed what a float or an int holds. Searches compare the cell itself, whose coordinates are
// whole numbers counted from amid the scene; the sort is stable and without atomics. That costs
// three floors for every photon within the radius, and sorting as many keys in every pass.
#include "stability/photon_cloud.h"

#include <fmt/format.h>

#include "render/photon_grid.h"
#include "shared/limits.h"
#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

void search(Findings& findings, PhotonGrid& grid, const std::string& name, const Cloud& cloud) {
  const std::vector<U4> expected = brute_force(cloud);
  std::size_t wrong = 0, more = 0, found_in_all = 0;
  for (uint bits : {GRID_BITS_MIN, 10u, 16u, GRID_BITS_MAX}) {
    grid.set_photons(cloud.photons, cloud.radius, cloud.origin, bits);
    grid.build();
    const std::vector<U4> found = grid.find(cloud.queries);
    for (std::size_t k = 0; k < found.size(); ++k) {
      wrong += !same(found[k], expected[k]);
      more += found[k].x > expected[k].x;
      found_in_all += found[k].x;
    }
  }
  findings.none("searches that differ from trying all, " + name, wrong);
  findings.none("photons met twice, " + name, more);
  findings.require("there is something to find, " + name, found_in_all > 0);
}

}  // namespace

Cloud cloud_of(std::size_t n, double extent_in_radii, float radius, const F4& center,
               std::size_t queries) {
  CloudRandom random;
  Cloud cloud;
  cloud.radius = radius, cloud.origin = center;
  const auto half = float(0.5 * extent_in_radii * radius);
  constexpr std::size_t clump = 8;
  for (F4 at{}; cloud.photons.size() < n;) {
    if (cloud.photons.size() % clump == 0) at = random.in_box(center, half);
    cloud.photons.push_back(random.in_box(at, radius));
  }
  for (std::size_t k = 0; k < queries; ++k) {
    const F4 at = n ? cloud.photons[random.below(n)] : center;
    cloud.queries.push_back(k % 3 == 0 ? at : random.in_box(at, radius));
  }
  return cloud;
}

std::vector<U4> brute_force(const Cloud& cloud) {
  const std::size_t n = cloud.photons.size();
  std::vector<float> x(n), y(n), z(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = cloud.photons[i].x, y[i] = cloud.photons[i].y, z[i] = cloud.photons[i].z;
  const float radius2 = cloud.radius * cloud.radius;
  std::vector<U4> found;
  for (const F4& q : cloud.queries) {
    U4 sums{};
    for (uint i = 0; i < n; ++i) {
      const float dx = x[i] - q.x, dy = y[i] - q.y, dz = z[i] - q.z;
      const uint hit = dx * dx + dy * dy + dz * dz <= radius2;
      sums.x += hit, sums.y += hit * i, sums.z += hit * i * i, sums.w += hit * i * i * i;
    }
    found.push_back(sums);
  }
  return found;
}

void photons_are_found_once(const Lab& lab, Findings& findings) {
  PlanOptions options;
  options.kernel_dir = lab.kernel_dir;
  PhotonGrid grid(lab.device, options);
  const std::size_t queries = lab.count(10000);
  for (double extent : {1.0, 30.0, 1e3, 1e5, 1e7})
    search(findings, grid, fmt::format("extent of {:g} radii", extent),
           cloud_of(3001, extent, 0.003f, {0, 0, 0, 0}, queries));
  search(findings, grid, "1e6 from the origin",
         cloud_of(3001, 100, 0.07f, {1e6f, -1e6f, 1e6f, 0}, queries));
  search(findings, grid, "a scene of 1e-15",
         cloud_of(3001, 1e3, 1e-18f, {1e-15f, 0, 0, 0}, queries));
  search(findings, grid, "a scene of 1e14", cloud_of(3001, 1e3, 1e11f, {1e14f, 0, 0, 0}, queries));
  for (int axis = 0; axis < 3; ++axis) {
    Cloud cloud = cloud_of(3001, 50, 0.1f, {0, 1, 0, 0}, queries);
    for (std::vector<F4>* points : {&cloud.photons, &cloud.queries})
      for (F4& p : *points) (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = 0.7f;
    search(findings, grid, fmt::format("a plane across axis {}", axis), cloud);
  }
}

}  // namespace pellucid::stability
