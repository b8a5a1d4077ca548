// The harness on Plan (many pictures of one program) and on Session (as the program renders).
#include "stability/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "integrators/reach.h"
#include "integrators/registry.h"
#include "render/aov.h"
#include "render/launch.h"
#include "shared/limits.h"

namespace pellucid::stability {
namespace {

PackedScene pack(const Lab& lab, Scene scene, const Build& build) {
  scene.settings.width = build.width;
  scene.settings.height = build.height;
  scene.settings.filter = build.filter;
  const int lanes = build.simd_width ? build.simd_width : simd_width_for(lab.device.info());
  PackedScene packed = pack_scene(scene, {lanes});
  if (!build.roulette)
    for (::Material& m : packed.materials)
      if (m.survive > 0) m.survive = m.untextured = 1;
  return packed;
}

PlanOptions plan_options(const Lab& lab, const Build& build) {
  PlanOptions o;
  if (!build.specialised) o.extra_features = all_scene_features();
  o.sampler = build.sampler;
  o.group = build.group;
  o.simd_builtins = build.simd_builtins;
  o.compact_vertices = build.compact_vertices;
  o.vertices_per_path = build.vertices_per_path;
  o.int64_atomics = build.int64_atomics;
  o.float_mode = build.float_mode;
  o.launch_items = build.launch_items;
  o.kernel_dir = lab.kernel_dir;
  return o;
}

RenderOptions render_options(const Lab& lab, const Build& build) {
  RenderOptions o;
  o.width = build.width;
  o.height = build.height;
  if (build.light_paths) o.light_paths = build.light_paths;
  if (build.radius > 0) o.radius = build.radius;
  o.radius_alpha = build.radius_alpha;
  o.merge_first_only = build.merge_first_only;
  o.plan = plan_options(lab, build);
  return o;
}

MemoryPlan memory_plan(const Lab& lab, const PackedScene& packed, const Build& build) {
  MemoryPlan plan = plan_memory(lab.device.info(), packed, find_integrator(build.method),
                                render_options(lab, build));
  if (build.slice_rows) plan.slice_rows = build.slice_rows;
  if (build.growth) plan.limit = plan.device_bytes() + *build.growth;
  return plan;
}

void require_no_errors(const std::string& method, const std::vector<Counter>& counters) {
  if (error_count(counters) > 0) throw NumericError(method + ": " + describe_counters(counters));
}

}  // namespace

double Estimate::error() const {
  return std::sqrt(variance);
}

Picture::Picture(Film accumulated)
    : width(accumulated.window.width),
      height(accumulated.window.height),
      film(std::move(accumulated)),
      pixels(film.pixels.size()) {
  const Image image = film_image(film, true, false);
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
      const Film::Sums s = film.sums(std::size_t(y * width + x));
      sum += s.sum[std::size_t(channel)];
      square += s.square[std::size_t(channel)];
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

Estimate Picture::tile(int channel, int t) const {
  const int w = width / TILES_ACROSS, h = height / TILES_ACROSS;
  const int x0 = t % TILES_ACROSS * w, y0 = t / TILES_ACROSS * h;
  Estimate e;
  for (int y = y0; y < y0 + h; ++y)
    for (int x = x0; x < x0 + w; ++x) {
      const Estimate& p = pixels[std::size_t(y * width + x)][std::size_t(channel)];
      e.mean += p.mean / (w * h);
      e.variance += p.variance / (double(w * h) * (w * h));
    }
  return e;
}

std::size_t different_pixels(const Film& a, const Film& b) {
  if (a.pixels.size() != b.pixels.size()) return std::max(a.pixels.size(), b.pixels.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    n += std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(FilmPixel)) != 0;
  return n;
}

bool same_film(const Film& a, const Film& b) {
  return different_pixels(a, b) == 0 && a.passes.text() == b.passes.text() && a.lsb == b.lsb &&
         a.current == b.current && a.open == b.open && a.layers == b.layers;
}

Renderer::Renderer(const Lab& lab, const Scene& scene, const Build& build)
    : build_(build),
      packed_(pack(lab, scene, build)),
      plan_(lab.device, packed_, find_integrator(build.method), render_options(lab, build),
            memory_plan(lab, packed_, build)) {}

void Renderer::check_counters() {
  std::vector<Counter> counters = make_counters();
  plan_.collect(counters, cuts_);
  for (const Counter& c : counters)
    if (c.name == "escaped") escapes_ += c.count;
  require_no_errors(build_.method, counters);
}

Launch Renderer::launch_for(const Sampling& run) {
  Launch launch = make_launch(packed_, build_.width, build_.height,
                              {0, 0, build_.width, build_.height}, build_.light_paths);
  launch.seed = uint(run.seed) * 2654435769u + 12345u;  // any spread will do
  launch.max_depth = run.max_depth.value_or(NONE);
  launch.mis = run.mis;
  return launch;
}

Film Renderer::black_film(const Launch& launch) {
  const std::uint64_t block = plan_.specialisation().features.has(INTG_SOBOL) ? SOBOL_BLOCK : 1u;
  Film film(build_.width, build_.height, {0, 0, build_.width, build_.height}, launch.film_lsb,
            block);
  plan_.write_film(film.pixels.data(), film.pixels.size());
  return film;
}

void Renderer::advance(Film& film, Launch launch, std::uint64_t passes) {
  constexpr std::uint64_t queue_length = 1024;
  PELLUCID_CHECK(passes % film.block_size == 0, "pictures are made of whole blocks");
  const std::uint64_t done = film.passes.count();
  for (std::uint64_t i = done; i < passes; ++i) {
    launch.iteration = uint(i);
    launch.block_ends = (i + 1) % film.block_size == 0;
    plan_.enqueue(launch);
    if (i % queue_length == queue_length - 1) plan_.finish();
  }
  plan_.finish();
  check_counters();
  plan_.read_film(film.pixels.data(), film.pixels.size());
  film.passes.add({done, passes});
  add_cut_paths(cuts_, launch, find_integrator(build_.method).walks_from_lights(), passes - done);
}

Picture Renderer::render(const Sampling& run) {
  const Launch launch = launch_for(run);
  Film film = black_film(launch);
  advance(film, launch, run.spp);
  return Picture(std::move(film));
}

std::pair<Picture, ErrorEstimate> Renderer::render_to(double target, const Sampling& run) {
  const Launch launch = launch_for(run);
  Film film = black_film(launch);
  ErrorEstimate error(
      target, film,
      least_effective(find_integrator(build_.method), optics_of(packed_, run.max_depth)));
  while (film.passes.count() < run.spp && !error.reached()) {
    advance(film, launch, error.border());
    error.observe(film);
  }
  return {Picture(std::move(film)), std::move(error)};
}

Measured Renderer::measure(const Sampling& run) {
  Measured m{};
  const Integrator& method = find_integrator(build_.method);
  if (!method.uses(Bundle::splat) && !method.uses(Bundle::grid)) {
    const Picture picture = render(run);
    m.pixels = picture.pixels;
    for (std::size_t c = 0; c < 3; ++c) {
      m.image[c] = picture.image(int(c));
      for (std::size_t t = 0; t < m.tiles.size(); ++t) m.tiles[t][c] = picture.tile(int(c), int(t));
    }
    return m;
  }
  constexpr std::uint64_t parts = 32;
  const auto add = [](Estimate& e, double x, std::uint64_t n) {  // [Welford62], n values so far
    const double d = x - e.mean;
    e.mean += d / double(n + 1);
    e.variance += d * (x - e.mean) / double(parts * (parts - 1));
  };
  m.pixels.resize(std::size_t(build_.width) * std::size_t(build_.height));
  Sampling part = run;
  part.spp = (run.spp + parts - 1) / parts;
  for (std::uint64_t k = 0; k < parts; ++k) {
    part.seed = run.seed + 7919 * k;
    const Picture picture = render(part);
    for (std::size_t c = 0; c < 3; ++c) {
      add(m.image[c], picture.image(int(c)).mean, k);
      for (std::size_t t = 0; t < m.tiles.size(); ++t)
        add(m.tiles[t][c], picture.tile(int(c), int(t)).mean, k);
      for (std::size_t i = 0; i < m.pixels.size(); ++i)
        add(m.pixels[i][c], picture.pixels[i][c].mean, k);
    }
  }
  return m;
}

std::uint64_t Renderer::spp_for(const Sampling& run, double relative, std::uint64_t most) {
  Sampling pilot = run;
  pilot.spp = 256;
  pilot.seed = run.seed + 1000003;
  const Measured measured = measure(pilot);
  double worst = 0;
  for (const Estimate& e : measured.image)
    if (e.mean > 0) worst = std::max(worst, e.variance / (e.mean * e.mean));
  const double spp = double(pilot.spp) * worst / (relative * relative);
  return std::clamp(std::uint64_t(spp) + 1, std::uint64_t{16}, most);
}

std::map<std::string, std::vector<float>> first_surfaces(const Lab& lab, const Scene& scene,
                                                         const std::vector<std::string>& channels,
                                                         int size) {
  RenderOptions options;
  options.width = options.height = size;
  options.plan.extra_features = all_scene_features();
  options.plan.kernel_dir = lab.kernel_dir;
  std::vector<Counter> counters = make_counters();
  std::map<std::string, std::vector<float>> aov;
  const auto found =
      render_aovs(lab.device, pack(lab, scene, {"path", size, size}), channels, options, counters);
  for (const AovChannel& channel : *found) aov[channel.name] = channel.data;
  return aov;
}

Picture session_render(const Lab& lab, const Scene& scene, const Build& build, const Sampling& run,
                       const RenderHooks& hooks) {
  const PackedScene packed = pack(lab, scene, build);
  RenderOptions o = render_options(lab, build);
  o.passes = PassRange{0, run.spp};
  o.seed = run.seed;
  o.max_depth = run.max_depth;
  o.mis = run.mis;
  Session session(lab.device, packed, find_integrator(build.method), o);
  session.run(hooks);
  require_no_errors(build.method, session.counters());
  return Picture(session.film());
}

}  // namespace pellucid::stability
