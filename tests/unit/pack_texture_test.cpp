// Packing of textures: 8-bit pictures survive, coordinates only where they are looked at.
#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/packing.hpp>

#include "pack/pack.h"
#include "scene/mesh_tools.h"
#include "support/test_scenes.h"

namespace pellucid {
namespace {

using test::add_shape;
using test::empty_scene;

Scene textured(TextureImage image) {
  Scene scene = empty_scene();
  scene.images.push_back(std::move(image));
  scene.textures.emplace_back();
  scene.materials[0].texture = 0;
  add_shape(scene, Sphere{});
  return scene;
}

double srgb_encode(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}
double srgb_decode(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

glm::dvec3 texel(const PackedScene& packed, std::size_t i) {
  const uint rg = packed.texels[2 * i], b = packed.texels[2 * i + 1];
  return {glm::unpackHalf1x16(glm::uint16(rg & 0xffffu)),
          glm::unpackHalf1x16(glm::uint16(rg >> 16)), glm::unpackHalf1x16(glm::uint16(b))};
}

TEST(PackTexture, EightBitColoursAreKeptToATwentiethOfAStep) {
  TextureImage image{256, 1, {}};
  for (int i = 0; i < 256; ++i) image.texels.emplace_back(float(srgb_decode(i / 255.0)));
  const PackedScene packed = pack_scene(textured(image), {8});
  double worst = 0;
  for (std::size_t i = 0; i < 256; ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(srgb_encode(texel(packed, i)[c]) * 255 - double(i)));
  std::printf("8-bit sRGB through halfs: off by %.4f of a step\n", worst);
  EXPECT_LT(worst, 0.06);  // 2^-11 of the value where a step is 0.9 % of it
  EXPECT_EQ(texel(packed, 0), glm::dvec3(0));
  EXPECT_EQ(texel(packed, 255), glm::dvec3(1));
}

TEST(PackTexture, ChannelsRowsAndHeaders) {
  TextureImage image{2, 2, {{0, 0.25f, 0.5f}, {1, 1, 1}, {0.5f, 0, 1}, {0, 0, 0}}};
  Scene scene = textured(image);
  scene.images.push_back({1, 1, {glm::vec3(0.75f)}});
  scene.textures.push_back({1, TextureWrap::mirror, true, {2, 3}, {4, 5}});
  const PackedScene packed = pack_scene(scene, {8});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(texel(packed, i), glm::dvec3(image.texels[i]));
  ASSERT_EQ(packed.textures.size(), 2u);
  EXPECT_EQ(packed.textures[0].mode, TEXTURE_REPEAT);
  EXPECT_EQ(packed.textures[1].first, 4u);
  EXPECT_EQ(packed.textures[1].mode, TEXTURE_MIRROR | TEXTURE_NEAREST);
  EXPECT_EQ(packed.textures[1].scale_offset.y, 3.0f);
  EXPECT_EQ(packed.textures[1].scale_offset.z, 4.0f);
  EXPECT_TRUE(packed.features.has(FEAT_TEXTURE));
}

TEST(PackTexture, CoordinatesOnlyWhereTheyAreLookedAt) {
  Scene scene = textured({1, 1, {glm::vec3(1)}});
  scene.materials.push_back(Material{});
  const RawMesh raw = make_rectangle({}, {1, 0, 0}, {0, 1, 0});
  const auto add = [&](int material, bool with_uvs) {
    Shape& shape = add_shape(scene, test::baked(raw));
    shape.material = material;
    if (!with_uvs) return;
    for (const glm::dvec2& uv : raw.uvs) std::get<Mesh>(shape.geometry).uvs.emplace_back(uv);
  };
  add(1, false), add(0, true), add(0, false), add(1, false);
  const PackedScene packed = pack_scene(scene, {8});
  const bool expected[] = {true, false, true, false, false};
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ((packed.shapes[i].flags & SHAPE_TEXTURED) != 0, expected[i]) << i;
  ASSERT_EQ(packed.uvs.size(), 16u) << "up to the last textured mesh";
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(packed.uvs[8 + 2 * i], float(raw.uvs[i].x));
    EXPECT_EQ(packed.uvs[9 + 2 * i], float(raw.uvs[i].y));
  }
}

TEST(PackTexture, UnusedTexturesCostNothing) {
  Scene scene = textured({64, 64, std::vector<glm::vec3>(4096)});
  scene.materials.push_back(Material{});
  scene.shapes[0].material = 1;
  const PackedScene packed = pack_scene(scene, {8});
  EXPECT_FALSE(packed.features.has(FEAT_TEXTURE));
  EXPECT_EQ(packed.texels.size(), 1u);
  EXPECT_EQ(packed.uvs.size(), 1u);
}

}  // namespace
}  // namespace pellucid
