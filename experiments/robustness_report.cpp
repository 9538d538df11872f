#include "experiments/robustness_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "core/equilibrium.h"
#include "experiments/json_store.h"
#include "experiments/replay.h"
#include "experiments/statistics.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTargetResidual = 1e-8;

template <class Value>
std::vector<double> column(const std::vector<RobustnessSolve>& solves, Value value) {
  std::vector<double> values;
  for (const RobustnessSolve& solve : solves) values.push_back(value(solve));
  return values;
}

/// null for NaN and infinity
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json finite_percentiles(const std::vector<double>& values) {
  Json result = percentiles(values);
  for (auto& entry : result) entry = finite(number(entry));
  return result;
}

std::string replay(const RobustnessSolve& solve, const std::filesystem::path& run) {
  const std::string index = std::to_string(solve.index), size = std::to_string(solve.size);
  return replay_command(run, "replay_" + size + "_" + index,
                        {"robustness.only=[" + index + "]", "robustness.vertices=[" + size + "]"});
}

std::string three(const Json& of, const char* format) {
  char text[96];
  std::snprintf(text, sizeof text, format, number(of["50"]), number(of["95"]), number(of["100"]));
  return text;
}

}  // namespace

double RobustnessSolve::target() const { return std::fmax(kTargetResidual, rounding_floor); }

nlohmann::ordered_json to_json(const RobustnessSolve& s) {
  return {{"index", s.index},
          {"seed", s.seed},
          {"distribution", s.distribution},
          {"size", s.size},
          {"failure", s.failure},
          {"reason", s.reason},
          {"bending_length", finite(s.bending_length)},
          {"residual", finite(s.residual)},
          {"rounding_floor", finite(s.rounding_floor)},
          {"negative_eigenvalues", s.negative_eigenvalues},
          {"newton_iterations", s.newton_iterations},
          {"factorizations", s.factorizations},
          {"wings_past_threshold", s.wings_past_threshold},
          {"contact_with_support", s.contact_with_support},
          {"self_intersections", s.self_intersections},
          {"cpu_seconds", finite(s.cpu_seconds)},
          {"unit_cpu_seconds", finite(s.unit_cpu_seconds)}};
}

RobustnessSolve robustness_solve(const nlohmann::ordered_json& json) {
  RobustnessSolve s;
  s.index = json.at("index");
  s.seed = json.at("seed");
  s.distribution = json.at("distribution").get<std::string>();
  s.size = json.at("size");
  s.failure = json.at("failure").get<std::string>();
  s.reason = json.at("reason").get<std::string>();
  s.bending_length = number(json.at("bending_length"));
  s.residual = number(json.at("residual"));
  s.rounding_floor = number(json.at("rounding_floor"));
  s.negative_eigenvalues = json.at("negative_eigenvalues");
  s.newton_iterations = json.at("newton_iterations");
  s.factorizations = json.at("factorizations");
  s.wings_past_threshold = json.at("wings_past_threshold");
  s.contact_with_support = json.at("contact_with_support");
  s.self_intersections = json.at("self_intersections");
  s.cpu_seconds = number(json.at("cpu_seconds"));
  s.unit_cpu_seconds = number(json.at("unit_cpu_seconds"));
  return s;
}

std::string failure_class(const RobustnessSolve& solve, const std::string& status, bool finite) {
  if (!finite || !std::isfinite(solve.residual))
    return std::string(name(EquilibriumStatus::non_finite));
  if (status != name(EquilibriumStatus::converged)) return status;
  if (solve.negative_eigenvalues != 0) return "not_certified";
  if (!(solve.residual <= solve.target())) return "residual_above_target";
  return "";
}

nlohmann::ordered_json account(const std::vector<RobustnessSolve>& solves) {
  int converged = 0, certified = 0, both_regimes = 0, on_support = 0, self_intersecting = 0;
  std::map<std::string, int> classes;
  std::vector<double> over_target;
  for (const RobustnessSolve& solve : solves) {
    converged += solve.failure.empty();
    certified += solve.negative_eigenvalues == 0;
    both_regimes += solve.wings_past_threshold > 0;
    on_support += solve.contact_with_support;
    self_intersecting += solve.self_intersections > 0;
    if (!solve.failure.empty()) ++classes[solve.failure];
    over_target.push_back(solve.residual / solve.target());
  }
  const auto worst = [](const std::vector<double>& values) {
    return finite(percentile(values, 100));
  };
  const auto all = [&](auto value) { return column(solves, value); };
  using Solve = const RobustnessSolve&;
  const auto cpu = all([](Solve s) { return s.cpu_seconds; });
  return {
      {"fabrics", solves.size()},
      {"converged", converged},
      {"certified_minima", certified},
      {"worst_residual", worst(all([](Solve s) { return s.residual; }))},
      {"worst_rounding_floor", worst(all([](Solve s) { return s.rounding_floor; }))},
      {"worst_residual_over_target", worst(over_target)},
      {"with_wings_past_threshold", both_regimes},
      {"contact_with_support", on_support},
      {"self_intersecting", self_intersecting},
      {"cpu_seconds_percentiles", finite_percentiles(cpu)},
      {"milliseconds_percentiles",
       finite_percentiles(all([](Solve s) { return 1e3 * s.cpu_seconds; }))},
      {"factorizations_percentiles",
       finite_percentiles(all([](Solve s) { return static_cast<double>(s.factorizations); }))},
      {"newton_iterations_percentiles",
       finite_percentiles(all([](Solve s) { return static_cast<double>(s.newton_iterations); }))},
      {"factorization_equivalents_percentiles",
       finite_percentiles(all([](Solve s) { return s.units(); }))},
      {"unit_milliseconds_median",
       finite(median(all([](Solve s) { return 1e3 * s.unit_cpu_seconds; })))},
      {"failure_classes", Json(classes)}};
}

nlohmann::ordered_json failures(const std::vector<RobustnessSolve>& solves,
                                const std::filesystem::path& run) {
  Json list = Json::array();
  for (const RobustnessSolve& solve : solves)
    if (!solve.failure.empty())
      list.push_back({{"index", solve.index},
                      {"seed", solve.seed},
                      {"distribution", solve.distribution},
                      {"vertices", solve.size},
                      {"class", solve.failure},
                      {"reason", solve.reason},
                      {"residual", finite(solve.residual)},
                      {"bending_length", finite(solve.bending_length)},
                      {"replay", replay(solve, run)}});
  return list;
}

std::string csv(const std::vector<RobustnessSolve>& solves) {
  std::ostringstream text;
  text.precision(17);
  text << "index,distribution,size,bending_length_m,residual,rounding_floor,newton_iterations,"
          "factorizations,wings_past_threshold,cpu_seconds,unit_cpu_seconds,failure\n";
  const auto add = [&](double number) {
    if (std::isfinite(number)) text << number;
    text << ',';
  };
  for (const RobustnessSolve& s : solves) {
    text << s.index << ',' << s.distribution << ',' << s.size << ',';
    for (double number : {s.bending_length, s.residual, s.rounding_floor}) add(number);
    text << s.newton_iterations << ',' << s.factorizations << ',' << s.wings_past_threshold << ',';
    for (double number : {s.cpu_seconds, s.unit_cpu_seconds}) add(number);
    text << s.failure << '\n';
  }
  return text.str();
}

std::string table_head() {
  char text[256];
  std::snprintf(text, sizeof text, "%-16s %7s %9s %9s %9s %9s   %-18s %-17s %-17s %7s\n", "",
                "fabrics", "converged", "certified", "residual", "/ target", "ms 50/95/100 %",
                "units", "factorisations", "ms/unit");
  return text;
}

std::string table_row(const std::string& label, const nlohmann::ordered_json& account) {
  char text[256];
  std::snprintf(text, sizeof text, "%-16s %7d %9d %9d %9.1e %9.2f   %-18s %-17s %-17s %7.2f\n",
                label.c_str(), account["fabrics"].get<int>(), account["converged"].get<int>(),
                account["certified_minima"].get<int>(), number(account["worst_residual"]),
                number(account["worst_residual_over_target"]),
                three(account["milliseconds_percentiles"], "%.0f/%.0f/%.0f").c_str(),
                three(account["factorization_equivalents_percentiles"], "%.0f/%.0f/%.0f").c_str(),
                three(account["factorizations_percentiles"], "%.0f/%.0f/%.0f").c_str(),
                number(account["unit_milliseconds_median"]));
  return text;
}

}  // namespace drape
