// Textures: one buffer of texels for all images, colours as half floats.
#include <fmt/format.h>

#include <glm/gtc/packing.hpp>

#include "base/error.h"
#include "pack/packer.h"

namespace pellucid {
namespace {

/// 0 to 1 by rounding to nearest: off by at most 2^-11 of the value or, below 2^-14, by 2^-25.
/// Steps of 8-bit sRGB are at least 0.8 % of the value, 16 times that.
uint half_bits(float value) {
  return glm::packHalf1x16(value);
}

uint mode_of(const Texture& texture) {
  const uint nearest = texture.nearest ? TEXTURE_NEAREST : 0u;
  switch (texture.wrap) {
    case TextureWrap::repeat:
      return TEXTURE_REPEAT | nearest;
    case TextureWrap::clamp:
      return TEXTURE_CLAMP | nearest;
    case TextureWrap::mirror:
      return TEXTURE_MIRROR | nearest;
  }
  throw InternalError("unknown way to wrap a texture");
}

}  // namespace

void pack_textures(const Scene& scene, PackedScene& out) {
  constexpr std::size_t most = std::size_t{1} << 31;  // texels are counted in 32 bits
  std::size_t total = 0;
  for (const TextureImage& image : scene.images) total += image.texels.size();
  if (total > most)
    throw InputError(
        fmt::format("the scene's textures have {} texels; the most is {} in all", total, most));
  std::vector<uint> first;
  out.texels.reserve(2 * total);
  for (const TextureImage& image : scene.images) {
    first.push_back(static_cast<uint>(out.texels.size() / 2));
    for (const glm::vec3& c : image.texels)
      out.texels.insert(out.texels.end(), {half_bits(c.r) | half_bits(c.g) << 16, half_bits(c.b)});
  }
  for (const Texture& texture : scene.textures) {
    const auto id = static_cast<std::size_t>(texture.image);
    const TextureImage& image = scene.images[id];
    out.textures.push_back({first[id], static_cast<uint>(image.width),
                            static_cast<uint>(image.height), mode_of(texture),
                            F4{float(texture.scale.x), float(texture.scale.y),
                               float(texture.offset.x), float(texture.offset.y)}});
  }
}

}  // namespace pellucid
