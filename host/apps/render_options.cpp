// Options of `render`: declaration, checks, and their meaning.
#include <CLI/App.hpp>  // before NONE of layout.h, which is a name in it

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

/// CLI11 would take -1 and all that is too large for 2^64 - 1.
std::string whole_number(const std::string& text) {
  std::uint64_t value = 0;
  const char* const text_end = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), text_end, value);
  const bool whole = error == std::errc() && end == text_end;
  return whole ? "" : fmt::format("takes a whole number such as 7, not '{}'", text);
}

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

struct AovEntry {
  std::string name, doc;
};
/// Everything that --aov takes: the film's own channels, its layers, then what the AOV pass makes.
std::vector<AovEntry> aov_entries() {
  std::vector<AovEntry> entries{{"variance", "of each pixel's mean"}, {"samples", "per pixel"}};
  for (const LayerInfo& info : layer_table()) entries.push_back({info.name, info.doc});
  for (const AovInfo& info : aov_table()) entries.push_back({info.name, info.doc});
  return entries;
}

std::vector<std::string> aov_names() {
  std::vector<std::string> names;
  for (const AovEntry& entry : aov_entries()) names.push_back(entry.name);
  return names;
}

std::string aov_help() {
  std::vector<std::string> texts;
  for (const AovEntry& entry : aov_entries())
    texts.push_back(fmt::format("{} ({})", entry.name, entry.doc));
  return "further EXR channels, by comma: " + join(texts);
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

/// Method, effort and where samples lie.
void declare_sampling(CLI::App& app, RenderFlags& f) {
  std::string methods;
  for (const Integrator& i : integrators())
    methods += fmt::format("{}{}: {}", methods.empty() ? "" : "; ", i.name, i.summary);
  app.add_option("-i,--integrator", f.integrator,
                 "the method (default: the scene's, else path). " + methods)
      ->type_name(integrator_names());
  app.add_option(
         "--mis", f.mis,
         "how methods weigh their strategies (default balance); max: `path` and `sppm` alone")
      ->type_name("balance|power|max");
  app.add_option("--spp", f.spp, "samples per pixel (default: the scene's, else 64)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xffffffff}));
  app.add_option("--time", f.time,
                 "stop after this long, e.g. 60s or 10m; with --spp, whichever is first")
      ->type_name("DURATION");
  app.add_option("--error", f.error,
                 "stop when the error, the root of relMSE, is below this with 95 % confidence, "
                 "e.g. 1%; with --spp, --time or --passes, whichever is first, and exit code 1 if "
                 "these come first")
      ->type_name("FRACTION");
  app.add_option("--sampler", f.sampler,
                 "sobol (default): scrambled Sobol points, less noise; random: independent numbers")
      ->type_name("sobol|random");
  app.add_option(
         "--float", f.float_mode,
         "arithmetic of kernels: strict (default), every operation rounded as written; mad, "
         "products and sums may be one; fast, and the compiler may reorder")
      ->type_name(fmt::format("{}", fmt::join(float_mode_names(), "|")));
  app.add_option("--filter", f.filter, "pixel filter (default: the scene's, else gaussian)")
      ->type_name(fmt::format("{}", fmt::join(pixel_filter_names(), "|")));
  app.add_option("--light-paths", f.light_paths,
                 "light paths of an iteration, for the whole picture (default: one per pixel)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xfffffffe}));
  app.add_option(
         "--radius", f.radius,
         "radius of merging in the first pass, world units (default: by the scene's size and "
         "the light paths)")
      ->type_name("LENGTH");
  app.add_option(
         "--radius-alpha", f.radius_alpha,
         "how the radius shrinks, above 0 and up to 1 (default 0.75): as pass^((alpha-1)/2), down "
         "to 16 roundings of the largest coordinate")
      ->type_name("NUMBER");
  app.add_option(
         "--merges", f.merges,
         "vertices of eye paths at which `bpm` and `vcm` merge: all (default), or the first "
         "one that can: quicker, and no path is lost")
      ->type_name("all|first");
  app.add_option("--vertices", f.vertices,
                 "how path vertices are kept: full (default), or compact, in half the memory")
      ->type_name("full|compact");
  app.add_option("--seed", f.seed, "random seed (default 0)")->check(whole_number);
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

void RenderFlags::declare(CLI::App& app) {
  app.add_option("SCENE", scene,
                 "scene file (.json), model (.obj, .ply), or the name of a shipped scene")
      ->required();
  declare_overrides(app, overrides);
  declare_sampling(app, *this);
  app.add_option("--size", size, "image size in pixels, e.g. 640x480 (default: the scene's)")
      ->type_name("WxH");
  app.add_option("--crop", crop,
                 "render only these pixels: x0,x1,y0,y1, half-open, from the top left")
      ->type_name("X0,X1,Y0,Y1");
  app.add_option("--max-depth", max_depth,
                 "longest path in segments, an emitter seen directly has 1 (default: the scene's, "
                 "else unlimited)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{0xfffffffe}));
  declare_files(app);
  declare_progress(app);
  device.declare(app);
  device.declare_threads(app);
  app.add_option(
         "--features", features,
         "what kernels hold: auto (what the scene needs), all, or a list like +phong,+disks")
      ->type_name("auto|all|LIST");
  app.add_option("--work-group", group,
                 "work-items per group; changes speed, never the image (default 64)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--memory", memory,
                 "most device memory to use, e.g. 2G; larger pictures are rendered in bands")
      ->type_name("BYTES");
  app.add_option("--kernel-dir", kernel_dir, "read kernels from this folder instead of the program")
      ->type_name("DIR");
  app.add_option("--stats", stats, "write statistics of the render as JSON")->type_name("FILE");
  app.add_flag("--strict", strict, "device counters and warnings are errors");
  app.add_flag("--deterministic", deterministic, "leave time, host and device out of the image");
  app.add_flag("--dry-run", dry_run,
               "tell what would be rendered, and whether it could be, without doing it");
  app.footer("Example: pellucid render cornell-box --spp 128 -o box.exr -o box.png");
}

void RenderFlags::declare_files(CLI::App& app) {
  app.add_option(
         "-o,--output", outputs,
         "picture to write, type by suffix; repeatable (default: SCENE.exr and SCENE.png here)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--aov", aovs, aov_help())->type_name(join(aov_names(), "|"))->delimiter(',');
  app.add_option("--aov-length", aov_length,
                 "longest path length that has layers of its own in --aov length and tech and in "
                 "--atlas (default 5); longer ones share one")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{LAYER_LENGTH_MAX}));
  app.add_option("--atlas", atlas,
                 "draw what every strategy brings, weighted and not, as a pyramid: rows by path "
                 "length, columns by s; implies --aov tech")
      ->type_name("FILE");
  app.add_option("--grid", grid,
                 "draw the photon grid of methods that merge in false colours: photons found, "
                 "occupied cells, radius; implies --aov photons,cells,radius")
      ->type_name("FILE");
  display.declare(app);
}

void RenderFlags::declare_progress(CLI::App& app) {
  app.add_option(
         "--checkpoint", checkpoint,
         "keep the render in this file, to go on with (--resume) or to merge; written at the "
         "end and as --every says")
      ->type_name("FILE");
  app.add_option("--every", every, "time between two checkpoints (default 60s)")
      ->type_name("DURATION");
  app.add_flag("--resume", resume, "go on with the checkpoint, if it exists");
  app.add_option(
         "--passes", passes,
         "render the global passes A to B-1 only, so that several runs share the work of one "
         "(see `merge`); a pass is one sample per pixel")
      ->type_name("A:B");
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

Integrator RenderFlags::method(const Scene& s) const {
  constexpr uint default_length = 5;
  const Integrator& plain = choose_integrator(integrator, s);
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

void RenderFlags::check() const {
  if (checkpoint.empty() && !every.empty())
    throw UsageError("--every needs --checkpoint FILE beside it");
  if (checkpoint.empty() && resume) throw UsageError("--resume needs --checkpoint FILE beside it");
  checkpoint_period();
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
