// kind = "branches": the drape followed while all bending stiffnesses are scaled together, from the
// softest fabric to the stiffest and back, from several starts: which drapes there are, where they
// end, and how much a drape remembers.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/fold.h"
#include "core/cpu_clock.h"
#include "core/drape_protocol.h"
#include "core/durable_file.h"
#include "core/outline.h"
#include "core/support_contact.h"
#include "experiments/figure.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/summary.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kKeptSpacing = 0.5;  // of largest_step: states closer than this are not kept

/// One start followed up and down; each method is one part of it.
class BranchRun {
 public:
  BranchRun(const Settings& settings, std::shared_ptr<const Discretization> discretization,
            std::string start, int lobes)
      : settings_(settings),
        path_(scaled_path(settings.fabric, {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})),
        softest_(std::log(settings.branches.softest)),
        stiffest_(std::log(settings.branches.stiffest)),
        potential_(make_potential(std::move(discretization), path_.fabric(softest_), settings)),
        start_(std::move(start)),
        lobes_(lobes) {
    // what acts does not change along a branch
    if (settings.contact == ContactMode::support)
      potential_.set_support(support_contact(settings.scene));
    options_.largest_step = settings.branches.largest_step;
    options_.smallest_step = settings.branches.largest_step / 32;
    options_.equilibrium = equilibrium_options(settings);
  }

  /// False when an interrupt ended it.
  bool run(Progress& progress) {
    const double begin = thread_cpu_seconds();
    const Equilibrium drape =
        lobes_ > 0 ? drape_by_lobes(potential_, settings_.scene, lobes_, 0, options_.equilibrium)
                   : drape_by_coarse_ramp(potential_, settings_.start.seed, options_.equilibrium);
    status_ = name(drape.status);
    if (drape.converged()) {
      BranchState state = make_branch_state(potential_, path_, softest_, drape);
      for (const auto& [direction, end] : {std::pair{"up", stiffest_}, {"down", softest_}}) {
        direction_ = direction;
        keep(state);
        const SweepVisitor visitor{[&](const BranchState& at) { return visit(at); },
                                   [&](const Snap& snap) { add_snap(snap); }};
        const bool arrived = sweep(potential_, path_, end, options_, state, cost_, visitor);
        if (interrupted()) return false;
        if (!arrived) {
          status_ = std::string("lost on the way ") + direction;
          break;
        }
        progress.advance();
      }
    }
    cpu_ = thread_cpu_seconds() - begin;
    return true;
  }

  Json summary() const {
    return {{"start", start_},
            {"status", status_},
            {"snap_count", snaps_.size()},
            {"folds", folds_},
            {"solves", cost_.solves},
            {"newton_iterations", cost_.newton_iterations},
            {"factorizations", cost_.factorizations},
            {"cpu_seconds", cpu_},
            {"points", points_},
            {"snaps", snaps_}};
  }
  const std::vector<Record>& records() const { return records_; }

 private:
  bool visit(const BranchState& at) {
    if (snapped_ || std::abs(at.s - kept_s_) >= kKeptSpacing * settings_.branches.largest_step ||
        at.s == softest_ || at.s == stiffest_)
      keep(at);
    return !interrupted();
  }

  void keep(const BranchState& at) {
    potential_.set_fabric(path_.fabric(at.s));
    Record record = make_record(settings_, potential_, at.equilibrium);
    record.id = start_ + " " + direction_ + " " + std::to_string(points_.size());
    record.name = start_;
    points_.push_back({{"sweep", direction_},
                       {"segment", segment_},
                       {"factor", std::exp(at.s)},
                       {"drape_coefficient_percent", 100 * record.observation.drape_coefficient},
                       {"node_count", record.observation.node_count},
                       {"energy", record.stats.energy},
                       {"support_penetration", record.stats.support_penetration},
                       {"self_intersections", record.stats.self_intersections},
                       {"record", records_.size()}});
    records_.push_back(std::move(record));
    kept_s_ = at.s;
    snapped_ = false;
  }

  double coefficient_percent(const VecX& x) const {
    const Points2 outline = trace_outline(potential_.mesh(), settings_.scene, x).points;
    return 100 * drape_coefficient(settings_.scene, area(outline));
  }

  void add_snap(const Snap& snap) {
    const double before = coefficient_percent(snap.fold.x), after = coefficient_percent(snap.x);
    snaps_.push_back({{"start", start_},
                      {"sweep", direction_},
                      {"segment", segment_},
                      {"end", name(snap.fold.end)},
                      {"factor", std::exp(snap.fold.s)},
                      {"negative_eigenvalues", snap.fold.negative_eigenvalues},
                      {"vertex_jump", snap.vertex_jump},
                      {"drape_coefficient_percent_before", before},
                      {"drape_coefficient_percent_after", after},
                      {"drape_coefficient_percent_jump", after - before},
                      {"energy_drop", snap.energy_drop}});
    folds_ += snap.fold.end == BranchEnd::limit_point;
    ++segment_;
    snapped_ = true;
  }

  const Settings& settings_;
  FabricPath path_;
  double softest_, stiffest_;
  Potential potential_;
  std::string start_;
  int lobes_;
  BranchOptions options_;
  ContinuationCost cost_;
  std::string status_, direction_;
  Json points_ = Json::array(), snaps_ = Json::array();
  std::vector<Record> records_;
  int folds_ = 0, segment_ = 0;
  double kept_s_ = 0, cpu_ = 0;
  bool snapped_ = false;
};

void print_table(const Json& branches) {
  std::printf("%-10s %7s %7s %6s %12s %14s %8s\n", "start", "states", "snaps", "folds",
              "largest jump", "factorizations", "CPU s");
  for (const Json& branch : branches) {
    double largest = 0;
    for (const Json& snap : branch["snaps"])
      largest = std::max(largest, number(snap["vertex_jump"]));
    std::printf("%-10s %7zu %7zu %6d %9.1f mm %14d %8.1f  %s\n",
                branch["start"].get<std::string>().c_str(), branch["points"].size(),
                branch["snaps"].size(), branch["folds"].get<int>(), 1e3 * largest,
                branch["factorizations"].get<int>(), number(branch["cpu_seconds"]),
                branch["status"].get<std::string>().c_str());
  }
}

}  // namespace

RunOutcome run_branches(const Settings& settings, OutputFolder& folder) {
  std::vector<int> starts = settings.branches.lobes;
  if (settings.branches.ramp) starts.insert(starts.begin(), 0);
  const auto start_name = [](int lobes) {
    return lobes > 0 ? "lobes " + std::to_string(lobes) : std::string("coarse_ramp");
  };
  const int count = static_cast<int>(starts.size());
  const auto discretization = make_discretization(settings);
  const RecordsHeader header = records_header(settings, discretization->mesh());
  const JsonStore store(folder, "branches");
  const auto states_file = [&](int i) {
    return folder / ("branches/" + std::to_string(i) + ".h5");
  };
  int resumed = 0;
  for (int i = 0; i < count; ++i) resumed += store.has(std::to_string(i));
  {
    Progress progress("sweeps", 2 * count, 2 * resumed);
    for_each_item(count, settings.experiment.thread_count(), [&](int i) {
      if (store.has(std::to_string(i))) return;
      const int lobes = starts[static_cast<size_t>(i)];
      BranchRun branch(settings, discretization, start_name(lobes), lobes);
      if (!branch.run(progress)) return;
      write_records(states_file(i), header, branch.records());
      store.save(std::to_string(i), branch.summary());
    });
  }
  if (interrupted()) return {"partial", {}};

  Json branches = Json::array(), snaps = Json::array();
  std::vector<Record> records;
  int good = 0;
  double cpu = 0;
  for (int i = 0; i < count; ++i) {
    Json branch = store.load(std::to_string(i));
    for (Json& point : branch["points"])
      point["record"] = records.size() + point["record"].get<size_t>();
    for (const Json& snap : branch["snaps"]) snaps.push_back(snap);
    for (Record& record : read_records(states_file(i))) records.push_back(std::move(record));
    good += branch["status"] == "converged";
    cpu += number(branch["cpu_seconds"]);
    branches.push_back(std::move(branch));
  }
  write_records(folder / "results.h5", header, records);
  print_table(branches);
  RunOutcome outcome{good == count ? "ok" : good > 0 ? "partial" : "failed", {}};
  outcome.summary["vertices"] = discretization->mesh().vertex_count();
  outcome.summary["starts"] = count;
  outcome.summary["snap_count"] = snaps.size();
  outcome.summary["sweep_cpu_seconds"] = cpu;  // over all sessions of the run
  outcome.summary["branches"] = branches;
  outcome.summary["snaps"] = snaps;
  write_text_durably(folder / "branches.json", summary_text(outcome.summary));
  draw_figure("branches.py", folder / "results.h5", folder / "branches");
  return outcome;
}

}  // namespace drape
