// How an iteration goes over slices of its tile: light paths, eye paths, connections; and what
// happens where their vertices need more room than there is.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/text.h"
#include "render/plan.h"

namespace pellucid {
namespace {

struct PathRange {
  uint first = 0, end = 0;
};

/// Light paths that the pixels of the slice are paired with (kernels/transport/connect.h).
PathRange paired_paths(const Launch& launch) {
  const std::uint64_t width = launch.width, pixels = width * launch.height;
  const std::uint64_t row = launch.tile_y + launch.slice_first / launch.tile_width;
  const std::uint64_t rows = launch.slice_count / launch.tile_width;
  const std::uint64_t first = row * width + launch.tile_x;
  const std::uint64_t last = (row + rows - 1) * width + launch.tile_x + launch.tile_width - 1;
  return {uint(first * launch.light_paths / pixels), uint(last * launch.light_paths / pixels) + 1};
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
    this->launch(pass_named("light_trace"), launch);
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
    for (PassState& state : passes_)
      if (state.pass.domain != Domain::tile && !traces_side(state.pass))
        this->launch(state, launch);
    row += rows;
  }
  splat_paths(launch, splatted, launch.light_paths);
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

/// Waits for the slice's vertices; where they did not all find room, makes it and traces that side
/// again, without what has been splatted and gathered already. False: the slice is too large.
bool Plan::settle_vertices(Launch launch) {
  const std::array<uint, 2> counts = take_vertex_counts();
  launch.splat_first = launch.splat_end = 0;
  launch.gather_first = NONE;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    Side& side = sides_[i];
    if (counts[i] <= side.capacity) continue;
    if (!make_room(side, counts[i])) {
      if (launch.slice_count > launch.tile_width) return false;
      throw DeviceError(fmt::format(
          "the {} vertices of one row of pixels need {}, more than is left of {} on {}; allow more "
          "with --memory, or try --vertices compact, --max-depth, or fewer --light-paths",
          side.name, format_bytes(counts[i] * vertex_bytes(options_)), format_bytes(memory_limit_),
          device_.info().name));
    }
    launch.light_capacity = uint(sides_[0].capacity);
    launch.eye_capacity = uint(sides_[1].capacity);
    this->launch(pass_named(side.trace), launch);
    take_vertex_counts();
  }
  return true;
}

/// Larger buffers for a side, if they fit beside all others.
bool Plan::make_room(Side& side, std::size_t needed) {
  constexpr double spare = 1.25;  // iterations differ: growing anew in each would cost more
  const std::string vertices = side.name + "_vertices", order = side.name + "_order";
  std::uint64_t others = 0;
  for (const auto& [name, buffer] : buffers_)
    if (name != vertices && name != order) others += buffer.bytes();
  const auto fits = [&](std::size_t capacity) {
    const std::size_t bytes = capacity * vertex_bytes(options_);
    return bytes <= device_.info().max_buffer &&
           others + bytes + capacity * sizeof(uint) <= memory_limit_;
  };
  std::size_t capacity = std::size_t(double(needed) * spare);
  if (!fits(capacity)) capacity = needed;
  if (!fits(capacity)) return false;
  buffers_[vertices] = buffers_[order] = buffers_.at("vertex_counts");  // lets go of the old ones
  for (PassState& state : passes_) bind(state);
  buffers_[vertices] = device_.create_buffer(vertices, capacity * vertex_bytes(options_));
  buffers_[order] = device_.create_buffer(order, capacity * sizeof(uint));
  for (PassState& state : passes_) bind(state);
  side.capacity = capacity;
  return true;
}

}  // namespace pellucid
