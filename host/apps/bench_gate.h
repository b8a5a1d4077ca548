// Baselines of `bench`: an earlier result read and checked, and what got worse since.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace pellucid {

/// A share from 0% to below 100%. Throws UsageError.
double parse_allowed(const std::string& fail_slower);

/// Baselines that a result can be compared with; checked before the bench takes its minutes. Throws
/// InputError.
nlohmann::json read_rays_baseline(const std::string& file);
/// `scenes`: name -> hash of those that are to be rendered.
nlohmann::json read_render_baseline(const std::string& file, const nlohmann::json& scenes);

/// Whole sentences on what is worse than in the baseline or cannot be compared; empty: the gate
/// holds. Slower by more than `allowed`, a fraction, is worse.
std::vector<std::string> worse_rays(const nlohmann::json& now, const nlohmann::json& before,
                                    double allowed);
/// So are scores that fell by more, beyond their uncertainty, and errors that grew beyond what
/// chance explains: equal seeds give equal errors, unless something changed what is computed.
std::vector<std::string> worse_renders(const nlohmann::json& now, const nlohmann::json& before,
                                       double allowed);

}  // namespace pellucid
