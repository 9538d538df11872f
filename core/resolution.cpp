#include "core/resolution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/cpu_clock.h"
#include "core/outline.h"
#include "core/profile.h"
#include "core/transfer.h"

namespace drape {
namespace {

// On the estimate by refinement: with 2 the measured errors of nearly all rungs are below it.
constexpr double kSafety = 2;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargestRms = 2e-3;  // of outlines on one branch [m]
constexpr double kShrinking = 0.5;    // of the scatter over two rungs; order h^2 gives 0.3
// Seeds alone do not tell: measured, meshes of one size share a bias that their seeds do not show.
constexpr double kOtherSize = 1.15;
constexpr double kOtherTolerance = 1e-3;  // residual on the other mesh: the coefficient to 1e-6

/// Smallest rms distance of two profiles over all turns by whole degrees [m].
double turned_distance(const VecX& a, const VecX& b) {
  const Eigen::Index n = a.size();
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index turn = 0; turn < n; ++turn) {
    const double squares = (a.head(n - turn) - b.tail(n - turn)).squaredNorm() +
                           (a.tail(turn) - b.head(turn)).squaredNorm();
    least = std::min(least, squares);
  }
  return std::sqrt(least / static_cast<double>(n));
}

/// Takes the larger of an error, which may be unknown, and another.
void raise(double& error, double other) {
  if (!(error >= other)) error = other;
}

/// The errors of two rungs from their difference, for errors that go with 1/vertices.
void estimate_errors(Rung& coarse, Rung& fine) {
  const double ratio = static_cast<double>(fine.vertices) / coarse.vertices;
  const double error =
      kSafety * std::abs(fine.drape_coefficient - coarse.drape_coefficient) / (ratio - 1);
  raise(coarse.estimate, ratio * error);
  raise(fine.estimate, error);
}

}  // namespace

std::string_view name(ResolutionStatus status) {
  switch (status) {
    case ResolutionStatus::within_tolerance:
      return "within_tolerance";
    case ResolutionStatus::limited_by_mesh_scatter:
      return "limited_by_mesh_scatter";
    case ResolutionStatus::limited_by_size:
      return "limited_by_size";
    case ResolutionStatus::limited_by_solver:
      return "limited_by_solver";
  }
  return "unknown";
}

bool same_branch(const DrapeSeen& a, const DrapeSeen& b) {
  return node_count(a.profile) == node_count(b.profile) &&
         turned_distance(a.profile, b.profile) < kLargestRms;
}

Resolution climb(int rung_count, double tolerance,
                 const std::function<DrapeSeen(int, bool)>& drape_on) {
  Resolution result;
  std::vector<Rung>& rungs = result.rungs;
  std::optional<DrapeSeen> before;
  for (int i = 0; i < rung_count; ++i) {
    const double begin = thread_cpu_seconds();
    DrapeSeen seen = drape_on(i, false);
    if (!seen.converged) return result;
    result.chosen = i;
    rungs.push_back({.vertices = seen.vertices,
                     .drape_coefficient = seen.drape_coefficient,
                     .node_count = node_count(seen.profile),
                     .same_branch = !before || same_branch(*before, seen),
                     .estimate = kNaN,
                     .scatter = kNaN,
                     .other_mesh_same_branch = false,
                     .cpu_seconds = 0});
    Rung& rung = rungs.back();
    const DrapeSeen other = drape_on(i, true);
    if (other.converged) {
      rung.scatter = std::abs(other.drape_coefficient - seen.drape_coefficient);
      rung.other_mesh_same_branch = same_branch(other, seen);
    }
    rung.cpu_seconds = thread_cpu_seconds() - begin;
    before = std::move(seen);
    if (i == 0) continue;

    estimate_errors(rungs[static_cast<size_t>(i) - 1], rung);
    for (int k = i - 1; rung.same_branch && k <= i; ++k)
      if (rungs[static_cast<size_t>(k)].error() <= tolerance) {
        result.chosen = k;
        result.status = ResolutionStatus::within_tolerance;
        return result;
      }
    // the mesh decides, on this rung and on those before
    const auto lost = [](const Rung& on) { return !on.same_branch || !on.other_mesh_same_branch; };
    const auto scattered = [&](const Rung& on) { return lost(on) || !(on.scatter <= tolerance); };
    if (i >= 2 && std::all_of(rungs.end() - 3, rungs.end(), scattered) &&
        (lost(rung) || !(rung.scatter < kShrinking * rungs[static_cast<size_t>(i) - 2].scatter))) {
      result.status = ResolutionStatus::limited_by_mesh_scatter;
      return result;
    }
  }
  result.status = ResolutionStatus::limited_by_size;
  return result;
}

ResolvedDrape drape_resolved(const Scene& scene, const DiscMeshOptions& mesh,
                             const std::function<Potential(const DiscMeshOptions&)>& potential_on,
                             ContactMode contact,
                             const std::function<Equilibrium(const Potential&)>& protocol,
                             const ResolutionOptions& resolution,
                             const EquilibriumOptions& options) {
  if (!(resolution.tolerance > 0))
    throw std::invalid_argument("resolution: tolerance = " + std::to_string(resolution.tolerance) +
                                ": must be positive");
  if (resolution.vertices.empty())
    throw std::invalid_argument("resolution: no mesh sizes; must be at least one");

  const auto observe = [&](const Mesh& on, const Equilibrium& equilibrium) {
    DrapeSeen seen;
    seen.converged = equilibrium.converged();
    seen.vertices = on.vertex_count();
    if (!seen.converged) return seen;
    const Points2 outline = trace_outline(on, scene, equilibrium.x).points;
    seen.drape_coefficient = drape_coefficient(scene, area(outline));
    seen.profile = radial_profile(outline).radius;
    return seen;
  };
  struct Draped {
    Potential potential;
    ContactDrape drape;
  };
  std::vector<Draped> draped;
  const auto drape_on = [&](int rung, bool other_mesh) {
    DiscMeshOptions size = mesh;
    size.vertices = resolution.vertices[static_cast<size_t>(rung)];
    if (other_mesh) {
      size.seed += 1;
      size.vertices = static_cast<int>(std::lround(kOtherSize * size.vertices));
    }
    Potential potential = potential_on(size);
    const EquilibriumOptions how = other_mesh ? options.loosened(kOtherTolerance) : options;
    std::function<Equilibrium(const Potential&)> from = protocol;
    if (!draped.empty())
      from = [&](const Potential& on) {
        const Draped& last = draped.back();
        const Transfer transfer(last.potential.mesh(), on.mesh());
        return solve_equilibrium(on, transfer(last.drape.equilibrium.x), how);
      };
    ContactDrape drape = drape_with_contact(potential, scene, contact, from, how);
    const DrapeSeen seen = observe(potential.mesh(), drape.equilibrium);
    if (other_mesh) return seen;
    if (draped.empty() || seen.converged) {
      if (!draped.empty()) {
        drape.equilibrium.add_work_of(draped.back().drape.equilibrium);
        drape.equilibrium.protocol = draped.back().drape.equilibrium.protocol;
      }
      draped.push_back({std::move(potential), std::move(drape)});
    }
    return seen;
  };

  Resolution found =
      climb(static_cast<int>(resolution.vertices.size()), resolution.tolerance, drape_on);
  Draped& chosen = draped[static_cast<size_t>(found.chosen)];
  return {std::move(chosen.potential), std::move(chosen.drape), std::move(found)};
}

}  // namespace drape
