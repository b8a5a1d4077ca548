// Pictures as text: PNG in base64, as pages and documents embed them.
#pragma once

#include <string>

#include "image/image.h"
#include "study/picture_stack.h"

namespace pellucid {

std::string base64(const std::string& bytes);

/// R, G, B as an image.
Image image_of(const Picture& picture, int width, int height);

/// The display picture as PNG in base64; `folder` takes a file for a moment.
std::string embedded(const Image& display, const std::string& folder);

}  // namespace pellucid
