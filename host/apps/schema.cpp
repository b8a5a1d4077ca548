// schema: the scene format as a JSON schema, for editors.
#include <CLI/App.hpp>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/common.h"
#include "scene/json_schema.h"

namespace pellucid {

CommandRun setup_schema(CLI::App& app) {
  app.footer("Example: pellucid schema > scene.schema.json");
  return [](const CommonOptions& common) {
    const nlohmann::ordered_json schema = scene_json_schema();
    if (common.wants_text()) print_result(schema.dump(2) + "\n");
    write_json(common.json, {{"scene_schema", schema}});
    return ExitCode::done;
  };
}

}  // namespace pellucid
