// RayTracer: the passes trace_closest and trace_any over a list of rays.
#include "render/ray_tracer.h"

#include "base/timer.h"
#include "render/diagnostics.h"
#include "shared/buffers.h"

namespace pellucid {

RayTracer::RayTracer(Device device, const PackedScene& scene, const PlanOptions& options)
    : device_(std::move(device)), options_(options) {
  set_scene(scene);
}

void RayTracer::set_scene(const PackedScene& scene) {
  info_ = scene.info, camera_ = scene.camera;
  buffers_ = upload_scene(device_, scene);
  buffers_["diag"] = device_.create_buffer("diag", DIAG_COUNT * sizeof(uint));
  const Specialisation special = specialise(scene, {}, device_.info(), options_);
  if (prelude_of(special) == prelude_) return;
  prelude_ = prelude_of(special);
  const KernelFiles files(options_.kernel_dir, options_.overlay);
  const auto build = [&](const std::string& name) {
    return device_.build(name, files.expand("passes/" + name + ".cl", prelude_),
                         options_of(special));
  };
  closest_ = build("trace_closest");
  any_ = build("trace_any");
}

void RayTracer::bind(Kernel& kernel) {
  unsigned index = 0;
  for (const std::string& name : bundle_buffers(Bundle::scene))
    kernel.set_buffer(index++, buffers_.at(name));
  kernel.set_bytes(index++, &info_, sizeof info_);
  kernel.set_bytes(index++, &camera_, sizeof camera_);
  for (const char* name : {"diag", "rays", "hits"}) kernel.set_buffer(index++, buffers_.at(name));
  kernel.set_bytes(index, &count_, sizeof count_);
}

void RayTracer::set_rays(const std::vector<TraceRay>& rays) {
  count_ = static_cast<uint>(rays.size());
  buffers_["rays"] = device_.create_buffer("rays", rays.size() * sizeof(TraceRay), rays.data());
  buffers_["hits"] = device_.create_buffer("hits", rays.size() * sizeof(TraceHit));
  for (Kernel* kernel : {&closest_, &any_}) {
    bind(*kernel);
    device_.launch(*kernel, count_, group_for(*kernel, options_.group),
                   nullptr);  // code generation happens here
  }
  device_.finish();
}

double RayTracer::trace(bool any) {
  const Timer timer;
  const Kernel& kernel = any ? any_ : closest_;
  device_.launch(kernel, count_, group_for(kernel, options_.group), nullptr);
  device_.finish();
  return timer.seconds();
}

std::vector<TraceHit> RayTracer::hits() {
  std::vector<TraceHit> out(count_);
  device_.read(buffers_.at("hits"), out.data(), out.size() * sizeof(TraceHit));
  return out;
}

std::vector<Counter> RayTracer::take_counters() {
  std::vector<Counter> counters = make_counters();
  collect_counters(device_, buffers_.at("diag"), counters);
  return counters;
}

}  // namespace pellucid
