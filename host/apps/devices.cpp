// devices: what OpenCL offers here, and whether it works.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "base/text.h"
#include "integrators/registry.h"
#include "render/math_probe.h"
#include "render/selftest.h"

namespace pellucid {
namespace {

nlohmann::json as_json(const DeviceInfo& d) {
  return {{"spec", d.spec()},
          {"platform", d.platform_name},
          {"name", d.name},
          {"vendor", d.vendor},
          {"version", d.version},
          {"driver", d.driver},
          {"cpu", d.cpu},
          {"fp64", d.fp64},
          {"int64_atomics", d.int64_atomics},
          {"memory_bytes", d.memory},
          {"max_buffer_bytes", d.max_buffer},
          {"compute_units", d.compute_units},
          {"native_float_width", d.native_float_width},
          {"unusable", d.unusable}};
}

std::string as_text(const DeviceInfo& d) {
  return fmt::format(
      "{}  {}\n     {}, driver {}, {}; {} compute units, memory {}, one buffer at most {}; fp64 "
      "{}, 64-bit atomics "
      "{}\n{}",
      d.spec(), d.name, d.platform_name, d.driver, d.vendor, d.compute_units,
      format_bytes(d.memory), format_bytes(d.max_buffer), d.fp64 ? "yes" : "no",
      d.int64_atomics ? "yes" : "no",
      d.unusable.empty() ? "" : fmt::format("     cannot be used: {}\n", d.unusable));
}

/// Layout and arithmetic probes and a tiny render; text for people, facts into `document`.
bool selftest(const DeviceInfo& info, std::string& text, nlohmann::json& document) {
  Device device = Device::open(info.spec());
  const std::vector<std::string> differences = probe_layout(device);
  const SelfTestRender render = selftest_render(device, find_integrator(default_integrator()));
  std::vector<std::string> inexact;
  nlohmann::json math = nlohmann::json::array();
  for (const MathError& e : probe_math(device, FloatMode::strict)) {
    if (!e.holds())
      inexact.push_back(fmt::format("{} is {:.3g} {} off instead of at most {}", e.function,
                                    e.worst, e.unit, e.bound));
    math.push_back(
        {{"function", e.function}, {"worst", e.worst}, {"bound", e.bound}, {"unit", e.unit}});
  }
  const bool passed = differences.empty() && inexact.empty() && render.passed;
  text += fmt::format(
      "     selftest {}: layouts {}, arithmetic {}, a sphere of radiance {} renders as {:.5f} +- "
      "{:.5f}\n",
      passed ? "passed" : "FAILED", differences.empty() ? "agree" : join(differences, "; "),
      inexact.empty() ? "is exact enough" : join(inexact, "; "), render.expected, render.mean,
      render.standard_error);
  document["selftest"] = {{"passed", passed},
                          {"layout_differences", differences},
                          {"math", math},
                          {"mean", render.mean},
                          {"expected", render.expected},
                          {"standard_error", render.standard_error}};
  return passed;
}

ExitCode run_devices(bool with_selftest, const CommonOptions& common) {
  std::string text;
  nlohmann::json devices = nlohmann::json::array();
  bool all_passed = true;
  for (const DeviceInfo& info : list_devices()) {
    nlohmann::json document = as_json(info);
    text += as_text(info);
    if (with_selftest && info.unusable.empty()) {
      try {
        all_passed &= selftest(info, text, document);
      } catch (const DeviceError& e) {
        all_passed = false;
        text += fmt::format("     selftest FAILED: {}\n", e.what());
        document["selftest"] = {{"passed", false}, {"error", e.what()}};
      }
    }
    devices.push_back(document);
  }
  if (common.wants_text()) print_result(text);
  write_json(common.json, {{"devices", devices}});
  return all_passed ? ExitCode::done : ExitCode::device;
}

}  // namespace

CommandRun setup_devices(CLI::App& app) {
  auto with_selftest = std::make_shared<bool>(false);
  app.add_flag("--selftest", *with_selftest,
               "also run probes of layouts and arithmetic and a tiny render on each");
  app.footer("Example: pellucid devices --selftest");
  return
      [with_selftest](const CommonOptions& common) { return run_devices(*with_selftest, common); };
}

}  // namespace pellucid
