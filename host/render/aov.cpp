// The AOV pass: tile by tile, as many pixels as device memory has room for.
#include "render/aov.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "base/error.h"
#include "render/launch.h"
#include "render/launch_parts.h"

namespace pellucid {
namespace {

float row3(const F4& v, std::size_t c) {
  return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

/// Indices are exact in float to 2^24; -1 where the ray left the scene.
float index_value(uint id) {
  return id == NONE ? -1.0f : float(id);
}

std::vector<AovInfo> asked_for(const std::vector<std::string>& names) {
  std::vector<AovInfo> asked;
  for (const AovInfo& info : aov_table())
    if (std::find(names.begin(), names.end(), info.name) != names.end()) asked.push_back(info);
  return asked;
}

const Integrator& aov_method() {
  static const Integrator method{
      "aov", "", {}, false, {{"aov", {Bundle::scene, Bundle::filter, Bundle::aov, Bundle::diag}}}};
  return method;
}

/// The pass made ready on a device for the tiles of `memory`.
class AovPass {
 public:
  AovPass(Device device, const PackedScene& scene, const PlanOptions& options,
          const MemoryPlan& memory);
  /// The accumulators of a tile after `iterations`; nothing if `stop` said so.
  std::optional<std::vector<AovPixel>> run(Launch launch, uint iterations,
                                           const std::function<bool()>& stop);
  void collect(std::vector<Counter>& counters) {
    collect_counters(device_, buffers_.at("diag"), counters);
  }

 private:
  Device device_;
  std::map<std::string, Buffer> buffers_;
  Kernel kernel_;
  std::size_t group_ = 1;
  unsigned launch_index_ = 0;
  LaunchParts parts_;
  std::shared_ptr<PassTime> time_ = std::make_shared<PassTime>();
};

AovPass::AovPass(Device device, const PackedScene& scene, const PlanOptions& options,
                 const MemoryPlan& memory)
    : device_(std::move(device)), buffers_(upload_scene(device_, scene)) {
  for (const char* name : {"aovs", "diag"})
    buffers_[name] = device_.create_buffer(name, memory.buffers.at(name));
  const Specialisation special = specialise(scene, aov_method(), device_.info(), options);
  const KernelFiles files(options.kernel_dir);
  kernel_ =
      device_.build("aov", files.expand("passes/aov.cl", prelude_of(special)), options_of(special));
  group_ = group_for(kernel_, options.group);
  for (const std::string& name : parameter_names(aov_method().passes[0])) {
    if (name == "launch") continue;
    if (name == "scene_info") {
      kernel_.set_bytes(launch_index_++, &scene.info, sizeof scene.info);
    } else if (name == "camera") {
      kernel_.set_bytes(launch_index_++, &scene.camera, sizeof scene.camera);
    } else {
      kernel_.set_buffer(launch_index_++, buffers_.at(name));
    }
  }
}

std::optional<std::vector<AovPixel>> AovPass::run(Launch launch, uint iterations,
                                                  const std::function<bool()>& stop) {
  const std::size_t pixels = std::size_t(launch.tile_width) * launch.tile_height;
  for (launch.iteration = 0; launch.iteration < iterations; ++launch.iteration) {
    parts_.enqueue(device_, kernel_, launch_index_, launch, pixels, group_, time_);
    device_.finish();  // or all would be queued before anybody could say stop
    parts_.learn(*time_);
    if (stop && stop()) return std::nullopt;
  }
  std::vector<AovPixel> tile(pixels);
  device_.read(buffers_.at("aovs"), tile.data(), pixels * sizeof(AovPixel));
  return tile;
}

/// Positions in coordinates of the scene's file.
void move_back(const std::array<double, 3>& origin, std::vector<AovPixel>& tile) {
  if (origin == std::array<double, 3>{}) return;
  for (AovPixel& pixel : tile) {
    if (pixel.id.x == NONE) continue;  // nothing there: 0
    F4& p = pixel.position;
    p.x = float(p.x + origin[0]), p.y = float(p.y + origin[1]), p.z = float(p.z + origin[2]);
  }
}

/// Appends a tile to the channels of all that was asked for.
void append_tile(const std::vector<AovInfo>& asked, const std::vector<AovPixel>& tile,
                 uint iterations, std::vector<AovChannel>& channels) {
  std::size_t out = 0;
  for (const AovInfo& info : asked) {
    const float scale = info.filtered ? 1.0f / float(iterations) : 1.0f;
    for (std::size_t c = 0; c < info.channels.size(); ++c, ++out)
      for (const AovPixel& pixel : tile) channels[out].data.push_back(info.value(pixel, c) * scale);
  }
}

}  // namespace

const std::vector<AovInfo>& aov_table() {
  static const std::vector<AovInfo> table{
      {"Z",
       {"Z"},
       "depth along the camera's axis, infinity behind all",
       false,
       [](const AovPixel& p, std::size_t) { return p.position.w; }},
      {"P",
       {"P.X", "P.Y", "P.Z"},
       "position in the world",
       false,
       [](const AovPixel& p, std::size_t c) { return row3(p.position, c); }},
      {"N",
       {"N.X", "N.Y", "N.Z"},
       "shading normal, on the side of the surface that the camera sees",
       true,
       [](const AovPixel& p, std::size_t c) { return row3(p.normal, c); }},
      {"Ng",
       {"Ng.X", "Ng.Y", "Ng.Z"},
       "geometric normal towards the camera",
       true,
       [](const AovPixel& p, std::size_t c) { return row3(p.geometric, c); }},
      {"albedo",
       {"albedo.R", "albedo.G", "albedo.B"},
       "colour of the first surface",
       true,
       [](const AovPixel& p, std::size_t c) { return row3(p.albedo, c); }},
      {"id.object",
       {"id.object"},
       "number of the shape, from 0",
       false,
       [](const AovPixel& p, std::size_t) { return index_value(p.id.x); }},
      {"id.material",
       {"id.material"},
       "number of the material, from 0",
       false,
       [](const AovPixel& p, std::size_t) { return index_value(p.id.y); }},
  };
  return table;
}

std::optional<std::vector<AovChannel>> render_aovs(Device device, const PackedScene& scene,
                                                   const std::vector<std::string>& names,
                                                   const RenderOptions& options,
                                                   std::vector<Counter>& counters,
                                                   const std::function<bool()>& stop) {
  const std::vector<AovInfo> asked = asked_for(names);
  std::vector<AovChannel> channels;
  for (const AovInfo& info : asked)
    for (const std::string& name : info.channels) channels.push_back({name, {}});
  if (asked.empty()) return channels;
  const bool filtered =
      std::any_of(asked.begin(), asked.end(), [](const AovInfo& info) { return info.filtered; });
  const uint iterations = filtered ? AOV_ITERATIONS : 1;
  const MemoryPlan memory = plan_memory(device.info(), scene, aov_method(), options);
  AovPass pass(std::move(device), scene, options.plan, memory);
  Launch launch = make_launch(scene, options.width, options.height, options.window());
  launch.seed = hash_seed(options.seed);
  for (const Window& tile : memory.tiles) {  // bands of rows, from the top
    set_tile(launch, tile);
    auto pixels = pass.run(launch, iterations, stop);
    if (!pixels) return std::nullopt;
    move_back(scene.origin, *pixels);
    append_tile(asked, *pixels, iterations, channels);
  }
  pass.collect(counters);
  return channels;
}

}  // namespace pellucid
