// The plan of a render in words and as JSON.
#include "apps/dry_run.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "apps/common.h"
#include "apps/scene_report.h"
#include "base/text.h"
#include "integrators/registry.h"
#include "render/launch.h"

namespace pellucid {
namespace {

nlohmann::json as_json(const RenderFacts& f, FeatureSet features, const MemoryPlan& memory,
                       const std::vector<std::string>& outputs) {
  using nlohmann::json;
  const json kernels = f.integrator->kernels();
  const RenderOptions& o = f.options;
  return {
      {"dry_run", true},
      {"scene", f.scene->name},
      {"file", f.scene->path},
      {"scene_hash", f.scene_hash},
      {"integrator", f.integrator->name},
      {"width", o.width},
      {"height", o.height},
      {"crop",
       {o.window().x0, o.window().x0 + o.window().width, o.window().y0,
        o.window().y0 + o.window().height}},
      {"spp", o.passes ? json(o.passes->last - o.passes->first) : json()},
      {"passes", o.passes ? json({o.passes->first, o.passes->last}) : json()},
      {"settings", settings_text(*f.scene, o)},
      {"time", o.seconds ? json(*o.seconds) : json()},
      {"error", o.error ? json(*o.error) : json()},
      {"seed", o.seed},
      {"max_depth", o.max_depth ? json(*o.max_depth) : json()},
      {"mis", mis_name(o.mis)},
      {"device", f.device->name},
      {"driver", f.device->platform_name + " " + f.device->driver},
      {"device_limits", device_facts(*f.device)},
      {"features", feature_flags(features, all_features())},
      {"kernels", kernels},
      {"memory_bytes", memory.buffers},
      {"memory_total", memory.device_bytes()},
      {"film_bytes", memory.film_bytes},
      {"tiles", memory.tiles.size()},
      {"radius", f.integrator->wishes.has(INTG_MERGE) ? json(merging_for(*f.packed, o).first_radius)
                                                      : json()},
      {"unreachable", unreachable_paths(*f.integrator, f.optics())},
      {"by_chance", chance_paths(*f.integrator, f.optics())},
      {"warnings", f.scene->warnings},
      {"outputs", outputs}};
}

std::string as_text(const RenderFacts& f, FeatureSet features, const MemoryPlan& memory,
                    const std::vector<std::string>& outputs) {
  const RenderOptions& o = f.options;
  const std::vector<std::string> kernels = f.integrator->kernels();
  std::vector<std::string> budget;
  if (o.passes)
    budget.push_back(fmt::format("{} spp, passes {}:{}", o.passes->last - o.passes->first,
                                 o.passes->first, o.passes->last));
  if (o.seconds) budget.push_back(format_seconds(*o.seconds));
  if (o.error) budget.push_back(fmt::format("error below {:g} %", 100 * *o.error));
  std::string text = fmt::format(
      "{}\n  scene     {}, hash {}\n  method    {}, mis {}, seed {}, max depth {}\n"
      "  film      {}\n  budget    {}\n  device    {} {}, {} {}\n  features  {}\n  kernels   {}\n"
      "  memory    {}\n",
      f.scene->name, f.scene->path, f.scene_hash, f.integrator->name, mis_name(o.mis), o.seed,
      o.max_depth ? std::to_string(*o.max_depth) : "unlimited", settings_text(*f.scene, o),
      join(budget, " or "), f.device->spec(), f.device->name, f.device->platform_name,
      f.device->driver, features.describe(), join(kernels), memory_text(memory.buffers, *f.device));
  if (f.integrator->uses(Bundle::light_vertices)) {
    std::size_t bytes = 0;
    for (const auto& [buffer, each] : vertex_buffers(*f.integrator, o.plan, "light")) bytes += each;
    text += fmt::format(
        "  vertices  {} bytes each of light paths; their buffers grow as the scene asks for it\n",
        bytes);
  }
  if (f.integrator->wishes.has(INTG_MERGE)) {
    const Merging merging = merging_for(*f.packed, o);
    text += fmt::format("  merging   radius {:.4g}, in pass i (from 0) times (i + 1)^{:.4g}\n",
                        merging.first_radius, 0.5 * (merging.alpha - 1));
  }
  if (memory.tiles.size() > 1) text += fmt::format("  bands     {}\n", memory.tiles.size());
  for (const std::string& blind : blind_spots(*f.integrator, f.optics(), integrators()))
    text += fmt::format("  unseen    {}\n", blind);
  for (const std::string& what : chance_paths(*f.integrator, f.optics()))
    text += fmt::format("  by chance {}: noisy if they are small\n", what);
  for (const std::string& name : outputs) text += fmt::format("  output    {}\n", name);
  return text;
}

}  // namespace

void tell_plan(const RenderFacts& f, const std::vector<std::string>& outputs,
               const CommonOptions& common) {
  const RenderOptions& o = f.options;
  const MemoryPlan memory = plan_memory(*f.device, *f.packed, *f.integrator, o);
  const Specialisation special = specialise(*f.packed, *f.integrator, *f.device, o.plan);
  if (special.features.has(INTG_COMPACT)) check_compact(*f.packed);
  const KernelFiles files(o.plan.kernel_dir);
  for (const Pass& pass : f.integrator->passes)  // a missing file shows
    files.expand("passes/" + pass.name + ".cl", prelude_of(special));
  if (common.wants_text()) print_result(as_text(f, special.features, memory, outputs));
  write_json(common.json, as_json(f, special.features, memory, outputs));
}

}  // namespace pellucid
