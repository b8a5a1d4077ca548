// The stages of a study and how they share its budget.
#include "study/runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "base/error.h"
#include "base/log.h"
#include "base/statistics.h"
#include "base/text.h"
#include "base/timer.h"
#include "image/metrics.h"
#include "image/tonemap.h"
#include "integrators/registry.h"
#include "render/launch.h"
#include "study/analyse.h"
#include "study/embed.h"
#include "study/ladder.h"
#include "study/machine_load.h"
#include "study/pairs.h"
#include "study/race.h"
#include "study/recommend.h"
#include "study/referee.h"
#include "study/tiles.h"

namespace pellucid {
namespace {

// Shares of the budget (accuracy.md 9); what one leaves, the next has.
constexpr double until_reference = 0.4, until_main = 0.9;
constexpr std::uint64_t pilot_spp = 2 * SOBOL_BLOCK;
/// Seeds of the stages, far enough apart that none has another's, nor one that people give to a
/// render that may become a reference.
constexpr std::uint64_t pilot_seeds = 1000000, reference_seeds = 2000000, pair_seeds = 3000000,
                        main_seeds = 4000000, seeds_of_a_study = 10000000;
/// Radii that the best method that merges is tried with, too: a lucky one is no merit of it.
constexpr double other_radii[] = {0.5, 2.0};

/// Thrown between two runs when nothing is left; what comes after has no figures.
struct BudgetSpent {};

class Runner {
 public:
  Runner(const StudyStage& stage, const SceneOptics& optics, const StudyRequest& request)
      : stage_(stage), optics_(optics), request_(request) {}
  Study run();

 private:
  void enlist();
  void pilot();
  void refer();
  void add_radii();
  void replicate();
  void replicate_one(Entry& entry, int k);
  std::vector<Entry*> quickest();
  void compare_precisions();
  void finish(Entry& entry);
  Study gather(bool whole);
  std::uint64_t seed(std::uint64_t stage, int k) const {
    return request_.seed * seeds_of_a_study + stage + std::uint64_t(k);
  }
  void tell(const std::string& text) const;

  const StudyStage& stage_;
  const SceneOptics& optics_;
  const StudyRequest& request_;
  Timer clock_;
  MachineLoad load_;
  std::vector<Entry> entries_;
  Reference reference_;
  std::vector<PrecisionPair> pairs_;
  std::vector<std::string> notes_;
};

/// Before every run: what it is, and how long the whole study will still take.
void Runner::tell(const std::string& text) const {
  const double left = request_.budget_seconds - clock_.seconds();
  if (left <= 0) throw BudgetSpent();
  request_.tell(fmt::format("{}  at most {} left", text, format_seconds(left)));
}

/// Unbiased, and drawing all paths by design: two of these make a reference if there are any.
bool aims_at_all(const Integrator& method, const SceneOptics& optics) {
  return method.name != "reference" && !method.wishes.has(INTG_MERGE) &&
         unreachable_paths(method, optics).empty() && chance_paths(method, optics).empty();
}

/// Options asked for, and methods that could make the reference.
void Runner::enlist() {
  const std::vector<Integrator>& all = integrators();
  const bool any_aims = std::any_of(all.begin(), all.end(), [this](const Integrator& method) {
    return aims_at_all(method, optics_);
  });
  for (const Integrator& method : integrators()) {
    Entry entry;
    entry.option.unreachable = unreachable_paths(method, optics_);
    entry.option.chance = chance_paths(method, optics_);
    const auto& asked = request_.integrators;
    entry.asked = std::find(asked.begin(), asked.end(), method.name) != asked.end();
    const bool sees = entry.option.unreachable.empty();
    entry.voice = method.name != "reference" && sees;
    const bool needed = entry.voice && (!any_aims || aims_at_all(method, optics_));
    if (!entry.asked && (!needed || !request_.reference.empty())) continue;
    entry.contender = std::make_unique<Contender>(stage_, method, "strict");
    if (!sees) entry.option.state = OptionState::blind;
    entries_.push_back(std::move(entry));
  }
  for (Entry& entry : entries_) entry.contender->describe(entry.option);
}

/// What fails by itself leaves the study; the others go on.
template <typename F>
void attempt(Entry& entry, F&& work) {
  try {
    work();
  } catch (const Error& error) {
    entry.option.state = OptionState::refused;
    entry.option.reason = error.what();
    log_warn("{}: {}", entry.contender->method().name, error.what());
  }
}

void Runner::pilot() {
  for (Entry& entry : entries_) {
    tell(fmt::format("building kernels: {}", entry.contender->method().name));
    attempt(entry, [&] { entry.contender->run(seed(pilot_seeds, pilot_runs), SOBOL_BLOCK); });
  }
  for (int k = 0; k < pilot_runs; ++k)
    for (Entry& entry : entries_) {
      if (entry.option.state == OptionState::refused) continue;
      tell(fmt::format("pilot {} of {}: {}", k + 1, pilot_runs, entry.contender->method().name));
      attempt(entry, [&] {
        entry.pilots.push_back(entry.contender->run(seed(pilot_seeds, k), pilot_spp));
      });
      if (entry.pilots.empty() || all_finite(entry.pilots.back().picture)) continue;
      entry.option.state = OptionState::refused;
      entry.option.reason = "its pictures hold pixels that are no numbers";
    }
}

void Runner::refer() {
  if (!request_.reference.empty()) {
    const Window window = stage_.options.window();
    reference_ = read_reference(
        request_.reference, {window.width, window.height, request_.scene_hash, request_.settings,
                             seed(main_seeds, 0), seed(main_seeds, main_runs - 1)});
    return;
  }
  reference_ = choose_reference(entries_, seed(reference_seeds, 0),
                                until_reference * request_.budget_seconds - clock_.seconds(),
                                [this](const std::string& text) { tell(text); });
}

/// The most promising method that merges, with other radii; these are the first to be left out
/// where time is short.
void Runner::add_radii() {
  const Entry* best = nullptr;
  for (Entry* entry : racing(entries_))
    if (entry->option.merges && entry->option.state == OptionState::main &&
        (!best || entry->option.pilot_efficiency > best->option.pilot_efficiency))
      best = entry;
  if (!best) return;
  std::vector<Entry> others;
  for (double factor : other_radii) {
    Entry other;
    other.contender = std::make_unique<Contender>(best->contender->with_radius(factor));
    other.option.chance = best->option.chance;
    other.asked = true;
    other.contender->describe(other.option);
    others.push_back(std::move(other));
  }
  for (Entry& other : others) entries_.push_back(std::move(other));
}

void Runner::replicate_one(Entry& entry, int k) {
  StudyRun run;
  run.seed = seed(main_seeds, k);
  const double energy = energy_of(reference_.picture);
  std::vector<Picture> pictures;
  entry.contender->run(run.seed, entry.ladder, [&](const LadderStep& step) {
    Rung rung = step.rung;
    rung.relmse = weighted_distance(step.picture, reference_.picture, reference_.weights) -
                  reference_.facts.relmse;
    rung.energy_ratio = energy > 0 ? energy_of(step.picture) / energy : 1;
    run.rungs.push_back(rung);
    pictures.push_back(step.picture);
  });
  if (!all_finite(pictures.back())) {
    entry.option.state = OptionState::refused;
    entry.option.reason = "its pictures hold pixels that are no numbers";
    return;
  }
  for (std::size_t r = 0; r < pictures.size(); ++r) entry.stacks[r].add(std::move(pictures[r]));
  entry.option.runs.push_back(std::move(run));
}

/// Rounds in which every option has one run, in an order of their own.
void Runner::replicate() {
  std::mt19937 shuffle(static_cast<unsigned>(request_.seed));
  std::vector<Entry*> order = racing(entries_);
  for (int k = 0; k < main_runs; ++k) {
    std::shuffle(order.begin(), order.end(), shuffle);
    for (Entry* entry : order) {
      const bool blind = entry->option.state == OptionState::blind;
      if (entry->option.state == OptionState::refused || (blind && k >= blind_runs)) continue;
      if (clock_.seconds() + entry->contender->cost(entry->ladder.back()) >
          until_main * request_.budget_seconds)
        continue;  // it would end too late
      tell(fmt::format("round {} of {}: {}", k + 1, main_runs, entry->option.name()));
      attempt(*entry, [&] { replicate_one(*entry, k); });
    }
    request_.save(gather(false));
  }
}

/// The two quickest options once more, each beside itself in other precisions.
/// The two that would reach the target first, among those that may be recommended.
std::vector<Entry*> Runner::quickest() {
  Study so_far = gather(false);
  analyse(so_far);
  std::vector<std::pair<double, Entry*>> all;
  for (std::size_t i = 0; i < so_far.options.size(); ++i) {
    const StudyOption& option = so_far.options[i];
    if (!eligible(option, so_far.verdicts[i]) || !option.plain()) continue;
    for (Entry& entry : entries_)
      if (entry.asked && entry.option.name() == option.name())
        all.emplace_back(so_far.verdicts[i].high, &entry);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  constexpr std::size_t most = 2;
  std::vector<Entry*> out;
  for (const auto& [seconds, entry] : all)
    if (out.size() < most) out.push_back(entry);
  return out;
}

void Runner::compare_precisions() {
  std::vector<PairJob> jobs;
  const std::vector<Entry*> those = quickest();
  for (const std::string& precision : request_.precisions) {
    if (precision == "strict") continue;
    const std::size_t before = jobs.size();
    for (const Entry* entry : those)
      if (precision != "compact" || entry->contender->method().uses(Bundle::light_vertices))
        jobs.push_back({entry->contender.get(), precision});
    if (jobs.size() == before)
      notes_.push_back(fmt::format("precision {} was not compared: {}", precision,
                                   those.empty() ? "no method is known to reach the target"
                                                 : "neither of the quickest two stores vertices"));
  }
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const double left = request_.budget_seconds - clock_.seconds();
    try {
      const auto pair = compare_precision(stage_, jobs[i], reference_.weights, seed(pair_seeds, 0),
                                          left / double(jobs.size() - i),
                                          [this](const std::string& t) { tell(t); });
      if (pair) pairs_.push_back(*pair);
    } catch (const Error& error) {  // that precision alone is not to be had here
      log_warn("{} {}: {}", jobs[i].strict->method().name, jobs[i].precision, error.what());
    }
  }
}

void Runner::finish(Entry& entry) {
  for (std::size_t r = 0; r < entry.stacks.size() && entry.stacks[r].size() >= 3; ++r) {
    Split split =
        entry.stacks[r].split(reference_.picture, reference_.weights, reference_.facts.relmse);
    split.spp = entry.ladder[r];
    entry.option.splits.push_back(split);
  }
  if (entry.stacks.empty() || entry.stacks.back().size() == 0) return;
  const Window window = stage_.options.window();
  entry.option.tiles = tile_errors({window.width, window.height}, entry.stacks.back(),
                                   reference_.picture, reference_.weights);
  const auto within =
      std::count_if(entry.option.tiles.begin(), entry.option.tiles.end(),
                    [&](double relmse) { return relmse <= request_.target * request_.target; });
  entry.option.tiles_within = double(within) / double(entry.option.tiles.size());
}

/// All that is known; `whole`: with what is drawn from the pictures, which takes a while.
Study Runner::gather(bool whole) {
  Study study;
  study.target = request_.target;
  study.budget_seconds = request_.budget_seconds;
  study.seconds = clock_.seconds();
  study.seed = request_.seed;
  study.width = stage_.options.window().width, study.height = stage_.options.window().height;
  study.reference = reference_.facts;
  study.machine.foreign_load = load_.share();
  for (Entry& entry : entries_) {
    if (!entry.asked) continue;
    entry.contender->describe(entry.option);
    if (whole) finish(entry);
    study.options.push_back(entry.option);
  }
  study.pairs = pairs_;
  study.warnings = notes_;
  for (const PrecisionPair& pair : pairs_) {
    StudyOption option;
    option.integrator = pair.integrator, option.precision = pair.precision;
    option.wrong = pair.wrong;
    for (const StudyOption& strict : study.options)
      if (strict.integrator == pair.integrator && strict.plain())
        option.merges = strict.merges, option.radius_alpha = strict.radius_alpha;
    study.options.push_back(option);
  }
  return study;
}

/// One run's picture and its errors, at the last rung.
void add_pictures(const Reference& reference, const std::vector<Entry>& entries, Study& study,
                  const std::string& folder) {
  if (reference.picture.empty()) return;
  const Image truth = image_of(reference.picture, study.width, study.height);
  study.reference.picture = embedded(to_display(truth), folder);
  for (StudyOption& option : study.options)
    for (const Entry& entry : entries) {
      if (!entry.asked || entry.option.name() != option.name()) continue;
      const bool raced = !entry.stacks.empty() && entry.stacks.back().size() > 0;
      if (!raced && entry.pilots.empty()) continue;
      const Picture& picture =
          raced ? entry.stacks.back().pictures().front() : entry.pilots.front().picture;
      const Image image = image_of(picture, study.width, study.height);
      option.picture = embedded(to_display(image), folder);
      option.error_map = embedded(false_colour(error_map(image, truth)), folder);
    }
}

Study Runner::run() {
  bool complete = true;
  enlist();
  try {
    pilot();
    refer();
    if (!(energy_of(reference_.picture) > 0))
      throw InputError(fmt::format("the reference ({}) is black: no error is relative to nothing",
                                   reference_.facts.source));
    eliminate(reference_, entries_);
    add_radii();
    plan_ladders(until_main * request_.budget_seconds - clock_.seconds(), entries_);
    replicate();
    compare_precisions();
  } catch (const StudyStopped&) {
    complete = false;
  } catch (const BudgetSpent&) {
    log_info("the budget of {} is spent", format_seconds(request_.budget_seconds));
  }
  Study study = gather(true);
  study.complete = complete;
  add_pictures(reference_, entries_, study, request_.folder);
  return study;
}

}  // namespace

std::uint64_t study_host_bytes(std::uint64_t pixels, std::size_t methods) {
  constexpr std::uint64_t usual_rungs = 8, bytes_per_pixel = 3 * sizeof(float);
  return pixels * bytes_per_pixel * usual_rungs * main_runs * (methods + std::size(other_radii));
}

Study run_study(const StudyStage& stage, const SceneOptics& optics, const StudyRequest& request) {
  return Runner(stage, optics, request).run();
}

}  // namespace pellucid
