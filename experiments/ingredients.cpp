#include "experiments/ingredients.h"

#include <algorithm>
#include <cmath>

namespace drape {
namespace {

constexpr double kShear = 5, kStretch = 10;  // factors, up and down

void scale_stretch(Settings& settings, double factor) {
  settings.fabric.k_u *= factor;
  settings.fabric.k_v *= factor;
}

/// Geometric means: stiffnesses are compared by their ratios.
void remove_anisotropy(Settings& settings) {
  Fabric& fabric = settings.fabric;
  fabric.k_bu = fabric.k_bv = fabric.k_bh = std::cbrt(fabric.k_bu * fabric.k_bv * fabric.k_bh);
  fabric.s_bu = fabric.s_bv = fabric.s_bh = std::cbrt(fabric.s_bu * fabric.s_bv * fabric.s_bh);
  fabric.k_u = fabric.k_v = std::sqrt(fabric.k_u * fabric.k_v);
}

void read_threshold_otherwise(Settings& settings) {
  BendingThreshold& threshold = settings.reading.threshold;
  threshold =
      threshold == BendingThreshold::printed ? BendingThreshold::radius : BendingThreshold::printed;
}

}  // namespace

const std::vector<Ingredient>& ingredients() {
  static const std::vector<Ingredient> list{
      {"clamp_factor_1", "clamp wings weigh 1", AblationWay::warm,
       [](Settings& s) { s.mesh.clamp_wing_factor = 1; }},
      {"clamp_even", "edges of one length", AblationWay::warm,
       [](Settings& s) { s.mesh.clamp_refinement = 1; }},
      {"mesh_half", "half the vertices", AblationWay::warm,
       [](Settings& s) { s.mesh.vertices = std::max(200, *s.mesh.vertices / 2); }},
      {"mesh_double", "twice the vertices", AblationWay::warm,
       [](Settings& s) { s.mesh.vertices = 2 * *s.mesh.vertices; }},
      {"mesh_seed", "another mesh as fine", AblationWay::warm, [](Settings& s) { ++s.mesh.seed; }},
      {"tolerance_1e-2", "tolerance 1e-2", AblationWay::tolerance,
       [](Settings& s) { s.solver.tolerance = 1e-2; }},
      {"tolerance_1e-4", "tolerance 1e-4", AblationWay::tolerance,
       [](Settings& s) { s.solver.tolerance = 1e-4; }},
      {"isotropic", "no anisotropy", AblationWay::path, remove_anisotropy},
      {"shear_stiff", "shear × 5", AblationWay::path, [](Settings& s) { s.fabric.k_h *= kShear; }},
      {"shear_soft", "shear / 5", AblationWay::path, [](Settings& s) { s.fabric.k_h /= kShear; }},
      {"stretch_stiff", "stretch × 10", AblationWay::path,
       [](Settings& s) { scale_stretch(s, kStretch); }},
      {"stretch_soft", "stretch / 10", AblationWay::path,
       [](Settings& s) { scale_stretch(s, 1 / kStretch); }},
      {"no_softening", "one bending regime", AblationWay::path,
       [](Settings& s) { s.fabric.s_bu = s.fabric.s_bv = s.fabric.s_bh = 1; }},
      {"other_threshold", "threshold read otherwise", AblationWay::warm, read_threshold_otherwise},
      {"secant_law", "secant law", AblationWay::warm,
       [](Settings& s) { s.reading.law = BendingLaw::secant; }},
      {"contact_off", "contact off", AblationWay::warm,
       [](Settings& s) { s.contact = ContactMode::off; }},
      {"contact_on", "contact on", AblationWay::warm,
       [](Settings& s) { s.contact = ContactMode::support; }}};
  return list;
}

}  // namespace drape
