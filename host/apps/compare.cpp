// `pellucid compare A B`: how far A is from the reference B, and whether that is near enough.
#include <fmt/format.h>
#include <CLI/App.hpp>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "apps/outputs.h"
#include "base/files.h"
#include "base/log.h"
#include "base/text.h"
#include "image/image.h"
#include "image/metrics.h"
#include "image/tonemap.h"

namespace pellucid {
namespace {

struct Options {
  std::string image, reference, diff;
  std::vector<std::string> gates;  ///< "metric=value"
};

/// A metric by its name in gates, tables and JSON.
struct Metric {
  const char* name;
  double ImageError::*value;
  double ideal;  ///< gates bound the distance from it
};

constexpr Metric METRICS[] = {
    {"mse", &ImageError::mse, 0},
    {"rmse", &ImageError::rmse, 0},
    {"relmse", &ImageError::relmse, 0},
    {"smape", &ImageError::smape, 0},
    {"p95_tile_relmse", &ImageError::p95_tile_relmse, 0},
    {"energy_ratio", &ImageError::energy_ratio, 1},
};

struct Gate {
  const Metric* metric;
  double limit;
  /// Written so that NaN never passes.
  bool holds(const ImageError& error) const {
    return std::abs(error.*metric->value - metric->ideal) <= limit;
  }
};

Gate parse_gate(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  std::vector<std::string> names;
  for (const Metric& metric : METRICS) {
    names.push_back(metric.name);
    if (name != metric.name) continue;
    if (equals == std::string::npos)
      throw UsageError(fmt::format("--fail-above takes metric=value, such as {}=1e-3", name));
    const double limit = parse_fraction("--fail-above " + name, text.substr(equals + 1));
    if (limit < 0) throw UsageError(fmt::format("--fail-above {}: below 0 nothing passes", text));
    return {&metric, limit};
  }
  throw UsageError(fmt::format("--fail-above: there is no metric '{}', but {}.{}", name,
                               join(names), did_you_mean(name, names)));
}

/// Files of 8 and 16 bits hold display values; errors are measured in linear light.
Image read_linear(const std::string& path) {
  return read_image(path, true);
}

/// compare_images() knows no file names; its errors must have them.
ImageError compare_files(const Options& options, const Image& image, const Image& reference) {
  try {
    return compare_images(image, reference);
  } catch (const InputError& error) {
    throw InputError(fmt::format("cannot compare '{}' with '{}': {}", options.image,
                                 options.reference, error.what()));
  }
}

void write_diff(const std::string& path, const Image& image, const Image& reference) {
  const Image map = error_map(image, reference);
  const std::string exr = ".exr";
  const bool as_numbers =
      path.size() >= exr.size() && path.compare(path.size() - exr.size(), exr.size(), exr) == 0;
  write_image(path, as_numbers ? map : false_colour(map));
}

std::string as_table(const ImageError& error, const std::vector<Gate>& gates) {
  std::string text = fmt::format("{:<16} {}{}\n", "nonfinite", error.nonfinite,
                                 error.nonfinite > 0 ? "  FAILS: no metric can be trusted" : "");
  for (const Metric& metric : METRICS) {
    text += fmt::format("{:<16} {:.6g}", metric.name, error.*metric.value);
    for (const Gate& gate : gates) {
      if (gate.metric != &metric) continue;
      text += fmt::format("  {}: {} {:g}", gate.holds(error) ? "holds" : "FAILS",
                          metric.ideal == 0 ? "<=" : "|ratio-1| <=", gate.limit);
    }
    text += '\n';
  }
  return text;
}

nlohmann::json as_json(const Options& options, const ImageError& error,
                       const std::vector<Gate>& gates) {
  nlohmann::json document = {{"image", options.image},
                             {"reference", options.reference},
                             {"nonfinite", error.nonfinite},
                             {"gates", nlohmann::json::array()}};
  for (const Metric& metric : METRICS) document[metric.name] = error.*metric.value;
  for (const Gate& gate : gates) {
    document["gates"].push_back(
        {{"metric", gate.metric->name}, {"limit", gate.limit}, {"holds", gate.holds(error)}});
  }
  if (!options.diff.empty()) document["diff"] = options.diff;
  return document;
}

ExitCode run(const Options& options, const CommonOptions& common) {
  std::vector<Gate> gates;
  for (const std::string& text : options.gates) gates.push_back(parse_gate(text));

  if (!options.diff.empty()) {  // before the work, not after it
    check_picture_types({options.diff});
    check_writable(options.diff);
  }

  const Image image = read_linear(options.image);
  const Image reference = read_linear(options.reference);
  const ImageError error = compare_files(options, image, reference);
  if (!options.diff.empty()) write_diff(options.diff, image, reference);

  if (common.wants_text()) print_result(as_table(error, gates));
  write_json(common.json, as_json(options, error, gates));
  if (common.wants_text() && !options.diff.empty()) print_result(options.diff + '\n');

  bool passed = error.nonfinite == 0;
  for (const Gate& gate : gates) passed = passed && gate.holds(error);
  return passed ? ExitCode::done : ExitCode::gate_failed;
}

}  // namespace

CommandRun setup_compare(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("A", options->image, "image to be judged")->required();
  app.add_option("B", options->reference, "reference")->required();
  app.add_option("--fail-above", options->gates,
                 "metric=value: exit with 1 if the metric is above the value, or NaN; repeatable; "
                 "mse, rmse, relmse, smape, p95_tile_relmse, energy_ratio (distance from 1)")
      ->allow_extra_args(false);
  app.add_option(
         "-o,--output", options->diff,
         "map of the relative error per pixel: false colours (0.001 black, 0.01 blue, "
         "0.1 red, 1 yellow, 10 white; not finite: green), or the numbers if it ends in .exr")
      ->type_name("FILE");
  app.footer(
      "Both images need the same size. Pixels that are NaN or Inf are counted first; any such "
      "pixel\n"
      "means exit code 1 and no other metric. Images of 8 or 16 bits are made linear with the "
      "sRGB\n"
      "curve. Only R, G, B (or the one channel of grey images) are compared.\n"
      "Exit code: 0 every gate holds, 1 not, 2 usage, 3 an image cannot be read or sizes "
      "differ.\n\n"
      "Example:\n"
      "  pellucid compare out.exr golden.exr --fail-above relmse=1e-3 -o diff.png");
  return [options](const CommonOptions& common) { return run(*options, common); };
}

}  // namespace pellucid
