// kind = "estimation_precision": outline and parameter error of a fit against CPU time, for several
// ways to fit (fit_methods.h).
//
// The outlines are exact, of random fabrics. A fit starts on the target's own branch, continued to
// the first parameters: what is compared is the optimiser alone, not how the branch is found. First
// parameters without that branch are drawn again.
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/durable_file.h"
#include "core/random.h"
#include "experiments/figure.h"
#include "experiments/fit_methods.h"
#include "experiments/interrupt.h"
#include "experiments/json_store.h"
#include "experiments/kinds.h"
#include "experiments/model.h"
#include "experiments/parallel_items.h"
#include "experiments/progress.h"
#include "experiments/recovery.h"
#include "experiments/recovery_targets.h"
#include "experiments/statistics.h"
#include "experiments/summary.h"
#include "experiments/work_precision_report.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kErrors[] = {"outline_mm", "bending_error", "shear_error"};
constexpr int kDraws = 20;              // of first parameters
constexpr double kQuarter = 25;         // the spread of a curve: the middle half [per cent]
constexpr double kBendingFound = 0.02;  // relative, see recovery_report.h
constexpr double kShearFound = 0.1;
constexpr double kOutlineFound = 0.01;  // [mm]

/// One fit: of which fabric, from which start, by which method.
struct Case {
  int fabric, start;
  FitMethodInfo method;

  std::string item() const {
    return std::to_string(fabric) + "_" + std::to_string(start) + "_" + method.name;
  }
};

/// A target's outline and a drape of other parameters on its branch.
struct Start {
  Fabric truth;
  ParameterSpace space;  ///< about the first fabric
  Picture picture;
};

/// Throws std::runtime_error where there is no such drape.
Start make_start(const Settings& settings, const RandomTargets& targets,
                 const std::shared_ptr<const Discretization>& discretization, int fabric,
                 int start) {
  const Record target = targets[fabric];
  if (!converged(target)) throw std::runtime_error("no target: " + target.stats.status);
  const Potential model =
      as_draped(make_potential(discretization, target.fabric, settings), target, settings.scene);
  const std::uint64_t seed =
      seed_of_item(settings.experiment.seed, static_cast<std::uint64_t>(fabric));
  for (int draw = 0; draw < kDraws; ++draw) {
    const Fabric first =
        perturbed(target.fabric, settings.estimate,
                  seed_of_item(seed, static_cast<std::uint64_t>(kDraws * (start + 1) + draw)));
    const BranchTest branch = follow_target(model, target, first, estimate_options(settings));
    if (!branch.shared) continue;
    OutlineObservation seen;
    seen.profile = target.observation.profile;
    seen.noise = settings.estimate.outline_noise;
    seen.noise_harmonics = settings.estimate.noise_harmonics;
    return {target.fabric,
            {settings.estimate.parameters, first},
            {model, settings.scene, seen, branch.start}};
  }
  throw std::runtime_error("none of " + std::to_string(kDraws) +
                           " first parameters shares the target's branch");
}

/// Largest relative error of the parameters that `counts` selects; NaN if there is none.
double largest_error(const Start& start, const VecX& z, bool (*counts)(Parameter)) {
  const Fabric found = start.space.decode(z);
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const Parameter p : start.space.parameters)
    if (counts(p)) largest = std::fmax(largest, std::abs(found[p] / start.truth[p] - 1));
  return largest;
}

bool is_bending(Parameter p) {
  return p == Parameter::k_bu || p == Parameter::k_bv || p == Parameter::k_bh;
}
bool is_shear(Parameter p) { return p == Parameter::k_h; }

Json run_case(const Settings& settings, const Start& start, const FitMethodInfo& method,
              double cpu_seconds) {
  TracedFitOptions options;
  options.cpu_seconds = cpu_seconds;
  options.bound_factor = settings.estimate.bounds;
  options.tolerance = settings.solver.tolerance;
  options.continuation = estimate_options(settings).continuation;
  const TracedFit fit = traced_fit(method.method, start.picture, start.space, options);
  const OutlineObservation& seen = start.picture.seen;
  Json trace = {{"cpu_seconds", Json::array()}, {"forward_solves", Json::array()}};
  for (const char* error : kErrors) trace[error] = Json::array();
  for (const FitMoment& moment : fit.moments) {
    trace["cpu_seconds"].push_back(moment.cpu_seconds);
    trace["forward_solves"].push_back(moment.forward_solves);
    // J = 1/2 N (rms / noise)^2
    trace["outline_mm"].push_back(1e3 * seen.noise *
                                  std::sqrt(2 * moment.cost / seen.independent_values()));
    trace["bending_error"].push_back(largest_error(start, moment.z, is_bending));
    trace["shear_error"].push_back(largest_error(start, moment.z, is_shear));
  }
  return {{"outcome", fit.converged ? "converged" : "stopped"},
          {"message", fit.message},
          {"trace", trace}};
}

/// Number of forward solves at a CPU time of a run.
double solves_at(const Json& run, double time) {
  double solves = std::numeric_limits<double>::infinity();
  const Json& trace = run["trace"];
  for (size_t i = 0; i < trace["cpu_seconds"].size(); ++i)
    if (trace["cpu_seconds"][i].get<double>() <= time && std::isfinite(time))
      solves = trace["forward_solves"][i].get<double>();
  return solves;
}

Json account_of(const ComparedRuns& compared) {
  std::map<std::string, int> outcomes;
  std::map<std::string, std::vector<double>> last, seconds, solves;
  const std::map<std::string, double> found{{"outline_mm", kOutlineFound},
                                            {"bending_error", kBendingFound},
                                            {"shear_error", kShearFound}};
  int recovered = 0;
  for (const Json& run : compared.runs) {
    ++outcomes[run["outcome"].get<std::string>()];
    bool all = true;
    for (const auto& [error, tolerance] : found) {
      const Json& values = run["trace"][error];
      const double time = time_within(run, error, tolerance);
      seconds[error].push_back(time);
      solves[error].push_back(solves_at(run, time));
      last[error].push_back(number(values.back()));
      all = all && !(number(values.back()) > tolerance);
    }
    recovered += all;
  }
  Json row = {{"label", compared.label},
              {"fits", compared.runs.size()},
              {"outcomes", outcomes},
              {"recovered", recovered}};
  for (const auto& [error, tolerance] : found)
    row[error] = {{"last_median", median(last[error])},
                  {"tolerance", tolerance},
                  {"cpu_seconds_median", median(seconds[error])},
                  {"forward_solves_median", median(solves[error])}};
  return row;
}

void print_account(const Json& accounts) {
  std::printf("%-36s %9s %14s %14s %14s %14s\n", "", "recovered", "s to .01 mm", "s to 2 % k_b",
              "solves to it", "last k_b error");
  for (const auto& [method, row] : accounts.items())
    std::printf("%-36s %4d of %2d %14.3g %14.3g %14.3g %14.2e\n",
                row["label"].get<std::string>().c_str(), row["recovered"].get<int>(),
                row["fits"].get<int>(), number(row["outline_mm"]["cpu_seconds_median"]),
                number(row["bending_error"]["cpu_seconds_median"]),
                number(row["bending_error"]["forward_solves_median"]),
                number(row["bending_error"]["last_median"]));
  std::fflush(stdout);  // the script of the figure prints as well
}

}  // namespace

RunOutcome run_estimation_precision(const Settings& settings, OutputFolder& folder) {
  const EstimationPrecisionSettings& study = settings.estimation_precision;
  const std::vector<FitMethodInfo> methods = compared_fits(study.methods);
  const JsonStore store(folder, "fits");
  const auto discretization = make_discretization(settings);
  const RandomTargets targets(settings, discretization);
  const double budget =
      study.cpu_seconds * discretization->mesh().vertex_count() / 1000;  // at 1000 vertices
  const int starts = study.fabrics * study.starts;
  const int total = starts * static_cast<int>(methods.size());
  const auto case_of = [&](int start, const FitMethodInfo& method) {
    return Case{start / study.starts, start % study.starts, method};
  };
  int resumed = 0;
  for (int s = 0; s < starts; ++s)
    for (const FitMethodInfo& method : methods) resumed += store.has(case_of(s, method).item());
  {
    Progress progress("estimation-precision", total, resumed);
    for_each_item(starts, settings.experiment.thread_count(), [&](int s) {
      std::optional<Start> start;
      std::string failure;
      for (const FitMethodInfo& method : methods) {
        const Case c = case_of(s, method);
        if (store.has(c.item()) || interrupted()) continue;
        try {
          if (!start && failure.empty())
            start = make_start(settings, targets, discretization, c.fabric, c.start);
        } catch (const std::runtime_error& error) {
          failure = error.what();
          progress.note("fabric " + std::to_string(c.fabric) + ", start " +
                        std::to_string(c.start) + ": " + failure);
        }
        store.save(c.item(), start ? run_case(settings, *start, method, budget)
                                   : Json{{"outcome", "no_start"}, {"message", failure}});
        progress.advance();
      }
    });
  }
  if (interrupted()) return {"partial", {}};

  Json accounts = Json::object(), curves = Json::object(), failures = Json::array();
  for (const FitMethodInfo& method : methods) {
    ComparedRuns compared{method.name, method.label, {}};
    for (int s = 0; s < starts; ++s) {
      const Case c = case_of(s, method);
      const Json run = store.load(c.item());
      if (run["outcome"] == "no_start") {
        if (method.name == methods.front().name)
          failures.push_back(
              {{"fabric", c.fabric}, {"start", c.start}, {"message", run["message"]}});
        continue;
      }
      compared.runs.push_back(run);
    }
    if (compared.runs.empty()) continue;
    accounts[method.name] = account_of(compared);
    for (const char* error : kErrors)
      curves[error].push_back(error_curve(compared, error, budget, kQuarter));
  }
  if (accounts.empty()) return {"failed", {{"failures", failures}}};
  print_account(accounts);
  const Json chart = {{"fabrics", study.fabrics},
                      {"starts", study.starts},
                      {"vertices", discretization->mesh().vertex_count()},
                      {"fits", accounts.front()["fits"]},
                      {"budget_cpu_seconds", budget},
                      {"curves", curves}};
  write_text_durably(folder / "curves.json", summary_text(chart));
  draw_figure("estimation_precision.py", folder / "curves.json", folder / "estimation_precision");
  Json summary = chart;
  summary.erase("curves");
  summary.update({{"failures", failures}, {"methods", accounts}});
  return {failures.empty() ? "ok" : "partial", std::move(summary)};
}

}  // namespace drape
