// Fireflies and replayed samples as tables for people and as documents for scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "render/fireflies.h"
#include "render/replay.h"
#include "scene/scene.h"

namespace pellucid {

/// Where to look again: "12,40,7" as --replay takes it.
std::string replay_place(const Replay& replay);

/// All that happened: light of the sample, the eye path, and the light path of the brightest of it.
std::string replay_text(const Replay& replay, const Scene& scene);
nlohmann::json replay_json(const Replay& replay, const Scene& scene);

/// A sample that stands out, and how it came about.
struct FireflyReplay {
  Firefly firefly;
  Replay replay;
};
std::string fireflies_text(const std::vector<FireflyReplay>& list);
nlohmann::json fireflies_json(const std::vector<FireflyReplay>& list, const Scene& scene);

}  // namespace pellucid
