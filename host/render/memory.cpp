// Sizes of buffers, and the largest tile that keeps all of them within the limits.
#include "render/memory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "render/plan.h"
#include "shared/buffers.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

std::uint64_t total(const std::map<std::string, std::size_t>& buffers) {
  std::uint64_t sum = 0;
  for (const auto& [name, bytes] : buffers) sum += bytes;
  return sum;
}

/// Why these buffers do not fit, or "".
std::string objection(const DeviceInfo& device, std::uint64_t limit, bool asked,
                      const std::map<std::string, std::size_t>& buffers) {
  for (const auto& [name, bytes] : buffers)
    if (bytes > device.max_buffer)
      return fmt::format("buffer '{}' needs {}, but one buffer on {} holds at most {}", name,
                         format_bytes(bytes), device.name, format_bytes(device.max_buffer));
  if (total(buffers) <= limit) return "";
  return fmt::format("this render needs {} of device memory, but {}", format_bytes(total(buffers)),
                     asked ? fmt::format("--memory allows {}", format_bytes(limit))
                           : fmt::format("{} has {}", device.name, format_bytes(limit)));
}

/// What the host can give: three quarters of its memory; the scene, pictures being written and
/// other programs need the rest.
std::uint64_t host_memory() {
  return std::uint64_t(sysconf(_SC_PHYS_PAGES)) / 4 * 3 * std::uint64_t(sysconf(_SC_PAGESIZE));
}

/// Buffers of one side's vertices.
void add_vertices(const Integrator& integrator, const PlanOptions& options, const std::string& side,
                  std::size_t paths, std::map<std::string, std::size_t>& bytes) {
  const std::size_t capacity = std::size_t(double(paths) * options.vertices_per_path) + 1;
  for (const auto& [name, each] : vertex_buffers(integrator, options, side))
    bytes[name] = capacity * each;
  bytes[side + "_last"] = paths * sizeof(uint);
  bytes[side + "_first"] = (paths + 1) * sizeof(uint);
}

void check_host(std::uint64_t film_bytes) {
  if (film_bytes > host_memory())
    throw DeviceError(
        fmt::format("the film of this picture (and its checkpoint, if asked for) needs {} of the "
                    "host's memory, of which {} may be used; render "
                    "parts of it with --crop, or a smaller --size",
                    format_bytes(film_bytes), format_bytes(host_memory())));
}

}  // namespace

std::uint64_t MemoryPlan::device_bytes() const {
  return total(buffers);
}

std::size_t MemoryPlan::tile_pixels() const {
  return tiles.front().pixels();  // the last one may be smaller
}

std::size_t slice_paths(const RenderOptions& options, std::size_t rows) {
  // A slice of a crop spans what lies between its rows, too.
  const double pixels = double(rows) * double(options.width);
  const double ratio =
      double(options.light_path_count()) / (double(options.width) * double(options.height));
  return std::size_t(pixels * ratio) + 2;
}

uint slice_rows(const Integrator& integrator, const RenderOptions& options, std::size_t tile_rows) {
  // Enough work for any device, and few enough vertices to stay near its caches.
  constexpr std::size_t enough = std::size_t{1} << 16;
  const std::size_t width = std::size_t(options.window().width);
  const bool all_at_once = integrator.uses(Bundle::grid);  // light paths are in no slice
  const std::size_t row = all_at_once ? width : std::max(width, slice_paths(options, 1));
  return uint(std::clamp<std::size_t>(enough / row, 1, std::max<std::size_t>(tile_rows, 1)));
}

std::map<std::string, std::size_t> vertex_buffers(const Integrator& integrator,
                                                  const PlanOptions& options,
                                                  const std::string& side) {
  std::map<std::string, std::size_t> bytes;
  bytes[side + "_vertices"] = options.compact_vertices ? sizeof(CompactVertex) : sizeof(PathVertex);
  bytes[side + "_order"] = sizeof(uint);
  if (side != "light" || !integrator.uses(Bundle::grid)) return bytes;
  bytes["photon_positions"] = sizeof(F4);
  bytes["photons"] = sizeof(Photon);
  bytes["grid_pairs"] = bytes["grid_sorted"] = 2 * sizeof(uint);
  return bytes;
}

uint grid_bits_for(const RenderOptions& options) {
  uint bits = GRID_BITS_MIN;
  while (bits < GRID_BITS_MAX && std::uint64_t{1} << bits < options.light_path_count()) ++bits;
  return bits;
}

std::map<std::string, std::size_t> buffer_sizes(const PackedScene& scene,
                                                const Integrator& integrator,
                                                const RenderOptions& options, std::size_t rows) {
  std::map<std::string, std::size_t> bytes;
  const std::size_t row_pixels = std::size_t(options.window().width);
  const std::size_t pixels = rows * row_pixels;
#define PELLUCID_SCENE_BYTES(T, name, meaning) bytes[#name] = bytes_of(scene.name);
  SCENE_BUFFERS(PELLUCID_SCENE_BYTES)
  FILTER_BUFFERS(PELLUCID_SCENE_BYTES)
#undef PELLUCID_SCENE_BYTES
  if (integrator.uses(Bundle::film)) {
    bytes["samples"] = pixels * sizeof(F4);
    bytes["film"] = pixels * sizeof(FilmPixel);
  }
  if (integrator.uses(Bundle::aov)) bytes["aovs"] = pixels * sizeof(AovPixel);
  bytes["diag"] = DIAG_WORDS * sizeof(uint);
  if (integrator.uses(Bundle::splat)) bytes["splats"] = pixels * SPLAT_WORDS * sizeof(uint);
  const std::size_t slice = slice_rows(integrator, options, rows);
  if (integrator.uses(Bundle::light_vertices))
    add_vertices(integrator, options.plan, "light",
                 integrator.uses(Bundle::grid) ? std::size_t(options.light_path_count())
                                               : slice_paths(options, slice),
                 bytes);
  if (integrator.uses(Bundle::eye_vertices))
    add_vertices(integrator, options.plan, "eye", slice * row_pixels, bytes);
  if (integrator.uses(Bundle::grid)) {
    bytes["grid_digits"] = SORT_DIGITS * SORT_BLOCKS * sizeof(uint);
    bytes["grid_cells"] = (std::size_t{2} << grid_bits_for(options)) * sizeof(uint);
  }
  if (integrator.uses(Bundle::vertex_counts)) bytes["vertex_counts"] = 2 * sizeof(uint);
  if (integrator.uses(Bundle::record)) {
    bytes["record"] = options.record_events * sizeof(PathEvent);
    bytes["record_count"] = sizeof(uint);
  }
  if (integrator.uses(Bundle::layers)) bytes["layers"] = pixels * layer_bytes(integrator.layers);
  return bytes;
}

MemoryPlan plan_memory(const DeviceInfo& device, const PackedScene& scene,
                       const Integrator& integrator, const RenderOptions& wanted) {
  RenderOptions options = wanted;
  const Window window = options.window();
  const std::uint64_t host_bytes = options.host_bytes;
  const std::uint64_t film_bytes =
      window.pixels() * (sizeof(FilmPixel) + layer_bytes(integrator.layers));
  check_host(film_bytes + host_bytes);
  std::uint64_t most = std::min(options.memory.value_or(device.memory), device.memory);
  // A CPU device's memory is the host's, where the film is already.
  if (device.cpu) most = std::min(most, host_memory() - film_bytes - host_bytes);
  const auto sizes = [&](int rows) {
    return buffer_sizes(scene, integrator, options, std::size_t(rows));
  };
  const bool asked = options.memory && most == *options.memory;
  const auto fits = [&](int rows) { return objection(device, most, asked, sizes(rows)).empty(); };
  MemoryPlan plan;
  plan.film_bytes = film_bytes;
  plan.limit = most;
  if (integrator.uses(Bundle::grid))  // all light paths' at once: less room than they mostly need
    while (!fits(1) && options.plan.vertices_per_path > 1) options.plan.vertices_per_path /= 2;
  if (!fits(1))
    throw DeviceError(objection(device, most, asked, sizes(1)) +
                      (integrator.uses(Bundle::grid)
                           ? "; it merges the vertices of all light paths at once: try fewer "
                             "--light-paths, --vertices compact, or more --memory"
                           : ""));
  const double per_path = options.plan.vertices_per_path;
  options.plan.vertices_per_path *= 2;  // what large bands would leave no room for
  if (!integrator.uses(Bundle::grid) || !fits(1)) options.plan.vertices_per_path = per_path;
  int low = 1, high = window.height;  // bisection: what `low` rows need fits
  while (low < high) {
    const int middle = low + (high - low + 1) / 2;
    if (fits(middle))
      low = middle;
    else
      high = middle - 1;
  }
  // Where bands are needed at all, large ones crowd the host out and gain nothing over these, but
  // for methods that trace all light paths anew in each.
  constexpr std::uint64_t enough = std::uint64_t{1} << 30;
  if (low < window.height && !integrator.walks_from_lights()) {
    const std::uint64_t row = total(sizes(2)) - total(sizes(1));
    low = int(std::min(std::uint64_t(low), std::max<std::uint64_t>(1, enough / row)));
  }
  options.plan.vertices_per_path = per_path;
  plan.buffers = sizes(low);
  plan.slice_rows = slice_rows(integrator, options, std::size_t(low));
  for (int row = 0; row < window.height; row += low)
    plan.tiles.push_back(
        {window.x0, window.y0 + row, window.width, std::min(low, window.height - row)});
  return plan;
}

}  // namespace pellucid
