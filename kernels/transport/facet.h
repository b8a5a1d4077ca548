// Interpolated normals that disagree with the facet they lie on, without losing light.
//
// A lobe about the shading normal would send part of its light through the facet: the facet mirrors
// it back. A camera that looks from below the shading horizon sees what its mirror image above
// would. So with f of the lobe and M, N the mirrors of the facet and of the shading plane
//   K(wo, wi) = f(No, wi) |wi.ns| + f(No, M wi) |M wi.ns|,  No: wo or N wo, what is above,
// where of wi and M wi only those count that lie on the right side of the shading plane. Its
// integral over wi is the lobe's own albedo for every wo: a white ball of few facets stays white
// to its outline, where lobes cut off at the facet leave black rims. (Mirrored light as in
// [Schuessler17], but in one step, so that each lobe is evaluated twice in the wedge between both
// planes and once elsewhere.)
//
// Walks from a light draw by the same lobes the other way round: of wi and M wi one, in proportion
// to |.ns|; then of the lobe's direction and its mirror image N the one above the facet, or one of
// both in proportion to |.ng|. Their weights are the adjoint K(wo, wi) |wo.ng| / |wi.ng| [Veach97
// 5.3.2]. All directions here are local to the shading frame, its normal on the facet's side where
// the walk is.
#ifndef PELLUCID_TRANSPORT_FACET_H
#define PELLUCID_TRANSPORT_FACET_H

#include "core/math.h"

/// The end of a pair of directions on the light's side, and its mirror image by the facet.
typedef struct LightEnd {
  real3 wi, image;
  int images;  // 1 or 2 of them lie on the right side of the shading plane; 0: nothing scatters
  real sum;    // of their |cosines| to the shading normal
} LightEnd;

/// The normal `ng` is a unit vector with ng.z >= 0; `wi` lies above it for `above` = 1, below it
/// for -1, and so should its images lie about z = 0.
INLINE LightEnd facet_light_end(real3 ng, real3 wi, real above) {
  LightEnd end;
  end.wi = wi;
  end.image = wi - ng * (REAL(2.0) * dot3(ng, wi));
  // The image is the lower one.
  real z = wi.z * above, image_z = end.image.z * above;
  end.images = !(z > REAL(0.0)) ? 0 : image_z > REAL(0.0) ? 2 : 1;
  end.sum = end.images == 2 ? z + image_z : z;
  return end;
}

/// The end on the camera's side: cosines to the facet of a direction `wo` on the right side of the
/// shading plane, and of its image in that plane. Only those above 0 can be met.
typedef struct CameraEnd {
  real cosine, image;
  real sum;  // of those above 0
} CameraEnd;

/// `above`: as in facet_light_end.
INLINE CameraEnd facet_camera_end(real3 ng, real3 wo, real above) {
  CameraEnd end;
  end.cosine = dot3(ng, wo) * above;
  end.image = end.cosine - REAL(2.0) * wo.z * above * ng.z;  // the lower one
  end.sum = end.image > REAL(0.0) ? end.cosine + end.image : end.cosine;
  return end;
}

/// Probability that a walk from a light which has drawn `wo` leaves along a direction with |cosine|
/// `cos_g` to the facet, wo itself or its image.
INLINE real facet_share(CameraEnd end, real cos_g) {
  return end.image > REAL(0.0) ? cos_g / end.sum : REAL(1.0);
}

/// The direction above or below the shading plane.
INLINE real3 facet_unfolded(real3 wo, real above) {
  return REAL3(wo.x, wo.y, r_abs(wo.z) * above);
}

#endif
