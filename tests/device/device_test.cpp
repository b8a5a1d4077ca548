// Devices, programs and buffers: what works, and how failures read.
#include "cl/device.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "cl/sources.h"
#include "integrators/registry.h"
#include "render/math_probe.h"
#include "render/selftest.h"
#include "render/session.h"
#include "stability/probes.h"
#include "stability/traced_scene.h"

namespace pellucid {
namespace {

template <typename F>
std::string message_of(F&& call) {
  try {
    call();
  } catch (const DeviceError& e) {
    return e.what();
  }
  return "";
}

TEST(DeviceTest, UnknownDeviceListsThoseThatExist) {
  const std::string message = message_of([] { Device::open("no such device"); });
  EXPECT_NE(message.find("no such device"), std::string::npos) << message;
  EXPECT_NE(message.find(Device::open("").info().name), std::string::npos) << message;
}

TEST(DeviceTest, OpensByIndexAndByPartOfName) {
  const DeviceInfo first = list_devices().front();
  EXPECT_EQ(Device::open(first.spec()).info().name, first.name);
  EXPECT_EQ(Device::open(first.name.substr(0, 6)).info().name, first.name);
}

TEST(DeviceTest, BufferAboveTheLimitIsRefusedWithTheFigure) {
  Device device = Device::open("");
  const std::size_t bytes = device.info().max_buffer + 1;
  const std::string message = message_of([&] { device.create_buffer("huge", bytes); });
  EXPECT_NE(message.find("huge"), std::string::npos) << message;
  EXPECT_NE(message.find("at most"), std::string::npos) << message;
}

TEST(DeviceTest, BuffersStartAtZeroAndKeepWhatIsWritten) {
  Device device = Device::open("");
  std::vector<uint> data(1000, 7u);
  Buffer buffer = device.create_buffer("zeros", data.size() * sizeof(uint));
  device.read(buffer, data.data(), buffer.bytes());
  EXPECT_EQ(data, std::vector<uint>(1000, 0u));
  data[17] = 42;
  device.write(buffer, data.data(), buffer.bytes());
  std::vector<uint> back(1000);
  device.read(buffer, back.data(), buffer.bytes());
  EXPECT_EQ(back, data);
}

TEST(DeviceTest, BuildErrorsCarryTheCompilersLog) {
  Device device = Device::open("");
  const std::string message =
      message_of([&] { device.build("broken", "#line 7 \"passes/broken.cl\"\nkernel oops", ""); });
  EXPECT_NE(message.find("passes/broken.cl:7"), std::string::npos) << message;
  EXPECT_NE(message.find("broken"), std::string::npos) << message;
}

TEST(DeviceTest, LayoutsAgree) {
  Device device = Device::open("");
  const std::vector<std::string> differences = probe_layout(device);
  EXPECT_TRUE(differences.empty()) << differences.front();
}

TEST(DeviceTest, ArithmeticIsExactEnough) {
  Device device = Device::open("");
  for (const MathError& e : probe_math(device, FloatMode::strict, 1000))
    EXPECT_TRUE(e.holds()) << e.function << ": " << e.worst << " " << e.unit;
}

TEST(DeviceTest, ListsOfRaysAreTraced) {
  using namespace stability;
  const Lab lab{Device::open("")};
  Scene scene = empty_scene();
  add_shape(scene, lump(500));
  Random random(1);
  std::vector<TraceRay> rays;
  for (int i = 0; i < 64; ++i) rays.push_back(ray_along(random.in_box(0.2), random.direction()));
  const RayConfig robust;
  std::vector<TraceHit> first;
  for (const RayConfig& config : {robust, naive_rays}) {
    TracedScene traced(lab, scene, config);
    const BothHits hits = traced.both(rays);
    if (first.empty()) first = hits.closest;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      EXPECT_NE(hits.any[i].prim, NONE) << i;
      EXPECT_EQ(hits.closest[i].prim, first[i].prim) << i << ": none of these is near an edge";
      EXPECT_NEAR(hits.closest[i].t, first[i].t, 1e-5) << i;
    }
    EXPECT_EQ(traced.errors(), 0u);
  }
}

TEST(DeviceTest, FramesAndWalks) {
  using namespace stability;
  const Lab lab{Device::open("")};
  for (const DeviceFrame& f : FrameProbe(lab).frames({{0, 0, -1, 0}, {0.6f, 0, 0.8f, 0}}))
    EXPECT_NEAR(f.s.x * f.t.x + f.s.y * f.t.y + f.s.z * f.t.z, 0, 2e-7);
  Scene scene = empty_scene(1.0);
  scene.materials[0].kind = MaterialKind::mirror;
  add_shape(scene, lump(500));
  constexpr uint bounces = 8;
  const std::vector<TraceRay> rays{ray_along({}, {1, 0, 0}), ray_along({}, {0, 0.6, 0.8})};
  for (const WalkEnd& end : WalkProbe(lab, scene).walk(rays, bounces))
    EXPECT_EQ(end.bounces, bounces);
}

/// The order of parameters comes from buffers.h on both sides; the device compiler's names prove
/// it.
TEST(DeviceTest, ParameterNamesAreTheBundles) {
  const Device device = Device::open("");
  const Scene scene;
  const PackedScene packed = pack_scene(scene, {simd_width_for(device.info())});
  for (const Integrator& integrator : integrators()) {
    RenderOptions options;
    options.width = options.height = 8;
    options.passes = PassRange{0, 1};
    const Session session(device, packed, integrator, options);
    for (const PassState& pass : session.plan().passes()) {
      std::vector<std::string> expected = parameter_names(pass.pass);
      EXPECT_EQ(pass.kernel.parameter_names(), expected)
          << integrator.name << " " << pass.pass.name;
    }
  }
}

TEST(DeviceTest, KnownRadianceOnEveryUsableDeviceAndMethod) {
  for (const DeviceInfo& info : list_devices()) {
    if (!info.unusable.empty()) continue;
    const Device device = Device::open(info.spec());
    for (const Integrator& integrator : integrators()) {
      const SelfTestRender result = selftest_render(device, integrator);
      EXPECT_TRUE(result.passed) << info.name << " " << integrator.name << ": " << result.mean
                                 << " +- " << result.standard_error << ", not " << result.expected;
    }
  }
}

}  // namespace
}  // namespace pellucid
