// Studies to JSON and back: one list of keys for each struct.
#include "study/study_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"

namespace pellucid {

NLOHMANN_JSON_SERIALIZE_ENUM(OptionState, {{OptionState::main, "main"},
                                           {OptionState::too_slow, "too slow"},
                                           {OptionState::pilot, "pilot"},
                                           {OptionState::blind, "blind"},
                                           {OptionState::refused, "refused"}})
NLOHMANN_JSON_SERIALIZE_ENUM(TargetKind, {{TargetKind::unknown, "unknown"},
                                          {TargetKind::measured, "measured"},
                                          {TargetKind::interpolated, "interpolated"},
                                          {TargetKind::extrapolated, "extrapolated"},
                                          {TargetKind::beyond, "beyond"},
                                          {TargetKind::never, "never"}})
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Rung, spp, seconds, relmse, energy_ratio, wall_seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StudyRun, seed, rungs)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Split, spp, variance, bias2, bias2_upper90)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PassSeconds, name, seconds)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PrecisionPair, integrator, precision, spp, bias2, bias2_upper90,
                                   time_ratio, time_low, time_high, divergent_per_million, wrong,
                                   runs)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StudyReference, source, relmse, energy_error, disagreement,
                                   trusted, doubt, picture, variance_known)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StudyMachine, device, driver, version, clock, threads,
                                   foreign_load)

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StudyOption, integrator, precision, state, reason, unreachable,
                                   chance, merges, radius_alpha, radius, radius_factor,
                                   setup_seconds, memory_bytes, wrong, pilot_efficiency, runs,
                                   splits, passes, tiles, tiles_within, picture, error_map)

namespace {

using nlohmann::json;

json verdict_json(const Verdict& v) {
  return {{"kind", v.kind},
          {"seconds_to_target", v.seconds},
          {"low", v.low},
          {"high", v.high},
          {"beyond_factor", v.beyond_factor},
          {"slope",
           {{"value", v.slope},
            {"low", v.slope_low},
            {"high", v.slope_high},
            {"expected", {v.slope_from, v.slope_to}}}},
          {"fit",
           {{"noise", v.noise},
            {"bias", v.bias},
            {"exponent", v.exponent},
            {"residual", v.fit_residual}}},
          {"energy_ratio", {{"value", v.energy}, {"low", v.energy_low}, {"high", v.energy_high}}},
          {"flags", v.flags}};
}

/// A time there is none of is null, not a number.
void blank_unknown(json& option, TargetKind kind) {
  if (kind == TargetKind::never || kind == TargetKind::unknown)
    for (const char* key : {"seconds_to_target", "low", "high"}) option[key] = nullptr;
  if (kind == TargetKind::beyond) option["high"] = nullptr;
}

double or_zero(const json& value) {
  return value.is_null() ? 0.0 : value.get<double>();
}

/// Of an enumeration: nlohmann takes any word that it does not know for the first one.
template <typename E>
E known(const json& word) {
  const E value = word.get<E>();
  if (json(value) != word) throw InputError(word.dump() + " is no word for this");
  return value;
}

Verdict read_verdict(const json& j) {
  Verdict v;
  v.kind = known<TargetKind>(j.at("kind"));
  v.seconds = or_zero(j.at("seconds_to_target"));
  v.low = or_zero(j.at("low")), v.high = or_zero(j.at("high"));
  v.beyond_factor = j.at("beyond_factor").get<double>();
  const json &slope = j.at("slope"), &fit = j.at("fit"), &energy = j.at("energy_ratio");
  v.slope = slope.at("value").get<double>();
  v.slope_low = slope.at("low").get<double>(), v.slope_high = slope.at("high").get<double>();
  v.slope_from = slope.at("expected").at(0).get<double>();
  v.slope_to = slope.at("expected").at(1).get<double>();
  v.noise = fit.at("noise").get<double>(), v.bias = fit.at("bias").get<double>();
  v.exponent = fit.at("exponent").get<double>();
  v.fit_residual = fit.at("residual").get<double>();
  v.energy = energy.at("value").get<double>();
  v.energy_low = energy.at("low").get<double>(), v.energy_high = energy.at("high").get<double>();
  v.flags = j.at("flags").get<std::vector<std::string>>();
  return v;
}

void read_all(const json& j, Study& s) {
  if (j.at("schema").get<int>() != 1) throw InputError("\"schema\" is not 1");
  j.at("scene").get_to(s.scene), j.at("scene_hash").get_to(s.scene_hash);
  j.at("settings").get_to(s.settings);
  j.at("width").get_to(s.width), j.at("height").get_to(s.height);
  j.at("target").get_to(s.target), j.at("budget_seconds").get_to(s.budget_seconds);
  j.at("seconds").get_to(s.seconds), j.at("seed").get_to(s.seed);
  j.at("complete").get_to(s.complete), j.at("warnings").get_to(s.warnings);
  j.at("machine").get_to(s.machine), j.at("reference").get_to(s.reference);
  j.at("pairs").get_to(s.pairs);
  for (const json& option : j.at("options")) {
    known<OptionState>(option.at("state"));
    s.options.push_back(option.get<StudyOption>());
    s.verdicts.push_back(read_verdict(option));
  }
  j.at("recommended").get_to(s.recommended), j.at("equals").get_to(s.equals);
  const int last = int(s.options.size()) - 1;
  if (s.recommended < -1 || s.recommended > last)
    throw InputError("\"recommended\" is not the number of an option");
  for (int i : s.equals)
    if (i < 0 || i > last) throw InputError("\"equals\" holds what is not the number of an option");
  j.at("recommendation").get_to(s.recommendation);
  j.at("would_change").get_to(s.would_change);
}

}  // namespace

json study_document(const Study& s) {
  json options = json::array();
  for (std::size_t i = 0; i < s.options.size(); ++i) {
    json option = s.options[i];
    if (i < s.verdicts.size()) {
      option.update(verdict_json(s.verdicts[i]));
      blank_unknown(option, s.verdicts[i].kind);
    }
    options.push_back(option);
  }
  return {{"schema", 1},
          {"scene", s.scene},
          {"scene_hash", s.scene_hash},
          {"settings", s.settings},
          {"width", s.width},
          {"height", s.height},
          {"target", s.target},
          {"budget_seconds", s.budget_seconds},
          {"seconds", s.seconds},
          {"seed", s.seed},
          {"complete", s.complete},
          {"warnings", s.warnings},
          {"machine", s.machine},
          {"reference", s.reference},
          {"options", options},
          {"pairs", s.pairs},
          {"recommended", s.recommended},
          {"equals", s.equals},
          {"recommendation", s.recommendation},
          {"would_change", s.would_change}};
}

Study read_study(const json& document, const std::string& file) {
  Study study;
  try {
    read_all(document, study);
  } catch (const json::exception& e) {
    throw InputError(fmt::format("{}: not a study of this version: {}", file, e.what()));
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: not a study of this version: {}", file, e.what()));
  }
  return study;
}

}  // namespace pellucid
