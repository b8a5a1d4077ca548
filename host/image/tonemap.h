// From linear radiance to what a PNG holds, and from errors to colours.
#pragma once

#include "image/image.h"

namespace pellucid {

/// The IEC 61966-2-1 curve: linear to display value, v < 0 maps to 0, v > 1 is clipped to 1.
/// NaN maps to 0.
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// R,G,B of a linear image as display-referred RGB: the sRGB curve alone, clipped. An image without
/// them gives its first channel as grey.
Image to_display(const Image& linear);

/// One channel of relative errors as display-referred RGB on a logarithmic scale: 0.001 and less
/// black, 0.01 blue, 0.1 red, 1 yellow, 10 and more white, straight lines in between; NaN is green,
/// which occurs nowhere else.
Image false_colour(const Image& error);

}  // namespace pellucid
