// `pellucid compare A B`: how far A is from the reference B, and whether that is near enough.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/compare_explain.h"
#include "apps/compare_metrics.h"
#include "apps/compare_noise.h"
#include "apps/compare_report.h"
#include "apps/outputs.h"
#include "base/files.h"
#include "base/text.h"
#include "image/flip.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

struct Options {
  std::string image, reference, diff;
  std::vector<std::string> others;  ///< further runs
  std::vector<std::string> gates;   ///< "metric=value"
  std::string map, ppd;             ///< "" is the default
  bool ztest = false, explain = false;
  std::string ztest_image, ztest_tile;
};

/// What -o can show.
struct Map {
  const char* name;
  Image (*draw)(const Image& a, const Image& reference, double ppd);
  ErrorScale scale;
  bool needs_variances;
};
constexpr Map MAPS[] = {
    {"relative", [](const Image& a, const Image& b, double) { return error_map(a, b); },
     ErrorScale::relative, false},
    {"flip", [](const Image& a, const Image& b, double ppd) { return flip_map(a, b, ppd); },
     ErrorScale::perceived, false},
    {"hdr-flip", [](const Image& a, const Image& b, double ppd) { return hdr_flip_map(a, b, ppd); },
     ErrorScale::perceived, false},
    {"signed", [](const Image& a, const Image& b, double) { return signed_map(a, b); },
     ErrorScale::signed_relative, false},
    {"z", [](const Image& a, const Image& b, double) { return z_map(a, b); },
     ErrorScale::deviations, true},
};

/// The options, understood.
struct Task {
  std::vector<Gate> gates;
  const Map* map = nullptr;  ///< null: none is wanted
  double ppd = FLIP_PPD;
  ZTestLimits limits;
};

const Map& parse_map(const std::string& name) {
  std::vector<std::string> names;
  for (const Map& map : MAPS) {
    if (name == map.name || name.empty()) return map;
    names.push_back(map.name);
  }
  throw UsageError(
      fmt::format("--map: '{}' is none of {}.{}", name, join(names), did_you_mean(name, names)));
}

double parse_ppd(const std::string& text) {
  if (text.empty()) return FLIP_PPD;
  const double ppd = parse_number("--ppd", text);
  if (!(ppd >= FLIP_LEAST_PPD && ppd <= FLIP_MOST_PPD))
    throw UsageError(fmt::format("--ppd takes {:g} to {:g} pixels per degree, not '{}'",
                                 FLIP_LEAST_PPD, FLIP_MOST_PPD, text));
  return ppd;
}

/// A limit of the z-test; it stays as it is for "".
void parse_limit(const char* option, const std::string& text, bool ztest, double& limit) {
  if (text.empty()) return;
  limit = parse_fraction(option, text);
  if (!(limit > 0 && limit <= 1))
    throw UsageError(fmt::format("{} takes a part above 0 and up to 100%, not '{}'", option, text));
  if (!ztest) throw UsageError(fmt::format("{} has no effect without --ztest", option));
}

Task parse_task(const Options& options) {
  Task task;
  for (const std::string& text : options.gates)
    task.gates.push_back(parse_gate(text, !options.others.empty()));
  const Map& map = parse_map(options.map);
  task.ppd = parse_ppd(options.ppd);
  parse_limit("--ztest-image", options.ztest_image, options.ztest, task.limits.image);
  parse_limit("--ztest-tile", options.ztest_tile, options.ztest, task.limits.tile);
  if (options.diff.empty()) {
    if (!options.map.empty()) throw UsageError("--map needs -o FILE, where the map is to go");
    return task;
  }
  task.map = &map;
  check_picture_types({options.diff});  // before the work, not after it
  check_writable(options.diff);
  return task;
}

/// Files of 8 and 16 bits hold display values; errors are measured in linear light.
NamedImage read_linear(const std::string& path) {
  return {path, read_image(path, true)};
}

/// The library of metrics knows no file names; its errors must have them.
template <typename Work>
auto naming_both(const NamedImage& a, const NamedImage& b, const Work& work) {
  try {
    return work(a.image, b.image);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("cannot compare '{}' with '{}': {}", a.name, b.name, error.what()));
  }
}

ZTest test_noise(const NamedImages& runs, const NamedImage& reference, const Comparison& found,
                 const ZTestLimits& limits) {
  if (found.nonfinite > 0) {
    ZTest refused;
    refused.reason = "pixels are not finite";
    return refused;
  }
  const NoisyImage a = noisy_image(runs);
  const NoisyImage b = noisy_image({&reference});
  ZTest test = z_test(a, b, limits);
  if (test.verdict == Verdict::inconclusive && !a.independent_pixels && !a.by_spread())
    test.reason += "; pixels of this method depend on each other: give more runs by --with";
  return test;
}

Comparison compare(const NamedImages& runs, const NamedImage& reference, const Options& options,
                   const Task& task) {
  Comparison found;
  const NamedImage& first = *runs.front();
  found.runs = runs.size();
  found.error = naming_both(first, reference, compare_images);
  found.nonfinite = found.error.nonfinite;
  if (found.nonfinite == 0) {
    found.flip = mean_of_map(flip_map(first.image, reference.image, task.ppd));
    found.hdr_flip = mean_of_map(hdr_flip_map(first.image, reference.image, task.ppd));
  }
  if (runs.size() > 1) {
    std::vector<const Image*> images;
    for (const NamedImage* run : runs) {
      naming_both(*run, reference, [](const Image& a, const Image& b) { return ImagePair(a, b); });
      images.push_back(&run->image);
    }
    found.split = split_error(images, reference.image);
    found.nonfinite = found.split->nonfinite;
  }
  if (options.ztest) found.ztest = test_noise(runs, reference, found, task.limits);
  return found;
}

void write_map(const std::string& path, const Map& map, const NamedImage& a,
               const NamedImage& reference, double ppd) {
  if (map.needs_variances) {
    check_variances(a);
    check_variances(reference);
  }
  const Image errors = map.draw(a.image, reference.image, ppd);
  const std::string exr = ".exr";
  const bool as_numbers =
      path.size() >= exr.size() && path.compare(path.size() - exr.size(), exr.size(), exr) == 0;
  write_image(path, as_numbers ? errors : false_colour(errors, map.scale));
}

ExitCode run(const Options& options, const CommonOptions& common) {
  const Task task = parse_task(options);
  std::vector<NamedImage> files{read_linear(options.image)};
  for (const std::string& other : options.others) files.push_back(read_linear(other));
  const NamedImage reference = read_linear(options.reference);
  NamedImages runs;
  for (const NamedImage& file : files) runs.push_back(&file);
  if (runs.size() > 1) {
    NamedImages all = runs;
    all.push_back(&reference);
    refuse_shared_samples(all);
  }
  const Comparison found = compare(runs, reference, options, task);
  if (task.map) write_map(options.diff, *task.map, files.front(), reference, task.ppd);
  std::optional<explain::Explanation> explanation;
  if (options.explain && found.nonfinite == 0) explanation = explain_pair(files.front(), reference);

  if (common.wants_text()) print_result(comparison_table(found, task.gates));
  if (common.wants_text() && explanation) print_result(explanation_text(*explanation));
  nlohmann::json document = comparison_json(found, task.gates);
  document["image"] = options.image;
  document["reference"] = options.reference;
  if (!options.others.empty()) document["with"] = options.others;
  if (explanation) document["explain"] = explanation_json(*explanation);
  if (task.map) document.update({{"diff", options.diff}, {"map", task.map->name}});
  write_json(common.json, document);
  if (common.wants_text() && task.map) print_result(options.diff + '\n');

  bool passed = found.nonfinite == 0;
  for (const Gate& gate : task.gates) passed = passed && gate.holds(found);
  if (found.ztest) passed = passed && found.ztest->verdict == Verdict::equal;
  return passed ? ExitCode::done : ExitCode::gate_failed;
}

void declare_ztest(CLI::App& app, Options& options) {
  app.add_flag("--ztest", options.ztest,
               "exit with 1 unless A and B differ by no more than their noise explains, and the "
               "noise is small enough to tell; both need render's AOV 'variance'");
  app.add_option("--ztest-image", options.ztest_image,
                 "what the noise may hide of the picture's energy at most (default: 0.5%)")
      ->type_name("PART");
  app.add_option("--ztest-tile", options.ztest_tile,
                 "what the noise may hide of a tile's energy at most (default: 5%)")
      ->type_name("PART");
}

void declare_explain(CLI::App& app, Options& options) {
  app.add_flag("--explain", options.explain,
               "tell why A and B differ in brightness; one of them needs render's AOV 'length'");
}

constexpr const char* FOOTER =
    "Both images need the same size. Pixels that are NaN or Inf are counted first; any such "
    "pixel\n"
    "means exit code 1 and no other metric. Images of 8 or 16 bits are made linear with the sRGB\n"
    "curve. Only R, G, B (or the one channel of grey images) are compared.\n"
    "relmse is the mean of (a-b)^2/(b^2+e^2), e = 1 % of the mean of B; trimmed_relmse leaves out\n"
    "the largest 0.1 % of these terms. Tiles have 16x16 pixels. flip is LDR-FLIP of what a "
    "display\n"
    "shows (clipped, sRGB), hdr_flip the worst over exposures, for floating-point images; both go\n"
    "from 0 to 1. firefly_index is the brightest pixel over the 99.9th percentile.\n"
    "With further runs by --with, variance is that of one run and bias2 the squared bias (rel...:\n"
    "as in relmse), without the variance of the mean of the runs and of B, if B tells it;\n"
    "bias2_upper90 is above it with 90 % confidence, by bootstrap over runs.\n"
    "--ztest says EQUAL, DIFFERENT or INCONCLUSIVE: Welch's test of every tile and of the whole "
    "at\n"
    "a family-wise level of 1e-4, and what differences it would have found with 95 % probability.\n"
    "Methods that splat or merge have pixels that depend on each other: there it needs several\n"
    "runs (--with), whose spread is then the noise. Tiles in which fewer than 300 samples matter\n"
    "are judged as a part of the whole only.\n"
    "--explain fits models of known causes (exposure, albedo, colour space, depth cap, clamp, "
    "lamps\n"
    "that emit on two sides, pixel filter, ...) to the difference, and says which it is, how sure\n"
    "that is and what to do next; or that there is none beyond noise, or none of these. One "
    "picture\n"
    "needs layers by path length (render's AOV 'length', best with a dozen of them); the other "
    "may\n"
    "be of any program, with the same camera and size.\n"
    "Maps: relative (0.001 black, 0.01 blue, 0.1 red, 1 yellow, 10 white), flip and hdr-flip (0\n"
    "black, over violet and orange to 1 pale yellow), signed (blue too dark, white right, red too\n"
    "bright; full colours at 100 %), z (the same in standard errors, full at 5; both images need\n"
    "variances); green is not finite. A name that ends in .exr gets the numbers.\n"
    "Exit code: 0 every gate holds, 1 not, 2 usage, 3 an image cannot be read or sizes differ.\n\n"
    "Example:\n"
    "  pellucid compare out.exr golden.exr --fail-above relmse=1e-3 -o diff.png\n"
    "  pellucid compare run0.exr truth.exr --with run1.exr run2.exr run3.exr\n"
    "  pellucid compare layers.exr other-program.exr --explain";

}  // namespace

CommandRun setup_compare(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("A", options->image, "image to be judged")->required();
  app.add_option("B", options->reference, "reference")->required();
  app.add_option("--with", options->others,
                 "further runs of A, by other seeds: tells noise and bias apart; repeatable")
      ->type_name("FILE");
  app.add_option(
         "--fail-above", options->gates,
         "metric=value: exit with 1 if the metric is above the value, or NaN; repeatable; " +
             metric_names() + " (tiles_within_1pct and those of energy: the distance from 1)")
      ->allow_extra_args(false);
  app.add_option("-o,--output", options->diff, "map of the error per pixel")->type_name("FILE");
  app.add_option("--map", options->map, "what the map shows (default: relative)")
      ->type_name("relative|flip|hdr-flip|signed|z");
  app.add_option("--ppd", options->ppd, "pixels per degree of view, for FLIP (default: 67.02)")
      ->type_name("NUMBER");
  declare_ztest(app, *options);
  declare_explain(app, *options);
  app.footer(FOOTER);
  return [options](const CommonOptions& common) { return run(*options, common); };
}

}  // namespace pellucid
