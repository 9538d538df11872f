// Contact, only where a drape needs it: solve without, look, and solve again with what was missed.
//
// Two things are looked at: vertices inside the support (support_contact.h), which are then kept
// out by solving again, from the state found, with the support in the potential; and triangles that
// cross each other (self_intersection.h), which are counted and reported but not resolved.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/equilibrium.h"
#include "core/potential.h"
#include "core/scene.h"

namespace drape {

enum class ContactMode {
  automatic,  ///< the support acts on a drape that would violate it
  off,        ///< nothing acts; violations are still looked for
  support,    ///< the support acts from the start
};
/// "auto", "off", "support".
std::string_view name(ContactMode mode);

/// A vertex further inside the support than this violates it [m].
inline constexpr double kAllowedPenetration = 1e-3;

/// What acts on an equilibrium, and what is seen of contact in it.
struct Contact {
  bool support = false;    ///< the support acts
  bool checked = false;    ///< false: the solve failed, and what follows is not known
  double penetration = 0;  ///< of the deepest vertex into the support [m]
  int self_intersections = 0;
  std::string reason;  ///< one sentence: why the support acts or does not

  /// What acts: "off" or "support".
  std::string_view acting() const { return support ? "support" : "off"; }
};

/// Looks at state x (3n) of a potential; what acts is what the potential says.
Contact check_contact(const Potential& potential, const Scene& scene, const VecX& x);

/// Whether the other choice would have been made at x: the support acts and touches no vertex, or
/// it does not and is violated.
bool would_choose_otherwise(const Potential& potential, const Contact& contact, const VecX& x);

struct ContactDrape {
  Equilibrium equilibrium;
  Contact contact;
};

/// The drape by `drape`, with contact as `mode` says. The potential ends with what acts, so that it
/// is the one whose equilibrium this is. Counts and times are those of both solves.
ContactDrape drape_with_contact(Potential& potential, const Scene& scene, ContactMode mode,
                                const std::function<Equilibrium(const Potential&)>& drape,
                                const EquilibriumOptions& options = {});

/// The decision of `mode` about an equilibrium of a potential without support. Where the support is
/// to act it is set in the potential and the equilibrium solved again from where it is.
ContactDrape with_contact(Potential& potential, const Scene& scene, ContactMode mode,
                          Equilibrium equilibrium, const EquilibriumOptions& options = {});

}  // namespace drape
