// What `compare` tells: a table for people, a document for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/compare_metrics.h"

namespace pellucid {

std::string comparison_table(const Comparison& found, const std::vector<Gate>& gates);
nlohmann::json comparison_json(const Comparison& found, const std::vector<Gate>& gates);

}  // namespace pellucid
