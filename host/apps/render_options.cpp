// Options of `render`: checks, and their meaning.
#include "apps/render_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <tuple>

#include "apps/common.h"
#include "apps/outputs.h"
#include "apps/scene_input.h"
#include "base/error.h"
#include "base/text.h"
#include "integrators/registry.h"
#include "render/aov.h"
#include "render/checkpoint.h"
#include "shared/limits.h"

namespace pellucid {
namespace {

uint parse_mis(const std::string& text, const Integrator& method) {
  if (text != "balance" && text != "power" && text != "max")
    throw UsageError("--mis: '" + text + "' is none of balance, power, max." +
                     did_you_mean(text, {"balance", "power", "max"}));
  if (text != "balance" && !method.weighs)
    throw UsageError("--mis " + text + " has no effect on '" + method.name +
                     "', which combines nothing");
  if (text == "max" && (method.wishes.has(INTG_CONNECT) || method.merges_everywhere()))
    throw UsageError("--mis max is for `path` and `sppm` alone: '" + method.name +
                     "' weighs too many strategies to look for the best");
  return text == "power" ? MIS_POWER : text == "max" ? MIS_MAX : MIS_BALANCE;
}

/// Passes to have in the end; none where only time or error ends the render.
std::optional<PassRange> pass_range(const RenderFlags& flags, const Scene& scene) {
  constexpr std::uint64_t default_spp = 64;
  if (!flags.passes.empty()) {
    const PassRange range = parse_passes("--passes", flags.passes);
    if (flags.spp && range.last > flags.spp)
      throw UsageError(
          fmt::format("--passes {} goes beyond the {} passes of --spp", flags.passes, flags.spp));
    return range;
  }
  if (flags.spp) return PassRange{0, flags.spp};
  if (!flags.time.empty() || !flags.error.empty()) return std::nullopt;
  return PassRange{0, scene.settings.spp ? std::uint64_t(*scene.settings.spp) : default_spp};
}

double wanted_error(const std::string& text) {
  const double error = parse_fraction("--error", text);
  if (!(error > 0 && error <= 1))
    throw UsageError("--error takes a part above 0 and up to 1 such as 1% or 0.01, not '" + text +
                     "'");
  return error;
}

std::string one_of(const std::string& option, const std::string& text,
                   const std::vector<std::string>& choices) {
  if (std::find(choices.begin(), choices.end(), text) != choices.end()) return text;
  throw UsageError(option + ": '" + text + "' is none of " + join(choices) + "." +
                   did_you_mean(text, choices));
}

/// What concerns merging. Throws UsageError where the method does none.
void set_merging(const RenderFlags& flags, const Integrator& method, RenderOptions& o) {
  for (const auto& [option, text] :
       {std::pair{"--radius", &flags.radius}, {"--radius-alpha", &flags.radius_alpha}})
    if (!text->empty() && !method.wishes.has(INTG_MERGE))
      throw UsageError(std::string(option) + " has no effect on '" + method.name +
                       "', which merges nothing");
  if (!flags.radius.empty()) o.radius = parse_radius(flags.radius);
  if (!flags.radius_alpha.empty()) o.radius_alpha = parse_radius_alpha(flags.radius_alpha);
}

/// Which vertices merge. Throws UsageError where the method has no choice.
void set_merges(const RenderFlags& flags, const Integrator& method, RenderOptions& o) {
  if (flags.merges.empty()) return;
  if (!method.merges_everywhere())
    throw UsageError("--merges has no effect on '" + method.name + "'");
  o.merge_first_only = one_of("--merges", flags.merges, {"all", "first"}) == "first";
}

/// What concerns sub-paths from lights. Throws UsageError where the method has none.
void set_sub_paths(const RenderFlags& flags, const Integrator& method, RenderOptions& o) {
  if (flags.light_paths) {
    if (!method.walks_from_lights())
      throw UsageError("--light-paths has no effect on '" + method.name + "', which traces none");
    o.light_paths = uint(flags.light_paths);
  }
  set_merging(flags, method, o);
  set_merges(flags, method, o);
  if (flags.vertices.empty()) return;
  o.plan.compact_vertices = one_of("--vertices", flags.vertices, {"full", "compact"}) == "compact";
  if (!method.uses(Bundle::light_vertices))
    throw UsageError("--vertices has no effect on '" + method.name + "', which stores none");
}

/// Throws UsageError where the method has nothing to put into a layer that `option` asks for.
void check_layer(const LayerInfo& layer, const std::string& option, const Integrator& method) {
  if (!layer.needs || method.wishes.has(*layer.needs)) return;
  std::vector<std::string> others;
  for (const Integrator& other : integrators())
    if (other.wishes.has(*layer.needs)) others.push_back(other.name);
  throw UsageError(
      fmt::format("{}: '{}' {}; {}", option, method.name, layer.without,
                  others.empty() ? "no method here does" : "methods that do: " + join(others)));
}

}  // namespace

double parse_radius(const std::string& text) {
  const double radius = parse_number("--radius", text);
  if (!(radius >= MERGE_RADIUS_MIN && radius <= MERGE_RADIUS_MAX))
    throw UsageError(fmt::format("--radius takes a length from {:.2g} to {:.2g}, not '{}'",
                                 MERGE_RADIUS_MIN, MERGE_RADIUS_MAX, text));
  return radius;
}

double parse_radius_alpha(const std::string& text) {
  const double alpha = parse_number("--radius-alpha", text);
  if (!(alpha > 0 && alpha <= 1))
    throw UsageError("--radius-alpha takes a number above 0 and up to 1, not '" + text + "'");
  return alpha;
}

LoadOptions RenderFlags::load_options() const {
  LoadOptions o;
  o.overrides = overrides;
  if (!size.empty()) o.size = parse_size("--size", size);
  return o;
}

void RenderFlags::override_settings(RenderSettings& settings) const {
  if (!filter.empty())
    settings.filter = find_pixel_filter(one_of("--filter", filter, pixel_filter_names()));
}

uint RenderFlags::layer_kinds() const {
  uint kinds = (atlas.empty() ? 0 : LAYERS_TECH) | (grid.empty() ? 0 : LAYERS_GRID);
  for (const LayerInfo& info : layer_table())
    if (std::find(aovs.begin(), aovs.end(), info.name) != aovs.end()) kinds |= info.kind;
  return kinds;
}

const Integrator& RenderFlags::plain_method(const Scene& s) const {
  return choose_integrator(integrator, s);
}

Integrator RenderFlags::method(const Scene& s) const {
  constexpr uint default_length = 5;
  const Integrator& plain = plain_method(s);
  const uint kinds = layer_kinds();
  for (const LayerInfo& layer : layer_table()) {
    const bool by_name = std::find(aovs.begin(), aovs.end(), layer.name) != aovs.end();
    if (kinds & layer.kind) check_layer(layer, by_name ? "--aov " + layer.name : "--grid", plain);
  }
  return with_layers(plain, kinds, aov_length ? uint(aov_length) : default_length);
}

RenderOptions RenderFlags::options(const Scene& s, const Integrator& method) const {
  RenderOptions o;
  o.width = s.settings.width;
  o.height = s.settings.height;
  if (!time.empty()) o.seconds = parse_duration("--time", time);
  if (!error.empty()) o.error = wanted_error(error);
  o.passes = pass_range(*this, s);
  if (!crop.empty()) o.crop = parse_crop("--crop", crop, o.width, o.height);
  if (!memory.empty()) o.memory = parse_bytes("--memory", memory);
  // Layers are copied twice on their way into a picture, too.
  o.host_bytes = o.window().pixels() * ((checkpoint.empty() ? 0 : checkpoint_bytes_per_pixel) +
                                        2 * layer_bytes(method.layers));
  if (o.error) o.host_bytes += ErrorEstimate::host_bytes(o.window().pixels());
  o.seed = seed;
  if (max_depth) o.max_depth = uint(max_depth);
  if (!max_depth && s.settings.max_depth) o.max_depth = uint(*s.settings.max_depth);
  o.mis = parse_mis(mis, method);
  set_sub_paths(*this, method, o);
  o.plan.sampler = find_sampler(sampler);
  o.plan.float_mode = find_float_mode(float_mode);
  o.plan.extra_features = parse_feature_request(features);
  o.plan.kernel_dir = kernel_dir;
  o.plan.group = group;
  return o;
}

std::vector<std::string> RenderFlags::output_names(const Scene& s) const {
  if (outputs.empty()) return {s.name + ".exr", s.name + ".png"};
  check_picture_types(outputs);
  return outputs;
}

std::vector<std::string> RenderFlags::results(std::vector<std::string> pictures) const {
  for (const std::string& drawn : {atlas, grid})
    if (!drawn.empty()) pictures.push_back(drawn);
  return pictures;
}

double RenderFlags::checkpoint_period() const {
  constexpr double default_period = 60.0;
  return every.empty() ? default_period : parse_duration("--every", every);
}

/// Throws UsageError for options of pictures.
void RenderFlags::check_replay() const {
  for (const auto& [option, given] : {std::pair{"-o", !outputs.empty()},
                                      {"--atlas", !atlas.empty()},
                                      {"--grid", !grid.empty()},
                                      {"--aov", !aovs.empty()},
                                      {"--checkpoint", !checkpoint.empty()},
                                      {"--stats", !stats.empty()},
                                      {"--fireflies", fireflies > 0},
                                      {"--dry-run", dry_run}})
    if (given)
      throw UsageError(fmt::format("--replay renders no picture, so {} has no effect", option));
}

void RenderFlags::check() const {
  if (checkpoint.empty() && !every.empty())
    throw UsageError("--every needs --checkpoint FILE beside it");
  if (checkpoint.empty() && resume) throw UsageError("--resume needs --checkpoint FILE beside it");
  checkpoint_period();
  if (!replay.empty()) check_replay();
  for (const std::string& aov : aovs) one_of("--aov", aov, aov_names());
  if (aov_length && !(layer_kinds() & (LAYERS_LENGTH | LAYERS_TECH)))
    throw UsageError("--aov-length needs --aov length, --aov tech or --atlas FILE beside it");
  if (!atlas.empty()) check_display_type("--atlas", atlas);
  if (!grid.empty()) check_display_type("--grid", grid);
  one_of("--sampler", sampler, sampler_names());
  one_of("--float", float_mode, float_mode_names());
  display.transform();
}

}  // namespace pellucid
