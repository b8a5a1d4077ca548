// `bench --only stability`: the suite of hard cases on a device.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stability/suite.h"

namespace pellucid {

/// The cases that --case names, by name or number; all where it names none. Throws UsageError.
std::vector<const stability::Case*> choose_cases(const std::vector<std::string>& asked);

/// Runs them one after another.
nlohmann::json run_stability(const std::vector<const stability::Case*>& cases, stability::Lab lab);

/// The document as a table.
std::string stability_text(const nlohmann::json& document);

/// Names of the cases, for --help.
std::string stability_help();

}  // namespace pellucid
