// Drapes and gradients per CPU second against vertices and workers, as a table and as JSON.
//
// The same random fabrics are draped from a folded start, and the adjoint gradient of the shadow's
// area is taken, by one worker and by two; a worker has one thread. What workers share (caches,
// memory) must cost little: CPU per drape with two workers over that with one is at most 1.15. The
// two take turns and each size counts its best turn, because other programs disturb both.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "adjoint/adjoint.h"
#include "core/cpu_clock.h"
#include "core/durable_file.h"
#include "core/drape_protocol.h"
#include "core/outline.h"
#include "core/version.h"
#include "experiments/parallel_items.h"
#include "experiments/random_fabric.h"
#include "tests/support/shapes.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kWorkers[] = {1, 2};
constexpr double kAllowedRatio = 1.15;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// CPU of one turn.
struct Turn {
  int drapes = 0, gradients = 0;
  double drape_seconds = 0, gradient_seconds = 0;

  double per_drape() const { return drapes > 0 ? drape_seconds / drapes : kInfinity; }
  double per_gradient() const { return gradients > 0 ? gradient_seconds / gradients : kInfinity; }
};

/// Drapes `count` fabrics by `workers` workers; what does not converge has no gradient.
Turn take_turn(const std::shared_ptr<const Discretization>& disc, int count, int workers) {
  std::vector<Turn> turns(static_cast<size_t>(count));
  for_each_item(count, workers, [&](int i) {
    Random random(seed_of_item(1, static_cast<std::uint64_t>(i)));
    const Potential potential(disc, random_fabric(random), {}, test::kCusick.gravity);
    Turn& turn = turns[static_cast<size_t>(i)];
    const double begin = thread_cpu_seconds();
    const Equilibrium drape = drape_by_lobes(potential, test::kCusick, 6, 0.1);
    const double draped = thread_cpu_seconds();
    turn.drapes = 1;
    turn.drape_seconds = draped - begin;
    if (!drape.converged()) return;
    const Outline outline = trace_outline(potential.mesh(), test::kCusick, drape.x);
    adjoint_gradient(potential, drape, pull_back(outline, drape.x, area_gradient(outline.points)));
    turn.gradients = 1;
    turn.gradient_seconds = thread_cpu_seconds() - draped;
  });
  Turn sum;
  for (const Turn& turn : turns) {
    sum.drapes += turn.drapes;
    sum.gradients += turn.gradients;
    sum.drape_seconds += turn.drape_seconds;
    sum.gradient_seconds += turn.gradient_seconds;
  }
  return sum;
}

/// One entry a number of workers.
Json measure(int vertices, int count, int turns) {
  const auto disc = test::disc(vertices);
  Json rows = Json::array();
  for (int workers : kWorkers)
    rows.push_back({{"vertices", vertices},
                    {"workers", workers},
                    {"drapes", count},
                    {"cpu_seconds_per_drape", kInfinity},
                    {"cpu_seconds_per_gradient", kInfinity}});
  const auto keep_best = [](Json& value, double now) {
    value = std::fmin(value.get<double>(), now);
  };
  for (int turn = 0; turn < turns; ++turn)
    for (Json& row : rows) {
      const Turn taken = take_turn(disc, count, row["workers"]);
      row["gradients"] = taken.gradients;
      keep_best(row["cpu_seconds_per_drape"], taken.per_drape());
      keep_best(row["cpu_seconds_per_gradient"], taken.per_gradient());
    }
  for (Json& row : rows) {
    row["drapes_per_cpu_second"] = 1 / row["cpu_seconds_per_drape"].get<double>();
    row["gradients_per_cpu_second"] = 1 / row["cpu_seconds_per_gradient"].get<double>();
    row["cpu_per_drape_over_one_worker"] =
        row["cpu_seconds_per_drape"].get<double>() / rows[0]["cpu_seconds_per_drape"].get<double>();
  }
  return rows;
}

int run(int argc, char** argv) {
  std::vector<int> vertices{1000, 2000, 8000};
  int drapes = 8, turns = 2;
  std::string out;
  CLI::App app("Drapes and gradients per CPU second against vertices and workers.");
  app.add_option("--vertices", vertices, "Mesh sizes")
      ->delimiter(',')
      ->check(CLI::Range(200, 100000));
  app.add_option("--drapes", drapes, "Fabrics a size")->check(CLI::PositiveNumber);
  app.add_option("--turns", turns, "Turns, of which the best counts")->check(CLI::PositiveNumber);
  app.add_option("--out", out, "JSON file");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  Json result = {{"version", version()}, {"git_commit", git_commit()}, {"compiler", compiler()}};
  std::printf("%9s %8s %8s %18s %21s %12s\n", "vertices", "workers", "drapes", "drapes per CPU s",
              "gradients per CPU s", "CPU / drape");
  bool met = true;
  for (int size : vertices)
    for (const Json& row : measure(size, drapes, turns)) {
      const double ratio = row["cpu_per_drape_over_one_worker"];
      met = met && ratio <= kAllowedRatio;
      std::printf("%9d %8d %8d %18.3g %21.3g %12.3f\n", size, row["workers"].get<int>(), drapes,
                  row["drapes_per_cpu_second"].get<double>(),
                  row["gradients_per_cpu_second"].get<double>(), ratio);
      std::fflush(stdout);
      result["rows"].push_back(row);
    }
  result["target_met"] = met;
  std::printf("%s: CPU per drape with two workers over that with one, target <= %.2f\n",
              met ? "PASS" : "FAIL", kAllowedRatio);
  if (!out.empty()) write_text_durably(out, result.dump(2) + "\n");
  return 0;
}

}  // namespace
}  // namespace drape

int main(int argc, char** argv) {
  try {
    return drape::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
