// The tables of the native scene format. Whoever adds a key adds it here, and nowhere else.
#include "scene/schema.h"

#include "base/error.h"
#include "scene/metals.h"
#include "scene/pixel_filter.h"
#include "scene/scene.h"

namespace pellucid {
namespace {

using T = FieldType;
using Fields = std::vector<Field>;

constexpr double brightest = 1e15;  // its square still fits a float
constexpr Range any{-1e30, 1e30};
constexpr Range coordinate{-largest_length, largest_length};
constexpr Range length{1.0 / largest_length, largest_length};
constexpr Range light{0.0, brightest};
constexpr Range unit{0.0, 1.0};

const Field type_field{"type", T::text, required, any, "which kind it is"};

/// The keys of one kind followed by those that its whole family shares.
Fields join(Fields own, const Fields& shared) {
  own.insert(own.end(), shared.begin(), shared.end());
  return own;
}

const Fields transform_field = {{"transform",
                                 T::array,
                                 optional,
                                 any,
                                 "steps, applied in the order written",
                                 {},
                                 "transform step"}};

Fields shape_fields(bool can_flip) {
  Fields fields = {
      type_field,
      {"name", T::text, optional, any, "for messages and object ids"},
      {"material", T::text, optional, any, "a name from \"materials\""},
      transform_field[0],
      {"sides", T::integer, "2", {1, 2}, "1: black, but blocking, from behind (opaque materials)"},
      {"emission", T::object, optional, any, "makes the surface a light", {}, "emission"},
  };
  if (can_flip)
    fields.push_back({"flip", T::boolean, "false", any, "turns the front side to the back"});
  return fields;
}

Fields generated_fields(Fields own) {
  const Fields shared = {
      {"triangles", T::integer, required, {1000, 10'000'000}, "about how many, within 10 %"},
      {"smooth", T::boolean, "true", any, "smooth shading normals, area weighted"},
  };
  return join(join(std::move(own), shared), shape_fields(true));
}

const Field seed_field{"seed", T::integer, "0", {0, 4294967295.0}, "picks another shape"};

std::vector<ObjectSpec> scene_specs() {
  return {
      {"scene",
       "a scene file",
       {
           {"$schema", T::text, optional, any,
            "for editors: where the JSON schema of this format is"},
           {"version", T::integer, required, {1, 1}, "version of the format"},
           {"description", T::text, optional, any, "why the scene is here"},
           {"closed", T::boolean, "false", any,
            "promises that no ray can leave it: those that do are counted, and warned of"},
           {"camera", T::object, required, any, "pinhole camera", {}, "camera"},
           {"film", T::object, "{}", any, "size and filter of the picture", {}, "film"},
           {"integrator",
            T::object,
            "{}",
            any,
            "method and effort; the command line wins",
            {},
            "integrator"},
           {"materials", T::map, "{}", any, "materials by name", {}, "material/"},
           {"shapes", T::array, "[]", any, "surfaces", {}, "shape/"},
           {"lights", T::array, "[]", any, "lights without a surface", {}, "light/"},
       }},
      {"camera",
       "pinhole camera",
       {
           {"origin", T::vector, required, coordinate, "where it stands"},
           {"target", T::vector, required, coordinate, "the point in the middle of the picture"},
           {"up", T::vector, "[0, 1, 0]", coordinate, "direction that is up in the picture"},
           {"fov", T::number, "45", {1e-4, 179.9}, "full angle in degrees along fovAxis"},
           {"fovAxis",
            T::choice,
            "\"x\"",
            any,
            "the axis that fov is measured along",
            {"x", "y", "smaller", "larger"}},
       }},
      {"film",
       "size and filter of the picture",
       {
           {"width", T::integer, "512", {1, largest_side}, "pixels"},
           {"height", T::integer, "512", {1, largest_side}, "pixels"},
           {"filter", T::choice, "\"gaussian\"", any,
            "how samples around a pixel's centre count; the command line wins",
            pixel_filter_names()},
       }},
      {"integrator",
       "method and effort",
       {
           {"name", T::text, optional, any, "method, as for --integrator"},
           {"spp", T::integer, optional, {1, 1 << 30}, "samples per pixel"},
           {"maxDepth", T::integer, optional, {1, 1 << 20}, "most segments of a path; absent: all"},
       }},
  };
}

/// Objects inside shapes.
std::vector<ObjectSpec> part_specs() {
  return {
      {"emission",
       "light that a surface gives off",
       {
           {"radiance", T::color, required, light, "W/(m^2 sr), the same in all directions"},
           {"sides", T::integer, "1", {1, 2}, "1: the front side; 2: both"},
       }},
      {"transform step",
       "exactly one of the keys",
       {
           {"translate", T::vector, optional, coordinate, "moves"},
           {"rotate",
            T::object,
            optional,
            any,
            "turns about an axis through the origin",
            {},
            "rotate"},
           {"scale", T::scale, optional, coordinate, "scales, per axis or alike; negative mirrors"},
           {"matrix", T::matrix, optional, coordinate, "4x4, row by row; last row 0 0 0 1"},
       }},
      {"texture",
       "an image that multiplies a material's reflectance",
       {
           {"file", T::text, required, any, "image, relative to the scene file"},
           {"wrap",
            T::choice,
            "\"repeat\"",
            any,
            "how it goes on outside 0 to 1",
            {"repeat", "clamp", "mirror"}},
           {"filter", T::choice, "\"bilinear\"", any, "between texels", {"bilinear", "nearest"}},
           {"colorSpace",
            T::choice,
            "\"auto\"",
            any,
            "auto: sRGB for 8 and 16 bits, linear for floating point",
            {"auto", "srgb", "linear"}},
           {"scale", T::pair, "[1, 1]", {-1e6, 1e6}, "factors of u and v"},
           {"offset", T::pair, "[0, 0]", {-1e6, 1e6}, "added to u and v after that"},
       }},
      {"rotate",
       "a rotation, counter-clockwise when the axis points at you",
       {
           {"axis", T::vector, required, coordinate, "direction, of any length"},
           {"degrees", T::number, required, {-36000, 36000}, "angle"},
       }},
  };
}

std::vector<ObjectSpec> material_specs() {
  const Field reflectance{"reflectance", T::color, "0.5", unit, "share of light sent back"};
  const Field texture{"texture", T::object, optional, any, "image that multiplies it",
                      {},        "texture"};
  const Fields width = {
      {"roughness", T::number, optional, unit, "alpha = roughness^2; absent: smooth"},
      {"alpha", T::number, optional, unit, "GGX width; instead of roughness"},
  };
  return {
      {"material/diffuse", "Lambert", {type_field, reflectance, texture}},
      {"material/oren-nayar",
       "rough diffuse, energy-preserving (EON)",
       {type_field,
        reflectance,
        {"roughness", T::number, "0.5", unit, "0: Lambert; 1: like dust, clay or the moon"},
        texture}},
      {"material/plastic", "diffuse base under a dielectric coat, smooth or rough (GGX)",
       join({type_field,
             reflectance,
             {"ior", T::number, "1.5", {1, 3}, "index of the coat"},
             texture},
            width)},
      {"material/mirror",
       "perfect mirror",
       {type_field, {"reflectance", T::color, "1", unit, "share of light sent back"}, texture}},
      {"material/dielectric", "glass, smooth or rough (GGX)",
       join({type_field,
             {"ior", T::number, "1.5", {0.1, 10}, "index of the inside over the outside"}},
            width)},
      {"material/thin-dielectric",
       "a pane of smooth glass without thickness",
       {type_field, {"ior", T::number, "1.5", {0.1, 10}, "index of the glass over its surround"}}},
      {"material/conductor", "metal, smooth or rough (GGX)",
       join({type_field,
             {"metal", T::choice, optional, any, "a measured metal", metal_names()},
             {"eta",
              T::color,
              optional,
              {0, 100},
              "real part of the index; with k instead of metal"},
             {"k", T::color, optional, {0, 100}, "imaginary part of the index"}},
            width)},
      {"material/phong",
       "modified Phong; diffuse + specular <= 1 in every channel",
       {
           type_field,
           {"diffuse", T::color, "0.5", unit, "share of the diffuse part"},
           {"texture",
            T::object,
            optional,
            any,
            "image that multiplies the diffuse part",
            {},
            "texture"},
           {"specular", T::color, "0.2", unit, "share of the glossy part at normal incidence"},
           {"exponent", T::number, "50", {0, 1e6}, "sharpness of the glossy part"},
       }},
  };
}

/// Materials made of others.
std::vector<ObjectSpec> blend_specs() {
  return {
      {"material/mix",
       "weighted sum of two materials",
       {
           type_field,
           {"materials", T::names, required, any, "two names from \"materials\""},
           {"amount", T::number, "0.5", unit, "weight of the second; the first has the rest"},
       }},
      {"material/principled",
       "metal, plastic and glass blended by weights",
       {
           type_field,
           {"baseColor", T::color, "0.5", unit, "of the plastic's base and of the metal"},
           {"metallic", T::number, "0", unit, "weight of the metal"},
           {"transmission", T::number, "0", unit, "weight of glass in what is no metal"},
           {"roughness", T::number, "0.5", unit, "of all of them; alpha = roughness^2"},
           {"ior", T::number, "1.5", {1, 3}, "of coat and glass"},
       }},
  };
}

std::vector<ObjectSpec> solid_specs() {
  const Field center{"center", T::vector, "[0, 0, 0]", coordinate, "middle"};
  return {
      {"shape/mesh", "triangles from an OBJ or PLY file",
       join({{"file", T::text, required, any, "OBJ or PLY file, relative to the scene file"},
             {"smooth", T::boolean, "true", any, "use the file's normals, where it has them"}},
            shape_fields(true))},
      {"shape/sphere", "exact sphere, front side outwards",
       join({center, {"radius", T::number, "1", length, "radius"}}, shape_fields(false))},
      {"shape/disk", "exact flat disk",
       join({center,
             {"normal", T::vector, "[0, 0, 1]", coordinate, "front side, of any length"},
             {"radius", T::number, "1", length, "radius"}},
            shape_fields(true))},
      {"shape/rectangle", "by corner and edges, or by center and size",
       join({{"corner", T::vector, optional, coordinate, "one corner"},
             {"edges", T::edges, optional, coordinate,
              "the two edges from it; front side = e0 x e1"},
             {"center", T::vector, optional, coordinate, "middle; lies in the xy plane, facing +z"},
             {"size", T::pair, optional, length, "extent along x and y"}},
            shape_fields(true))},
      {"shape/cube", "closed box, front side outwards",
       join({center, {"size", T::scale, "1", length, "edges along x, y, z"}}, shape_fields(true))},
  };
}

std::vector<ObjectSpec> generated_specs() {
  return {
      {"shape/displaced-sphere", "closed lump: a sphere with noise along its radius",
       generated_fields(
           {{"radius", T::number, "1", length, "mean radius"},
            {"amplitude", T::number, "0.15", {0, 0.9}, "largest change over the radius"},
            {"frequency", T::number, "3", {0.01, 1000}, "bumps per radius"},
            {"octaves", T::integer, "4", {1, 12}, "layers of finer noise"},
            seed_field})},
      {"shape/torus-knot", "closed tube along a (p,q) torus knot about the z axis",
       generated_fields(
           {{"p", T::integer, "2", {1, 20}, "turns about the axis; p and q have no common divisor"},
            {"q", T::integer, "3", {1, 20}, "turns about the ring"},
            {"radius", T::number, "1", length, "of the ring"},
            {"ring",
             T::number,
             "0.45",
             {0.01, 0.99},
             "distance of the curve from the ring / radius"},
            {"tube", T::number, "0.2", {0.001, 0.9}, "radius of the tube / radius"}})},
      {"shape/wave-surface", "sum of sine waves over the xz plane, front side up (+y)",
       generated_fields({{"size", T::pair, "[2, 2]", length, "extent along x and z"},
                         {"amplitude", T::number, "0.1", {0, largest_length}, "largest height"},
                         {"waves", T::integer, "5", {1, 64}, "how many waves"},
                         {"wavelength", T::number, "0.7", length, "of the longest wave"},
                         seed_field})},
      {"shape/height-field", "fractal ground over the xz plane, front side up (+y)",
       generated_fields(
           {{"size", T::pair, "[2, 2]", length, "extent along x and z"},
            {"height", T::number, "0.3", {0, largest_length}, "largest distance from the plane"},
            {"frequency", T::number, "3", {0.01, 1000}, "hills along the longer side"},
            {"octaves", T::integer, "6", {1, 12}, "layers of finer noise"},
            seed_field})},
  };
}

std::vector<ObjectSpec> light_specs() {
  return {
      {"light/point",
       "the same in all directions",
       {
           type_field,
           {"position", T::vector, required, coordinate, "where it stands"},
           {"intensity", T::color, optional, light, "W/sr"},
           {"power", T::color, optional, light, "W, instead of intensity"},
       }},
      {"light/spot",
       "a point light through a cone",
       {
           type_field,
           {"position", T::vector, required, coordinate, "where it stands"},
           {"target", T::vector, optional, coordinate, "a point in the middle of the cone"},
           {"direction", T::vector, optional, coordinate, "the way light travels there, instead"},
           {"intensity", T::color, optional, light, "W/sr in the middle"},
           {"power", T::color, optional, light, "W in all, instead of intensity"},
           {"angle", T::number, "60", {0.01, 360}, "full angle of the cone in degrees"},
           {"falloff", T::number, "0.2", unit, "share of the angle over which light fades out"},
       }},
      {"light/directional",
       "parallel light from infinity",
       {
           type_field,
           {"direction", T::vector, required, coordinate, "the way light travels, of any length"},
           {"irradiance", T::color, required, light, "W/m^2 on a plane facing it"},
       }},
      {"light/environment",
       "constant background",
       {
           type_field,
           {"radiance", T::color, required, light, "W/(m^2 sr) from all directions"},
       }},
  };
}

}  // namespace

const std::vector<ObjectSpec>& object_specs() {
  static const std::vector<ObjectSpec> specs = [] {
    std::vector<ObjectSpec> all = scene_specs();
    for (auto* part :
         {&part_specs, &material_specs, &blend_specs, &solid_specs, &generated_specs, &light_specs})
      for (ObjectSpec& spec : (*part)()) all.push_back(std::move(spec));
    return all;
  }();
  return specs;
}

const ObjectSpec& object_spec(const std::string& name) {
  for (const ObjectSpec& spec : object_specs())
    if (spec.name == name) return spec;
  throw InternalError("no scene table is called " + name);
}

std::vector<std::string> family_types(const std::string& family) {
  std::vector<std::string> types;
  for (const ObjectSpec& spec : object_specs())
    if (spec.name.rfind(family + "/", 0) == 0) types.push_back(spec.name.substr(family.size() + 1));
  return types;
}

}  // namespace pellucid
