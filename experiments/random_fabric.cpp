#include "experiments/random_fabric.h"

namespace drape {
namespace {

constexpr double kRigidityOverStiffness = 4.15;  // B / k_b, measured on isotropic meshes

}  // namespace

Fabric random_fabric(Random& random, const FabricBox& box) {
  const auto log_uniform = [&](const Interval& of) { return random.log_uniform(of.low, of.high); };
  Fabric fabric;
  fabric.areal_density = log_uniform(box.areal_density);
  fabric.k_u = log_uniform(box.stretch);
  fabric.k_v = log_uniform(box.stretch);
  fabric.k_h = log_uniform(box.shear);
  const double k_b = log_uniform(box.flexural_rigidity) / kRigidityOverStiffness;
  for (Parameter p : {Parameter::k_bu, Parameter::k_bv, Parameter::k_bh})
    fabric[p] = k_b * log_uniform(box.anisotropy);
  for (Parameter p : {Parameter::s_bu, Parameter::s_bv, Parameter::s_bh})
    fabric[p] = log_uniform(box.past_threshold);
  for (Parameter p : {Parameter::t_bu, Parameter::t_bv, Parameter::t_bh})
    fabric[p] = random.uniform(box.threshold.low, box.threshold.high);
  return fabric;
}

}  // namespace drape
