// Textures of the scene file and of MTL files, and their images.
#include <fmt/format.h>

#include <filesystem>

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "image/tonemap.h"
#include "scene/parse.h"
#include "scene/text_file.h"

namespace pellucid {
namespace {

/// Texels of one image, and bytes of its file: 16384 x 16384 are 2 GiB on the device.
constexpr std::size_t most_texels = std::size_t{1} << 28, most_bytes = std::size_t{8} << 30;

/// The channels that hold red, green and blue; an image without them is grey.
glm::ivec3 colour_channels(const Image& image) {
  const glm::ivec3 rgb(image.channel("R"), image.channel("G"), image.channel("B"));
  return glm::all(glm::greaterThanEqual(rgb, glm::ivec3(0))) ? rgb : glm::ivec3(0);
}

/// Refuses what cannot be a share of reflected light. Texels are named as image viewers count them.
void check_texel(const std::string& path, const glm::vec3& texel, int x, int y) {
  for (int c = 0; c < 3; ++c)
    if (!(texel[c] >= 0.0f && texel[c] <= 1.0f))
      throw InputError(fmt::format(
          "texture '{}' has the value {:g} in channel {} of its texel ({}, {}), counted from the "
          "top left; reflectances lie in 0 to 1, so scale the image",
          path, texel[c], "rgb"[c], x, y));
}

TextureImage read_texture(const std::string& path, const std::string& color_space) {
  check_file(path, "texture", most_bytes);
  const Image image = read_image(path, color_space == "auto", most_texels);
  const bool decode = color_space == "srgb";
  const glm::ivec3 from = colour_channels(image);
  TextureImage texture{image.width, image.height, {}};
  texture.texels.reserve(std::size_t(image.width) * std::size_t(image.height));
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x) {
      const float* pixel =
          &image.data[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) *
                      image.channels.size()];
      glm::vec3 texel(pixel[from.r], pixel[from.g], pixel[from.b]);
      check_texel(path, texel, x, y);
      if (decode)
        for (int c = 0; c < 3; ++c) texel[c] = srgb_decode(texel[c]);
      texture.texels.push_back(texel);
    }
  return texture;
}

/// Index of an image, read at its first use.
int image_of(const std::string& path, const std::string& color_space, SceneBuilder& builder) {
  std::error_code ignored;
  const std::filesystem::path same = std::filesystem::weakly_canonical(path, ignored);
  const std::string key = color_space + ":" + (ignored ? path : same.string());
  const auto found = builder.image_index.find(key);
  if (found != builder.image_index.end()) return found->second;
  builder.scene.images.push_back(read_texture(path, color_space));
  builder.scene.files.push_back(source_file(path, read_text(path)));
  return builder.image_index[key] = static_cast<int>(builder.scene.images.size()) - 1;
}

int add(const Texture& texture, SceneBuilder& builder) {
  builder.scene.textures.push_back(texture);
  return static_cast<int>(builder.scene.textures.size()) - 1;
}

}  // namespace

int parse_texture(const JsonNode& node, SceneBuilder& builder) {
  const ObjectReader reader(node, object_spec("texture"));
  const std::string wrap = reader.text("wrap");
  Texture texture;
  texture.wrap = wrap == "repeat"  ? TextureWrap::repeat
                 : wrap == "clamp" ? TextureWrap::clamp
                                   : TextureWrap::mirror;
  texture.nearest = reader.text("filter") == "nearest";
  texture.scale = reader.pair("scale");
  texture.offset = reader.pair("offset");
  const std::filesystem::path file = std::filesystem::path(builder.folder) / reader.text("file");
  try {
    texture.image = image_of(file.string(), reader.text("colorSpace"), builder);
  } catch (const InputError& error) {
    fail(reader.place("file"), error.what());
  }
  return add(texture, builder);
}

int add_texture(const MtlTexture& mtl, SceneBuilder& builder) {
  Texture texture;
  texture.wrap = mtl.clamp ? TextureWrap::clamp : TextureWrap::repeat;
  texture.scale = mtl.scale;
  texture.offset = mtl.offset;
  try {
    texture.image = image_of(mtl.file, "auto", builder);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", mtl.place, error.what()));
  }
  return add(texture, builder);
}

}  // namespace pellucid
