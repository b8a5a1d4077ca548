// Plan: allocation, specialisation, binding by bundle, launching.
#include "render/plan.h"

#include <algorithm>

#include "base/error.h"
#include "base/phase_clock.h"
#include "render/launch.h"
#include "render/memory.h"
#include "shared/buffers.h"
#include "shared/limits.h"

namespace pellucid {
std::vector<std::string> bundle_buffers(Bundle bundle) {
#define PELLUCID_NAME(T, name, meaning) #name,
  switch (bundle) {
    case Bundle::scene:
      return {SCENE_BUFFERS(PELLUCID_NAME)};
    case Bundle::filter:
      return {FILTER_BUFFERS(PELLUCID_NAME)};
    case Bundle::film:
      return {FILM_BUFFERS(PELLUCID_NAME)};
    case Bundle::splat:
      return {SPLAT_BUFFERS(PELLUCID_NAME)};
    case Bundle::light_vertices:
      return {LIGHT_VERTEX_BUFFERS(PELLUCID_NAME)};
    case Bundle::eye_vertices:
      return {EYE_VERTEX_BUFFERS(PELLUCID_NAME)};
    case Bundle::vertex_counts:
      return {VERTEX_COUNT_BUFFERS(PELLUCID_NAME)};
    case Bundle::grid:
      return {GRID_BUFFERS(PELLUCID_NAME)};
    case Bundle::aov:
      return {AOV_BUFFERS(PELLUCID_NAME)};
    case Bundle::layers:
      return {LAYER_BUFFERS(PELLUCID_NAME)};
    case Bundle::record:
      return {RECORD_BUFFERS(PELLUCID_NAME)};
    case Bundle::diag:
      return {DIAG_BUFFERS(PELLUCID_NAME)};
  }
#undef PELLUCID_NAME
  throw InternalError("unknown bundle");
}

std::map<std::string, Buffer> upload_scene(Device& device, const PackedScene& scene) {
  std::map<std::string, Buffer> buffers;
#define PELLUCID_UPLOAD(T, name, meaning) \
  buffers[#name] = device.create_buffer(#name, bytes_of(scene.name), scene.name.data());
  SCENE_BUFFERS(PELLUCID_UPLOAD)
  FILTER_BUFFERS(PELLUCID_UPLOAD)
#undef PELLUCID_UPLOAD
  return buffers;
}

std::size_t group_for(const Kernel& kernel, std::size_t asked) {
  if (asked > kernel.max_group())
    throw DeviceError("a work-group of " + std::to_string(asked) + " is more than the " +
                      std::to_string(kernel.max_group()) + " that kernel '" + kernel.name() +
                      "' allows on this device");
  return asked ? asked : std::min(default_group, kernel.max_group());
}

std::size_t group_for_pass(const Pass& pass, const Kernel& kernel, std::size_t asked) {
  const std::size_t group = group_for(kernel, asked);
  if (pass.domain == Domain::sides) return std::min<std::size_t>(group, SCAN_GROUP);
  if (pass.domain == Domain::blocks) return 1;  // few, and each one much work: for all cores
  return group;
}

/// All of them and what stands behind them, which is 0 then.
static std::vector<uint> take_words(Device& device, const Buffer& diag) {
  std::vector<uint> words(diag.bytes() / sizeof(uint));
  device.read(diag, words.data(), diag.bytes());
  const std::vector<uint> none(words.size());
  device.write(diag, none.data(), diag.bytes());
  return words;
}

void collect_counters(Device& device, const Buffer& diag, std::vector<Counter>& counters) {
  add_counts(take_words(device, diag), counters);
}

std::vector<std::string> parameter_names(const Pass& pass) {
  std::vector<std::string> names;
  for (Bundle bundle : pass.bundles) {
    for (const std::string& name : bundle_buffers(bundle)) names.push_back(name);
    if (bundle == Bundle::scene) names.insert(names.end(), {"scene_info", "camera"});
  }
  names.push_back("launch");
  return names;
}

Specialisation specialise(const PackedScene& scene, const Integrator& integrator,
                          const DeviceInfo& device, const PlanOptions& options) {
  Specialisation s;
  s.features = scene.features | integrator.wishes | options.extra_features;
  if (options.sampler == Sampler::sobol) s.features.set(INTG_SOBOL);
  if (options.compact_vertices && integrator.uses(Bundle::light_vertices))
    s.features.set(INTG_COMPACT);
  s.simd_width = scene.simd_width;
  s.stack_bound = scene.stack_bound;
  s.simd_builtins = options.simd_builtins;
  s.int64_atomics = device.int64_atomics && options.int64_atomics;
  s.rounded_division = device.rounded_division;
  s.float_mode = options.float_mode;
  return s;
}

Plan::Plan(Device device, const PackedScene& scene, const Integrator& integrator,
           const RenderOptions& options, const MemoryPlan& memory)
    : device_(std::move(device)),
      options_(options.plan),
      specialisation_(specialise(scene, integrator, device_.info(), options_)),
      scene_info_(scene.info),
      camera_(scene.camera),
      tile_pixels_(memory.tile_pixels()),
      memory_limit_(memory.limit),
      slice_rows_(memory.slice_rows),
      merges_(integrator.uses(Bundle::grid)),
      merging_(merging_for(scene, options)),
      grid_bits_(grid_bits_for(options)),
      buffers_(upload_scene(device_, scene)) {
  for (const auto& [name, size] : memory.buffers)
    if (!buffers_.count(name)) buffers_[name] = device_.create_buffer(name, size);
  if (integrator.uses(Bundle::vertex_counts))
    for (const auto& [side, trace] : {std::pair{"light", "light_trace"}, {"eye", "camera_trace"}})
      sides_.push_back({side, trace, vertex_buffers(integrator, options_, side),
                        buffers_.at(side + std::string("_last")).bytes() / sizeof(uint),
                        buffers_.at(side + std::string("_order")).bytes() / sizeof(uint)});
  if (specialisation_.features.has(INTG_COMPACT)) check_compact(scene);
  const KernelFiles files(options_.kernel_dir, options_.overlay);
  const std::string prelude = prelude_of(specialisation_);
  passes_.reserve(integrator.passes.size());
  for (const Pass& pass : integrator.passes) {
    PassState state;
    state.pass = pass;
    state.kernel = device_.build(pass.name, files.expand("passes/" + pass.name + ".cl", prelude),
                                 options_of(specialisation_));
    state.group = group_for_pass(pass, state.kernel, options_.group);
    state.parts = LaunchParts(options_.launch_items);
    bind(state);
    passes_.push_back(std::move(state));
  }
  warm_up();
}

void Plan::bind(PassState& state) {
  unsigned index = 0;
  for (Bundle bundle : state.pass.bundles) {
    for (const std::string& name : bundle_buffers(bundle))
      state.kernel.set_buffer(index++, buffers_.at(name));
    if (bundle == Bundle::scene) {
      state.kernel.set_bytes(index++, &scene_info_, sizeof scene_info_);
      state.kernel.set_bytes(index++, &camera_, sizeof camera_);
    }
  }
  state.launch_index = index;
}

void Plan::warm_up() {
  const PhaseScope phase(Phase::kernels);
  // Drivers generate code at the first launch of a kernel, per group size and kind of grid: launch
  // with the real sizes on an image of no pixels.
  const Launch nothing{};
  for (PassState& state : passes_) {
    state.kernel.set_bytes(state.launch_index, &nothing, sizeof nothing);
    const bool sides = state.pass.domain == Domain::sides;
    device_.launch(state.kernel, sides ? 2 * state.group : tile_pixels_, state.group, nullptr);
  }
  device_.finish();
}

std::size_t domain_size(Domain domain, const Launch& launch, std::size_t group) {
  switch (domain) {
    case Domain::tile:
      return std::size_t(launch.tile_width) * launch.tile_height;
    case Domain::slice:
      return launch.slice_count;
    case Domain::light_paths:
      return launch.path_count;
    case Domain::sub_paths:
      return std::size_t(launch.path_count) + launch.slice_count;
    case Domain::photons:
      return std::max<std::size_t>(launch.photon_count, std::size_t{1} << launch.grid_bits);
    case Domain::blocks:
      return SORT_BLOCKS;
    case Domain::sides:
      return 2 * group;
  }
  throw InternalError("unknown domain");
}

void Plan::launch(PassState& state, Launch launch) {
  launch.digit = state.pass.digit;
  const std::size_t items = domain_size(state.pass.domain, launch, state.group);
  // Scans and sorts are one launch: few work-items, and each knows its group.
  const bool whole = state.pass.domain == Domain::blocks || state.pass.domain == Domain::sides;
  LaunchParts one(items);
  (whole ? one : state.parts)
      .enqueue(device_, state.kernel, state.launch_index, launch, items, state.group, state.time);
}

void Plan::finish() {
  device_.finish();
  for (PassState& state : passes_) state.parts.learn(*state.time);
}

PassState& Plan::pass_named(const std::string& name) {
  for (PassState& state : passes_)
    if (state.pass.name == name) return state;
  throw InternalError("no pass is called " + name);
}

void Plan::enqueue(Launch launch) {
  const std::size_t pixels = std::size_t(launch.tile_width) * launch.tile_height;
  PELLUCID_CHECK(pixels <= tile_pixels_, "a tile fits the buffers");
  if (sides_.empty())
    run_whole(launch);
  else if (merges_) {
    set_merging(launch, merging_);
    set_grid(launch, scene_info_.center_radius, grid_bits_);
    run_merging(launch);
  } else
    run_slices(launch);
  for (PassState& state : passes_)
    if (state.pass.domain == Domain::tile) this->launch(state, launch);
}

void Plan::read_film(FilmPixel* film, std::size_t pixels) {
  const PhaseScope phase(Phase::film);
  device_.read(buffers_.at("film"), film, pixels * sizeof(FilmPixel));
}

void Plan::write_film(const FilmPixel* film, std::size_t pixels) {
  const PhaseScope phase(Phase::film);
  device_.write(buffers_.at("film"), film, pixels * sizeof(FilmPixel));
}

void Plan::read_layers(Layers& layers, std::size_t first, std::size_t pixels) {
  const PhaseScope phase(Phase::film);
  const std::size_t stride = layers.words_per_pixel();
  if (layers.set)
    device_.read(buffers_.at("layers"), &layers.words[first * stride],
                 pixels * stride * sizeof(uint));
}

void Plan::write_layers(const Layers& layers, std::size_t first, std::size_t pixels) {
  const PhaseScope phase(Phase::film);
  const std::size_t stride = layers.words_per_pixel();
  if (layers.set)
    device_.write(buffers_.at("layers"), &layers.words[first * stride],
                  pixels * stride * sizeof(uint));
}

std::vector<uint> Plan::read_words(const std::string& buffer) {
  std::vector<uint> words(buffers_.at(buffer).bytes() / sizeof(uint));
  device_.read(buffers_.at(buffer), words.data(), words.size() * sizeof(uint));
  return words;
}

void Plan::collect(std::vector<Counter>& counters, DepthCuts& cuts) {
  const std::vector<uint> words = take_words(device_, buffers_.at("diag"));
  add_counts(words, counters);
  add_cut_words(cuts, words);
}

std::map<std::string, std::size_t> Plan::memory() const {
  std::map<std::string, std::size_t> bytes;
  for (const auto& [name, buffer] : buffers_) bytes[name] = buffer.bytes();
  return bytes;
}

}  // namespace pellucid
