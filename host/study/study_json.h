// Studies as documents: study.json holds all there is to know.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/study.h"

namespace pellucid {

/// "schema": 1. Verdicts are told with their options.
nlohmann::json study_document(const Study& study);

/// The inverse, bit for bit: numbers are written with all their digits. Throws InputError naming
/// `file` and the key.
Study read_study(const nlohmann::json& document, const std::string& file);

}  // namespace pellucid
