// `compare --explain`: which of two pictures is taken for known, and what is told.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/compare_noise.h"
#include "explain/explain.h"

namespace pellucid {

/// Throws UsageError if neither picture has layers by path length, InputError if those there are do
/// not add up to their picture. Both are finite and of one size.
explain::Explanation explain_pair(const NamedImage& a, const NamedImage& b);

std::string explanation_text(const explain::Explanation& x);
nlohmann::json explanation_json(const explain::Explanation& x);

}  // namespace pellucid
