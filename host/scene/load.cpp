// Scene files to scenes: the top level of the parser.
#include "scene/load.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "base/error.h"
#include "scene/bare_model.h"
#include "scene/coplanar.h"
#include "scene/distance.h"
#include "scene/model.h"
#include "scene/needles.h"
#include "scene/overrides.h"
#include "scene/parse.h"
#include "scene/text_file.h"
#include "scene/thin_glass.h"
#include "scene/thin_shells.h"

namespace pellucid {
namespace {

/// Geometry never stands inside JSON, so that no sensible scene file comes near this.
constexpr std::size_t max_scene_bytes = std::size_t{64} << 20;

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
  for (const auto warning :
       {distance_warning, coplanar_warning, needle_warning, thin_glass_warning, thin_shell_warning})
    if (std::string text = warning(scene); !text.empty()) scene.warnings.push_back(std::move(text));
}

/// The document of a scene or of a bare model, with what the command line changes.
JsonNode read_document(const std::string& path, const LoadOptions& options, SceneBuilder& builder) {
  JsonNode root;
  if (is_model_file(path)) {
    root = bare_model_document(path);
  } else {
    const std::string text = read_text_file(path, "scene file", max_scene_bytes);
    builder.scene.files.push_back(source_file(path, text));
    root = parse_json(path, text);
  }
  for (const std::string& definition : options.overrides) apply_override(root, definition);
  builder.scene.overrides = options.overrides;
  return root;
}

/// Camera and lamps, as place_shapes() does with shapes.
void place_points(Scene& scene) {
  scene.camera.origin -= scene.origin;
  for (Light& light : scene.lights)
    if (PointLight* point = std::get_if<PointLight>(&light)) {
      point->position -= scene.origin;
    } else if (SpotLight* spot = std::get_if<SpotLight>(&light)) {
      spot->position -= scene.origin;
    }
}

}  // namespace

Scene load_scene(const std::string& path, const LoadOptions& options) {
  SceneBuilder builder;
  Scene& scene = builder.scene;
  JsonNode root = read_document(path, options, builder);
  const ObjectReader reader(root, object_spec("scene"));
  const bool bare = is_model_file(path);
  const std::filesystem::path file(path);
  builder.folder = file.parent_path().string();
  scene.path = path;
  scene.name = file.stem().string();
  if (reader.has("description")) scene.description = reader.text("description");
  scene.closed = reader.boolean("closed");
  scene.settings = parse_settings(reader.value("film"), reader.value("integrator"));
  if (options.size) std::tie(scene.settings.width, scene.settings.height) = *options.size;
  if (!bare) scene.camera = parse_camera(reader.value("camera"));
  parse_materials(reader.value("materials"), builder);
  if (bare) builder.bare_material = bare_material(builder);
  const JsonNode shapes = reader.value("shapes");
  for (const JsonNode& node : shapes.items) parse_shape(node, builder);
  place_shapes(builder);
  if (bare) {
    complete_bare_model(scene, root);
    scene.camera = parse_camera(reader.value("camera"));
  }
  parse_lights(reader.value("lights"), scene);
  place_points(scene);
  finish_warnings(builder);
  return std::move(builder.scene);
}

}  // namespace pellucid
