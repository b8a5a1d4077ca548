// Evidence and statistics of a render.
#include "apps/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/scene_report.h"
#include "base/phase_clock.h"
#include "base/text.h"
#include "base/version.h"
#include "integrators/registry.h"
#include "render/launch.h"

namespace pellucid {
namespace {

/// World to camera space (x right, y up, looking down -z), for row vectors as OpenEXR has it: p' =
/// p M.
glm::dmat4 world_to_camera(const Camera& camera) {
  const glm::dvec3 axes[3] = {camera.right, camera.up, -camera.forward};
  glm::dmat4 m(1.0);  // m[column][row] of the column-vector form
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) m[column][row] = axes[row][column];
    m[3][row] = -glm::dot(axes[row], camera.origin);
  }
  return m;
}

/// Perspective to x, y in [-1, 1] (y up) over the image.
glm::dmat4 camera_to_ndc(const ::Camera& camera, int width, int height) {
  const double distance = camera.forward.w;
  glm::dmat4 m(0.0);
  m[0][0] = 2 * distance / width;
  m[1][1] = 2 * distance / height;
  m[2][2] = -1.0;
  m[2][3] = -1.0;
  return m;
}

/// GLM keeps columns of the column-vector form: read in order, that is the row-vector matrix by
/// rows.
std::vector<float> row_vector_matrix(const glm::dmat4& m) {
  std::vector<float> out;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) out.push_back(float(m[c][r]) + 0.0f);  // no -0
  return out;
}

/// Options that decide what is rendered, by their names without "--"; those that a method knows
/// defaults of its own for only where they were given.
std::vector<std::pair<std::string, std::string>> settings(const Scene& scene,
                                                          const RenderOptions& o) {
  const Window w = o.window();
  std::vector<std::pair<std::string, std::string>> all{
      {"size", fmt::format("{}x{}", o.width, o.height)},
      {"crop", fmt::format("{},{},{},{}", w.x0, w.x0 + w.width, w.y0, w.y0 + w.height)},
      {"max-depth", o.max_depth ? std::to_string(*o.max_depth) : "unlimited"},
      {"mis", mis_name(o.mis)},
      {"filter", pixel_filter_info(scene.settings.filter).name},
      {"sampler", sampler_name(o.plan.sampler)}};
  if (o.light_paths) all.emplace_back("light-paths", std::to_string(*o.light_paths));
  if (o.radius) all.emplace_back("radius", fmt::format("{}", *o.radius));
  if (o.radius_alpha != RenderOptions().radius_alpha)
    all.emplace_back("radius-alpha", fmt::format("{}", o.radius_alpha));
  if (o.merge_first_only) all.emplace_back("merges", "first");
  if (o.plan.float_mode != FloatMode::strict)
    all.emplace_back("float", float_mode_name(o.plan.float_mode));
  if (o.plan.compact_vertices) all.emplace_back("vertices", "compact");
  return all;
}

std::string counters_text(const std::vector<Counter>& counters) {
  const std::string text = describe_counters(counters);
  return text.empty() ? "all zero" : text;
}

/// The contract's `error_estimate`.
nlohmann::json error_report(const RenderFacts& f) {
  using nlohmann::json;
  const std::optional<ErrorEstimate>& error = f.session->error();
  // Without --error nothing is known of the estimate's own error, so no confidence is claimed.
  if (!error) return {{"relmse", f.film.relmse}, {"confidence", nullptr}};
  json looks = json::array();
  for (const ErrorLook& look : error->looks())
    looks.push_back({{"spp", look.passes},
                     {"relmse", look.relmse},
                     {"relmse_expected", look.expected},
                     {"relmse_upper", look.upper},
                     {"groups", look.groups},
                     {"spread", look.spread},
                     {"effective", look.effective}});
  const bool known = !error->looks().empty();
  return {{"relmse", f.film.relmse},
          {"confidence", ErrorEstimate::confidence},
          {"relmse_upper", known ? json(error->looks().back().upper) : json()},
          {"target", error->target()},
          {"reached", error->reached()},
          {"groups", known ? error->looks().back().groups : 0},
          {"looks", looks},
          {"unknown", error_unknown(f)}};
}

}  // namespace

std::string settings_text(const Scene& scene, const RenderOptions& o) {
  std::string text;
  for (const auto& [name, value] : settings(scene, o))
    text += (text.empty() ? "" : " ") + (name == "size" ? value : name + " " + value);
  return text;
}

const char* mis_name(uint mis) {
  return mis == MIS_POWER ? "power" : mis == MIS_MAX ? "max" : "balance";
}

Evidence lasting_evidence(const RenderFacts& f) {
  Evidence meta;
  Camera camera = f.scene->camera;
  camera.origin += f.scene->origin;
  const glm::dmat4 to_camera = world_to_camera(camera);
  meta["worldToCamera"] = row_vector_matrix(to_camera);
  meta["worldToNDC"] = row_vector_matrix(
      camera_to_ndc(f.packed->camera, f.options.width, f.options.height) * to_camera);
  meta["pellucid:version"] = std::string(version()) + " " + commit();
  meta["pellucid:scene"] = f.scene->name;
  meta["pellucid:sceneHash"] = f.scene_hash;
  meta["pellucid:settings"] = settings_text(*f.scene, f.options);
  meta["pellucid:integrator"] = f.integrator->name;
  const auto unreachable = unreachable_paths(*f.integrator, f.optics());
  meta["pellucid:unreachable"] = unreachable.empty() ? "nothing" : join(unreachable, "; ");
  meta["pellucid:seed"] = std::to_string(f.options.seed);
  meta["pellucid:features"] = f.session->plan().specialisation().features.describe();
  meta["pellucid:floatMode"] = float_mode_name(f.options.plan.float_mode);
  meta["pellucid:device"] = f.device->name;
  meta["pellucid:driver"] = f.device->platform_name + " " + f.device->driver;
  return meta;
}

void add_progress(const Film& film, const FilmSummary& summary,
                  const std::vector<Counter>& counters, const DepthCuts& cuts, double seconds,
                  Evidence& meta) {
  meta["samplesPerPixel"] = int(std::min<std::uint64_t>(film.passes.count(), INT_MAX));
  meta["pellucid:passes"] = film.passes.text();
  meta["pellucid:counters"] = counters_text(counters);
  if (const std::string cut = describe_cuts(cuts); !cut.empty()) meta["pellucid:depthCut"] = cut;
  if (std::isfinite(summary.relmse)) meta["pellucid:relmseEstimate"] = float(summary.relmse);
  meta["renderTimeSeconds"] = float(seconds);
}

void add_error(const Film& film, const ErrorEstimate& error, Evidence& meta) {
  if (error.looks().empty() || error.looks().back().passes != film.passes.count()) return;
  meta["pellucid:relmseUpper"] = float(error.looks().back().upper);
  meta["pellucid:relmseConfidence"] = float(ErrorEstimate::confidence);
}

void make_deterministic(Evidence& evidence) {
  for (const char* name : {"renderTimeSeconds", "pellucid:device", "pellucid:driver"})
    evidence.erase(name);
}

std::map<std::string, std::string> identity(const RenderFacts& f) {
  std::map<std::string, std::string> all{{"scene", f.scene_hash},
                                         {"kernels", f.kernels_hash},
                                         {"layers", describe_layers(f.integrator->layers)},
                                         {"integrator", f.integrator->name},
                                         {"seed", std::to_string(f.options.seed)}};
  for (const auto& [name, value] : settings(*f.scene, f.options)) all.emplace(name, value);
  return all;
}

std::optional<double> known_error(const Evidence& evidence) {
  const auto found = evidence.find("pellucid:relmseUpper");
  const float* upper = found == evidence.end() ? nullptr : std::get_if<float>(&found->second);
  return upper ? std::optional<double>(std::sqrt(double(*upper))) : std::nullopt;
}

std::vector<std::string> error_unknown(const RenderFacts& f) {
  const Integrator& method = *f.integrator;
  std::vector<std::string> sentences = blind_spots(method, f.optics(), integrators());
  for (const std::string& what : chance_paths(method, f.optics()))
    sentences.push_back(
        fmt::format("'{}' finds {} by chance alone: those that no pass has met are not in the "
                    "estimate of the error",
                    method.name, what));
  if (method.wishes.has(INTG_MERGE)) {
    const Merging merging = merging_for(*f.packed, f.options);
    const std::uint64_t first = f.options.passes ? f.options.passes->first : 0;
    const std::uint64_t last = first + std::max<std::uint64_t>(f.film.iterations, 1) - 1;
    sentences.push_back(
        fmt::format("'{}' merges within a radius of {:.3g} in the first pass and {:.3g} in the "
                    "last: what that blurs is bias, which is not in the estimate of the error",
                    method.name, merging_radius(merging, first), merging_radius(merging, last)));
  }
  sentences.push_back("bright paths so rare that no pass has met one are in no estimate");
  return sentences;
}

std::string error_verdict(const ErrorEstimate& error) {
  const auto percent = [](double relmse) {
    return fmt::format("{:.3g} %", 100 * std::sqrt(relmse));
  };
  std::string known = "its passes are too few to say more";
  if (!error.looks().empty()) {
    const ErrorLook& look = error.looks().back();
    known = fmt::format(
        "with {:g} % confidence it is below {} ({})", 100 * ErrorEstimate::confidence,
        percent(look.upper),
        look.groups > 0 ? "expected: " + percent(look.expected) : "as an earlier render found");
    if (std::isinf(look.upper)) known = "the picture is black so far, which says nothing";
  }
  return fmt::format("error of {:.3g} % {}: {}", 100 * error.target(),
                     error.reached() ? "reached" : "not reached", known);
}

/// Of this process until now: parts, which add up, and `total`.
static nlohmann::json phase_seconds() {
  const PhaseClock& clock = process_clock();
  nlohmann::json seconds{{"total", clock.total()}};
#define X(name, meaning) seconds[#name] = clock.seconds(Phase::name);
  PHASES(X)
#undef X
  return seconds;
}

nlohmann::json cuts_json(const DepthCuts& cuts) {
  nlohmann::json shares = nlohmann::json::object();
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (cuts[i].paths) shares[cut_names()[i]] = cuts[i].share();
  return shares;
}

nlohmann::json render_stats(const RenderFacts& f) {
  using nlohmann::json;
  json counters = json::object();
  for (const Counter& c : f.session->counters()) counters[c.name] = c.count;
  json passes = json::array();
  for (const PassState& p : f.session->plan().passes()) {
    const auto same = std::find_if(passes.begin(), passes.end(),
                                   [&](const json& row) { return row["name"] == p.pass.name; });
    if (same == passes.end()) {
      passes.push_back({{"name", p.pass.name},
                        {"seconds", p.time->seconds},
                        {"launches", p.time->launches},
                        {"longest", p.time->longest}});
    } else {  // a kernel that runs more than once in an iteration
      (*same)["seconds"] = (*same)["seconds"].get<double>() + p.time->seconds;
      (*same)["launches"] = (*same)["launches"].get<std::uint64_t>() + p.time->launches;
      (*same)["longest"] = std::max((*same)["longest"].get<double>(), p.time->longest);
    }
  }
  double in_passes = 0;
  for (const json& pass : passes) in_passes += pass["seconds"].get<double>();
  const json seconds = phase_seconds();
  const double pixels = double(f.options.window().pixels());
  return {{"scene", f.scene->name},
          {"scene_hash", f.scene_hash},
          {"integrator", f.integrator->name},
          {"width", f.options.width},
          {"height", f.options.height},
          {"seed", f.options.seed},
          {"spp", f.film.iterations},
          {"paths", std::uint64_t(pixels) * f.film.iterations},
          {"rays", f.film.rays},
          {"mean", f.film.mean},
          {"seconds", seconds},
          {"render_seconds", f.render_seconds},
          {"passes", passes},
          {"outside_passes", seconds["render"].get<double>() - in_passes},
          {"features", feature_flags(f.session->plan().specialisation().features, all_features())},
          {"counters", counters},
          {"depth_cut", cuts_json(f.session->cuts())},
          {"unreachable", unreachable_paths(*f.integrator, f.optics())},
          {"memory_bytes", f.session->plan().memory()},
          {"film_bytes", f.session->memory().film_bytes},
          {"tiles", f.session->memory().tiles.size()},
          {"error_estimate", error_report(f)},
          {"device", f.device->name},
          {"driver", f.device->platform_name + " " + f.device->driver}};
}

}  // namespace pellucid
