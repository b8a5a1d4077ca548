// Replays: a session of one pixel and pass that writes down what happens, and sorting it.
#include "render/replay.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "render/launch.h"
#include "render/session.h"

namespace pellucid {
namespace {

struct Record {
  std::vector<PathEvent> events;
  std::array<double, 3> film{};
  float luminance = 0;
};

bool is_walk(const PathEvent& e) {
  return e.kind <= EVENT_SCATTER;
}

/// Merges know the place of their photon among all light vertices; what is asked for is its path.
void name_light_paths(Plan& plan, std::vector<PathEvent>& events) {
  const auto merged = [](const PathEvent& e) { return e.kind == EVENT_MERGE; };
  if (std::none_of(events.begin(), events.end(), merged)) return;
  const std::vector<uint> first = plan.read_words("light_first");
  for (PathEvent& e : events) {
    if (!merged(e)) continue;
    const auto after = std::upper_bound(first.begin(), first.end(), e.partner);
    e.partner = uint(after - first.begin()) - 1;
  }
}

/// Renders the pass of that one pixel. Room for the record grows until all of it is there.
Record record_pass(const Device& device, const PackedScene& scene, const Integrator& method,
                   RenderOptions options) {
  constexpr std::size_t room_at_first = 4096;
  options.record_events = room_at_first;
  for (;;) {
    Session session(device, scene, method, options);
    session.run({});
    const std::size_t wanted = session.plan().read_words("record_count").at(0);
    if (wanted > options.record_events) {
      options.record_events = wanted;
      continue;
    }
    const std::vector<uint> words = session.plan().read_words("record");
    Record record;
    record.events.resize(wanted);
    if (wanted) std::memcpy(record.events.data(), words.data(), wanted * sizeof(PathEvent));
    name_light_paths(session.plan(), record.events);
    record.film = session.film().sums(0).sum;
    record.luminance = session.film().pixels.front().peak;
    return record;
  }
}

std::array<float, 3> brought_by(const PathEvent& e) {
  return {e.brought.x, e.brought.y, e.brought.z};
}

/// What makes a sample none comes first.
float brightness(const PathEvent& e) {
  const float luminance = luminance_of(e);
  return std::isfinite(luminance) && luminance >= 0 ? luminance : PEAK_DROPPED;
}

/// Adds light up as the passes do: what is found on the way, connections, merges vertex by vertex,
/// all in order; then splats in their fixed point.
class SampleSum {
 public:
  explicit SampleSum(float splat_scale) : scale_(splat_scale) {}

  void add(const PathEvent& e) {
    const std::array<float, 3> more = brought_by(e);
    for (std::size_t c = 0; c < 3; ++c) {
      if (e.kind == EVENT_SPLAT) {
        steps_[c] += std::uint64_t(std::llrint(double(more[c] * scale_)));
      } else if (e.kind == EVENT_MERGE) {
        if (e.depth != depth_) merged_[c] += vertex_[c], vertex_[c] = 0.0f;
        vertex_[c] += more[c];
      } else {
        (e.kind == EVENT_CONNECT ? connected_ : found_)[c] += more[c];
      }
    }
    if (e.kind == EVENT_MERGE) depth_ = e.depth;
  }

  std::array<float, 3> total() const {
    std::array<float, 3> sum{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto high = float(uint(steps_[c] >> 32)), low = float(uint(steps_[c]));
      const float splats = (high * 4294967296.0f + low) / scale_;
      sum[c] = found_[c] + connected_[c] + (merged_[c] + vertex_[c]) + splats;
    }
    return sum;
  }

 private:
  float scale_;
  uint depth_ = 0;  ///< of the vertex whose merges are being added
  std::array<float, 3> found_{}, connected_{}, merged_{}, vertex_{};
  std::array<std::uint64_t, 3> steps_{};
};

}  // namespace

float luminance_of(const std::array<float, 3>& rgb) {
  return LUMINANCE_R * rgb[0] + LUMINANCE_G * rgb[1] + LUMINANCE_B * rgb[2];
}

float luminance_of(const PathEvent& event) {
  return luminance_of(brought_by(event));
}

bool Replay::adds_up() const {
  return luminance_of(sum) == luminance;
}

Integrator with_record(Integrator method) {
  method.wishes.set(INTG_RECORD);
  method.add_to_gathering(Bundle::record);
  return method;
}

Replay replay(const Device& device, const PackedScene& scene, const Integrator& method,
              const RenderOptions& asked, int x, int y, std::uint64_t pass) {
  const Integrator recording = with_record(method);
  RenderOptions options = asked;
  options.crop = Window{x, y, 1, 1};
  options.passes = PassRange{pass, pass + 1};
  options.seconds = options.error = options.known_error = std::nullopt;
  Record record = record_pass(device, scene, recording, options);

  Replay out;
  out.x = x, out.y = y, out.pass = pass;
  out.origin = scene.origin;
  out.film = record.film;
  out.luminance = record.luminance;
  SampleSum sum(
      make_launch(scene, options.width, options.height, *options.crop, options.light_path_count())
          .splat_scale);
  for (const PathEvent& e : record.events) {
    if (!is_walk(e)) sum.add(e);
    (is_walk(e) ? out.eye : out.brought).push_back(e);
  }
  out.sum = sum.total();
  // Splats come from many work-items: their order is nobody's but this.
  std::stable_sort(out.brought.begin(), out.brought.end(),
                   [](const PathEvent& a, const PathEvent& b) {
                     const float la = brightness(a), lb = brightness(b);
                     if (la != lb) return la > lb;
                     return std::pair(a.path, a.depth) < std::pair(b.path, b.depth);
                   });
  if (out.brought.empty()) return out;
  const PathEvent& brightest = out.brought.front();
  options.record_path = brightest.on_light ? brightest.path : brightest.partner;
  if (options.record_path == NONE) return out;
  for (const PathEvent& e : record_pass(device, scene, recording, options).events)
    if (is_walk(e) && e.on_light) out.light.push_back(e);
  return out;
}

}  // namespace pellucid
