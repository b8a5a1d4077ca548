// Options of `render` as the command line has them.
#include <CLI/App.hpp>  // before NONE of layout.h, which is a name in it

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "apps/render_options.h"
#include "apps/scene_input.h"
#include "base/text.h"
#include "integrators/registry.h"
#include "render/aov.h"
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

struct AovEntry {
  std::string name, doc;
};
std::vector<AovEntry> aov_entries() {
  std::vector<AovEntry> entries{{"variance", "of each pixel's mean"}, {"samples", "per pixel"}};
  for (const LayerInfo& info : layer_table()) entries.push_back({info.name, info.doc});
  for (const AovInfo& info : aov_table()) entries.push_back({info.name, info.doc});
  return entries;
}

std::string aov_help() {
  std::vector<std::string> texts;
  for (const AovEntry& entry : aov_entries())
    texts.push_back(fmt::format("{} ({})", entry.name, entry.doc));
  return "further EXR channels, by comma: " + join(texts);
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

std::vector<std::string> aov_names() {
  std::vector<std::string> names;
  for (const AovEntry& entry : aov_entries()) names.push_back(entry.name);
  return names;
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
                 "else unlimited); what that cuts off is told at the end")
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
                 "work-items per group; changes speed, never the image, but for the last bits\n"
                 "with --float fast (default 64)")
      ->check(CLI::Range(1, 4096));
  app.add_option("--memory", memory,
                 "most device memory to use, e.g. 2G; larger pictures are rendered in bands")
      ->type_name("BYTES");
  app.add_option("--kernel-dir", kernel_dir, "read kernels from this folder instead of the program")
      ->type_name("DIR");
  app.add_option("--stats", stats, "write statistics of the render as JSON")->type_name("FILE");
  app.add_option("--fireflies", fireflies,
                 "list this many samples that change their pixels most, each traced again: how its "
                 "light was found, with densities, weight and vertices (all of them in --json)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000}));
  app.add_option("--replay", replay,
                 "instead of rendering, trace the sample of pixel X,Y in this pass again and tell "
                 "all that its paths did; with the options of the render it belongs to")
      ->type_name("X,Y,PASS");
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

}  // namespace pellucid
