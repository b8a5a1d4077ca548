// From linear radiance to what a PNG holds.
#pragma once

#include "image/image.h"

namespace pellucid {

/// The IEC 61966-2-1 curve: linear to display value, v < 0 maps to 0, v > 1 is clipped to 1.
float srgb_encode(float linear);
float srgb_decode(float encoded);

/// R,G,B of a linear image as display-referred RGB: the sRGB curve alone, clipped.
Image to_display(const Image& linear);

}  // namespace pellucid
