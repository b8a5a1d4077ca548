// Points projected onto the film against rays through it, and the density of camera rays.
#include <gtest/gtest.h>

#include "support/test_scenes.h"
#include "support/twin.h"

namespace {

using namespace twin;
using pellucid::test::Random;

::Camera camera_of(Random& random, int width, int height) {
  pellucid::Scene scene = pellucid::test::empty_scene();
  pellucid::Camera& c = scene.camera;
  c.origin = random.in_box(10);
  c.forward = random.direction();
  c.right = glm::normalize(glm::cross(c.forward, random.direction()));
  c.up = glm::cross(c.right, c.forward);
  c.fov = random.uniform(5, 120);
  scene.settings.width = width;
  scene.settings.height = height;
  return pellucid::pack_scene(scene, {SIMD_WIDTH}).camera;
}

TEST(TwinCamera, ProjectsWhatItsRaysMeet) {
  Random random(1);
  int width = 0, height = 0;
  ::Camera camera{};
  for (int i = 0; i < 20000; ++i) {
    if (i % 1000 == 0) {
      width = 100 + int(random.below(1000)), height = 100 + int(random.below(1000));
      camera = camera_of(random, width, height);
    }
    const double x = random.uniform(-10, width + 10), y = random.uniform(-10, height + 10);
    const double t = random.uniform(10, 100);
    const Ray ray = camera_ray(camera, real(x), real(y));
    FilmPosition at;
    ASSERT_TRUE(camera_project(camera, ray.o + ray.d * real(t), &at));
    // The camera is stored as floats: some roundoffs of the distance D of the film, and the point
    // itself is known to as many of the origin's coordinates over t.
    const double pixels = double(camera.forward.w) + width + height;
    EXPECT_NEAR(double(at.x), x, 1e-6 * pixels);
    EXPECT_NEAR(double(at.y), y, 1e-6 * pixels);
    EXPECT_FALSE(camera_project(camera, ray.o - ray.d * real(t), &at));
  }
}

/// Solid angle of small squares of the film times the density is their area: summed over the film,
/// the number of pixels.
TEST(TwinCamera, DensityIsOnePerPixel) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const int width = 64 + int(random.below(200)), height = 64 + int(random.below(200));
    const ::Camera camera = camera_of(random, width, height);
    const auto direction = [&](double x, double y) {
      return glm::normalize(to_dvec3(load3(camera.corner)) + x * to_dvec3(load3(camera.dx)) +
                            y * to_dvec3(load3(camera.dy)));
    };
    constexpr int steps = 64;
    const double dx = double(width) / steps, dy = double(height) / steps, h = 1e-3;
    double sum = 0;
    for (int j = 0; j < steps * steps; ++j) {
      const double x = (j % steps + 0.5) * dx, y = (j / steps + 0.5) * dy;
      const glm::dvec3 across = (direction(x + h, y) - direction(x - h, y)) / (2 * h),
                       down = (direction(x, y + h) - direction(x, y - h)) / (2 * h);
      const double pdf = double(camera_pdf_w(camera, to_real3(direction(x, y))));
      sum += pdf * glm::length(glm::cross(across, down)) * dx * dy;
    }
    EXPECT_NEAR(sum / (width * height), 1.0, 2e-5);
  }
}

}  // namespace
