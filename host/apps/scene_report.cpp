// Parts of reports about scenes.
#include "apps/scene_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text.h"

namespace pellucid {
namespace {

const char* kind_of(const Material& material) {
  switch (material.kind) {
    case MaterialKind::diffuse:
      return "diffuse";
    case MaterialKind::mirror:
      return "mirror";
    case MaterialKind::dielectric:
      return "dielectric";
    case MaterialKind::conductor:
      return "conductor";
    case MaterialKind::phong:
      return "phong";
    case MaterialKind::oren_nayar:
      return "oren-nayar";
    case MaterialKind::plastic:
      return "plastic";
    case MaterialKind::thin_dielectric:
      return "thin-dielectric";
    case MaterialKind::mix:
      return "mix";
  }
  throw InternalError("unknown kind of material");
}

const char* kind_of(const PointLight&) {
  return "point";
}
const char* kind_of(const SpotLight&) {
  return "spot";
}
const char* kind_of(const DirectionalLight&) {
  return "directional";
}
const char* kind_of(const ConstantEnvironment&) {
  return "environment";
}

const char* kind_of(const Mesh&) {
  return "mesh";
}
const char* kind_of(const Sphere&) {
  return "sphere";
}
const char* kind_of(const Disk&) {
  return "disk";
}

const auto name_kind = [](const auto& thing) { return kind_of(thing); };

}  // namespace

FeatureSet all_features() {
  FeatureSet all;
  for (unsigned i = 0; i < FEATURE_COUNT; ++i) all.set(static_cast<Feature>(i));
  return all;
}

nlohmann::json feature_flags(FeatureSet set, FeatureSet among) {
  nlohmann::json flags = nlohmann::json::object();
  for (unsigned i = 0; i < FEATURE_COUNT; ++i) {
    const auto feature = static_cast<Feature>(i);
    if (among.has(feature)) flags[feature_word(feature)] = set.has(feature);
  }
  return flags;
}

nlohmann::json device_facts(const DeviceInfo& device) {
  return {{"spec", device.spec()},
          {"compute_units", device.compute_units},
          {"memory_bytes", device.memory},
          {"max_buffer_bytes", device.max_buffer}};
}

std::string memory_text(const Memory& buffers, const DeviceInfo& device) {
  std::vector<std::pair<std::size_t, std::string>> sorted;
  std::size_t total = 0;
  for (const auto& [name, bytes] : buffers) {
    sorted.emplace_back(bytes, name);
    total += bytes;
  }
  std::sort(sorted.rbegin(), sorted.rend());
  std::vector<std::string> parts;
  for (const auto& [bytes, name] : sorted)
    parts.push_back(fmt::format("{} {}", name, format_bytes(bytes)));
  const std::size_t largest = sorted.empty() ? 0 : sorted.front().first;
  return fmt::format("{} of {} on {}; largest buffer {} of at most {}: {}", format_bytes(total),
                     format_bytes(device.memory), device.name, format_bytes(largest),
                     format_bytes(device.max_buffer), join(parts));
}

std::map<std::string, int> material_kinds(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Material& material : scene.materials) ++counts[kind_of(material)];
  return counts;
}

std::map<std::string, int> light_kinds(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Light& light : scene.lights) ++counts[std::visit(name_kind, light)];
  for (const Shape& shape : scene.shapes)
    if (shape.emission) ++counts[std::visit(name_kind, shape.geometry)];
  return counts;
}

std::map<std::string, int> shape_kinds(const Scene& scene) {
  std::map<std::string, int> counts;
  for (const Shape& shape : scene.shapes) ++counts[std::visit(name_kind, shape.geometry)];
  return counts;
}

std::string counts_text(const std::map<std::string, int>& counts) {
  std::vector<std::string> parts;
  for (const auto& [kind, count] : counts) parts.push_back(fmt::format("{} {}", count, kind));
  return parts.empty() ? "none" : join(parts);
}

}  // namespace pellucid
