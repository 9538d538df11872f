// Recovery of known parameters: one record's outline back to its parameters, from a wrong start.
#pragma once

#include <cstdint>
#include <optional>

#include "core/potential.h"
#include "core/records.h"
#include "experiments/settings.h"
#include "experiments/tag_dataset.h"

namespace drape {

/// The first parameters of a fit: the truth, perturbed as the settings say; `seed` chooses.
Fabric perturbed(const Fabric& truth, const EstimateSettings& settings, std::uint64_t seed);

/// Adds smooth noise of standard deviation `sd` [m] to a profile: harmonics 0 to `harmonic_count`,
/// random phases.
VecX with_noise(const VecX& profile, double sd, int harmonic_count, std::uint64_t seed);

/// Without a prior: where there is one it needs the fabric, see fit_prior.
EstimateOptions estimate_options(const Settings& settings);

/// The prior of the estimated parameters; none for PriorKind::none. Not for PriorKind::tag, which
/// takes a tag (tag_prior).
std::optional<Prior> fit_prior(const Settings& settings, PriorKind kind, Structure structure,
                               const Fabric& start);

/// The potential with what acted on the record's drape: it acts on all of its branch.
Potential as_draped(Potential model, const Record& record, const Scene& scene);

/// The target's own branch at the first parameters of a fit, if there is one, and whether following
/// it back ends where it began (within 1e-6 m).
struct BranchTest {
  std::optional<Equilibrium> start;
  bool shared = false;
};
BranchTest follow_target(Potential potential, const Record& record, const Fabric& start,
                         const EstimateOptions& options);

/// Estimates the parameters of a record from its profile (or coverage). `model` gives mesh, reading
/// and gravity; `tag_prior` is asked where the settings say "tag". Only start = "continued" uses
/// the record's own equilibrium: where target and start share a branch (continuing target -> start
/// -> target comes back within 1e-6 m) the fit begins on it.
EstimateRecord recover(const Settings& settings, const Potential& model, const Record& record,
                       const RecordsHeader& header, const TagPrior& tag_prior, std::uint64_t seed);

/// What is seen of an estimate in one of its pictures and how it went, as a record keeps it.
EstimateRecord estimate_record(const Picture& picture, const PictureEstimate& drape,
                               const Estimate& estimate, const std::vector<Parameter>& parameters);

}  // namespace drape
