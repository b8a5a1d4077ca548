// Exact invariances, on a scene with every effect and by every method: lengths times 2^k (numerics
// 10), short buffers (19), work-groups and atomics (22). No tolerance to argue about.
//
// Rounding commutes with powers of two, so one absolute epsilon anywhere would show. All tolerances
// are relative or in ulps (kernels/shared/limits.h), which costs nothing. Buffers of vertices grow
// where a pass asks for more, which repeats part of a pass; splats and film sums are whole numbers,
// which add up to the same in any order.
#include "stability/exact.h"

#include <fmt/format.h>

#include <vector>

#include "stability/measurements.h"

namespace pellucid::stability {
namespace {

Scene everything(const Lab& lab) {
  return lab.open_scene("everything");
}

Film film_of(const Lab& lab, const Scene& scene, const Build& build) {
  return session_render(lab, scene, build, short_run).film;
}

std::uint64_t vertex_bytes(const Plan& plan) {
  std::uint64_t bytes = 0;
  for (const auto& [name, size] : plan.memory())
    if (name == "light_vertices" || name == "eye_vertices") bytes += size;
  return bytes;
}

}  // namespace

void scale_changes_no_bit(const Lab& lab, Findings& findings) {
  const Scene scene = everything(lab);
  // -20 to 20, a fifth of them by each method unless there is time for all.
  const int stride = lab.effort > 1 ? 1 : 5;
  int m = 0;
  for (const char* method : methods) {
    std::vector<int> powers{-33, 33};
    for (int k = -20 + m++ % stride; k <= 20; k += stride)
      if (k != 0) powers.push_back(k);
    const Film film = film_of(lab, scene, build_of(method));
    std::size_t differing = 0;
    for (int k : powers)
      differing += different_pixels(film, film_of(lab, scaled(scene, k), build_of(method)));
    findings.none(
        fmt::format("pixels that differ, lengths times {} powers of 2 from 2^-33 to 2^33, {}",
                    powers.size(), method),
        differing);
  }
  files_have_no_scale(lab, findings);
}

void short_buffers_drop_nothing(const Lab& lab, Findings& findings) {
  const Scene scene = everything(lab);
  for (const char* method : {"bdpt", "sppm", "bpm", "vcm"}) {
    Build build = build_of(method);
    build.vertices_per_path = 64;  // enough
    const Film film = Renderer(lab, scene, build).render(whole_run).film;
    build.vertices_per_path = 0.01;
    Renderer renderer(lab, scene, build);
    const std::uint64_t before = vertex_bytes(renderer.plan());
    findings.none(
        fmt::format("pixels that differ with room for 0.01 vertices per path, {}", method),
        different_pixels(film, renderer.render(whole_run).film));
    findings.require(fmt::format("buffers grew, {}", method),
                     vertex_bytes(renderer.plan()) > before);
  }
}

void work_groups_change_no_bit(const Lab& lab, Findings& findings) {
  const Scene scene = everything(lab);
  for (const char* method : one_per_pass) {
    const Film film = film_of(lab, scene, build_of(method));
    std::size_t differing = different_pixels(film, film_of(lab, scene, build_of(method)));
    for (std::size_t group : {1, 256}) {
      Build build = build_of(method);
      build.group = group;
      differing += different_pixels(film, film_of(lab, scene, build));
    }
    findings.none(fmt::format("pixels that differ, again and in groups of 1 and 256, {}", method),
                  differing);
  }
  for (const char* method : {"light", "vcm"}) {
    Build build = build_of(method);
    build.int64_atomics = false;
    findings.none(
        fmt::format("pixels that differ without 64-bit atomics, {}", method),
        different_pixels(film_of(lab, scene, build_of(method)), film_of(lab, scene, build)));
  }
}

}  // namespace pellucid::stability
