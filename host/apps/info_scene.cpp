// info on scenes: what is in them, and what rendering them would take.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/info_parts.h"
#include "apps/scene_input.h"
#include "apps/scene_report.h"
#include "base/text.h"
#include "integrators/reach.h"
#include "integrators/registry.h"
#include "render/memory.h"
#include "render/specialise.h"

namespace pellucid {
namespace {

/// The scene's own picture.
RenderOptions scene_options(const Scene& scene) {
  RenderOptions o;
  o.width = scene.settings.width, o.height = scene.settings.height;
  return o;
}

struct SceneFacts {
  const Scene& scene;
  const PackedScene& packed;
  const DeviceInfo& device;
  Memory memory;  ///< for the scene's own method and film

  SceneFacts(const Scene& s, const PackedScene& p, const DeviceInfo& d)
      : scene(s),
        packed(p),
        device(d),
        memory(buffer_sizes(p, choose_integrator("", s), scene_options(s),
                            std::size_t(s.settings.height))) {}
};

nlohmann::json methods_json(const SceneFacts& f) {
  nlohmann::json methods = nlohmann::json::object();
  const SceneOptics optics = optics_of(f.packed, f.scene.settings.max_depth);
  for (const Integrator& method : integrators()) {
    const nlohmann::json kernels = method.kernels();
    methods[method.name] = {{"can_render", true},
                            {"unreachable", unreachable_paths(method, optics)},
                            {"by_chance", chance_paths(method, optics)},
                            {"kernels", kernels}};
  }
  return methods;
}

nlohmann::json bvh_json(const PackedScene& packed) {
  const bvh::Statistics& b = packed.bvh;
  return {{"width", packed.simd_width},
          {"nodes", b.nodes},
          {"leaves", b.leaves},
          {"depth", b.depth},
          {"stack", b.stack},
          {"mean_children", b.mean_children},
          {"mean_leaf_fill", b.mean_leaf_fill},
          {"sah_cost", b.sah_cost},
          {"seconds", packed.bvh_seconds}};
}

/// JSON first, text from it and the facts.
nlohmann::json scene_document(const SceneFacts& f) {
  using nlohmann::json;
  const Scene& scene = f.scene;
  json files = json::array();
  for (const SourceFile& file : scene.files) files.push_back(file.path);
  return {{"file", scene.path},
          {"files", files},
          {"name", scene.name},
          {"description", scene.description},
          {"hash", scene_hash(scene)},
          {"overrides", scene.overrides},
          {"width", scene.settings.width},
          {"height", scene.settings.height},
          {"integrator", choose_integrator("", scene).name},
          {"spp", scene.settings.spp ? json(*scene.settings.spp) : json()},
          {"max_depth", scene.settings.max_depth ? json(*scene.settings.max_depth) : json()},
          {"shapes", scene.shapes.size()},
          {"shape_kinds", shape_kinds(scene)},
          {"triangles", f.packed.info.triangle_count},
          {"materials", scene.materials.size()},
          {"material_kinds", material_kinds(scene)},
          {"lights", f.packed.info.light_count},
          {"light_kinds", light_kinds(scene)},
          {"warnings", scene.warnings},
          {"notes", scene.notes},
          {"features", feature_flags(f.packed.features, all_scene_features())},
          {"integrators", methods_json(f)},
          {"memory_bytes", f.memory},
          {"device", f.device.name},
          {"device_limits", device_facts(f.device)},
          {"bvh", bvh_json(f.packed)}};
}

std::string methods_text(const nlohmann::json& methods) {
  std::string text;
  for (const auto& [name, method] : methods.items()) {
    text += fmt::format("  {:<10}kernels {}\n", name,
                        join(method["kernels"].get<std::vector<std::string>>()));
    for (const auto& what : method["unreachable"])
      text += fmt::format("            cannot see {}\n", what.get<std::string>());
    for (const auto& what : method["by_chance"])
      text += fmt::format("            by chance alone, noisy if they are small: {}\n",
                          what.get<std::string>());
  }
  return text;
}

std::string bvh_text(const PackedScene& packed) {
  const bvh::Statistics& b = packed.bvh;
  return fmt::format(
      "  BVH       width {}, {} nodes, {} leaves, depth {}, stack {}, {:.1f} children per node, "
      "{:.1f} primitives per leaf, SAH cost {:.1f}, built in {}\n",
      packed.simd_width, b.nodes, b.leaves, b.depth, b.stack, b.mean_children, b.mean_leaf_fill,
      b.sah_cost, format_seconds(packed.bvh_seconds));
}

std::string scene_text(const SceneFacts& f, const nlohmann::json& d) {
  const Scene& s = f.scene;
  const RenderSettings& settings = s.settings;
  std::string present, absent;
  for (const auto& [name, on] : d["features"].items())
    (on.get<bool>() ? present : absent) += " " + name;
  std::string text = fmt::format("{}: {}\n", s.name, s.description);
  text += fmt::format("  file      {}, hash {}\n", s.path, d["hash"].get<std::string>());
  for (std::size_t i = 1; i < s.files.size(); ++i)
    text += fmt::format("            {}\n", s.files[i].path);
  text += fmt::format("  film      {}x{} by {}, {} spp, max depth {}\n", settings.width,
                      settings.height, d["integrator"].get<std::string>(),
                      settings.spp ? std::to_string(*settings.spp) : "default",
                      settings.max_depth ? std::to_string(*settings.max_depth) : "unlimited");
  text += fmt::format("  shapes    {}, {} triangles\n", counts_text(shape_kinds(s)),
                      f.packed.info.triangle_count);
  text += fmt::format("  materials {}\n", counts_text(material_kinds(s)));
  text += fmt::format("  lights    {} ({} to choose from)\n", counts_text(light_kinds(s)),
                      f.packed.info.light_count);
  text += fmt::format("  present  {}\n  absent   {}\n", present, absent);
  text += bvh_text(f.packed);
  text += fmt::format("  memory    {}\n", memory_text(f.memory, f.device));
  text += methods_text(d["integrators"]);
  for (const std::string& warning : s.warnings) text += fmt::format("  warning   {}\n", warning);
  return text;
}

}  // namespace

ExitCode scene_info(const std::string& file, const LoadOptions& options, const DeviceFlags& device,
                    const CommonOptions& common) {
  const Scene scene = open_scene(file, options);
  const Device target = device.open();
  const PackedScene packed = pack_scene(scene, {simd_width_for(target.info())});
  const SceneFacts facts(scene, packed, target.info());
  const nlohmann::json document = scene_document(facts);
  if (common.wants_text()) print_result(scene_text(facts, document));
  write_json(common.json, document);
  return ExitCode::done;
}

}  // namespace pellucid
