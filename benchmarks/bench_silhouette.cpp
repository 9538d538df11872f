// From a state to what is seen of it, and back: outline, radial profile, coverage image (256^2),
// and the pull-back of each.
#include "benchmarks/drape_fixture.h"
#include "core/coverage.h"
#include "core/profile.h"

namespace drape::bench {
namespace {

const PixelGrid kGrid = centred_grid(256, 0.32);

struct Seen {
  explicit Seen(const benchmark::State& state)
      : potential(medium_drape(vertices(state))),
        x(folded_start(potential)),
        outline(trace_outline(potential.mesh(), kCusick, x)) {}

  const Potential potential;
  const VecX x;
  const Outline outline;
};

void outline(benchmark::State& state) {
  const Seen seen(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(trace_outline(seen.potential.mesh(), kCusick, seen.x).points.data());
}

void outline_pull_back(benchmark::State& state) {
  const Seen seen(state);
  const Points2 ones = Points2::Ones(seen.outline.size(), 2);
  for (auto _ : state) benchmark::DoNotOptimize(pull_back(seen.outline, seen.x, ones).data());
}

void profile(benchmark::State& state) {
  const Seen seen(state);
  for (auto _ : state) benchmark::DoNotOptimize(radial_profile(seen.outline.points).radius.data());
}

void profile_pull_back(benchmark::State& state) {
  const Seen seen(state);
  const Points2& polygon = seen.outline.points;
  const Profile radii = radial_profile(polygon);
  const VecX ones = VecX::Ones(kProfileSize);
  for (auto _ : state)
    benchmark::DoNotOptimize(pull_back(radii, polygon, Vec2::Zero(), ones).data());
}

void coverage_image(benchmark::State& state) {
  const Seen seen(state);
  for (auto _ : state) benchmark::DoNotOptimize(coverage(seen.outline.points, kGrid).data());
}

void coverage_pull_back(benchmark::State& state) {
  const Seen seen(state);
  const CoverageImage image = coverage(seen.outline.points, kGrid);
  for (auto _ : state)
    benchmark::DoNotOptimize(pull_back(seen.outline.points, kGrid, image).data());
}

BENCHMARK(outline)->Apply(every_size);
BENCHMARK(outline_pull_back)->Apply(every_size);
BENCHMARK(profile)->Apply(every_size);
BENCHMARK(profile_pull_back)->Apply(every_size);
BENCHMARK(coverage_image)->Apply(every_size);
BENCHMARK(coverage_pull_back)->Apply(every_size);

}  // namespace
}  // namespace drape::bench
