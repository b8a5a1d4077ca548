// From linear radiance to what a PNG holds, and from errors to colours.
#pragma once

#include <array>

#include "image/image.h"

namespace pellucid {

/// The IEC 61966-2-1 curve: linear to display value, v < 0 maps to 0, v > 1 is clipped to 1.
/// NaN maps to 0.
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// How linear values become those of a display picture.
enum class ToneCurve {
  srgb,    ///< the sRGB curve alone, clipped
  filmic,  ///< an S-shaped curve that rolls highlights off, then the sRGB curve [Narkowicz15]
  none,    ///< linear values, clipped
};
struct DisplayTransform {
  ToneCurve curve = ToneCurve::srgb;
  double exposure = 0.0;  ///< stops: values are first multiplied by 2^exposure
};

/// In [0,1]; NaN maps to 0.
float display_value(float linear, const DisplayTransform& display);

/// R,G,B of a linear image as a display picture. An image without them gives its first channel as
/// grey. Metadata says so if its values are linear.
Image to_display(const Image& linear, const DisplayTransform& display = {});

/// Colour of a place on a scale from 0 to 1: black, blue, red, yellow, white, straight lines in
/// between; NaN is green, which occurs nowhere else. Clipped.
std::array<float, 3> heat_colour(float t);

/// What the numbers of a map of errors mean, and thus their colours.
enum class ErrorScale {
  relative,         ///< on a logarithmic scale: 0.001 and less black, 0.01 blue, 0.1 red, 1 yellow,
                    ///< 10 and more white
  perceived,        ///< 0 black, over violet and orange to 1 pale yellow: matplotlib's magma
  signed_relative,  ///< white where 0.001 or less is missing or in excess, on a logarithmic scale
                    ///< to full blue (too dark) or red (too bright) at 1
  deviations,       ///< 0 white, straight to full blue at -5 and red at 5
};

/// One channel of errors as display-referred RGB, straight lines between colours; NaN is green,
/// which occurs nowhere else.
Image false_colour(const Image& error, ErrorScale scale = ErrorScale::relative);

}  // namespace pellucid
