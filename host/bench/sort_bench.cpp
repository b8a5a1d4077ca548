// Builds of the photon grid and sorts by the host, in turns.
#include "bench/sort_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <thread>
#include <utility>

#include "base/clock.h"
#include "render/photon_grid.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

/// Photons on the walls of a box with edges of 2.
std::vector<F4> photons_on_walls(std::size_t n) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<F4> photons(n);
  for (F4& p : photons) {
    const float u = uniform(engine), v = uniform(engine);
    const auto wall = engine() % 6;
    const float w = wall < 3 ? -1.0f : 1.0f;
    p = wall % 3 == 0 ? F4{w, u, v, 0} : wall % 3 == 1 ? F4{u, w, v, 0} : F4{u, v, w, 0};
  }
  return photons;
}

/// The pairs as they were before the sort.
std::vector<GridPair> unsorted(const std::vector<GridPair>& pairs) {
  std::vector<GridPair> out(pairs.size());
  for (const GridPair& pair : pairs) out[pair.place] = pair;
  return out;
}

void radix_sort(std::vector<GridPair>& pairs, std::vector<GridPair>& other) {
  constexpr uint bits = 11, digits = 1u << bits;
  for (uint shift = 0; shift < GRID_BITS_MAX; shift += bits) {
    std::array<uint, digits> place{};
    for (const GridPair& p : pairs) ++place[(p.bucket >> shift) & (digits - 1)];
    uint before = 0;
    for (uint& n : place) before += std::exchange(n, before);
    for (const GridPair& p : pairs) other[place[(p.bucket >> shift) & (digits - 1)]++] = p;
    pairs.swap(other);
  }
}

struct Contest {
  PhotonGrid& grid;
  Clock clock;
  int repeats;

  SortCell run(std::uint64_t n) const;
};

SortCell Contest::run(std::uint64_t n) const {
  uint bits = GRID_BITS_MIN;
  while (bits < GRID_BITS_MAX && std::uint64_t{1} << bits < n) ++bits;
  // As many photons within the radius as a render with its default radius finds: a few.
  const float radius = 3.0f / std::sqrt(float(n));
  grid.set_photons(photons_on_walls(n), radius, {}, bits);
  grid.build();  // code generation happens here
  const std::vector<GridPair> pairs = unsorted(grid.pairs());
  std::vector<GridPair> work, other(pairs.size());
  grid.take_times();
  const double million = 1e-6 * double(n);
  std::vector<double> whole, stable, radix, ratio_stable, ratio_radix;
  const Clock one_thread{true, 1};
  const auto time_grid = [&] { return clock([&] { return grid.build(); }); };
  const auto time_host = [&](auto&& sort) {
    work = pairs;
    return one_thread([&] { return sort(), 0.0; });
  };
  for (int i = -1; i < repeats; ++i) {  // the first round warms caches and is not counted
    const double first = time_grid();
    const double s = time_host([&] {
      std::stable_sort(work.begin(), work.end(),
                       [](const GridPair& a, const GridPair& b) { return a.bucket < b.bucket; });
    });
    const double r = time_host([&] { radix_sort(work, other); });
    const double near_own = 0.5 * (first + time_grid());
    if (i < 0) {
      grid.take_times();
      continue;
    }
    whole.push_back(million / near_own);
    stable.push_back(million / s), radix.push_back(million / r);
    ratio_stable.push_back(s / near_own), ratio_radix.push_back(r / near_own);
  }
  SortCell cell;
  cell.photons = n;
  cell.build = figure_of(whole);
  cell.stable_sort = figure_of(stable), cell.radix_sort = figure_of(radix);
  cell.ratio_stable = figure_of(ratio_stable), cell.ratio_radix = figure_of(ratio_radix);
  for (const auto& [pass, seconds] : grid.take_times())
    cell.passes.emplace_back(pass, seconds / (2 * repeats));
  return cell;
}

}  // namespace

std::vector<SortCell> bench_sorts(const Device& device, const SortBenchOptions& options) {
  const int cores = std::max(1u, std::thread::hardware_concurrency());
  PhotonGrid grid(device, options.plan);
  const Contest contest{grid, Clock{device.info().cpu, cores}, options.repeats};
  std::vector<SortCell> cells;
  for (std::uint64_t n : options.photons) {
    if (options.progress) options.progress(fmt::format("{} photons", n));
    cells.push_back(contest.run(n));
  }
  return cells;
}

}  // namespace pellucid
