// merge: checkpoints of disjoint passes to one picture or checkpoint.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/outputs.h"
#include "apps/render_report.h"
#include "base/files.h"
#include "base/log.h"
#include "render/checkpoint.h"

namespace pellucid {
namespace {

struct MergeFlags {
  std::vector<std::string> inputs, outputs, aovs;
  std::string atlas, grid;
  DisplayFlags display;
  bool deterministic = false;
};

bool names_checkpoint(const std::string& name) {
  std::string suffix = std::filesystem::path(name).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return suffix == ".ckpt";
}

/// Holes are allowed, since another worker may still be busy, but not in silence.
void warn_of_gaps(const PassSet& passes) {
  const auto& ranges = passes.ranges();
  PassSet gaps;
  for (const PassRange& gap : passes.missing({0, ranges.back().last})) gaps.add(gap);
  if (!gaps.empty()) log_warn("passes {} are missing; the rest is a valid picture", gaps.text());
}

Checkpoint merged(const std::vector<std::string>& names) {
  Checkpoint all = read_checkpoint(names.front());
  std::vector<PassSet> passes = {all.film.passes};
  for (std::size_t i = 1; i < names.size(); ++i) {
    const Checkpoint next = read_checkpoint(names[i]);
    std::size_t other = 0;  // the file to name beside this one: that whose passes it repeats
    for (std::size_t k = 0; k < i; ++k)
      if (passes[k].overlaps(next.film.passes)) other = k;
    merge_checkpoint(all, names[other], next, names[i]);
    passes.push_back(next.film.passes);
  }
  return all;
}

Image picture_of(const Checkpoint& c, const MergeFlags& flags) {
  const auto asked = [&](const char* aov) {
    return std::find(flags.aovs.begin(), flags.aovs.end(), aov) != flags.aovs.end();
  };
  Image image = film_image(c.film, asked("variance"), asked("samples"));
  add_channels(image, c.facts.aovs);
  image.metadata = c.facts.evidence;
  add_progress(c.film, summarise(c.film), c.facts.counters, c.facts.cuts, c.facts.seconds,
               image.metadata);
  if (flags.deterministic) make_deterministic(image.metadata);
  return image;
}

void check_output(const std::string& option, const std::string& name,
                  const std::vector<std::string>& others) {
  for (const std::string& other : others)
    if (same_file(name, other))
      throw UsageError(
          fmt::format("{} '{}' would overwrite '{}'; name another", option, name, other));
  check_writable(name);
}

ExitCode merge(const MergeFlags& flags, const CommonOptions& common) {
  std::vector<std::string> pictures, checkpoints;
  for (const std::string& name : flags.outputs) {
    (names_checkpoint(name) ? checkpoints : pictures).push_back(name);
    check_output("-o", name, flags.inputs);
  }
  check_picture_types(pictures);
  for (const auto& [option, name] :
       {std::pair<std::string, std::string>{"--atlas", flags.atlas}, {"--grid", flags.grid}}) {
    if (name.empty()) continue;
    check_display_type(option, name);
    check_output(option, name, flags.inputs);
    check_output(option, name, flags.outputs);
  }
  if (!flags.atlas.empty() && !flags.grid.empty())
    check_output("--grid", flags.grid, {flags.atlas});
  for (const std::string& aov : flags.aovs)
    if (aov != "variance" && aov != "samples")
      throw UsageError("--aov: there is no '" + aov +
                       "' to add; there are variance, samples, and what the checkpoints bring");
  const DisplayTransform display = flags.display.transform();
  Checkpoint all = merged(flags.inputs);
  if (!flags.atlas.empty() && !(layer_kinds(all.film.layers.set) & LAYERS_TECH))
    throw UsageError("--atlas: these checkpoints have no strategies; render with --aov tech");
  if (!flags.grid.empty() && (layer_kinds(all.film.layers.set) & LAYERS_GRID) != LAYERS_GRID)
    throw UsageError(
        "--grid: these checkpoints lack layers of the photon grid; render with --aov "
        "photons,cells,radius");
  if (!pictures.empty()) warn_of_gaps(all.film.passes);
  for (const std::string& name : checkpoints) write_checkpoint(name, all.film, all.facts);
  if (!pictures.empty()) write_pictures(pictures, picture_of(all, flags), display);
  if (!flags.atlas.empty()) write_image(flags.atlas, film_atlas(all.film));
  if (!flags.grid.empty()) write_image(flags.grid, film_grid(all.film));
  log_info("{} files, passes {}", flags.inputs.size(), all.film.passes.text());
  std::vector<std::string> results = flags.outputs;
  for (const std::string& drawn : {flags.atlas, flags.grid})
    if (!drawn.empty()) results.push_back(drawn);
  if (common.wants_text())
    for (const std::string& name : results) print_result(name + "\n");
  write_json(common.json, {{"inputs", flags.inputs},
                           {"outputs", results},
                           {"passes", all.film.passes.text()},
                           {"spp", all.film.passes.count()}});
  return ExitCode::done;
}

}  // namespace

CommandRun setup_merge(CLI::App& app) {
  auto flags = std::make_shared<MergeFlags>();
  app.add_option("CKPT", flags->inputs, "checkpoints of the same render with different passes")
      ->required();
  app.add_option("-o,--output", flags->outputs,
                 "picture to write, type by suffix, or a checkpoint (.ckpt); repeatable")
      ->type_name("FILE")
      ->required()
      ->allow_extra_args(false);
  app.add_option("--aov", flags->aovs,
                 "further EXR channels beside those that the checkpoints bring: variance (of each "
                 "pixel's mean), samples")
      ->type_name("LIST")
      ->delimiter(',');
  app.add_option("--atlas", flags->atlas,
                 "draw the pyramid of strategies, if the checkpoints have their layers")
      ->type_name("FILE");
  app.add_option("--grid", flags->grid, "draw the photon grid, if the checkpoints have its layers")
      ->type_name("FILE");
  flags->display.declare(app);
  app.add_flag("--deterministic", flags->deterministic,
               "leave time, host and device out of the image");
  app.footer("Example: pellucid merge a.ckpt b.ckpt -o whole.exr -o whole.png");
  return [flags](const CommonOptions& common) { return merge(*flags, common); };
}

}  // namespace pellucid
