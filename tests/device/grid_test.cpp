// The photon grid: what a search finds is what is there, each photon once, at every scale and
// place; its sort is a stable one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "render/photon_grid.h"
#include "shared/limits.h"
#include "stability/photon_cloud.h"
#include "support/kernel_folder.h"

#define PELLUCID_REAL float
#define PELLUCID_REAL_IS_FLOAT 1
namespace twin {
#include "transport/grid.h"
}

namespace pellucid {
namespace {

using namespace stability;

PhotonGrid make_grid(std::size_t group = 0) {
  PlanOptions options;
  options.group = group;
  options.kernel_dir = test::kernel_folder();
  return {Device::open(""), options};
}

void build(PhotonGrid& grid, const Cloud& cloud, uint bits) {
  grid.set_photons(cloud.photons, cloud.radius, cloud.origin, bits);
  grid.build();
}

/// The photons in the order that a stable sort gives them.
void expect_sorted(PhotonGrid& grid, const Cloud& cloud) {
  std::vector<GridPair> expected;
  for (const F4& p : cloud.photons) {
    const twin::GridCell cell = twin::grid_cell(grid.launch(), twin::load3(p));
    expected.push_back({twin::grid_bucket(grid.launch(), cell), uint(expected.size())});
  }
  std::stable_sort(expected.begin(), expected.end(),
                   [](const GridPair& a, const GridPair& b) { return a.bucket < b.bucket; });
  const std::vector<GridPair> pairs = grid.pairs();
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ASSERT_EQ(pairs[i].bucket, expected[i].bucket) << i;
    ASSERT_EQ(pairs[i].place, expected[i].place) << i;
  }
}

/// Searches in tables of all these sizes against brute force; returns the mean number found.
double expect_found(const Cloud& cloud,
                    const std::vector<uint>& table_bits = {GRID_BITS_MIN, 16, GRID_BITS_MAX}) {
  static PhotonGrid grid = make_grid();
  const std::vector<U4> expected = brute_force(cloud);
  for (uint bits : table_bits) {
    build(grid, cloud, bits);
    expect_sorted(grid, cloud);
    const std::vector<U4> found = grid.find(cloud.queries);
    for (std::size_t k = 0; k < found.size(); ++k)
      if (!same(found[k], expected[k])) {
        ADD_FAILURE() << "table of 2^" << bits << ", query " << k << ": " << found[k].x
                      << " found of " << expected[k].x;
        break;
      }
  }
  double sum = 0;
  for (const U4& e : expected) sum += e.x;
  return sum / double(expected.size());
}

TEST(GridTest, TablesOfAllSizes) {
  std::vector<uint> bits;
  for (uint b = GRID_BITS_MIN; b <= GRID_BITS_MAX; ++b) bits.push_back(b);
  EXPECT_GT(expect_found(cloud_of(5003, 30, 0.01f, {1, 2, 3, 0}), bits), 1.0);
}

TEST(GridTest, ExtentsUpToTenMillionRadii) {
  for (double extent : {1.0, 1e3, 1e5, 1e6, 1e7})
    EXPECT_GT(expect_found(cloud_of(3001, extent, 0.003f, {0, 0, 0, 0})), 1.0) << extent;
}

TEST(GridTest, PlacesFarFromZero) {
  // A float at 1e6 steps by 1/16: radii of many steps, and of one.
  for (float radius : {30.0f, 1.0f, 0.07f})
    EXPECT_GT(expect_found(cloud_of(3001, 100, radius, {1e6f, -1e6f, 1e6f, 0})), 1.0) << radius;
  // Cells count from far away, up to 2^29 of them.
  for (float radius : {1.0f, 1e-3f}) {
    Cloud cloud = cloud_of(3001, 100, radius, {0, 0, 0, 0});
    cloud.origin = {1e6f, -1e6f, 1e6f, 0};
    EXPECT_GT(expect_found(cloud), 1.0) << radius;
  }
}

TEST(GridTest, TinyAndHugeScenes) {
  for (float size : {1e-15f, 1e9f, 1e14f})
    EXPECT_GT(expect_found(cloud_of(3001, 1e3, 1e-3f * size, {size, 0, 0, 0})), 1.0) << size;
  EXPECT_GT(expect_found(cloud_of(3001, 1e3, MERGE_RADIUS_MIN, {0, 0, 0, 0})), 1.0);
}

TEST(GridTest, FlatClouds) {
  for (int axis = 0; axis < 3; ++axis) {
    Cloud cloud = cloud_of(3001, 50, 0.1f, {0, 1, 0, 0});
    for (F4& p : cloud.photons) (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = 0.7f;
    for (F4& q : cloud.queries) (axis == 0 ? q.x : axis == 1 ? q.y : q.z) = 0.7f;
    EXPECT_GT(expect_found(cloud), 1.0) << axis;
  }
}

/// Photons and queries on a lattice of a quarter of the radius, where cells have their borders:
/// many distances are exactly the radius, and others one bit beside it.
TEST(GridTest, PhotonsAtExactlyTheRadius) {
  CloudRandom random;
  for (float radius : {0.25f, 0.1f}) {
    Cloud cloud;
    cloud.radius = radius;
    const auto on_lattice = [&] {
      F4 p = random.in_box({0, 0, 0, 0}, 16);
      for (float* x : {&p.x, &p.y, &p.z}) {
        *x = std::round(*x) * (radius / 4);
        if (random.below(4) == 0) *x = std::nextafter(*x, float(random.below(3)) - 1);
      }
      return p;
    };
    for (std::size_t i = 0; i < 3001; ++i) cloud.photons.push_back(on_lattice());
    for (std::size_t k = 0; k < 10000; ++k) cloud.queries.push_back(on_lattice());
    EXPECT_GT(expect_found(cloud), 1.0);
  }
}

TEST(GridTest, Crowds) {
  EXPECT_GT(expect_found(cloud_of(3001, 0.3, 1.0f, {0.5f, 0.5f, 0.5f, 0})), 100.0) << "one cell";
  Cloud point = cloud_of(3001, 1, 1.0f, {0, 0, 0, 0});
  for (F4& p : point.photons) p = point.photons.front();
  EXPECT_GT(expect_found(point), 100.0);
  EXPECT_GT(expect_found(cloud_of(100003, 100, 1.0f, {0, 0, 0, 0}, 2000), {17}), 1.0);
}

// Also run by oclgrind_test.py.
TEST(GridTest, FewPhotons) {
  for (std::size_t n : {0u, 1u, 5u, SORT_BLOCKS - 1, SORT_BLOCKS, SORT_BLOCKS + 1, 1000u})
    EXPECT_EQ(expect_found(cloud_of(n, 10, 1.0f, {0, 0, 0, 0}, 1000), {6}) > 0, n > 0) << n;
}

TEST(GridTest, SameBitsForAnyGroup) {
  const Cloud cloud = cloud_of(20011, 30, 0.01f, {1, 2, 3, 0});
  std::vector<U4> first;
  for (std::size_t group : {std::size_t{1}, std::size_t{7}, std::size_t{64}}) {
    PhotonGrid grid = make_grid(group);
    build(grid, cloud, 12);
    expect_sorted(grid, cloud);
    const std::vector<U4> found = grid.find(cloud.queries);
    if (first.empty()) first = found;
    EXPECT_TRUE(std::equal(first.begin(), first.end(), found.begin(), same)) << group;
  }
}

}  // namespace
}  // namespace pellucid
