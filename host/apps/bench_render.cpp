// `bench --only render`: scenes, methods and devices brought together.
#include "apps/bench_render.h"

#include <fmt/format.h>

#include "apps/bench_report.h"
#include "apps/device_input.h"
#include "apps/scene_input.h"
#include "base/error.h"
#include "base/log.h"
#include "bench/method_bench.h"
#include "bench/render_workload.h"
#include "integrators/reach.h"
#include "integrators/registry.h"

namespace pellucid {
namespace {

bool sees_all(const Integrator& method, const PackedScene& scene,
              std::optional<unsigned> max_depth) {
  return unreachable_paths(method, optics_of(scene, max_depth)).empty();
}

/// `bdpt`, or where it is blind to something or finds it by chance alone, `vcm`.
const Integrator& referee_of(const PackedScene& scene, std::optional<unsigned> max_depth) {
  const Integrator& bdpt = find_integrator("bdpt");
  const bool by_chance = !chance_paths(bdpt, optics_of(scene, max_depth)).empty();
  return sees_all(bdpt, scene, max_depth) && !by_chance ? bdpt : find_integrator("vcm");
}

/// `path`, which gains are over, and all others but `reference`, which is slow by design.
std::vector<const Integrator*> methods_to_bench() {
  std::vector<const Integrator*> methods{&find_integrator("path")};
  for (const Integrator& method : integrators())
    if (&method != methods.front() && method.name != "reference") methods.push_back(&method);
  return methods;
}

}  // namespace

RenderBench::RenderBench(const std::vector<std::string>& names, std::optional<int> repeats,
                         std::string kernel_dir)
    : whole_(names.empty()), repeats_(repeats), kernel_dir_(std::move(kernel_dir)) {
  std::vector<std::string> wanted = names;
  if (whole_)
    for (const RenderWorkload& workload : render_workloads()) wanted.push_back(workload.scene);
  for (const std::string& name : wanted) {
    scenes_.push_back(open_scene(name));
    hashes_[scenes_.back().name] = scene_hash(scenes_.back());
  }
}

nlohmann::json RenderBench::run_on(const std::string& spec, const DeviceFlags& flags) const {
  DeviceFlags one = flags;
  one.device = spec;
  const Device device = one.open();
  Progress progress("bench on " + device.info().spec());
  MethodBenchOptions options;
  options.repeats = repeats_.value_or(options.repeats);
  options.plan.kernel_dir = kernel_dir_;
  options.progress = [&](const std::string& text) { progress.update(text); };
  const Judge judge{referee_of, sees_all};
  const auto cells = bench_methods(device, scenes_, methods_to_bench(), judge, options);
  for (const MethodCell& cell : cells)
    if (!cell.failed.empty())
      log_warn("{}: {} on {}: {}", device.info().name, cell.method, cell.scene, cell.failed);
  return device_document(cells, device.info(), whole_);
}

nlohmann::json RenderBench::run(const DeviceFlags& device) const {
  nlohmann::json devices = nlohmann::json::array();
  if (!device.device.empty()) {
    devices.push_back(run_on(device.device, device));
  } else {
    std::exception_ptr last;
    for (const DeviceInfo& info : list_devices()) {
      if (!info.unusable.empty()) continue;
      try {
        devices.push_back(run_on(info.spec(), device));
      } catch (const DeviceError& e) {
        last = std::current_exception();
        log_warn("{}: {}", info.name, e.what());
        devices.push_back({{"device", info.name},
                           {"spec", info.spec()},
                           {"driver", info.platform_name + " " + info.driver},
                           {"failed", e.what()}});
      }
    }
    const auto failed = [](const nlohmann::json& entry) { return entry.contains("failed"); };
    if (last && std::all_of(devices.begin(), devices.end(), failed)) std::rethrow_exception(last);
    if (devices.empty()) device.open();  // tells what there is and why it cannot be used
  }
  return {{"workload", RENDER_WORKLOAD},
          {"size", WORKLOAD_SIZE},
          {"seeds", repeats_.value_or(MethodBenchOptions().repeats)},
          {"scenes", hashes_},
          {"every_device", device.device.empty()},
          {"devices", devices}};
}

std::string render_bench_help() {
  std::string text = fmt::format("The scenes of --only render, {0}, at {1}x{1} pixels:\n",
                                 RENDER_WORKLOAD, WORKLOAD_SIZE);
  for (const RenderWorkload& workload : render_workloads())
    text += fmt::format("  {:<22} {}\n", workload.scene, workload.trait);
  return text +
         fmt::format(
             "A score such as {0}/path is the geometric mean of {1} / (relMSE x seconds) over the "
             "scenes of which the method sees all paths: pictures with {2:.0f} % of noise per "
             "second. It can be compared from device to device; every change of scenes, sizes or "
             "meaning changes the number in {0}. It takes every usable device in turns unless "
             "--device names one.",
             RENDER_WORKLOAD, SCORE_RELMSE, 100 * std::sqrt(SCORE_RELMSE));
}

}  // namespace pellucid
