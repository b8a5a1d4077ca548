// The passes probe_frame and probe_walk.
#include "stability/probes.h"

#include "integrators/registry.h"
#include "shared/buffers.h"

namespace pellucid::stability {
namespace {

Kernel build(const Lab& lab, Device& device, const std::string& name, const PackedScene& packed) {
  PlanOptions options;
  options.sampler = Sampler::random;
  const Specialisation special = specialise(packed, {}, device.info(), options);
  return device.build(
      name, KernelFiles(lab.kernel_dir).expand("passes/" + name + ".cl", prelude_of(special)),
      options_of(special));
}

}  // namespace

FrameProbe::FrameProbe(const Lab& lab)
    : device_(lab.device), kernel_(build(lab, device_, "probe_frame", pack_scene({}, {4}))) {}

std::vector<DeviceFrame> FrameProbe::frames(const std::vector<F4>& normals) {
  std::vector<DeviceFrame> out(normals.size());
  const auto n = uint(normals.size());
  const Buffer in = device_.create_buffer("normals", n * sizeof(F4), normals.data());
  const Buffer found = device_.create_buffer("frames", n * sizeof(DeviceFrame));
  kernel_.set_buffer(0, in), kernel_.set_buffer(1, found), kernel_.set_bytes(2, &n, sizeof n);
  device_.launch(kernel_, n, group_for(kernel_, 0), nullptr);
  device_.finish();
  device_.read(found, out.data(), n * sizeof(DeviceFrame));
  return out;
}

WalkProbe::WalkProbe(const Lab& lab, const Scene& scene)
    : device_(lab.device),
      packed_(pack_scene(scene, {simd_width_for(lab.device.info())})),
      kernel_(build(lab, device_, "probe_walk", packed_)) {}

std::vector<WalkEnd> WalkProbe::walk(const std::vector<TraceRay>& rays, uint bounces) {
  std::vector<WalkEnd> out(rays.size());
  const auto n = uint(rays.size());
  std::map<std::string, Buffer> buffers = upload_scene(device_, packed_);
  buffers["diag"] = device_.create_buffer("diag", DIAG_COUNT * sizeof(uint));
  buffers["rays"] = device_.create_buffer("rays", n * sizeof(TraceRay), rays.data());
  buffers["ends"] = device_.create_buffer("ends", n * sizeof(WalkEnd));
  Launch launch{};
  launch.max_depth = bounces;
  unsigned index = 0;
  for (const std::string& name : bundle_buffers(Bundle::scene))
    kernel_.set_buffer(index++, buffers.at(name));
  kernel_.set_bytes(index++, &packed_.info, sizeof packed_.info);
  kernel_.set_bytes(index++, &packed_.camera, sizeof packed_.camera);
  for (const char* name : {"diag", "rays", "ends"}) kernel_.set_buffer(index++, buffers.at(name));
  kernel_.set_bytes(index++, &n, sizeof n);
  kernel_.set_bytes(index, &launch, sizeof launch);
  device_.launch(kernel_, n, group_for(kernel_, 0), nullptr);
  device_.finish();
  device_.read(buffers.at("ends"), out.data(), n * sizeof(WalkEnd));
  return out;
}

}  // namespace pellucid::stability
