// How an iteration goes over slices of its tile: light paths, eye paths, connections; and what
// happens where their vertices need more room than there is.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/text.h"
#include "render/plan.h"
#include "shared/pairing.h"

namespace pellucid {
namespace {

struct PathRange {
  uint first = 0, end = 0;
};

/// Light paths that the pixels of the slice are paired with.
PathRange paired_paths(const Launch& launch) {
  const uint pixels = launch.width * launch.height;
  const uint row = launch.tile_y + launch.slice_first / launch.tile_width;
  const uint rows = launch.slice_count / launch.tile_width;
  const uint first = row * launch.width + launch.tile_x;
  const uint last = (row + rows - 1) * launch.width + launch.tile_x + launch.tile_width - 1;
  return {paired_light_path(first, pixels, launch.light_paths),
          paired_light_path(last, pixels, launch.light_paths) + 1};
}

}  // namespace

bool Plan::traces_side(const Pass& pass) const {
  return std::any_of(sides_.begin(), sides_.end(),
                     [&](const Side& side) { return side.trace == pass.name; });
}

/// Methods that store nothing: the tile is one slice, with all light paths.
void Plan::run_whole(Launch launch) {
  launch.slice_count = launch.tile_width * launch.tile_height;
  launch.path_count = launch.splat_end = launch.light_paths;
  for (PassState& state : passes_)
    if (state.pass.domain != Domain::tile) this->launch(state, launch);
}

/// Light paths that no slice is paired with: the camera sees them all the same.
void Plan::splat_paths(Launch launch, uint first, uint end) {
  const auto most = uint(sides_[0].paths);
  launch.store_first = launch.store_end = 0;
  for (; first < end; first += launch.path_count) {
    launch.path_first = launch.splat_first = first;
    launch.path_count = std::min(most, end - first);
    launch.splat_end = first + launch.path_count;
    this->launch(pass_named(sides_[0].trace), launch);
  }
}

void Plan::run_slices(Launch launch) {
  uint splatted = 0;  // light paths
  uint gathered = 0;  // pixels of the tile
  for (uint row = 0; row < launch.tile_height;) {
    const uint rows = std::min(slice_rows_, launch.tile_height - row);
    launch.slice_first = row * launch.tile_width;
    launch.slice_count = rows * launch.tile_width;
    const PathRange paths = paired_paths(launch);
    splat_paths(launch, splatted, paths.first);
    splatted = std::max(splatted, paths.first);
    launch.path_first = launch.store_first = paths.first;
    launch.path_count = paths.end - paths.first;
    launch.splat_end = launch.store_end = paths.end;
    launch.splat_first = splatted;
    launch.gather_first = gathered;
    launch.light_capacity = uint(sides_[0].capacity);
    launch.eye_capacity = uint(sides_[1].capacity);
    for (const Side& side : sides_) this->launch(pass_named(side.trace), launch);
    splatted = std::max(splatted, paths.end);
    gathered = std::max(gathered, launch.slice_first + launch.slice_count);
    if (!settle_vertices(launch)) {
      slice_rows_ = rows / 2;  // what was splatted and gathered stays; the rest is done again
      continue;
    }
    run_slice_passes(launch, false);
    row += rows;
  }
  splat_paths(launch, splatted, launch.light_paths);
}

/// Passes over slices that trace nothing: those before camera_trace, or those after it.
void Plan::run_slice_passes(const Launch& launch, bool light_stage) {
  bool before = true;
  for (PassState& state : passes_) {
    if (state.pass.name == sides_[1].trace) before = false;
    if (state.pass.domain != Domain::tile && !traces_side(state.pass) && before == light_stage)
      this->launch(state, launch);
  }
}

/// Methods that merge: all light paths and their grid first, then the slices.
void Plan::run_merging(Launch launch) {
  launch.path_count = launch.splat_end = launch.store_end = launch.light_paths;
  launch.light_capacity = uint(sides_[0].capacity);
  this->launch(pass_named(sides_[0].trace), launch);
  launch.photon_count = settle_light(launch);
  launch.light_capacity = uint(sides_[0].capacity);
  run_slice_passes(launch, true);
  launch.path_count = 0;  // scan and order leave the light's side alone
  for (uint row = 0; row < launch.tile_height;) {
    const uint rows = std::min(slice_rows_, launch.tile_height - row);
    launch.slice_first = row * launch.tile_width;
    launch.slice_count = rows * launch.tile_width;
    launch.eye_capacity = uint(sides_[1].capacity);
    this->launch(pass_named(sides_[1].trace), launch);
    launch.gather_first = std::max(launch.gather_first, launch.slice_first + launch.slice_count);
    if (!settle_vertices(launch)) {
      slice_rows_ = rows / 2;
      continue;
    }
    run_slice_passes(launch, false);
    row += rows;
  }
}

/// Waits for the vertices of all light paths, with room for them, and tells their number.
uint Plan::settle_light(Launch launch) {
  const uint count = take_vertex_counts()[0];
  if (count <= sides_[0].capacity) return count;
  if (!make_room({count, 0}))
    throw DeviceError(fmt::format(
        "the {} vertices of this iteration's light paths are merged all at once and need {}, more "
        "than is left of {} on {}; allow more with --memory, or try --vertices compact, "
        "--max-depth, or fewer --light-paths",
        count, format_bytes(count * sides_[0].bytes()), format_bytes(memory_limit_),
        device_.info().name));
  launch.splat_first = launch.splat_end = 0;
  launch.light_capacity = uint(sides_[0].capacity);
  this->launch(pass_named(sides_[0].trace), launch);
  return take_vertex_counts()[0];
}

/// Vertices that the traces asked room for since the last call, by side; waits for them.
std::array<uint, 2> Plan::take_vertex_counts() {
  std::array<uint, 2> counts{};
  const std::array<uint, 2> none{};
  Buffer& buffer = buffers_.at("vertex_counts");
  device_.read(buffer, counts.data(), sizeof counts);
  device_.write(buffer, none.data(), sizeof none);
  return counts;
}

/// Waits for the slice's vertices; where they did not all find room, makes it and traces again,
/// without what has been splatted and gathered already. False: the slice is too large.
bool Plan::settle_vertices(Launch launch) {
  std::array<uint, 2> counts = take_vertex_counts();
  if (merges_) counts[0] = uint(sides_[0].capacity);  // they stay where they are
  const std::array<std::size_t, 2> before{sides_[0].capacity, sides_[1].capacity};
  if (counts[0] <= before[0] && counts[1] <= before[1]) return true;
  if (!make_room(counts)) {
    if (launch.slice_count > launch.tile_width) return false;
    const std::uint64_t bytes = counts[0] * sides_[0].bytes() + counts[1] * sides_[1].bytes();
    throw DeviceError(fmt::format(
        "the vertices of one row of pixels need {}, more than is left of {} on {}; allow more "
        "with --memory, or try --vertices compact, --max-depth, or fewer --light-paths",
        format_bytes(bytes), format_bytes(memory_limit_), device_.info().name));
  }
  launch.splat_first = launch.splat_end = 0;
  launch.gather_first = NONE;
  launch.light_capacity = uint(sides_[0].capacity);
  launch.eye_capacity = uint(sides_[1].capacity);
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (sides_[i].capacity != before[i]) this->launch(pass_named(sides_[i].trace), launch);
  take_vertex_counts();
  return true;
}

/// Buffers for so many vertices, if they fit beside all others: with something to spare, or else
/// exactly, or else at the cost of what the other side has too much.
bool Plan::make_room(const std::array<uint, 2>& needed) {
  constexpr double spare = 1.25;  // iterations differ: growing anew in each would cost more
  std::uint64_t others = 0;
  for (const auto& [name, buffer] : buffers_) others += buffer.bytes();
  for (const Side& side : sides_) others -= side.capacity * side.bytes();
  std::array<std::size_t, 2> grown{}, exact{}, least{};
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const std::size_t has = sides_[i].capacity;
    least[i] = std::max<std::size_t>(needed[i], 1);
    exact[i] = std::max(has, least[i]);
    grown[i] = needed[i] > has ? std::size_t(double(needed[i]) * spare) : has;
  }
  for (const auto& capacity : {grown, exact, least}) {
    std::uint64_t all = others, largest = 0;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (capacity[i] >= NONE) all = memory_limit_ + 1;  // slots are 32-bit numbers
      all += capacity[i] * sides_[i].bytes();
      for (const auto& [name, each] : sides_[i].per_vertex)
        largest = std::max<std::uint64_t>(largest, capacity[i] * each);
    }
    if (all > memory_limit_ || largest > device_.info().max_buffer) continue;
    resize(capacity);
    return true;
  }
  return false;
}

void Plan::resize(const std::array<std::size_t, 2>& capacity) {
  const auto each = [&](auto&& act) {
    for (std::size_t i = 0; i < sides_.size(); ++i)
      if (sides_[i].capacity != capacity[i]) act(sides_[i], capacity[i]);
    for (PassState& state : passes_) bind(state);
  };
  each([&](Side& side, std::size_t) {  // lets go of the old ones first
    for (const auto& [name, bytes] : side.per_vertex) buffers_[name] = buffers_.at("vertex_counts");
  });
  each([&](Side& side, std::size_t n) {
    for (const auto& [name, bytes] : side.per_vertex)
      buffers_[name] = device_.create_buffer(name, n * bytes);
    side.capacity = n;
  });
}

}  // namespace pellucid
