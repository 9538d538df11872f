#include "benchmarks/drape_fixture.h"

#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/drape_protocol.h"
#include "experiments/factorization_unit.h"

namespace drape::bench {
namespace {

std::mutex making;  // of meshes and solved drapes

std::shared_ptr<const Discretization> disc(int vertices) {
  static std::map<int, std::shared_ptr<const Discretization>> discs;
  auto& disc = discs[vertices];
  if (!disc) disc = test::disc(vertices);
  return disc;
}

Potential medium_drape_of(std::shared_ptr<const Discretization> discretization) {
  return {std::move(discretization),
          test::medium_fabric(),
          {BendingLaw::tangent, BendingThreshold::radius},
          kCusick.gravity};
}

/// A state at rest; not one where the solve failed.
const VecX& state_at_rest(int vertices) {
  static std::map<int, VecX> states;
  const auto found = states.find(vertices);
  if (found != states.end()) return found->second;
  const Potential potential = medium_drape_of(disc(vertices));
  return states[vertices] = drape_by_lobes(potential, kCusick, kLobes, kPhase).x;
}

}  // namespace

void every_size(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("vertices")->Unit(benchmark::kMillisecond);
  for (int vertices : {1000, 2000, 8000, 30000}) benchmark->Arg(vertices);
  benchmark->Threads(1)->Threads(2);
}

void every_size_once(benchmark::internal::Benchmark* benchmark) {
  every_size(benchmark);
  benchmark->Iterations(1);
}

Potential medium_drape(int vertices) {
  const std::lock_guard lock(making);
  return medium_drape_of(disc(vertices));
}

VecX folded_start(const Potential& potential) {
  return folded_state(potential.mesh(), kCusick, kLobes, kPhase);
}

std::optional<SolvedDrape> solved_drape(benchmark::State& state) {
  VecX x;
  {
    const std::lock_guard lock(making);
    x = state_at_rest(vertices(state));
  }
  Potential potential = medium_drape(vertices(state));
  Equilibrium equilibrium = solve_equilibrium(potential, x);  // at rest already: only its factor
  if (!equilibrium.converged()) {
    state.SkipWithError("the drape did not converge");
    return std::nullopt;
  }
  Outline outline = trace_outline(potential.mesh(), kCusick, equilibrium.x);
  return SolvedDrape{std::move(potential), std::move(equilibrium), std::move(outline)};
}

void report(benchmark::State& state, const char* counter, double value) {
  state.counters[counter] = benchmark::Counter(value, benchmark::Counter::kAvgThreads);
}

void report_units(benchmark::State& state, const Potential& potential, const VecX& x,
                  double cpu_seconds) {
  const double unit = factorization_unit(potential, x);
  report(state, "units", cpu_seconds / unit);
  report(state, "unit_ms", 1e3 * unit);
}

}  // namespace drape::bench
