// The harness on Plan (many pictures of one program) and on Session (as the program renders).
#include "render_harness.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "integrators/registry.h"
#include "scene/load.h"

namespace pellucid::test {
namespace {

PackedScene pack(Scene scene, const Build& build) {
  scene.settings.width = build.width;
  scene.settings.height = build.height;
  const int lanes = build.simd_width ? build.simd_width : simd_width_for(test_device().info());
  return pack_scene(scene, {lanes});
}

PlanOptions plan_options(const Build& build) {
  PlanOptions o;
  if (!build.specialised) o.extra_features = all_scene_features();
  o.group = build.group;
  o.simd_builtins = build.simd_builtins;
  // Mutation tests point this at a copy of kernels/ with a planted fault.
  if (const char* folder = std::getenv("PELLUCID_TEST_KERNELS")) o.kernel_dir = folder;
  return o;
}

/// Difference of two sums of two floats each, good to 2^-48 of the larger.
void subtract(const F4& a, const F4& a_low, const F4& b, const F4& b_low, F4& high, F4& low) {
  const auto one = [](float a1, float a2, float b1, float b2, float& h, float& l) {
    const double d = (double(a1) - double(b1)) + (double(a2) - double(b2));
    h = float(d);
    l = float(d - double(h));
  };
  one(a.x, a_low.x, b.x, b_low.x, high.x, low.x);
  one(a.y, a_low.y, b.y, b_low.y, high.y, low.y);
  one(a.z, a_low.z, b.z, b_low.z, high.z, low.z);
}

void expect_no_errors(const std::vector<Counter>& counters) {
  EXPECT_EQ(error_count(counters), 0u) << describe_counters(counters);
}

}  // namespace

double tier_tolerance() {
  const char* tier = std::getenv("PELLUCID_TIER");
  return tier && std::string(tier) == "full" ? 0.005 : 0.015;
}

double tier_effort() {
  const double ratio = 0.015 / tier_tolerance();
  return ratio * ratio;
}

const Device& test_device() {
  static const Device device = [] {
    const char* spec = std::getenv("PELLUCID_DEVICE");
    return Device::open(spec ? spec : "");
  }();
  return device;
}

Scene scene_named(const std::string& name) {
  const std::string root = PELLUCID_SOURCE_DIR;
  return load_scene(find_scene(name, {root + "/tests/render/scenes", root + "/scenes"}));
}

double Estimate::error() const {
  return std::sqrt(variance);
}

Picture::Picture(std::vector<FilmPixel> accumulated, int w, int h)
    : width(w), height(h), film(std::move(accumulated)), pixels(film.size()) {
  const Image image = film_image(film, w, h, true, false);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      pixels[i][c] = {image.data[6 * i + c], image.data[6 * i + 3 + c]};
}

Estimate Picture::image(int channel) const {
  Estimate e;
  const double n = double(pixels.size());
  for (const auto& p : pixels) {
    e.mean += p[std::size_t(channel)].mean / n;
    e.variance += p[std::size_t(channel)].variance / (n * n);
  }
  return e;
}

double Picture::effective_samples(int channel, int x0, int y0, int block) const {
  double sum = 0, square = 0;
  for (int y = y0; y < std::min(y0 + block, height); ++y)
    for (int x = x0; x < std::min(x0 + block, width); ++x) {
      const FilmPixel& p = film[std::size_t(y * width + x)];
      const float s[3] = {p.sum.x, p.sum.y, p.sum.z};
      const float q[3] = {p.square.x, p.square.y, p.square.z};
      sum += s[channel];
      square += q[channel];
    }
  return square > 0 ? sum * sum / square : 0;
}

double Picture::block_mean(int channel, int x0, int y0, int block) const {
  double sum = 0;
  int n = 0;
  for (int y = y0; y < std::min(y0 + block, height); ++y)
    for (int x = x0; x < std::min(x0 + block, width); ++x, ++n)
      sum += pixels[std::size_t(y * width + x)][std::size_t(channel)].mean;
  return sum / n;
}

bool same_film(const std::vector<FilmPixel>& a, const std::vector<FilmPixel>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

Renderer::Renderer(const Scene& scene, const Build& build)
    : build_(build),
      packed_(pack(scene, build)),
      plan_(test_device(), packed_, find_integrator(build.method), plan_options(build),
            uint(build.width), uint(build.height)),
      before_(std::size_t(build.width) * std::size_t(build.height)) {}

void Renderer::check_counters() {
  std::vector<Counter> counters = make_counters();
  plan_.collect(counters);
  expect_no_errors(counters);
}

Picture Renderer::render(const Sampling& run) {
  constexpr std::uint64_t queue_length = 1024;
  Launch launch{};
  launch.width = launch.tile_width = uint(build_.width);
  launch.height = launch.tile_height = uint(build_.height);
  launch.seed = uint(run.seed) * 2654435769u + 12345u;  // any spread will do
  launch.max_depth = run.max_depth.value_or(NONE);
  launch.mis = run.mis;
  for (std::uint64_t i = 0; i < run.spp; ++i) {
    launch.iteration = uint(i);
    plan_.enqueue(launch);
    if (i % queue_length == queue_length - 1) plan_.finish();
  }
  plan_.finish();
  check_counters();
  const std::vector<FilmPixel> after = plan_.read_film();
  std::vector<FilmPixel> added(after.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    subtract(after[i].sum, after[i].sum_low, before_[i].sum, before_[i].sum_low, added[i].sum,
             added[i].sum_low);
    subtract(after[i].square, after[i].square_low, before_[i].square, before_[i].square_low,
             added[i].square, added[i].square_low);
    added[i].count.x = after[i].count.x - before_[i].count.x;
  }
  before_ = after;
  return Picture(std::move(added), build_.width, build_.height);
}

std::uint64_t Renderer::spp_for(const Sampling& run, double relative, std::uint64_t most) {
  Sampling pilot = run;
  pilot.spp = 256;
  pilot.seed = run.seed + 1000003;
  const Picture picture = render(pilot);
  double worst = 0;
  for (int c = 0; c < 3; ++c) {
    const Estimate e = picture.image(c);
    if (e.mean > 0) worst = std::max(worst, e.variance / (e.mean * e.mean));
  }
  const double spp = double(pilot.spp) * worst / (relative * relative);
  return std::clamp(std::uint64_t(spp) + 1, std::uint64_t{16}, most);
}

Picture session_render(const Scene& scene, const Build& build, const Sampling& run,
                       const RenderHooks& hooks) {
  const PackedScene packed = pack(scene, build);
  RenderOptions o;
  o.width = build.width;
  o.height = build.height;
  o.spp = run.spp;
  o.seed = run.seed;
  o.max_depth = run.max_depth;
  o.mis = run.mis;
  o.plan = plan_options(build);
  Session session(test_device(), packed, find_integrator(build.method), o);
  session.run(hooks);
  expect_no_errors(session.counters());
  return Picture(session.film(), build.width, build.height);
}

std::string judge(const Estimate& e, double expected, double slack) {
  constexpr double sigmas = 4.5;
  const double off = std::abs(e.mean - expected), width = sigmas * e.error() + slack * expected;
  const std::string found =
      fmt::format("{:.7g} +- {:.2g} ({:+.3f} %, {:.2f} sigma) instead of {:.7g}", e.mean, e.error(),
                  100 * (e.mean / expected - 1), off / e.error(), expected);
  if (!(off <= width)) return "WRONG: " + found;
  if (!(off + width <= tier_tolerance() * expected)) return "INCONCLUSIVE, too noisy: " + found;
  return "";
}

}  // namespace pellucid::test
