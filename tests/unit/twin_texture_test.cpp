// Image textures in the kernel core: texels, wrapping and filter against values by hand, texture
// coordinates of every primitive, and what a texel does to a material.
#include <gtest/gtest.h>

#include <glm/gtc/packing.hpp>

#include "pack/packer.h"
#include "scene/parse.h"
#include "support/double_twin.h"
#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::Scene;
using pellucid::TextureWrap;
using pellucid::test::add_shape;
using pellucid::test::Random;

constexpr TextureWrap wraps[] = {TextureWrap::repeat, TextureWrap::clamp, TextureWrap::mirror};

/// A scene whose only material shows a picture of `width` x `height` greys, bottom row first, on
/// one rectangle from (0, 0, 0) to (1, 1, 0).
Scene textured_scene(int width, int height, const std::vector<float>& greys) {
  Scene scene = pellucid::test::empty_scene(1.0);
  pellucid::TextureImage image{width, height, {}};
  for (float g : greys) image.texels.emplace_back(g);
  scene.images.push_back(image);
  scene.textures.emplace_back();
  scene.materials[0].texture = 0;
  const pellucid::RawMesh raw = pellucid::make_rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  pellucid::Mesh& mesh =
      std::get<pellucid::Mesh>(add_shape(scene, pellucid::test::baked(raw)).geometry);
  for (const glm::dvec2& uv : raw.uvs) mesh.uvs.emplace_back(uv);
  return scene;
}

/// Four texels side by side: 0, 1/4, 1/2, 1.
double row_at(TextureWrap wrap, bool nearest, double u) {
  Scene scene = textured_scene(4, 1, {0.0f, 0.25f, 0.5f, 1.0f});
  scene.textures[0].wrap = wrap;
  scene.textures[0].nearest = nearest;
  const TwinScene t(scene);
  const real3 c = texture_at(&t.data, 0, real(u), real(0.5));
  EXPECT_EQ(c.x, c.y);
  EXPECT_EQ(c.x, c.z);
  return double(c.x);
}

TEST(TwinTexture, EveryHalfFrom0To1IsExact) {
  for (uint h = 0; h <= 0x3c00u; ++h)
    ASSERT_EQ(float(half_value(h)), glm::unpackHalf1x16(glm::uint16(h))) << h;
  EXPECT_EQ(half_value(1), real(0x1p-24));
  EXPECT_EQ(half_value(0x7bff), real(65504));
}

TEST(TwinTexture, TexelCentresGiveTexelsThemselves) {
  const double texels[] = {0, 0.25, 0.5, 1};
  for (TextureWrap wrap : wraps)
    for (int i = 0; i < 4; ++i)
      for (bool nearest : {false, true})
        EXPECT_EQ(row_at(wrap, nearest, (i + 0.5) / 4), texels[i]) << i;
}

TEST(TwinTexture, BilinearByHandAtAndBeyondTheBorder) {
  const struct {
    double u, repeat, clamp, mirror;
  } cases[] = {
      {0.25, 0.125, 0.125, 0.125},  // halfway between 0 and 1/4
      {0.75, 0.75, 0.75, 0.75},     // between 1/2 and 1
      {0.6875, 0.625, 0.625, 0.625},
      {0.0, 0.5, 0.0, 0.0},  // repeat: between the last and the first
      {1.0, 0.5, 1.0, 1.0},
      {0.0625, 0.25, 0.0, 0.0},  // a quarter of a texel from the border
      {-0.0625, 0.75, 0.0, 0.0},
      {-0.125, 1.0, 0.0, 0.0},  // the last texel's centre
      {-0.25, 0.75, 0.0, 0.125},
      {1.125, 0.0, 1.0, 1.0},
      {1.375, 0.25, 1.0, 0.5},
      {1.875, 1.0, 1.0, 0.0},
      {2.125, 0.0, 1.0, 0.0},
      {-3.625, 0.25, 0.0, 0.25},  // 4 to the right: 0.375 either way
      {7.625, 0.5, 1.0, 0.25},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(row_at(TextureWrap::repeat, false, c.u), c.repeat) << "repeat " << c.u;
    EXPECT_EQ(row_at(TextureWrap::clamp, false, c.u), c.clamp) << "clamp " << c.u;
    EXPECT_EQ(row_at(TextureWrap::mirror, false, c.u), c.mirror) << "mirror " << c.u;
  }
}

TEST(TwinTexture, NearestChangesHalfwayBetweenCentres) {
  for (TextureWrap wrap : wraps) {
    EXPECT_EQ(row_at(wrap, true, 0.2499), 0.0);
    EXPECT_EQ(row_at(wrap, true, 0.25), 0.25);
    EXPECT_EQ(row_at(wrap, true, 0.0), 0.0);
  }
  EXPECT_EQ(row_at(TextureWrap::repeat, true, 1.0), 0.0);
  EXPECT_EQ(row_at(TextureWrap::clamp, true, 1.0), 1.0);
  EXPECT_EQ(row_at(TextureWrap::mirror, true, 1.0), 1.0);
  EXPECT_EQ(row_at(TextureWrap::mirror, true, 1.3), 0.5);
}

TEST(TwinTexture, RowsGoUpwardsAndScaleComesBeforeOffset) {
  Scene scene = textured_scene(2, 2, {0.0f, 0.25f, 0.5f, 1.0f});
  const auto at = [](const Scene& s, double u, double v) {
    const TwinScene t(s);
    return double(texture_at(&t.data, 0, real(u), real(v)).x);
  };
  EXPECT_EQ(at(scene, 0.25, 0.25), 0.0);
  EXPECT_EQ(at(scene, 0.75, 0.25), 0.25);
  EXPECT_EQ(at(scene, 0.25, 0.75), 0.5);
  EXPECT_EQ(at(scene, 0.75, 0.75), 1.0);
  EXPECT_EQ(at(scene, 0.5, 0.5), 0.4375);
  scene.textures[0].scale = {0.5, 2};
  scene.textures[0].offset = {0.25, -0.25};
  EXPECT_EQ(at(scene, 1.0, 0.25), 0.25);  // (0.75, 0.25)
  EXPECT_EQ(at(scene, 0.0, 0.5), 0.5);    // (0.25, 0.75)
}

/// The same filter in double, written apart: a sum over texels of the infinitely repeated picture.
double reference_at(const std::vector<float>& greys, int width, int height, TextureWrap wrap,
                    double u, double v) {
  const auto index = [&](int i, int size) {
    if (wrap == TextureWrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = wrap == TextureWrap::repeat ? size : 2 * size;
    i = ((i % period) + period) % period;
    return i < size ? i : period - 1 - i;
  };
  const double x = u * width - 0.5, y = v * height - 0.5;
  double sum = 0;
  for (int j = int(std::floor(y)); j <= int(std::floor(y)) + 1; ++j)
    for (int i = int(std::floor(x)); i <= int(std::floor(x)) + 1; ++i)
      sum += (1 - std::abs(x - i)) * (1 - std::abs(y - j)) *
             double(greys[std::size_t(index(j, height) * width + index(i, width))]);
  return sum;
}

TEST(TwinTexture, AnySizeAndPlaceAgreesWithDouble) {
  Random random(3);
  double worst = 0;
  for (const glm::ivec2 size : {glm::ivec2(7, 5), {1, 3}, {2, 1}, {100, 64}})
    for (TextureWrap wrap : wraps) {
      std::vector<float> greys;
      for (int i = 0; i < size.x * size.y; ++i)
        greys.push_back(glm::unpackHalf1x16(glm::uint16(random.below(0x3c01))));
      Scene scene = textured_scene(size.x, size.y, greys);
      scene.textures[0].wrap = wrap;
      const TwinScene t(scene);
      for (int i = 0; i < 20000; ++i) {
        const real u = real(random.uniform(-3, 3)), v = real(random.uniform(-3, 3));
        const double exact = reference_at(greys, size.x, size.y, wrap, double(u), double(v));
        // Slopes are at most 1 per texel and axis; coordinates are rounded three times at up to
        // 3 times the size, and the filter itself a few times at 1.
        const double unit = is_float ? double(UNIT_ROUNDOFF) : 0x1p-53;
        const double bound = unit * (3 * 3 * (size.x + size.y) + 8);
        const double error = std::abs(double(texture_at(&t.data, 0, u, v).y) - exact);
        ASSERT_LT(error, bound) << u << " " << v;
        worst = std::max(worst, error / bound);
      }
    }
  std::printf("bilinear filter: at most %.2f of its bound\n", worst);
}

// Several images share the buffer of texels, and each texture finds its own.
TEST(TwinTexture, TexturesKeepToTheirImages) {
  Scene scene = textured_scene(1, 1, {0.25f});
  scene.images.push_back({2, 1, {glm::vec3(0.5f, 1, 0), glm::vec3(0.5f, 1, 0)}});
  scene.textures.push_back(scene.textures[0]);
  scene.textures[1].image = 1;
  const TwinScene t(scene);
  for (double u : {-5.5, 0.0, 0.3, 1.0, 1e9}) {
    EXPECT_EQ(texture_at(&t.data, 0, real(u), real(u)).x, real(0.25));
    EXPECT_EQ(texture_at(&t.data, 1, real(u), real(u)).x, real(0.5));
    EXPECT_EQ(texture_at(&t.data, 1, real(u), real(u)).y, real(1));
  }
}

TEST(TwinTexture, TurnsOfAnAngle) {
  const real s[] = {0, 1, 0, -1}, c[] = {1, 0, -1, 0}, turns[] = {0, 0.25, 0.5, -0.25};
  for (int i = 0; i < 4; ++i) EXPECT_EQ(atan2_turns(s[i], c[i]), turns[i]);
  EXPECT_EQ(atan2_turns(real(3), real(3)), real(0.125));
  EXPECT_EQ(atan2_turns(real(0), real(0)), real(0));
  double worst = 0;
  Random random(1);
  for (int i = 0; i < 1000000; ++i) {
    const real y = real(random.uniform(-1, 1)), x = real(random.uniform(-1, 1));
    const long double exact =
        std::atan2((long double)(y), (long double)(x)) / 6.28318530717958647692528676655900577L;
    worst = std::max(worst, double(std::abs((long double)atan2_turns(y, x) - exact)));
  }
  std::printf("atan2_turns: %.3f * 2^-24\n", worst / 0x1p-24);
  EXPECT_LT(worst, is_float ? 0x1p-24 : 1e-15);  // the claim
}

Surface surface_seen(const TwinScene& t, const glm::dvec3& o, const glm::dvec3& d) {
  const Ray ray = make_ray(to_real3(o), to_real3(glm::normalize(d)), REAL_MAX);
  const Hit hit = t.trace(ray);
  EXPECT_NE(hit.prim, NONE);
  return surface_at(&t.data, ray, hit);
}

// Barycentrics of these points are exact, and so must be what they interpolate.
TEST(TwinTexture, CoordinatesOfTrianglesAreInterpolated) {
  const TwinScene t(textured_scene(1, 1, {1.0f}));
  const double places[] = {0.125, 0.25, 0.5, 0.625, 0.875};
  for (double x : places)
    for (double y : places) {
      const Surface s = surface_seen(t, {x, y, 1}, {0, 0, -1});
      EXPECT_EQ(double(s.u), x);
      EXPECT_EQ(double(s.v), y);
    }
}

TEST(TwinTexture, SphereIsLongitudeAndLatitude) {
  Scene scene = textured_scene(1, 1, {1.0f});
  scene.shapes.clear();
  add_shape(scene, pellucid::Sphere{{0, 0, 0}, 2});
  const TwinScene t(scene);
  const auto uv = [&](const TwinScene& twin_scene, const glm::dvec3& from) {
    const Surface s = surface_seen(twin_scene, from, -from);
    return glm::dvec2(s.u, s.v);
  };
  EXPECT_EQ(uv(t, {0, 0, 8}), glm::dvec2(0.5, 0.5)) << "the middle faces +z";
  EXPECT_EQ(uv(t, {8, 0, 0}), glm::dvec2(0.75, 0.5));
  EXPECT_EQ(uv(t, {-8, 0, 0}), glm::dvec2(0.25, 0.5));
  EXPECT_EQ(uv(t, {0, 8, 0}).y, 1.0);
  EXPECT_EQ(uv(t, {0, -8, 0}).y, 0.0);
  EXPECT_EQ(uv(t, {0, 8, 8}), glm::dvec2(0.5, 0.75));
  EXPECT_LT(uv(t, {-1e-3, 0, -8}).x, 1e-4) << "the seam is at -z";
  EXPECT_GT(uv(t, {1e-3, 0, -8}).x, 1 - 1e-4);
  // Turned a quarter about y, and mirrored in x.
  auto& sphere = std::get<pellucid::Sphere>(scene.shapes[0].geometry);
  sphere.axes = glm::dmat3(0, 0, -1, 0, 1, 0, 1, 0, 0);
  EXPECT_EQ(uv(TwinScene(scene), {8, 0, 0}), glm::dvec2(0.5, 0.5));
  EXPECT_EQ(uv(TwinScene(scene), {0, 0, -8}), glm::dvec2(0.75, 0.5));
  sphere.axes = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
  EXPECT_EQ(uv(TwinScene(scene), {-8, 0, 0}), glm::dvec2(0.75, 0.5));
}

TEST(TwinTexture, DiskShowsTheSquareAroundIt) {
  Scene scene = textured_scene(1, 1, {1.0f});
  scene.shapes.clear();
  add_shape(scene, pellucid::Disk{{1, 2, 3}, {0, 0, 1}, 2});
  const TwinScene t(scene);
  for (double x : {-1.0, 0.0, 0.5, 1.5}) {
    const Surface s = surface_seen(t, {1 + x, 3, 8}, {0, 0, -1});
    EXPECT_EQ(double(s.u), 0.5 + x / 4);
    EXPECT_EQ(double(s.v), 0.75);
  }
}

#ifdef PELLUCID_REAL_IS_FLOAT

::Material phong_material() {
  pellucid::Material m;
  m.kind = pellucid::MaterialKind::phong;
  m.reflectance = {0.31, 0.17, 0.43};
  m.specular = {0.12, 0.33, 0.29};
  m.texture = 0;
  pellucid::FeatureSet ignored;
  return pellucid::pack_material(m, ignored);
}

Surface textured_surface() {
  Surface s{};
  s.flags = SHAPE_TEXTURED;
  s.u = s.v = 0.5f;
  return s;
}

TEST(TwinTexture, WhiteChangesNothingInAnyMaterial) {
  const TwinScene t(textured_scene(1, 1, {1.0f}));
  const Surface s = textured_surface();
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    pellucid::Material m;
    m.kind = i % 2 ? pellucid::MaterialKind::phong : pellucid::MaterialKind::diffuse;
    const auto colour = [&] {
      const double r = random.uniform(), g = random.uniform(), b = random.uniform();
      return pellucid::Rgb(r, g, b) * std::pow(10.0, random.uniform(-8, 0)) * 0.5;
    };
    m.reflectance = colour();
    m.specular = colour();
    m.texture = 0;
    pellucid::FeatureSet ignored;
    const ::Material before = pellucid::pack_material(m, ignored);
    ::Material after = before;
    apply_texture(&t.data, &s, &after);
    ASSERT_EQ(0, std::memcmp(&before, &after, sizeof before)) << i;
  }
}

// What survives is at least the albedo of every channel here, so weights stay at most 1, and no
// more than the untextured material's.
TEST(TwinTexture, RouletteGoesWithTheTexel) {
  for (float grey : {0.0f, 1e-3f, 0.5f, 1.0f}) {
    const TwinScene t(textured_scene(1, 1, {grey}));
    const Surface s = textured_surface();
    const ::Material before = phong_material();
    ::Material after = before;
    apply_texture(&t.data, &s, &after);
    EXPECT_LE(after.survive, before.survive);
    const real3 albedo = load3(after.reflectance) + load3(after.eta_specular);
    EXPECT_GE(after.survive, max3(albedo) * (1 - UNIT_ROUNDOFF));
    EXPECT_LE(after.survive, 0.43f * grey + 0.33f + 1e-6f);
    EXPECT_EQ(after.reflectance.w, before.reflectance.w) << "lobes are picked as before";
  }
}

TEST(TwinTexture, ShapesWithoutCoordinatesKeepTheBaseColour) {
  const TwinScene t(textured_scene(1, 1, {0.25f}));
  Surface s = textured_surface();
  s.flags = 0;
  ::Material m = phong_material();
  apply_texture(&t.data, &s, &m);
  EXPECT_EQ(m.reflectance.x, 0.31f);
}

#endif

}  // namespace
