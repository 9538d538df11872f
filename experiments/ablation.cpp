#include "experiments/ablation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "adjoint/fold.h"
#include "core/outline.h"
#include "core/profile.h"
#include "core/resolution.h"
#include "core/support_contact.h"
#include "core/transfer.h"
#include "experiments/model.h"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kSoftest = 0.01, kStiffest = 100;  // factors on the bending stiffness
constexpr int kBisections = 9;
constexpr double kSameDrape = 1e-5;     // vertices of one drape are closer [m]
constexpr double kLargestStep = 0.1;    // of a path of fabrics, whose length is 1
constexpr double kSmallestStep = 3e-3;  // no step that counts below it: a snap
constexpr int kMostSnaps = 20;          // on a path; then it is given up

double rms(const VecX& difference) {
  return difference.norm() / std::sqrt(static_cast<double>(difference.size()));
}

Json difference(const UnchangedDrape& unchanged, const SeenDrape& from, const SeenDrape& to) {
  Json item = {{"change", to.coefficient - from.coefficient},
               {"outline_rms", rms(to.profile - from.profile)},
               {"node_change", to.nodes - from.nodes}};
  if (unchanged.observed.size() > 0)
    item["miss_change"] = unchanged.miss(to) - unchanged.miss(from);
  return item;
}

/// From one fabric to another, unit length, straight in the logarithms.
FabricPath path_between(const Fabric& from, const Fabric& to) {
  const ParameterVector start = to_vector(from);
  ParameterVector rate = ParameterVector::Zero();
  for (int i = 0; i < kParameterCount; ++i)
    if (to_vector(to)[i] != start[i]) rate[i] = std::log(to_vector(to)[i] / start[i]);
  const auto at = [start, rate](double s) {
    return ParameterVector((s * rate.array()).exp() * start.array());
  };
  return {[at](double s) { return to_fabric(at(s)); },
          [at, rate](double s) { return ParameterVector(at(s).cwiseProduct(rate)); }};
}

Json follow_path(const UnchangedDrape& from, const Settings& changed) {
  Potential potential = from.potential;
  const Scene& scene = changed.scene;
  const FabricPath path = path_between(from.settings.fabric, changed.fabric);
  BranchState state = make_branch_state(potential, path, 0, from.drape.equilibrium);
  int snaps = 0;
  double snap_change = 0;
  ContinuationCost cost;
  const SweepVisitor visitor{[&](const BranchState&) { return snaps <= kMostSnaps; },
                             [&](const Snap& snap) {
                               ++snaps;
                               snap_change += see(scene, potential.mesh(), snap.x).coefficient -
                                              see(scene, potential.mesh(), snap.fold.x).coefficient;
                             }};
  const bool arrived = sweep(potential, path, 1,
                             {.largest_step = kLargestStep,
                              .smallest_step = kSmallestStep,
                              .equilibrium = equilibrium_options(changed)},
                             state, cost, visitor);
  Json item = {{"status", arrived ? "converged" : "lost on the way"},
               {"followed", arrived},
               {"snaps", snaps},
               {"snap_change", snap_change}};
  if (arrived)
    item.update(difference(from, from.seen, see(scene, potential.mesh(), state.equilibrium.x)));
  return item;
}

Json follow_warm(const UnchangedDrape& from, const Settings& changed,
                 std::shared_ptr<const Discretization> discretization) {
  Potential potential = make_potential(std::move(discretization), changed.fabric, changed);
  potential.set_support(changed.contact == from.settings.contact ? from.potential.support()
                        : changed.contact == ContactMode::support
                            ? std::optional(support_contact(changed.scene))
                            : std::nullopt);
  const Mesh &here = from.potential.mesh(), &other = potential.mesh();
  const bool same_places = here.rest_uv.rows() == other.rest_uv.rows() &&
                           (here.rest_uv - other.rest_uv).cwiseAbs().maxCoeff() == 0;
  const auto move = [&](const Mesh& a, const Mesh& b, const VecX& x) {
    return same_places ? x : Transfer(a, b)(x);
  };
  const EquilibriumOptions options = equilibrium_options(changed);
  const Equilibrium there =
      solve_equilibrium(potential, move(here, other, from.drape.equilibrium.x), options);
  Json item = {{"status", name(there.status)}, {"followed", false}, {"snaps", 0}};
  if (!there.converged()) return item;
  const Equilibrium back = solve_equilibrium(from.potential, move(other, here, there.x), options);
  item["way_back"] = largest_distance(back.x, from.drape.equilibrium.x);
  item["followed"] =
      back.converged() && largest_distance(back.x, from.drape.equilibrium.x) < kSameDrape;
  item.update(difference(from, from.seen, see(changed.scene, other, there.x)));
  return item;
}

/// The drape of the loose tolerance against the minimum that it is on the way to.
Json polished(const UnchangedDrape& from, const Potential& potential, const Equilibrium& loose) {
  const Equilibrium tight =
      solve_equilibrium(potential, loose.x, equilibrium_options(from.settings));
  Json item = {{"status", name(tight.status)}, {"followed", tight.converged()}, {"snaps", 0}};
  if (tight.converged())
    item.update(difference(from, see(from.settings.scene, potential.mesh(), tight.x),
                           see(from.settings.scene, potential.mesh(), loose.x)));
  return item;
}

}  // namespace

SeenDrape see(const Scene& scene, const Mesh& mesh, const VecX& x) {
  const Points2 outline = trace_outline(mesh, scene, x).points;
  const VecX profile = radial_profile(outline).radius;
  return {100 * drape_coefficient(scene, area(outline)), profile, node_count(profile)};
}

Fabric fabric_of_coefficient(const Settings& settings,
                             const std::shared_ptr<const Discretization>& coarse, double percent) {
  double low = std::log(kSoftest), high = std::log(kStiffest);
  double nearest = std::numeric_limits<double>::infinity();
  Fabric best = settings.fabric;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    const Fabric fabric =
        scaled_path(settings.fabric, {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
            .fabric(middle);
    Potential potential = make_potential(coarse, fabric, settings);
    const Equilibrium equilibrium = drape(settings, potential).equilibrium;
    if (!equilibrium.converged()) throw std::runtime_error("no drape on the coarse mesh");
    const double miss = see(settings.scene, potential.mesh(), equilibrium.x).coefficient - percent;
    if (std::abs(miss) < nearest) {
      nearest = std::abs(miss);
      best = fabric;
    }
    (miss < 0 ? low : high) = middle;
  }
  return best;
}

UnchangedDrape::UnchangedDrape(const Settings& settings_,
                               std::shared_ptr<const Discretization> discretization, VecX observed_)
    : settings(settings_),
      observed(std::move(observed_)),
      potential(make_potential(std::move(discretization), settings_.fabric, settings_)) {
  Settings free = settings;
  free.contact = ContactMode::off;
  const ContactDrape alone = drape::drape(free, potential);
  without_contact = alone.equilibrium.x;
  penetration = alone.contact.penetration;
  drape = with_contact(potential, settings.scene, settings.contact, alone.equilibrium,
                       equilibrium_options(settings));
  if (!drape.equilibrium.converged())
    throw std::runtime_error("the unchanged drape: " + std::string(name(drape.equilibrium.status)));
  seen = see(settings.scene, potential.mesh(), drape.equilibrium.x);
}

double UnchangedDrape::miss(const SeenDrape& of) const { return rms(of.profile - observed); }

Json ablate(const UnchangedDrape& unchanged, const Ingredient& ingredient,
            std::shared_ptr<const Discretization> changed_discretization) {
  Settings changed = unchanged.settings;
  ingredient.change(changed);
  Potential cold = make_potential(changed_discretization, changed.fabric, changed);
  const Equilibrium drape = drape::drape(changed, cold).equilibrium;
  Json item = ingredient.way == AblationWay::path ? follow_path(unchanged, changed)
              : ingredient.way == AblationWay::warm
                  ? follow_warm(unchanged, changed, std::move(changed_discretization))
                  : polished(unchanged, cold, drape);
  item["cold_status"] = name(drape.status);
  if (drape.converged())
    item["cold_change"] =
        see(changed.scene, cold.mesh(), drape.x).coefficient - unchanged.seen.coefficient;
  item["cpu_ratio"] = drape.cpu_seconds / unchanged.drape.equilibrium.cpu_seconds;
  return item;
}

Json check_contact_rule(const UnchangedDrape& unchanged) {
  const Settings& settings = unchanged.settings;
  Potential potential = unchanged.potential;
  potential.set_support(support_contact(settings.scene));
  const Equilibrium held =
      solve_equilibrium(potential, unchanged.without_contact, equilibrium_options(settings));
  Json item = {{"status", name(held.status)},
               {"penetration", unchanged.penetration},
               {"acts", unchanged.penetration > kAllowedPenetration}};
  if (!held.converged()) return item;
  const Mesh& mesh = potential.mesh();
  item.update(difference(unchanged, see(settings.scene, mesh, unchanged.without_contact),
                         see(settings.scene, mesh, held.x)));
  item["needed"] = std::abs(item["change"].get<double>()) > settings.mesh.tolerance ||
                   item["outline_rms"].get<double>() > settings.ablation.outline_tolerance;
  return item;
}

Json check_resolution_rule(const Settings& settings) {
  const int largest = settings.ablation.largest_vertices;
  const ResolvedDrape resolved = drape_resolved(settings, largest);
  const Resolution& found = resolved.resolution;
  Json item = {{"status", name(found.status)}};
  if (found.rungs.empty()) return item;
  const Rung& rung = found.rungs[static_cast<size_t>(found.chosen)];
  item["vertices"] = rung.vertices;
  item["estimate"] = 100 * rung.error();
  VecX x = resolved.drape.equilibrium.x;
  Potential potential = resolved.potential;
  for (int vertices = 2 * rung.vertices;; vertices = std::min(2 * vertices, 2 * largest)) {
    Potential finer =
        make_potential(make_discretization(settings, vertices), settings.fabric, settings);
    finer.set_support(potential.support());
    const Equilibrium equilibrium = solve_equilibrium(
        finer, Transfer(potential.mesh(), finer.mesh())(x), equilibrium_options(settings));
    if (!equilibrium.converged()) {
      item["reference"] = name(equilibrium.status);
      return item;
    }
    x = equilibrium.x;
    potential = std::move(finer);
    if (vertices >= 2 * largest) break;
  }
  const auto seen = [&](const Potential& on, const VecX& state) {
    const SeenDrape drape = see(settings.scene, on.mesh(), state);
    return DrapeSeen{true, on.mesh().vertex_count(), drape.coefficient / 100, drape.profile};
  };
  const DrapeSeen chosen = seen(resolved.potential, resolved.drape.equilibrium.x),
                  reference = seen(potential, x);
  item["reference"] = "converged";
  item["same_branch"] = same_branch(chosen, reference);
  item["error"] = 100 * std::abs(chosen.drape_coefficient - reference.drape_coefficient);
  return item;
}

}  // namespace drape
