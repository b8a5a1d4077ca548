// Materials and outgoing directions over which every lobe is tested.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "pack/pack.h"
#include "support/test_scenes.h"

namespace pellucid::test {

struct BsdfCase {
  std::string name;
  ::Material material{};
  glm::dvec3 wo{0.0, 0.0, 1.0};
  double eta = 1.0;                 ///< as in BsdfContext; 1 for opaque kinds
  double side = 1.0;                ///< of wo; only mixes with glass in them ask
  std::vector<::Material> parts{};  ///< mix: the buffer that its indices point into
  double delta_albedo = 0.0;        ///< what goes into single directions, red channel
};

::Material diffuse(const Rgb& reflectance);
::Material phong(const Rgb& diffuse, const Rgb& specular, double exponent);
::Material gold(double alpha);
::Material glass(double ior, double alpha);
::Material oren_nayar(const Rgb& reflectance, double roughness);
::Material plastic(const Rgb& reflectance, double ior, double alpha);
::Material pane(double ior);

/// Fresnel reflectance of glass from outside, written apart from the kernels.
double fresnel_of(double cosine, double ior);

/// Every kind with a density, several widths and indices, cos(wo) from 1 to 1e-3.
std::vector<BsdfCase> density_cases();

/// Relative error that float may make in the density of a microfacet case for wi although sampling
/// and evaluation agree: both know the half vector to a few roundoffs over the length of wo + wi
/// (or wo + eta wi), D varies by 4/alpha per radian, the transmittance by 1/cos_t^2 and the
/// projected facet by 1/cos.
double half_vector_error(const BsdfCase& c, const glm::dvec3& wi);

/// The axis and the scale around which the cells of the chi-square test gather.
struct LobeShape {
  glm::dvec3 axis;
  double width;
};
LobeShape reflection_shape(const BsdfCase& c);
LobeShape transmission_shape(const BsdfCase& c);

}  // namespace pellucid::test
