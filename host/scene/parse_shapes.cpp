// Shapes of the scene file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "base/error.h"
#include "scene/distance.h"
#include "scene/generate.h"
#include "scene/model.h"
#include "scene/parse.h"
#include "scene/transform.h"

namespace pellucid {
namespace {

/// What shapes of all kinds have in common, ready to be joined with a geometry.
struct ShapeParts {
  Shape shape;
  Affine transform;
  bool flip = false;
};

/// Emission that gives no light is no emission: a light of zero power could not be picked.
std::optional<Emission> useful(const Emission& emission) {
  return emission.radiance == Rgb(0.0) ? std::nullopt : std::optional<Emission>(emission);
}

ShapeParts parse_common(const ObjectReader& reader, const SceneBuilder& builder,
                        bool is_mesh_file) {
  ShapeParts parts;
  parts.shape.name = reader.has("name") ? reader.text("name") : reader.node().path;
  parts.shape.sides = reader.integer("sides");
  if (reader.has("material")) {
    parts.shape.material = find_material(reader.place("material"), builder);
  } else if (!is_mesh_file) {
    fail(reader.node(), "a shape needs the key \"material\" with a name from \"materials\"");
  }
  if (reader.has("emission"))
    parts.shape.emission = useful(parse_emission(reader.place("emission")));
  if (reader.has("transform")) parts.transform = read_transform(reader.place("transform"));
  return parts;
}

/// Adds the shape, for now without its triangles.
void add_mesh(const ObjectReader& reader, ShapeParts parts, RawMesh raw, SceneBuilder& builder) {
  if (!textured(builder.scene, parts.shape)) raw.uvs = {};
  builder.unplaced.push_back(
      {&reader.node(), builder.scene.shapes.size(), std::move(raw), parts.transform, parts.flip});
  builder.scene.shapes.push_back(std::move(parts.shape));
}

double similarity_scale(const ObjectReader& reader, const Affine& transform, const char* remedy) {
  const std::optional<double> scale = transform.uniform_scale();
  if (!scale)
    fail(reader.place("transform"),
         fmt::format("this shape is exact and takes only rotations, translations and uniform "
                     "scale; for others use {}",
                     remedy));
  return *scale;
}

/// What a transform makes of a center and a radius has to stay in range, as they are by themselves.
void check_reach(const ObjectReader& reader, glm::dvec3 center, double radius) {
  const double reach = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
  if (!(reach <= largest_length && radius <= largest_length && radius >= 1.0 / largest_length))
    fail(reader.place("transform"),
         fmt::format(
             "makes a center at {:g} {:g} {:g} and a radius of {:g}; coordinates reach {:g}, "
             "lengths lie between {:g} and {:g}",
             center.x, center.y, center.z, radius, largest_length, 1.0 / largest_length,
             largest_length));
}

Sphere parse_sphere(const ObjectReader& reader, const Affine& transform) {
  const double scale = similarity_scale(
      reader, transform, "a \"displaced-sphere\" with amplitude 0, which is made of triangles");
  const glm::dmat3 axes = transform.linear / scale;
  const Sphere sphere{
      transform.point(reader.vector("center")), scale * reader.number("radius"),
      glm::dmat3(glm::normalize(axes[0]), glm::normalize(axes[1]), glm::normalize(axes[2]))};
  check_reach(reader, sphere.center, sphere.radius);
  return sphere;
}

/// A direction across `normal` to which u grows, so that v grows upwards (+y) as far as it can.
glm::dvec3 upright_u_axis(glm::dvec3 normal) {
  const glm::dvec3 u = glm::cross(glm::dvec3(0.0, 1.0, 0.0), normal);
  return u == glm::dvec3(0.0) ? glm::dvec3(1.0, 0.0, 0.0) : glm::normalize(u);
}

Disk parse_disk(const ObjectReader& reader, const ShapeParts& parts) {
  const double scale =
      similarity_scale(reader, parts.transform, "a \"mesh\" or a \"rectangle\", made of triangles");
  const glm::dvec3 normal = reader.vector("normal");
  if (normal == glm::dvec3(0.0)) fail(reader.place("normal"), "a normal must not be zero");
  const glm::dvec3 world = parts.transform.normal(normal), u_axis = upright_u_axis(normal);
  const glm::dvec3 v_axis = glm::cross(glm::normalize(normal), u_axis);
  const Disk disk{parts.transform.point(reader.vector("center")), parts.flip ? -world : world,
                  scale * reader.number("radius"), glm::normalize(parts.transform.linear * u_axis),
                  glm::normalize(parts.transform.linear * v_axis)};
  check_reach(reader, disk.center, disk.radius);
  return disk;
}

RawMesh parse_rectangle(const ObjectReader& reader) {
  if (reader.exactly_one({"corner", "center"}) == "center") {
    if (reader.has("edges")) fail(reader.place("edges"), "goes with \"corner\", not \"center\"");
    if (!reader.has("size")) fail(reader.node(), "\"center\" needs \"size\" beside it");
    const glm::dvec2 size = reader.pair("size");
    return make_rectangle(reader.vector("center") - glm::dvec3(size, 0.0) * 0.5, {size.x, 0, 0},
                          {0, size.y, 0});
  }
  if (reader.has("size")) fail(reader.place("size"), "goes with \"center\", not \"corner\"");
  if (!reader.has("edges")) fail(reader.node(), "\"corner\" needs \"edges\" beside it");
  const JsonNode& edges = reader.place("edges");
  constexpr Range coordinate{-largest_length, largest_length};
  return make_rectangle(reader.vector("corner"), read_vector(edges.items[0], coordinate),
                        read_vector(edges.items[1], coordinate));
}

std::uint32_t seed_of(const ObjectReader& reader) {
  return static_cast<std::uint32_t>(reader.value("seed").number);
}

RawMesh parse_torus_knot(const ObjectReader& reader) {
  const TorusKnot knot{reader.integer("triangles"), reader.integer("p"),   reader.integer("q"),
                       reader.number("radius"),     reader.number("ring"), reader.number("tube")};
  if (std::gcd(knot.p, knot.q) != 1)
    fail(reader.node(),
         fmt::format("p = {} and q = {} have a common divisor: that is a link of several rings, "
                     "not a knot",
                     knot.p, knot.q));
  return generate(knot);
}

RawMesh parse_generated(const ObjectReader& reader, const std::string& kind, bool textured) {
  const int triangles = reader.integer("triangles");
  RawMesh mesh;
  if (kind == "shape/displaced-sphere") {
    mesh = generate(DisplacedSphere{triangles, reader.number("radius"), reader.number("amplitude"),
                                    reader.number("frequency"), reader.integer("octaves"),
                                    seed_of(reader)});
  } else if (kind == "shape/torus-knot") {
    mesh = parse_torus_knot(reader);
  } else if (kind == "shape/wave-surface") {
    mesh = generate(WaveSurface{triangles, reader.pair("size"), reader.number("amplitude"),
                                reader.integer("waves"), reader.number("wavelength"),
                                seed_of(reader)});
  } else {
    PELLUCID_CHECK(kind == "shape/height-field", "a shape of the table has no parser");
    mesh = generate(HeightField{triangles, reader.pair("size"), reader.number("height"),
                                reader.number("frequency"), reader.integer("octaves"),
                                seed_of(reader)});
  }
  if (reader.boolean("smooth")) add_smooth_normals(mesh);
  const bool closed = kind == "shape/displaced-sphere" || kind == "shape/torus-knot";
  if (textured && closed) cut_seams(mesh);
  return mesh;
}

/// Appends the model's materials with their textures; returns the index of the first.
int add_materials(Model& model, SceneBuilder& builder) {
  const int first = static_cast<int>(builder.scene.materials.size());
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    if (model.textures[i]) model.materials[i].texture = add_texture(*model.textures[i], builder);
    builder.scene.materials.push_back(std::move(model.materials[i]));
  }
  return first;
}

void parse_mesh_file(const ObjectReader& reader, const ShapeParts& parts, SceneBuilder& builder) {
  const std::filesystem::path file = std::filesystem::path(builder.folder) / reader.text("file");
  const bool own_material = reader.has("material");
  ModelOptions options;
  options.use_normals = reader.boolean("smooth");
  options.textured = own_material && textured(builder.scene, parts.shape);
  if (builder.bare_material) options.materials = ModelMaterials::lenient;
  if (own_material) options.materials = ModelMaterials::replaced;
  Model model;
  int first_material = 0;
  try {
    model = load_model(file.string(), options);
    first_material = add_materials(model, builder);
  } catch (const InputError& error) {
    if (builder.bare_material) throw;  // the place in the file says it all
    fail(reader.place("file"), error.what());
  }
  for (SourceFile& read : model.files) builder.scene.files.push_back(std::move(read));
  for (const std::string& warning : model.warnings) builder.scene.warnings.push_back(warning);
  for (const auto& [kind, where] : model.not_supported) builder.not_supported[kind].insert(where);
  for (ModelPart& part : model.parts) {
    ShapeParts piece = parts;
    if (!part.name.empty()) piece.shape.name += "/" + part.name;
    if (!own_material)
      piece.shape.material =
          part.material == no_material ? *builder.bare_material : first_material + part.material;
    if (options.textured && part.mesh.uvs.empty())
      fail(reader.place("material"),
           fmt::format("the material has a texture, but {} of '{}' has faces without texture "
                       "coordinates (vt)",
                       piece.shape.name, file.string()));
    if (std::string text = rounded_file_warning(piece.shape.name, part.mesh); !text.empty())
      builder.scene.warnings.push_back(std::move(text));
    if (!reader.has("emission") && part.emission) piece.shape.emission = useful(*part.emission);
    add_mesh(reader, std::move(piece), std::move(part.mesh), builder);
  }
}

}  // namespace

void parse_shape(const JsonNode& node, SceneBuilder& builder) {
  const ObjectSpec& spec = typed_spec(node, "shape");
  const ObjectReader reader(node, spec);
  const std::string& kind = spec.name;
  ShapeParts parts = parse_common(reader, builder, kind == "shape/mesh");
  if (kind != "shape/sphere") parts.flip = reader.boolean("flip");

  if (kind == "shape/sphere") {
    parts.shape.geometry = parse_sphere(reader, parts.transform);
    builder.scene.shapes.push_back(std::move(parts.shape));
  } else if (kind == "shape/disk") {
    parts.shape.geometry = parse_disk(reader, parts);
    builder.scene.shapes.push_back(std::move(parts.shape));
  } else if (kind == "shape/mesh") {
    parse_mesh_file(reader, parts, builder);
  } else if (kind == "shape/rectangle") {
    add_mesh(reader, std::move(parts), parse_rectangle(reader), builder);
  } else if (kind == "shape/cube") {
    const glm::dvec3 size = reader.vector("size");
    add_mesh(reader, std::move(parts), make_cube(reader.vector("center"), size), builder);
  } else {
    RawMesh mesh = parse_generated(reader, kind, textured(builder.scene, parts.shape));
    add_mesh(reader, std::move(parts), std::move(mesh), builder);
  }
}

}  // namespace pellucid
