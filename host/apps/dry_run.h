// render --dry-run: what would be rendered.
#pragma once

#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/render_report.h"

namespace pellucid {

/// Prints the plan of a render, as text or as JSON, after the checks that need no kernels: sources
/// of the kernels, memory. `facts` need no session. Throws what the render would.
void tell_plan(const RenderFacts& facts, const std::vector<std::string>& outputs,
               const CommonOptions& common);

}  // namespace pellucid
