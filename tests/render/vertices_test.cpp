// Sub-paths in memory: the same bits whatever room their vertices have, in whichever slices they
// are made; and what it costs to keep them in half the bytes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "render_harness.h"

namespace pellucid::test {
namespace {

constexpr int side = 24;
constexpr Sampling short_run{16, 7, {}, MIS_BALANCE};

/// Colours of compact vertices are rounded to 1/256 of the largest channel or better, directions to
/// 6e-5 rad: 4e-3 at most at either end of a connection. Colours that differ leave little of that
/// in the mean; a single light, whose walks all start with the same, leaves up to 7e-4.
constexpr double most_bias = 1e-3, most_relmse = 4e-3 * 4e-3;

const Scene& everything() {
  static const Scene scene = scene_named("everything");
  return scene;
}

const char* const methods[] = {"bdpt", "sppm", "vcm"};

Build build_of(const char* method = "bdpt") {
  Build b;
  b.method = method;
  b.width = b.height = side;
  b.sampler = Sampler::sobol;  // as the program and exact_test.cpp have it: the same kernels
  b.filter = PixelFilter::gaussian;
  return b;
}

Film film_of(const Build& build) {
  return Renderer(everything(), build).render(short_run).film;
}

std::uint64_t bytes_of_vertices(const Plan& plan) {
  const auto memory = plan.memory();
  std::uint64_t bytes = 0;
  for (const char* name : {"light_vertices", "light_order", "eye_vertices", "eye_order"})
    bytes += memory.at(name);
  return bytes;
}

std::uint64_t bytes_of_all(const Plan& plan) {
  std::uint64_t sum = 0;
  for (const auto& [name, bytes] : plan.memory()) sum += bytes;
  return sum;
}

TEST(Vertices, room_at_first_does_not_matter) {
  for (const char* method : methods)
    for (bool compact : {false, true}) {
      Build b = build_of(method);
      b.compact_vertices = compact;
      b.vertices_per_path = 64;  // enough
      const Film film = film_of(b);
      for (double room : {0.25, 0.01}) {
        b.vertices_per_path = room;
        Renderer renderer(everything(), b);
        const std::uint64_t before = bytes_of_vertices(renderer.plan());
        EXPECT_TRUE(same_film(film, renderer.render(short_run).film))
            << method << ", " << room << " per path";
        EXPECT_GT(bytes_of_vertices(renderer.plan()), before) << "nothing had to grow";
      }
    }
}

TEST(Vertices, slices_do_not_matter) {
  for (const char* method : methods) {
    const Film film = film_of(build_of(method));
    for (uint rows : {1u, 5u}) {
      Build b = build_of(method);
      b.slice_rows = rows;
      EXPECT_TRUE(same_film(film, film_of(b))) << method << ", " << rows << " rows in a slice";
      b.light_paths = 100;  // fewer than one per pixel, so that slices share some
      const Film shared = film_of(b);
      b.slice_rows = 0;
      EXPECT_TRUE(same_film(shared, film_of(b)))
          << method << ", " << rows << " rows in a slice share light paths";
    }
  }
}

TEST(Vertices, short_memory_makes_smaller_slices) {
  Build b = build_of();
  b.vertices_per_path = 0.01;
  Renderer free(everything(), b);
  const Film film = free.render(short_run).film;
  const std::uint64_t needed = bytes_of_vertices(free.plan());
  for (double part : {0.7, 0.3, 0.15}) {
    b.growth = std::uint64_t(part * double(needed));
    Renderer tight(everything(), b);
    const std::uint64_t limit = bytes_of_all(tight.plan()) + *b.growth;
    EXPECT_TRUE(same_film(film, tight.render(short_run).film)) << part << " of the memory";
    EXPECT_LE(bytes_of_all(tight.plan()), limit) << part << " of the memory";
  }
  b.growth = 1000;  // not even one row
  Renderer hopeless(everything(), b);
  try {
    hopeless.render(short_run);
    FAIL() << "1000 bytes are not enough";
  } catch (const DeviceError& e) {
    EXPECT_NE(std::string(e.what()).find("--memory"), std::string::npos) << e.what();
  }
}

/// What half the bytes change, measured with the same random numbers.
TEST(Vertices, compact_ones_are_nearly_as_good) {
  Sampling run = short_run;
  run.spp = 256;
  for (const char* name : {"everything", "equal-room", "equal-keyhole"}) {
    const Scene scene = scene_named(name);
    Build b = build_of();
    const Picture full = Renderer(scene, b).render(run);
    b.compact_vertices = true;
    const Picture compact = Renderer(scene, b).render(run);
    EXPECT_FALSE(same_film(full.film, compact.film)) << name << ": the option must matter";
    double relmse = 0;
    for (int c = 0; c < 3; ++c) {
      const auto channel = std::size_t(c);
      const double mean = full.image(c).mean, floor = 0.01 * mean;
      const double bias = compact.image(c).mean / mean - 1;
      fmt::print("{}, channel {}: mean off by {:.1e}\n", name, c, bias);
      EXPECT_LT(std::abs(bias), most_bias) << name << ", channel " << c;
      for (std::size_t i = 0; i < full.pixels.size(); ++i) {
        const double x = full.pixels[i][channel].mean, d = compact.pixels[i][channel].mean - x;
        relmse += d * d / (x * x + floor * floor) / double(3 * full.pixels.size());
      }
    }
    fmt::print("{}: relMSE {:.1e}\n", name, relmse);
    EXPECT_LT(relmse, most_relmse) << name;
  }
}

// Atomics of 64 bits, or two of 32 and a carry: whole numbers either way.
TEST(Splats, atomics_do_not_matter) {
  const Scene scene = scene_named("equal-paint");
  for (const char* method : {"light", "bdpt", "vcm"}) {
    Build b = build_of(method);
    b.specialised = true;  // another program: a short one
    const Film film = Renderer(scene, b).render(short_run).film;
    b.int64_atomics = false;
    EXPECT_TRUE(same_film(film, Renderer(scene, b).render(short_run).film)) << method;
  }
}

}  // namespace
}  // namespace pellucid::test
