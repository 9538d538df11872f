#include "core/contact.h"

#include <cstdio>
#include <stdexcept>
#include <utility>

#include "core/self_intersection.h"
#include "core/support_contact.h"

namespace drape {
namespace {

std::string millimetres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f mm", 1e3 * length);
  return text;
}

std::string penetration_text(double penetration) {
  return penetration > 0 ? "the deepest vertex is " + millimetres(penetration) + " in the support"
                         : "no vertex is in the support";
}

/// The solve of `first` went on as `second`.
Equilibrium continued(const Equilibrium& first, Equilibrium second) {
  second.add_work_of(first);
  second.protocol = first.protocol;
  return second;
}

}  // namespace

std::string_view name(ContactMode mode) {
  switch (mode) {
    case ContactMode::automatic:
      return "auto";
    case ContactMode::off:
      return "off";
    case ContactMode::support:
      return "support";
  }
  throw std::logic_error("a contact mode without a name");
}

Contact check_contact(const Potential& potential, const Scene& scene, const VecX& x) {
  Contact contact;
  contact.support = potential.support().has_value();
  contact.checked = true;
  contact.penetration = support_penetration(support_contact(scene), potential.mesh(), x);
  contact.self_intersections = self_intersections(potential.mesh().triangles, x).count();
  return contact;
}

bool would_choose_otherwise(const Potential& potential, const Contact& contact, const VecX& x) {
  return contact.support ? potential.contact_force(x).isZero(0)
                         : contact.penetration > kAllowedPenetration;
}

ContactDrape with_contact(Potential& potential, const Scene& scene, ContactMode mode,
                          Equilibrium equilibrium, const EquilibriumOptions& options) {
  if (!equilibrium.converged()) {
    Contact contact;
    contact.support = potential.support().has_value();
    contact.reason = "Not checked: the solve did not converge.";
    return {std::move(equilibrium), contact};
  }
  Contact contact = check_contact(potential, scene, equilibrium.x);
  const std::string found = penetration_text(contact.penetration);
  if (mode == ContactMode::off) {
    contact.reason = "Switched off by the settings; " + found + ".";
  } else if (contact.support) {
    contact.reason = "Switched on by the settings.";
  } else if (mode == ContactMode::automatic && contact.penetration <= kAllowedPenetration) {
    contact.reason = "Not needed: " + found + ", " + millimetres(kAllowedPenetration) + " allowed.";
  } else {
    potential.set_support(support_contact(scene));
    equilibrium = continued(
        equilibrium, solve_equilibrium(potential, equilibrium.x, options, equilibrium.factor));
    if (equilibrium.converged()) {
      contact = check_contact(potential, scene, equilibrium.x);
    } else {
      contact = {};
      contact.support = true;
    }
    contact.reason = mode == ContactMode::support ? "Switched on by the settings."
                                                  : "Switched on: without it " + found + ".";
  }
  return {std::move(equilibrium), contact};
}

ContactDrape drape_with_contact(Potential& potential, const Scene& scene, ContactMode mode,
                                const std::function<Equilibrium(const Potential&)>& drape,
                                const EquilibriumOptions& options) {
  potential.set_support(mode == ContactMode::support ? std::optional(support_contact(scene))
                                                     : std::nullopt);
  return with_contact(potential, scene, mode, drape(potential), options);
}

}  // namespace drape
