// Textures in whole renders: a floor under a uniform sky shows every texel's own value, bilinear
// filtering keeps the mean, and a white texture is none.
#include <gtest/gtest.h>

#include <cmath>

#include "render_harness.h"
#include "scene/mesh_tools.h"

namespace pellucid::test {
namespace {

const char* const methods[] = {"naive", "nee", "path", "reference"};
constexpr int texels = 4, picture_size = 32, block = picture_size / texels;

/// Texel i of 16: all channels differ from each other and from texel to texel, 1/8 to 1.
glm::vec3 colour(int i) {
  return glm::vec3(float(2 + i % 15), float(16 - i), float(2 + (7 * i) % 15)) / 16.0f;
}

/// A unit square that fills the film, v upwards, under a sky of radiance 1: Lambert shows rho.
Scene textured_square(bool nearest) {
  Scene scene;
  scene.camera.origin = {0.5, 0.5, 0.5};
  scene.camera.fov = 90;
  scene.lights.push_back(ConstantEnvironment{Rgb(1.0)});
  TextureImage image{texels, texels, {}};
  for (int i = 0; i < texels * texels; ++i) image.texels.push_back(colour(i));
  scene.images.push_back(image);
  Texture texture;
  texture.nearest = nearest;
  scene.textures.push_back(texture);
  Material material;
  material.reflectance = Rgb(1.0);
  material.texture = 0;
  scene.materials.push_back(material);
  Shape shape;
  shape.geometry = bake_mesh(make_rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), {}, false).mesh;
  scene.shapes.push_back(shape);
  return scene;
}

Estimate block_of(const Picture& picture, int channel, int x0, int y0) {
  Estimate e;
  for (int y = y0; y < y0 + block; ++y)
    for (int x = x0; x < x0 + block; ++x) {
      const Estimate p = picture.pixels[std::size_t(y * picture.width + x)][std::size_t(channel)];
      e.mean += p.mean / (block * block);
      e.variance += p.variance / std::pow(block, 4);
    }
  return e;
}

TEST(Textures, EveryTexelShowsItsReflectanceUnderTheSky) {
  for (const char* method : methods) {
    Renderer renderer(textured_square(true), {method, picture_size, picture_size});
    Sampling run;
    run.spp = 4096;
    const Picture picture = renderer.render(run);
    for (int i = 0; i < texels * texels; ++i)
      for (int c = 0; c < 3; ++c) {
        const int top = texels - 1 - i / texels;  // row 0 is the bottom one
        const Estimate e = block_of(picture, c, i % texels * block, top * block);
        const double rho = colour(i)[c];
        // Neighbours differ by 1/16 or more; 5 sigma of 192 values are met once in 10^4 runs.
        EXPECT_LT(e.error(), 0.004) << method;
        EXPECT_NEAR(e.mean, rho, 5 * e.error() + 1e-6) << method << " texel " << i << " " << c;
      }
  }
}

// Bilinear weights of a picture that repeats add up to one texel each, so the mean is theirs.
TEST(Textures, BilinearFilterKeepsTheMean) {
  glm::dvec3 mean(0.0);
  for (int i = 0; i < texels * texels; ++i) mean += glm::dvec3(colour(i)) / 16.0;
  for (const char* method : methods) {
    Renderer renderer(textured_square(false), {method, picture_size, picture_size});
    Sampling run;
    run.spp = 1024;
    const Picture picture = renderer.render(run);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(judge(picture.image(c), mean[c], 1e-5), "") << method;
  }
}

TEST(Textures, WhiteIsNoTextureBitForBit) {
  Scene white = scene_named("everything"), plain = white;
  ASSERT_FALSE(white.images.empty());
  for (TextureImage& image : white.images)
    for (glm::vec3& texel : image.texels) texel = glm::vec3(1.0f);
  for (Material& material : plain.materials) material.texture.reset();
  for (const char* method : methods)
    for (bool specialised : {false, true}) {
      // Two programs more for each method; all look textures up in the same code.
      if (specialised && method != std::string("path")) continue;
      Build build;
      build.method = method;
      build.width = build.height = 24;
      build.specialised = specialised;
      const Sampling run{24, 7, {}, MIS_BALANCE};
      EXPECT_TRUE(
          same_film(session_render(white, build, run).film, session_render(plain, build, run).film))
          << method << (specialised ? ", specialised" : "");
    }
  Build build;
  build.width = build.height = 24;
  EXPECT_FALSE(same_film(session_render(white, build, {}).film,
                         session_render(scene_named("everything"), build, {}).film))
      << "the scene's own textures must matter";
}

}  // namespace
}  // namespace pellucid::test
