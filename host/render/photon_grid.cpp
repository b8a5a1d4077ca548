// PhotonGrid: the passes grid_keys to grid_ranges over a list of positions.
#include "render/photon_grid.h"

#include <algorithm>

#include "base/timer.h"
#include "render/launch.h"
#include "render/plan.h"
#include "shared/buffers.h"
#include "shared/limits.h"

namespace pellucid {

std::vector<Pass> grid_passes() {
  using B = Bundle;
  std::vector<Pass> passes{{"grid_keys", {B::light_vertices, B::grid}, Domain::photons}};
  for (uint digit = 0; digit < SORT_PASSES; ++digit) {
    passes.push_back({"grid_count", {B::grid}, Domain::blocks, false, digit});
    passes.push_back({"grid_scan", {B::grid}, Domain::sides, false, digit});
    passes.push_back({"grid_scatter", {B::grid}, Domain::blocks, false, digit});
  }
  passes.push_back({"grid_ranges", {B::light_vertices, B::grid}, Domain::photons});
  return passes;
}

namespace {
/// A method of these passes alone.
Integrator grid_alone() {
  Integrator method;
  method.wishes = {INTG_MERGE};
  method.passes = grid_passes();
  return method;
}
}  // namespace

PhotonGrid::PhotonGrid(Device device, const PlanOptions& options) : device_(std::move(device)) {
  const Specialisation special = specialise({}, grid_alone(), device_.info(), options);
  const KernelFiles files(options.kernel_dir);
  const auto build = [&](const std::string& name) {
    return device_.build(name, files.expand("passes/" + name + ".cl", prelude_of(special)),
                         options_of(special));
  };
  for (const Pass& pass : grid_passes()) {
    Kernel kernel = build(pass.name);
    const std::size_t group = group_for_pass(pass, kernel, options.group);
    steps_.push_back({pass, std::move(kernel), group});
  }
  probe_ = build("probe_grid");
  probe_group_ = group_for(probe_, options.group);
}

unsigned PhotonGrid::bind(Kernel& kernel, const std::vector<Bundle>& bundles) {
  unsigned index = 0;
  for (Bundle bundle : bundles)
    for (const std::string& name : bundle_buffers(bundle))
      kernel.set_buffer(index++, buffers_.at(name));
  return index;
}

void PhotonGrid::set_photons(const std::vector<F4>& positions, float radius, const F4& origin,
                             uint grid_bits) {
  std::vector<PathVertex> vertices(positions.size());
  std::vector<uint> order(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {  // slots are not places
    order[i] = uint(positions.size() - 1 - i);
    vertices[order[i]].p_offset = positions[i];
  }
  launch_ = {};
  launch_.photon_count = uint(positions.size());
  launch_.radius = radius;
  set_grid(launch_, origin, grid_bits);
  const std::size_t room = std::max<std::size_t>(positions.size(), 1);
  const auto create = [&](const std::string& name, std::size_t bytes) {
    buffers_[name] = device_.create_buffer(name, bytes);
  };
  for (const auto& [name, each] : vertex_buffers(grid_alone(), {}, "light"))
    create(name, room * each);
  create("light_last", sizeof(uint)), create("light_first", sizeof(uint));
  create("grid_digits", SORT_DIGITS * SORT_BLOCKS * sizeof(uint));
  create("grid_cells", (std::size_t{2} << grid_bits) * sizeof(uint));
  if (!positions.empty()) {
    device_.write(buffers_.at("light_vertices"), vertices.data(),
                  vertices.size() * sizeof(PathVertex));
    device_.write(buffers_.at("light_order"), order.data(), order.size() * sizeof(uint));
  }
  for (Step& step : steps_) step.launch_index = bind(step.kernel, step.pass.bundles);
}

double PhotonGrid::build() {
  const Timer timer;
  for (Step& step : steps_) {
    launch_.digit = step.pass.digit;
    step.kernel.set_bytes(step.launch_index, &launch_, sizeof launch_);
    device_.launch(step.kernel, domain_size(step.pass.domain, launch_, step.group), step.group,
                   step.time);
  }
  device_.finish();
  return timer.seconds();
}

std::map<std::string, double> PhotonGrid::take_times() {
  std::map<std::string, double> times;
  for (Step& step : steps_) {
    times[step.pass.name] += step.time->seconds;
    *step.time = {};
  }
  return times;
}

std::vector<GridPair> PhotonGrid::pairs() {
  std::vector<GridPair> out(launch_.photon_count);
  if (out.empty()) return out;
  device_.read(buffers_.at("grid_pairs"), out.data(), out.size() * sizeof(GridPair));
  return out;
}

std::vector<U4> PhotonGrid::find(const std::vector<F4>& points) {
  std::vector<U4> found(points.size());
  const uint n = uint(points.size());
  const Buffer list = device_.create_buffer("points", n * sizeof(F4), points.data());
  const Buffer out = device_.create_buffer("found", n * sizeof(U4));
  unsigned index = bind(probe_, {Bundle::grid});
  probe_.set_buffer(index++, list), probe_.set_buffer(index++, out);
  probe_.set_bytes(index++, &n, sizeof n), probe_.set_bytes(index, &launch_, sizeof launch_);
  device_.launch(probe_, n, probe_group_, nullptr);
  device_.finish();
  device_.read(out, found.data(), n * sizeof(U4));
  return found;
}

}  // namespace pellucid
