// Robust and naive rays side by side, as a document and as tables.
#include "apps/bench_robustness.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/markdown.h"
#include "bench/robust_bench.h"
#include "cl/device.h"
#include "stability/robustness.h"

namespace pellucid {
namespace {

using nlohmann::json;

/// Geometric mean of time over naive time, less 1, of all cells but renders, or of renders.
double mean_price(const json& prices, bool renders) {
  double sum = 0;
  int n = 0;
  for (const json& c : prices)
    if (c["energy"].is_number() == renders) sum += std::log1p(c["price"].get<double>()), ++n;
  return n ? std::expm1(sum / n) : 0;
}

std::string percent(double share) {
  return fmt::format("{:+.1f} %", 100 * share);
}

std::string per_million(const json& count, const json& of) {
  const auto n = count.get<double>();
  return n == 0 ? "0" : fmt::format("{:.3g}", 1e6 * n / of.get<double>());
}

}  // namespace

json robustness_document(const std::vector<PriceCell>& prices,
                         const std::vector<stability::Faults>& faults, const DeviceInfo& device) {
  json cells = json::array(), rows = json::array();
  for (const PriceCell& c : prices)
    cells.push_back({{"scene", c.scene},
                     {"triangles", c.triangles},
                     {"what", c.what},
                     {"mrays_per_s", c.ours.median},
                     {"naive_mrays_per_s", c.naive.median},
                     {"price", c.price.median},
                     {"price_low", c.price.low},
                     {"price_high", c.price.high},
                     {"energy", c.energy ? json(*c.energy) : json()},
                     {"differing", c.differing ? json(*c.differing) : json()}});
  for (const stability::Faults& f : faults)
    rows.push_back({{"what", f.what}, {"rays", f.rays}, {"faults", f.ours}, {"naive", f.naive}});
  return {{"workload", "robustness-1"},
          {"device", device.name},
          {"driver", device.platform_name + " " + device.driver},
          {"clock", device.cpu ? "cpu" : "wall"},
          {"prices", cells},
          {"price_rays", mean_price(cells, false)},
          {"price_renders", mean_price(cells, true)},
          {"faults", rows}};
}

std::string robustness_text(const json& d) {
  std::vector<std::vector<std::string>> prices{
      {"scene", "what", "Mrays/s", "naive", "costs", "95 %", "naive differs"}};
  for (const json& c : d["prices"])
    prices.push_back({c["scene"], c["what"], fmt::format("{:.2f}", c["mrays_per_s"].get<double>()),
                      fmt::format("{:.2f}", c["naive_mrays_per_s"].get<double>()),
                      percent(c["price"].get<double>()),
                      fmt::format("{:+.1f} to {:+.1f}", 100 * c["price_low"].get<double>(),
                                  100 * c["price_high"].get<double>()),
                      c["differing"].is_number()
                          ? fmt::format("{} rays", c["differing"].get<std::uint64_t>())
                          : fmt::format("{:+.3f} % light", 100 * c["energy"].get<double>())});
  std::vector<std::vector<std::string>> faults{{"faults per million rays", "naive", "here"}};
  for (const json& f : d["faults"])
    faults.push_back(
        {f["what"], per_million(f["naive"], f["rays"]), per_million(f["faults"], f["rays"])});
  constexpr std::size_t first_number = 2, first_count = 1;
  return fmt::format("{} ({} time)\n{}geometric mean: rays cost {}, renders {}\n\n{}",
                     d["device"].get<std::string>(), d["clock"].get<std::string>(),
                     markdown_table(prices, first_number), percent(d["price_rays"].get<double>()),
                     percent(d["price_renders"].get<double>()),
                     markdown_table(faults, first_count));
}

}  // namespace pellucid
