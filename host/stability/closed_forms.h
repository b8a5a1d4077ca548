// Values known exactly, in double and written apart from the kernels.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace pellucid::stability {

/// Form factor of a point with normal n to a polygon wholly above its horizon: L = rho Le F
/// [Lambert 1760].
double polygon_form_factor(const glm::dvec3& p, const glm::dvec3& n,
                           const std::vector<glm::dvec3>& corners);

/// Fresnel reflectance, mean of both polarisations, by complex refractive indices: from index
/// `from` at cosine `cos_i` into `eta - i k`.
double fresnel(double cos_i, double from, double eta, double k);

/// A lossless pane of index n with all echoes: (1 - R) / (1 + R).
double pane_transmission(double degrees, double n);

/// Where light of angle a, sine given, lands under a pane of thickness t and index n, from a point
/// D above the floor: (D - t) tan a + t tan a' from its foot, by sin a = n sin a'.
double lands_below_pane(double sine, double D, double t, double n);
/// Irradiance there, at `r` from the foot of a point light of intensity 1.
double irradiance_below_pane(double r, double D, double t, double n);

/// What a GGX interface of width alpha shows under a uniform sky of radiance 1 on both sides, seen
/// from index `near` at cosine `cos_o` into index `far` (k: its extinction): single scattering with
/// correlated Smith masking, by quadrature [Walter07; Heitz14]. Transmitted radiance scales by
/// (near / far)^2.
double ggx_reflected(double cos_o, double alpha, double near, double far, double k);
double ggx_transmitted(double cos_o, double alpha, double near, double far);

/// Albedo of energy-preserving Oren-Nayar of roughness r seen at cosine `cos_o`, in closed form
/// [Portsmouth24].
double oren_nayar_albedo(double cos_o, double rho, double r);

/// What the base of plastic sends back of light that has entered its coat of index n: the light
/// inside comes back from the coat by the share F: rho (1 - F) / (1 - rho F).
double plastic_base(double rho, double n);

/// Albedo of the modified Phong lobe (n + 2) / (2 pi) cos^n seen at cosine `cos_o`.
double phong_albedo(double cos_o, double exponent);

}  // namespace pellucid::stability
