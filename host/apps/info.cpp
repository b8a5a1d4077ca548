// info: what is in a scene or an image, and what rendering it would take.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/outputs.h"
#include "apps/scene_input.h"
#include "base/text.h"
#include "image/image.h"
#include "integrators/reach.h"
#include "integrators/registry.h"
#include "render/memory.h"
#include "render/plan.h"

namespace pellucid {
namespace {

std::string meta_text(const MetaValue& value) {
  if (const int* i = std::get_if<int>(&value)) return std::to_string(*i);
  if (const float* f = std::get_if<float>(&value)) return fmt::format("{}", *f);
  if (const std::string* s = std::get_if<std::string>(&value)) return *s;
  return fmt::format("{}", fmt::join(std::get<std::vector<float>>(value), " "));
}

ExitCode image_info(const std::string& path, const CommonOptions& common) {
  const Image image = read_image(path);
  std::string text = fmt::format("{}: {}x{}, channels {}\n", path, image.width, image.height,
                                 join(image.channels));
  nlohmann::json metadata = nlohmann::json::object();
  for (const auto& [name, value] : image.metadata) {
    text += fmt::format("  {:<24} {}\n", name, meta_text(value));
    metadata[name] = meta_text(value);
  }
  if (common.wants_text()) print_result(text);
  write_json(common.json, {{"file", path},
                           {"width", image.width},
                           {"height", image.height},
                           {"channels", image.channels},
                           {"metadata", metadata}});
  return ExitCode::done;
}

/// What a scene's report is made of; JSON first, text from it.
nlohmann::json scene_document(const Scene& scene, const PackedScene& packed,
                              const DeviceInfo& device) {
  using nlohmann::json;
  json features = json::object(), methods = json::object();
  const FeatureSet scene_features = all_scene_features();
  for (unsigned i = 0; i < FEATURE_COUNT; ++i)
    if (scene_features.has(static_cast<Feature>(i)))
      features[feature_word(static_cast<Feature>(i))] =
          packed.features.has(static_cast<Feature>(i));
  for (const Integrator& method : integrators()) {
    json kernels = json::array();
    for (const Pass& pass : method.passes) kernels.push_back(pass.name);
    methods[method.name] = {{"can_render", true},
                            {"unreachable", unreachable_paths(method, packed.features)},
                            {"kernels", kernels}};
  }
  const std::size_t pixels = std::size_t(scene.settings.width) * std::size_t(scene.settings.height);
  const auto memory = buffer_sizes(packed, choose_integrator("", scene), pixels);
  const bvh::Statistics& b = packed.bvh;
  return {{"file", scene.path},
          {"name", scene.name},
          {"description", scene.description},
          {"hash", scene_hash(scene)},
          {"width", scene.settings.width},
          {"height", scene.settings.height},
          {"shapes", scene.shapes.size()},
          {"triangles", packed.info.triangle_count},
          {"materials", scene.materials.size()},
          {"lights", packed.info.light_count},
          {"warnings", scene.warnings},
          {"features", features},
          {"integrators", methods},
          {"memory_bytes", memory},
          {"device", device.name},
          {"bvh",
           {{"width", packed.simd_width},
            {"nodes", b.nodes},
            {"leaves", b.leaves},
            {"depth", b.depth},
            {"stack", b.stack},
            {"mean_children", b.mean_children},
            {"mean_leaf_fill", b.mean_leaf_fill},
            {"sah_cost", b.sah_cost},
            {"seconds", packed.bvh_seconds}}}};
}

std::string scene_text(const nlohmann::json& d) {
  std::string present, absent, text;
  for (const auto& [name, on] : d["features"].items())
    (on.get<bool>() ? present : absent) += " " + name;
  std::uint64_t bytes = 0;
  for (const auto& [name, size] : d["memory_bytes"].items()) bytes += size.get<std::uint64_t>();
  text +=
      fmt::format("{}: {}\n", d["name"].get<std::string>(), d["description"].get<std::string>());
  text += fmt::format("  film      {}x{}\n", d["width"].get<int>(), d["height"].get<int>());
  text += fmt::format("  contents  {} shapes, {} triangles, {} materials, {} lights\n",
                      d["shapes"].get<int>(), d["triangles"].get<int>(), d["materials"].get<int>(),
                      d["lights"].get<int>());
  text += fmt::format("  present  {}\n  absent   {}\n", present, absent);
  const auto& b = d["bvh"];
  text += fmt::format(
      "  BVH       width {}, {} nodes, {} leaves, depth {}, stack {}, {:.1f} children per node, "
      "{:.1f} primitives per leaf, SAH cost {:.1f}, built in {}\n",
      b["width"].get<int>(), b["nodes"].get<int>(), b["leaves"].get<int>(), b["depth"].get<int>(),
      b["stack"].get<int>(), b["mean_children"].get<double>(), b["mean_leaf_fill"].get<double>(),
      b["sah_cost"].get<double>(), format_seconds(b["seconds"].get<double>()));
  text +=
      fmt::format("  memory    {} on {}\n", format_bytes(bytes), d["device"].get<std::string>());
  for (const auto& [name, method] : d["integrators"].items()) {
    text += fmt::format("  {:<10}kernels {}", name,
                        fmt::join(method["kernels"].get<std::vector<std::string>>(), ", "));
    for (const auto& what : method["unreachable"])
      text += fmt::format("; cannot see {}", what.get<std::string>());
    text += "\n";
  }
  return text;
}

ExitCode scene_info(const std::string& file, const std::string& device,
                    const CommonOptions& common) {
  const Scene scene = open_scene(file);
  const Device target = Device::open(device);
  const PackedScene packed = pack_scene(scene, {simd_width_for(target.info())});
  const nlohmann::json document = scene_document(scene, packed, target.info());
  if (common.wants_text()) print_result(scene_text(document));
  write_json(common.json, document);
  return ExitCode::done;
}

}  // namespace

CommandRun setup_info(CLI::App& app) {
  struct Options {
    std::string file, device;
  };
  auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "a scene, the name of a shipped scene, or an image")
      ->required();
  app.add_option("--device", options->device, "OpenCL device that the layout and memory are for")
      ->type_name("SPEC")
      ->envname("PELLUCID_DEVICE");
  app.footer("Example: pellucid info cornell-box");
  return [options](const CommonOptions& common) {
    return is_picture_name(options->file) ? image_info(options->file, common)
                                          : scene_info(options->file, options->device, common);
  };
}

}  // namespace pellucid
