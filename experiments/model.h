// From settings to the objects of the model, and from an equilibrium to a record: what all kinds of
// experiments share.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/contact.h"
#include "core/coverage.h"
#include "core/discretization.h"
#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/records.h"
#include "core/resolution.h"
#include "experiments/settings.h"

namespace drape {

/// The specimen's mesh and all that depends on it alone. `vertices` overrides mesh.vertices, which
/// must be a count otherwise.
std::shared_ptr<const Discretization> make_discretization(const Settings& settings,
                                                          int vertices = 0);

/// Throws std::invalid_argument on an invalid fabric.
Potential make_potential(std::shared_ptr<const Discretization> discretization, const Fabric& fabric,
                         const Settings& settings);

EquilibriumOptions equilibrium_options(const Settings& settings);

/// The drape by the start protocol of the settings, with contact as they say: the potential ends
/// with the support where it acts.
ContactDrape drape(const Settings& settings, Potential& potential);
/// The same from another start: `from` takes the place of the protocol.
ContactDrape drape(const Settings& settings, Potential& potential,
                   const std::function<Equilibrium(const Potential&)>& from);

/// The same on a mesh as fine as the drape needs, by mesh.tolerance, of no more vertices than
/// those.
ResolvedDrape drape_resolved(const Settings& settings, int largest_vertices = 1'000'000);

EnsembleOptions ensemble_options(const Settings& settings);

/// The grid of coverage images.
PixelGrid observation_grid(const Settings& settings);

/// What is seen of state x (3n). Throws std::runtime_error if the outline cannot be traced.
Observation observe(const Scene& scene, const Mesh& mesh, const VecX& x, const PixelGrid& grid);

RecordsHeader records_header(const Settings& settings, const Mesh& mesh);

SolveStats solve_stats(const Potential& potential, const Scene& scene,
                       const Equilibrium& equilibrium);

/// What the summary of a drape says of contact: `reason` as in Contact.
void write_contact(nlohmann::ordered_json& summary, const SolveStats& stats,
                   const std::string& reason);

/// The record of an equilibrium, converged or not; the tag is left to the caller. Throws like
/// observe.
Record make_record(const Settings& settings, const Potential& potential,
                   const Equilibrium& equilibrium);

/// The record of a fabric without an equilibrium: NaN positions, `status` says why.
Record failed_record(const Settings& settings, const Mesh& mesh, const Fabric& fabric,
                     const std::string& status);

/// Calls `work`, which fills the record of a run's `index`-th item. An exception becomes the status
/// of the record, which keeps what it held before; its message is returned, "" if there was none.
/// The record has the id `index` either way.
std::string fill_record(Record& record, int index, const std::function<void()>& work);

/// Whether the record's solve ended at a certified minimum.
bool converged(const Record& record);

}  // namespace drape
