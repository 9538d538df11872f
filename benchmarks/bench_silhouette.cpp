// From a state to what is seen of it, and back: outline, radial profile, coverage image (256^2),
// and the pull-back of each.
#include <benchmark/benchmark.h>

#include "benchmarks/drape_fixture.h"
#include "core/coverage.h"
#include "core/profile.h"

namespace drape::bench {
namespace {

const PixelGrid kGrid = centred_grid(256, 0.32);

const SolvedDrape& drape_of(const benchmark::State& state) {
  return solved_drape(static_cast<int>(state.range(0)));
}

void silhouette_outline(benchmark::State& state) {
  const SolvedDrape& drape = drape_of(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        trace_outline(drape.potential.mesh(), kScene, drape.equilibrium.x).points.data());
}

void silhouette_outline_pull_back(benchmark::State& state) {
  const SolvedDrape& drape = drape_of(state);
  const Points2 ones = Points2::Ones(drape.outline.size(), 2);
  for (auto _ : state)
    benchmark::DoNotOptimize(pull_back(drape.outline, drape.equilibrium.x, ones).data());
}

void silhouette_profile(benchmark::State& state) {
  const Points2& polygon = drape_of(state).outline.points;
  for (auto _ : state) benchmark::DoNotOptimize(radial_profile(polygon).radius.data());
}

void silhouette_profile_pull_back(benchmark::State& state) {
  const Points2& polygon = drape_of(state).outline.points;
  const Profile profile = radial_profile(polygon);
  const VecX ones = VecX::Ones(kProfileSize);
  for (auto _ : state)
    benchmark::DoNotOptimize(pull_back(profile, polygon, Vec2::Zero(), ones).data());
}

void silhouette_coverage(benchmark::State& state) {
  const Points2& polygon = drape_of(state).outline.points;
  for (auto _ : state) benchmark::DoNotOptimize(coverage(polygon, kGrid).data());
}

void silhouette_coverage_pull_back(benchmark::State& state) {
  const Points2& polygon = drape_of(state).outline.points;
  const CoverageImage image = coverage(polygon, kGrid);
  for (auto _ : state) benchmark::DoNotOptimize(pull_back(polygon, kGrid, image).data());
}

BENCHMARK(silhouette_outline)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMicrosecond);
BENCHMARK(silhouette_outline_pull_back)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(8000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(silhouette_profile)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMicrosecond);
BENCHMARK(silhouette_profile_pull_back)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(8000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(silhouette_coverage)->Arg(1000)->Arg(2000)->Arg(8000)->Unit(benchmark::kMicrosecond);
BENCHMARK(silhouette_coverage_pull_back)
    ->Arg(1000)
    ->Arg(2000)
    ->Arg(8000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace drape::bench
