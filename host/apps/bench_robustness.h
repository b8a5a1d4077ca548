// `bench --only robustness`: what rays without faults cost, and the faults that they do not have.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pellucid {

struct DeviceInfo;
struct PriceCell;
namespace stability {
struct Faults;
}

nlohmann::json robustness_document(const std::vector<PriceCell>& prices,
                                   const std::vector<stability::Faults>& faults,
                                   const DeviceInfo& device);
/// The document as two tables.
std::string robustness_text(const nlohmann::json& document);

}  // namespace pellucid
