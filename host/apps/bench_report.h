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

/// One device's part of the document: its facts, and a cell for every scene and method; scores
/// where `whole`, all workloads, are there.
nlohmann::json device_document(const std::vector<MethodCell>& cells, const DeviceInfo& device,
                               bool whole);
/// Of all devices: tables that read well in an issue.
std::string renders_text(const nlohmann::json& document);

nlohmann::json sampler_document(const std::vector<SamplerCell>& cells, const DeviceInfo& device);
std::string sampler_text(const nlohmann::json& document);

nlohmann::json sorts_document(const std::vector<SortCell>& cells, const DeviceInfo& device);
std::string sorts_text(const nlohmann::json& document);

}  // namespace pellucid
