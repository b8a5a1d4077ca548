// Scene files to scenes: the top level of the parser.
#include "scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "scene/parse.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

/// Geometry never stands inside JSON, so that no sensible scene file comes near this.
constexpr std::size_t max_scene_bytes = std::size_t{64} << 20;
/// Pixels: what fits the film accumulators of common devices with room to spare.

RenderSettings parse_settings(const JsonNode& film_node, const JsonNode& integrator_node) {
  RenderSettings settings;
  const ObjectReader film(film_node, object_spec("film"));
  settings.width = film.integer("width");
  settings.height = film.integer("height");
  if (static_cast<double>(settings.width) * settings.height > double(largest_film))
    fail(film_node, fmt::format("{} x {} pixels are too many; the most is {:.0f} in all",
                                settings.width, settings.height, double(largest_film)));
  settings.filter = find_pixel_filter(film.text("filter"));
  const ObjectReader integrator(integrator_node, object_spec("integrator"));
  if (integrator.has("name")) settings.integrator = integrator.text("name");
  if (integrator.has("spp")) settings.spp = integrator.integer("spp");
  if (integrator.has("maxDepth")) settings.max_depth = integrator.integer("maxDepth");
  return settings;
}

void parse_lights(const JsonNode& list, Scene& scene) {
  const JsonNode* environment = nullptr;
  for (const JsonNode& node : list.items) {
    const Light light = parse_light(node);
    if (std::holds_alternative<ConstantEnvironment>(light)) {
      if (environment != nullptr)
        fail(node, fmt::format("a scene has at most one environment; {} is one already",
                               environment->path));
      environment = &node;
    }
    const Rgb strength = std::visit(
        [](const auto& l) {
          using L = std::decay_t<decltype(l)>;
          if constexpr (std::is_same_v<L, PointLight> || std::is_same_v<L, SpotLight>)
            return l.intensity;
          else if constexpr (std::is_same_v<L, DirectionalLight>)
            return l.irradiance;
          else
            return l.radiance;
        },
        light);
    if (strength == Rgb(0.0)) {
      scene.warnings.push_back(fmt::format("{} gives no light and is left out", node.path));
    } else {
      scene.lights.push_back(light);
    }
  }
}

/// Warnings that only the whole scene can tell.
void finish_warnings(SceneBuilder& builder) {
  Scene& scene = builder.scene;
  for (const auto& [kind, files] : builder.not_supported) {
    std::string where = *files.begin();
    if (files.size() > 1) where += fmt::format(" and {} more", files.size() - 1);
    scene.warnings.push_back(
        fmt::format("{} is not supported yet and was ignored ({})", kind, where));
  }
  const bool lit = !scene.lights.empty() ||
                   std::any_of(scene.shapes.begin(), scene.shapes.end(),
                               [](const Shape& shape) { return shape.emission.has_value(); });
  if (!lit) scene.warnings.push_back("the scene has no light: the picture will be black");
}

void require_scene_suffix(const std::string& path) {
  const std::string suffix = std::filesystem::path(path).extension().string();
  if (suffix == ".obj" || suffix == ".ply" || suffix == ".mtl")
    throw InputError(
        fmt::format("'{}' is a model, not a scene; write a scene file (.json) with a "
                    "shape of type \"mesh\" that names it",
                    path));
}

}  // namespace

Scene load_scene(const std::string& path) {
  require_scene_suffix(path);
  const JsonNode root = parse_json(path, read_text_file(path, "scene file", max_scene_bytes));
  const ObjectReader reader(root, object_spec("scene"));

  SceneBuilder builder;
  Scene& scene = builder.scene;
  const std::filesystem::path file(path);
  builder.folder = file.parent_path().string();
  scene.path = path;
  scene.name = file.stem().string();
  scene.files.push_back(path);
  if (reader.has("description")) scene.description = reader.text("description");
  scene.camera = parse_camera(reader.value("camera"));
  scene.settings = parse_settings(reader.value("film"), reader.value("integrator"));
  parse_materials(reader.value("materials"), builder);
  for (const JsonNode& node : reader.value("shapes").items) parse_shape(node, builder);
  parse_lights(reader.value("lights"), scene);
  finish_warnings(builder);
  return std::move(builder.scene);
}

}  // namespace pellucid
