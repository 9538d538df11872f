// What the benchmarks work on: the drape of a fabric of medium stiffness in both bending regimes,
// on the standard instrument.
//
// Meshes and solved drapes are made once a size and kept; that is not measured. Every thread of a
// benchmark works on a potential, a matrix and a factor of its own, as workers of a run do.
#pragma once

#include <benchmark/benchmark.h>

#include <optional>

#include "core/equilibrium.h"
#include "core/outline.h"
#include "core/potential.h"
#include "tests/support/shapes.h"

namespace drape::bench {

using test::kCusick;

inline constexpr int kLobes = 6;
inline constexpr double kPhase = 0.1;  // of the folded start [rad]

/// 1k, 2k, 8k and 30k vertices, each on one thread and on two.
void every_size(benchmark::internal::Benchmark* benchmark);
/// The same for what takes seconds: one iteration a repetition.
void every_size_once(benchmark::internal::Benchmark* benchmark);

/// The number of vertices of a benchmark that every_size was applied to.
inline int vertices(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

/// The fabric on a mesh of this size; meshes are shared.
Potential medium_drape(int vertices);

/// The folded start on that mesh: a state as bent as a drape, which costs no solve. 3n.
VecX folded_start(const Potential& potential);

struct SolvedDrape {
  Potential potential;
  Equilibrium equilibrium;  ///< certified, with a factor of its own
  Outline outline;
};

/// A copy for the calling thread. The drape is solved at the first call for a size; where that
/// fails the benchmark is marked as failed and there is none.
std::optional<SolvedDrape> solved_drape(benchmark::State& state);

/// Counter `units`: CPU per iteration over one Hessian and one factorisation on the same mesh,
/// timed right here; `unit_ms` is that unit. The mean over threads.
void report_units(benchmark::State& state, const Potential& potential, const VecX& x,
                  double cpu_seconds);
/// A counter of which the mean over threads is meant.
void report(benchmark::State& state, const char* counter, double value);

}  // namespace drape::bench
