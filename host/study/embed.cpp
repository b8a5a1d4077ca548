// Base64, and the way there over a file: the image library writes no other.
#include "study/embed.h"

#include <filesystem>

#include "base/files.h"

namespace pellucid {

std::string base64(const std::string& bytes) {
  static const char* const letters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      out += i + k > bytes.size() ? '=' : letters[(word >> (18 - 6 * k)) & 63u];
  }
  return out;
}

Image image_of(const Picture& picture, int width, int height) {
  Image image;
  image.width = width, image.height = height;
  image.channels = {"R", "G", "B"};
  image.data = picture;
  return image;
}

std::string embedded(const Image& display, const std::string& folder) {
  const std::string file = folder + "/picture-in-work.png";
  write_image(file, display);
  const std::string bytes = read_text(file);
  std::filesystem::remove(file);
  return base64(bytes);
}

}  // namespace pellucid
