// FLIP: how different two pictures look when one takes the other's place [Andersson20,
// Andersson21].
#pragma once

#include <cmath>

#include "image/image.h"

namespace pellucid {

/// Pixels per degree of view of the papers' observer: 0.7 m from a screen 0.7 m wide that has 3840
/// pixels.
constexpr double FLIP_PPD = 3840 * 3.14159265358979323846 / 180;
constexpr double FLIP_LEAST_PPD = 1, FLIP_MOST_PPD = 1000;

/// Both take linear images, grey ones as three equal colours, and give one channel "error" per
/// pixel, from 0 (looks the same) to 1; NaN where either image is not finite (there its colours
/// count as black for the neighbours). Throw InputError if sizes or colour channels differ.

/// Of the display pictures: values clipped to [0,1], which is what the sRGB curve shows.
Image flip_map(const Image& a, const Image& reference, double ppd = FLIP_PPD);
/// The worst over a range of exposures that shows all of the reference, by ACES's curve.
Image hdr_flip_map(const Image& a, const Image& reference, double ppd = FLIP_PPD);

/// Exposures of HDR-FLIP, in stops, evenly spaced from start to stop.
struct ExposureRange {
  double start = 0, stop = 0;
  int count = 1;
  double at(int i) const { return count < 2 ? start : start + (stop - start) * i / (count - 1); }
};
/// From the one at which the brightest pixel of the reference comes out as 0.85 to that at which
/// its median does (the median of what is not black, where more than half is). {0, 0, 1} if all is
/// black.
ExposureRange flip_exposures(const Image& reference);

/// Mean of a map; NaN if any of it is.
double mean_of_map(const Image& map);

}  // namespace pellucid
