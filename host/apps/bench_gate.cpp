// Gates of `bench` against an earlier result.
#include "apps/bench_gate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/common.h"
#include "base/error.h"
#include "base/files.h"
#include "base/statistics.h"
#include "bench/render_workload.h"

namespace pellucid {
namespace {

using nlohmann::json;

/// Why a baseline is none, with the remedy.
class Reading {
 public:
  Reading(std::string file, std::string only) : file_(std::move(file)), only_(std::move(only)) {}

  json document() const {
    json read = json::parse(read_text(file_), nullptr, false);
    if (read.is_discarded()) fail("not valid JSON");
    if (!read.is_object()) fail("not a JSON object");
    return read;
  }
  /// A list of objects that is not empty.
  const json& list(const json& in, const char* key) const {
    const auto found = in.find(key);
    const bool whole = found != in.end() && found->is_array() && !found->empty() &&
                       std::all_of(found->begin(), found->end(),
                                   [](const json& entry) { return entry.is_object(); });
    if (!whole) fail(fmt::format("there is no list \"{}\"", key));
    return *found;
  }
  void texts(const json& entry, const char* list, std::initializer_list<const char*> keys) const {
    for (const char* key : keys)
      if (!entry.contains(key) || !entry[key].is_string())
        fail(fmt::format("an entry of \"{}\" lacks \"{}\"", list, key));
  }
  void number(const json& value, const char* list, const char* key) const {
    if (!value.is_number()) fail(fmt::format("an entry of \"{}\" lacks \"{}\"", list, key));
    if (!(value.get<double>() > 0)) fail(fmt::format("\"{}\" is not above 0", key));
  }
  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(fmt::format("{}: {}; make it with 'pellucid bench --only {} --json {}'", file_,
                                 why, only_, file_));
  }

 private:
  std::string file_, only_;
};

/// Logarithms: their distribution is nearer to the normal one, with rare bright paths far from it.
struct Logs {
  double n = 0, mean = 0, variance_of_mean = 0;
  explicit Logs(const json& errors) : n(double(errors.size())) {
    for (const json& e : errors) mean += std::log(e.get<double>()) / n;
    double square = 0;
    for (const json& e : errors) square += std::pow(std::log(e.get<double>()) - mean, 2);
    if (n > 1) variance_of_mean = square / (n - 1) / n;
  }
};

/// Welch's test, one-sided, with a chance of `alpha` to be wrong.
bool error_grew(const json& now, const json& before, double alpha) {
  if (now == before) return false;  // the rule
  const Logs a(now), b(before);
  const double variance = a.variance_of_mean + b.variance_of_mean;
  // One seed, or a spread of 0, is no measure of chance.
  if (a.n < 2 || b.n < 2 || !(variance > 0)) return false;
  const double degrees =
      variance * variance /
      (std::pow(a.variance_of_mean, 2) / (a.n - 1) + std::pow(b.variance_of_mean, 2) / (b.n - 1));
  return (a.mean - b.mean) / std::sqrt(variance) > student_quantile(1 - alpha, degrees);
}

const json* find_entry(const json& list, const json& like,
                       std::initializer_list<const char*> keys) {
  for (const json& entry : list)
    if (std::all_of(keys.begin(), keys.end(),
                    [&](const char* key) { return entry.at(key) == like.at(key); }))
      return &entry;
  return nullptr;
}

/// Chance to blame any one of all errors by chance.
constexpr double false_alarm = 0.01;

void compare_cells(const json& now, const json& before, double allowed,
                   std::vector<std::string>& worse) {
  const json& cells = now.at("methods");
  for (const json& cell : cells) {
    const std::string name = fmt::format("{} on {}", cell.at("integrator").get<std::string>(),
                                         cell.at("scene").get<std::string>());
    const json* old = find_entry(before.at("methods"), cell, {"integrator", "scene"});
    if (!old) {
      worse.push_back(name + " cannot be compared: the baseline lacks it");
      continue;
    }
    if (old->contains("failed")) continue;
    if (cell.contains("failed")) {
      worse.push_back(name + " fails now: " + cell["failed"].get<std::string>());
      continue;
    }
    const double ratio =
        cell.at("samples_per_s_best").get<double>() / old->at("samples_per_s_best").get<double>();
    if (ratio < 1 - allowed)
      worse.push_back(fmt::format("{}: {:.1f} % slower", name, 100 * (1 - ratio)));
    if (error_grew(cell.at("relmse_runs"), old->at("relmse_runs"),
                   false_alarm / double(cells.size())))
      worse.push_back(fmt::format("{}: relMSE of {:.3g} after {:.3g}, beyond chance", name,
                                  std::exp(Logs(cell.at("relmse_runs")).mean),
                                  std::exp(Logs(old->at("relmse_runs")).mean)));
  }
}

}  // namespace

double parse_allowed(const std::string& fail_slower) {
  const double allowed = parse_fraction("--fail-slower", fail_slower);
  if (allowed < 0 || allowed >= 1)
    throw UsageError("--fail-slower takes a share from 0% to below 100%, not '" + fail_slower +
                     "'");
  return allowed;
}

json read_rays_baseline(const std::string& file) {
  const Reading reading(file, "rays");
  json document = reading.document();
  for (const json& cell : reading.list(document, "rays")) {
    reading.texts(cell, "rays", {"kind"});
    reading.number(cell.value("triangles", json()), "rays", "triangles");
    reading.number(cell.value("mrays_per_s", json()), "rays", "mrays_per_s");
  }
  return document;
}

json read_render_baseline(const std::string& file, const json& scenes) {
  const Reading reading(file, "render");
  json document = reading.document();
  if (document.value("workload", json()) != RENDER_WORKLOAD)
    reading.fail(fmt::format("it is no result of {}", RENDER_WORKLOAD));
  const json hashes = document.value("scenes", json());
  for (const auto& [name, scene] : scenes.items())
    if (!hashes.is_object() || !hashes.contains(name) || hashes[name] != scene)
      reading.fail(fmt::format("it is of another '{}', or of none", name));
  for (const json& device : reading.list(document, "devices")) {
    reading.texts(device, "devices", {"device", "driver"});
    if (device.contains("failed")) continue;
    for (const json& cell : reading.list(device, "methods")) {
      reading.texts(cell, "methods", {"integrator", "scene"});
      if (cell.contains("failed")) continue;
      reading.number(cell.value("samples_per_s_best", json()), "methods", "samples_per_s_best");
      const json runs = cell.value("relmse_runs", json());
      if (!runs.is_array() || runs.empty()) reading.number({}, "methods", "relmse_runs");
      for (const json& run : runs) reading.number(run, "methods", "relmse_runs");
    }
    const json scores = device.value("scores", json());
    if (!scores.is_array()) reading.fail("a device has no list \"scores\"");
    for (const json& score : scores) {
      if (!score.is_object()) reading.fail("an entry of \"scores\" is no object");
      reading.texts(score, "scores", {"name"});
      for (const char* key : {"score", "low"})
        reading.number(score.value(key, json()), "scores", key);
    }
  }
  return document;
}

std::vector<std::string> worse_rays(const json& now, const json& before, double allowed) {
  std::vector<std::string> worse;
  std::size_t compared = 0;
  for (const json& cell : now.at("rays")) {
    const json* old = find_entry(before.at("rays"), cell, {"triangles", "kind"});
    if (!old) continue;
    ++compared;
    const double ratio = cell["mrays_per_s"].get<double>() / old->at("mrays_per_s").get<double>();
    if (ratio < 1.0 - allowed)
      worse.push_back(fmt::format("{} rays on {} triangles: {:.1f} % slower",
                                  cell["kind"].get<std::string>(), cell["triangles"].get<int>(),
                                  100 * (1 - ratio)));
  }
  if (compared != now.at("rays").size())
    worse.push_back(fmt::format("{} of {} cells cannot be compared: it lacks them",
                                now.at("rays").size() - compared, now.at("rays").size()));
  return worse;
}

std::vector<std::string> worse_renders(const json& now, const json& before, double allowed) {
  std::vector<std::string> worse;
  for (const json& device : now.at("devices")) {
    const std::string name = device.at("device").get<std::string>();
    const json* old = find_entry(before.at("devices"), device, {"device"});
    if (!old) {
      worse.push_back(name + " cannot be compared: the baseline lacks it");
      continue;
    }
    if (old->contains("failed")) continue;
    if (device.contains("failed")) {
      worse.push_back(name + " fails now: " + device["failed"].get<std::string>());
      continue;
    }
    compare_cells(device, *old, allowed, worse);
    for (const json& score : device.at("scores")) {
      const json* earlier = find_entry(old->at("scores"), score, {"name"});
      if (!earlier) continue;  // its cells failed, which is told above
      if (score.at("high").get<double>() < (1 - allowed) * earlier->at("low").get<double>())
        worse.push_back(
            fmt::format("{}: a score of {:.3g} after {:.3g}", score.at("name").get<std::string>(),
                        score.at("score").get<double>(), earlier->at("score").get<double>()));
    }
  }
  for (const json& old : before.at("devices"))
    if (now.at("every_device") == true && !find_entry(now.at("devices"), old, {"device"}))
      worse.push_back(
          fmt::format("{} is in the baseline and not to be used here; --device compares "
                      "one device alone",
                      old.at("device").get<std::string>()));
  return worse;
}

}  // namespace pellucid
