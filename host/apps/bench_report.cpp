// The benchmark's results as documents and tables.
#include "apps/bench_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/ray_bench.h"
#include "bench/sampler_bench.h"
#include "bench/sort_bench.h"

namespace pellucid {
namespace {

nlohmann::json number(const std::optional<Figure>& f) {
  return f ? nlohmann::json(f->median) : nlohmann::json();
}

/// Geometric mean of a ratio over all cells, or 0 where there is none.
double geometric_mean(const nlohmann::json& rays, const char* key) {
  double sum = 0;
  for (const auto& cell : rays) {
    if (!cell[key].is_number()) return 0;
    sum += std::log(cell[key].get<double>());
  }
  return rays.empty() ? 0 : std::exp(sum / double(rays.size()));
}

}  // namespace

nlohmann::json rays_document(const RayBench& bench, const DeviceInfo& device) {
  using nlohmann::json;
  json rays = json::array(), builds = json::array();
  for (const RayCell& c : bench.rays)
    rays.push_back({{"triangles", c.triangles},
                    {"kind", ray_kind_name(c.kind)},
                    {"mrays_per_s", c.mrays_per_s.median},
                    {"mrays_per_s_iqr", c.mrays_per_s.iqr},
                    {"embree_mrays_per_s", number(c.embree_mrays_per_s)},
                    {"ratio", number(c.ratio)},
                    {"embree_robust_mrays_per_s", number(c.embree_robust_mrays_per_s)},
                    {"ratio_robust", number(c.ratio_robust)},
                    {"differing_hits", c.differing_hits}});
  for (const BuildCell& b : bench.builds)
    builds.push_back({{"triangles", b.triangles},
                      {"seconds", b.seconds},
                      {"embree_seconds", b.embree_seconds ? json(*b.embree_seconds) : json()}});
  return {{"workload", "rays-1"},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"clock", bench.clock},
          {"rays", rays},
          {"build", builds}};
}

std::string rays_text(const nlohmann::json& d) {
  const auto text_of = [](const nlohmann::json& v, const char* format) {
    return v.is_number() ? fmt::format(fmt::runtime(format), v.get<double>()) : std::string("-");
  };
  std::string text =
      fmt::format("{} ({} time)\n{:>10} {:>9} {:>9} {:>9} {:>7} {:>9} {:>7} {:>9}\n",
                  d["device"].get<std::string>(), d["clock"].get<std::string>(), "triangles",
                  "kind", "Mrays/s", "Embree", "ratio", "robust", "ratio", "differing");
  for (const auto& c : d["rays"])
    text += fmt::format("{:>10} {:>9} {:>9.2f} {:>9} {:>7} {:>9} {:>7} {:>9}\n",
                        c["triangles"].get<int>(), c["kind"].get<std::string>(),
                        c["mrays_per_s"].get<double>(), text_of(c["embree_mrays_per_s"], "{:.2f}"),
                        text_of(c["ratio"], "{:.2f}"),
                        text_of(c["embree_robust_mrays_per_s"], "{:.2f}"),
                        text_of(c["ratio_robust"], "{:.2f}"), c["differing_hits"].get<int>());
  if (const double mean = geometric_mean(d["rays"], "ratio"); mean > 0)
    text += fmt::format("geometric mean: {:.3f} of Embree, {:.3f} of its robust mode\n", mean,
                        geometric_mean(d["rays"], "ratio_robust"));
  for (const auto& b : d["build"])
    text +=
        fmt::format("build {:>10} triangles: {:.3f} s, Embree {} s\n", b["triangles"].get<int>(),
                    b["seconds"].get<double>(), text_of(b["embree_seconds"], "{:.3f}"));
  return text;
}

nlohmann::json sampler_document(const std::vector<SamplerCell>& cells, const DeviceInfo& device) {
  using nlohmann::json;
  json samplers = json::array();
  for (const SamplerCell& c : cells)
    samplers.push_back({{"scene", c.scene},
                        {"spp", c.spp},
                        {"relmse_random", c.relmse_random},
                        {"relmse_sobol", c.relmse_sobol},
                        {"gain_equal_spp", c.gain_equal_spp()},
                        {"ns_per_path_random", c.ns_per_path_random},
                        {"ns_per_path_sobol", c.ns_per_path_sobol},
                        {"gain_equal_time", c.gain_equal_time()}});
  return {{"workload", "sampler-1"},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"clock", device.cpu ? "cpu" : "wall"},
          {"samplers", samplers}};
}

std::string sampler_text(const nlohmann::json& d) {
  std::string text =
      fmt::format("{} ({} time)\n{:>24} {:>5} {:>10} {:>10} {:>10} {:>9} {:>9} {:>11}\n",
                  d["device"].get<std::string>(), d["clock"].get<std::string>(), "scene", "spp",
                  "relMSE", "by sobol", "equal spp", "ns/path", "by sobol", "equal time");
  for (const auto& c : d["samplers"])
    text += fmt::format("{:>24} {:>5} {:>10.3g} {:>10.3g} {:>9.2f}x {:>9.0f} {:>9.0f} {:>10.2f}x\n",
                        c["scene"].get<std::string>(), c["spp"].get<int>(),
                        c["relmse_random"].get<double>(), c["relmse_sobol"].get<double>(),
                        c["gain_equal_spp"].get<double>(), c["ns_per_path_random"].get<double>(),
                        c["ns_per_path_sobol"].get<double>(), c["gain_equal_time"].get<double>());
  return text + fmt::format("geometric mean: {:.2f}x at equal spp, {:.2f}x at equal time\n",
                            geometric_mean(d["samplers"], "gain_equal_spp"),
                            geometric_mean(d["samplers"], "gain_equal_time"));
}

nlohmann::json sorts_document(const std::vector<SortCell>& cells, const DeviceInfo& device) {
  using nlohmann::json;
  json sorts = json::array();
  for (const SortCell& c : cells) {
    json passes = json::object();
    for (const auto& [pass, seconds] : c.passes) passes[pass] = seconds;
    sorts.push_back({{"photons", c.photons},
                     {"build_mphotons_per_s", c.build.median},
                     {"build_mphotons_per_s_iqr", c.build.iqr},
                     {"stable_sort_mphotons_per_s", c.stable_sort.median},
                     {"ratio_stable_sort", c.ratio_stable.median},
                     {"radix_sort_mphotons_per_s", c.radix_sort.median},
                     {"ratio_radix_sort", c.ratio_radix.median},
                     {"pass_seconds", passes}});
  }
  return {{"workload", "sort-1"},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"clock", device.cpu ? "cpu" : "wall"},
          {"sorts", sorts}};
}

std::string sorts_text(const nlohmann::json& d) {
  std::string text = fmt::format(
      "{} ({} time), millions of photons per second\n{:>9} {:>7} {:>12} {:>6} {:>11} "
      "{:>6}  ms of passes\n",
      d["device"].get<std::string>(), d["clock"].get<std::string>(), "photons", "grid",
      "stable_sort", "ratio", "radix sort", "ratio");
  for (const auto& c : d["sorts"]) {
    text += fmt::format(
        "{:>9} {:>7.1f} {:>12.1f} {:>6.2f} {:>11.1f} {:>6.2f} ", c["photons"].get<int>(),
        c["build_mphotons_per_s"].get<double>(), c["stable_sort_mphotons_per_s"].get<double>(),
        c["ratio_stable_sort"].get<double>(), c["radix_sort_mphotons_per_s"].get<double>(),
        c["ratio_radix_sort"].get<double>());
    for (const auto& [pass, seconds] : c["pass_seconds"].items())
      text += fmt::format(" {} {:.2f}", pass.substr(5), 1e3 * seconds.get<double>());  // "grid_"
    text += "\n";
  }
  return text + "the grid: keys, sort and photons in order, by all cores; the host's: by one\n";
}

}  // namespace pellucid
