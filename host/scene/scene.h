// The scene in human units: what a scene file says, after checks and with all shapes in world
// space. No OpenCL, no file formats here. Right-handed world, colours linear Rec.709.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/pixel_filter.h"

namespace pellucid {

/// Largest coordinate and length; its inverse is the smallest length. The kernels' triangle test
/// multiplies three lengths and sums a few such terms, which must stay within float.
constexpr double largest_length = 1e11;

/// Largest film: pixels per side and in all, so that pixel numbers fit 32 bits everywhere.
constexpr int largest_side = 32768, largest_film = 1 << 28;

using Rgb = glm::dvec3;  ///< linear Rec.709

/// How a surface scatters. Only the fields named beside a kind are read for it.
enum class MaterialKind {
  diffuse,     ///< Lambert: reflectance
  mirror,      ///< perfect mirror: reflectance
  dielectric,  ///< Fresnel glass: ior (inside over outside), alpha (0 = smooth)
  conductor,   ///< GGX metal: eta, k, alpha (0 = smooth)
  phong,       ///< modified Phong: reflectance (diffuse) + specular * (n+2)/(2 pi) cos^n
  oren_nayar,  ///< rough diffuse: reflectance, roughness
  plastic,     ///< diffuse under a dielectric coat: reflectance, ior (of the coat), alpha (of it)
  thin_dielectric,  ///< pane of glass without thickness: ior
  mix,              ///< weighted sum of parts
};

/// A picture in linear Rec.709 from 0 to 1, bottom row first.
struct TextureImage {
  int width = 0, height = 0;
  std::vector<glm::vec3> texels;  ///< [height][width]
};

enum class TextureWrap { repeat, clamp, mirror };

/// A picture on a surface: looked up at scale * (u, v) + offset.
struct Texture {
  int image = 0;  ///< index into Scene::images
  TextureWrap wrap = TextureWrap::repeat;
  bool nearest = false;  ///< no bilinear filter
  glm::dvec2 scale{1.0}, offset{0.0};
};

struct Material {
  std::string name;
  MaterialKind kind = MaterialKind::diffuse;
  Rgb reflectance{0.5};
  std::optional<int> texture;  ///< index into Scene::textures; multiplies reflectance
  Rgb specular{0.0};       ///< Phong: hemispherical strength of the glossy lobe at normal incidence
  double exponent = 1.0;   ///< Phong exponent n >= 0
  double ior = 1.5;        ///< dielectric, index of the inside over the outside, > 0; plastic: >= 1
  double alpha = 0.0;      ///< GGX width in [0, 1]; alpha = roughness^2
  Rgb eta{0.0}, k{0.0};    ///< conductor: complex index of refraction per channel
  double roughness = 0.0;  ///< Oren-Nayar, in [0, 1]
  std::vector<Material> parts;  ///< mix: at least one, may be mixes themselves
  double weight = 1.0;          ///< of a part in its mix; the weights of a mix add up to 1
};

/// Light that a surface gives off, the same in all directions of the emitting side(s).
struct Emission {
  Rgb radiance{1.0};  ///< W/(m^2 sr) per channel, >= 0
  int sides = 1;      ///< 1: the side the geometric normal points to; 2: both
};

/// Triangles in world space. `normals` is empty (flat) or has one unit vector per position; `uvs`
/// is empty unless the material has a texture. Front side: vertices counter-clockwise, so Ng =
/// normalize((p1-p0) x (p2-p0)).
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::uvec3> triangles;
  std::vector<glm::vec2> uvs = {};
};
struct Sphere {  ///< normal points outwards
  glm::dvec3 center{0.0};
  double radius = 1.0;
  /// Where texture coordinates lie, orthonormal: east (u = 3/4), north pole (v = 1), and the middle
  /// of the picture (u = v = 1/2).
  glm::dmat3 axes{1.0};
};
struct Disk {
  glm::dvec3 center{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit; the front side
  double radius = 1.0;
  glm::dvec3 u_axis{1.0, 0.0, 0.0}, v_axis{0.0, 1.0, 0.0};  ///< unit; texture coordinates grow so
};

/// One surface with one material. Rectangles, cubes and generated shapes arrive here as meshes.
struct Shape {
  std::string name;
  int material = 0;                  ///< index into Scene::materials
  int sides = 2;                     ///< opaque surfaces: 1 = black (but blocking) from behind
  std::optional<Emission> emission;  ///< absent: not a light
  std::variant<Mesh, Sphere, Disk> geometry;
};

struct PointLight {
  glm::dvec3 position{0.0};
  Rgb intensity{1.0};  ///< W/sr per channel
};
/// A point light through a cone: full intensity within the inner angle, none beyond the outer.
struct SpotLight {
  glm::dvec3 position{0.0};
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< unit, along the middle of the cone
  Rgb intensity{1.0};                    ///< W/sr per channel in the middle
  double inner = 0.4, outer = 0.5;       ///< radians from the middle, 0 <= inner <= outer <= pi
};
/// Power of a spot over its intensity in the middle, exactly: the falloff is a cubic of the cosine
/// with mean 1/2, so 2 pi (1 - (cos inner + cos outer) / 2), here without cancellation.
inline double spot_solid_angle(const SpotLight& spot) {
  const double i = std::sin(0.5 * spot.inner), o = std::sin(0.5 * spot.outer);
  return 2.0 * 3.14159265358979323846 * (i * i + o * o);
}

struct DirectionalLight {
  glm::dvec3 direction{0.0, -1.0, 0.0};  ///< unit, the way light travels
  Rgb irradiance{1.0};                   ///< W/m^2 on a plane facing the light
};
struct ConstantEnvironment {
  Rgb radiance{1.0};  ///< the same from all directions
};
using Light = std::variant<PointLight, SpotLight, DirectionalLight, ConstantEnvironment>;

enum class FovAxis { x, y, smaller, larger };

/// Pinhole camera. right, up, forward are unit and orthogonal; image x grows to the right, image y
/// downwards.
struct Camera {
  glm::dvec3 origin{0.0};
  glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, forward{0.0, 0.0, -1.0};
  double fov = 45.0;  ///< full angle in degrees along fov_axis, in (0, 180)
  FovAxis fov_axis = FovAxis::x;
};

/// What the scene file asks for; flags of the command line win over it.
struct RenderSettings {
  int width = 512, height = 512;
  PixelFilter filter = PixelFilter::gaussian;
  std::optional<int> spp;
  std::optional<int> max_depth;           ///< segments; absent = unlimited
  std::optional<std::string> integrator;  ///< a name from the table of integrators
};

/// A file that the scene was read from.
struct SourceFile {
  std::string path;
  std::string hash;  ///< of its bytes, taken while they were read
};

struct Scene {
  std::string name;         ///< file name without folder and suffix
  std::string path;         ///< as opened
  std::string description;  ///< the file's "description": why the scene is here
  bool closed = false;      ///< the file promises that no ray can leave it
  /// Where coordinates are counted from, in those of the file. Not 0 where the scene lies so far
  /// away that floats would round it visibly: then near its middle.
  glm::dvec3 origin{0.0};
  Camera camera;
  RenderSettings settings;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<TextureImage> images;
  std::vector<Shape> shapes;
  std::vector<Light> lights;
  std::vector<std::string> warnings;   ///< what was asked for and is not there yet, once per kind
  std::vector<std::string> notes;      ///< what was decided for the user
  std::vector<SourceFile> files;       ///< every file read, for the identity hash
  std::vector<std::string> overrides;  ///< of the command line, as given, for the identity hash
};

/// Whether the material, or a part of it, looks at texture coordinates.
inline bool textured(const Material& material) {
  for (const Material& part : material.parts)
    if (textured(part)) return true;
  return material.texture.has_value();
}
inline bool textured(const Scene& scene, const Shape& shape) {
  return textured(scene.materials[static_cast<std::size_t>(shape.material)]);
}

}  // namespace pellucid
