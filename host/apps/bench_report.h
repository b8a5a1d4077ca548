// The benchmark's results: as documents for scripts, and from those as tables for people.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pellucid {

struct DeviceInfo;
struct MethodCell;
struct RayBench;
struct SamplerCell;
struct SortCell;

nlohmann::json rays_document(const RayBench& bench, const DeviceInfo& device);
std::string rays_text(const nlohmann::json& document);

nlohmann::json methods_document(const std::vector<MethodCell>& cells, const DeviceInfo& device);
std::string methods_text(const nlohmann::json& document);

nlohmann::json sampler_document(const std::vector<SamplerCell>& cells, const DeviceInfo& device);
std::string sampler_text(const nlohmann::json& document);

nlohmann::json sorts_document(const std::vector<SortCell>& cells, const DeviceInfo& device);
std::string sorts_text(const nlohmann::json& document);

}  // namespace pellucid
