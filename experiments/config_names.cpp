#include "experiments/config_names.h"

#include "benchmarks/baselines/methods.h"
#include "experiments/ingredients.h"

namespace drape {

template <>
std::vector<std::string> names_of<Kind>() {
  return {"drape",
          "dataset",
          "estimate",
          "photograph",
          "photograph_set",
          "gradient_check",
          "robustness",
          "quickstart",
          "branches",
          "validation",
          "accuracy",
          "photographs",
          "identifiability",
          "work_precision",
          "stability",
          "ablation",
          "gradient_precision",
          "estimation_precision",
          "tag_comparison",
          "paper"};
}
template <>
std::vector<std::string> names_of<MeshKind>() {
  return {"isotropic"};
}
template <>
std::vector<std::string> names_of<FactorBackend>() {
  return {std::string(name(FactorBackend::cholmod)), std::string(name(FactorBackend::eigen))};
}
template <>
std::vector<std::string> names_of<StartProtocol>() {
  return {"coarse_ramp", "lobes", "ramp", "lowering", "guided", "ensemble"};
}
template <>
std::vector<std::string> names_of<ContactMode>() {
  return {std::string(name(ContactMode::automatic)), std::string(name(ContactMode::off)),
          std::string(name(ContactMode::support))};
}
template <>
std::vector<std::string> names_of<DatasetTags>() {
  return {"model", "random"};
}
template <>
std::vector<std::string> names_of<FitMethod>() {
  return {"levenberg_marquardt", "bfgs"};
}
template <>
std::vector<std::string> names_of<OutlineLoss>() {
  return {"profile", "coverage", "signed_distance"};
}
template <>
std::vector<std::string> names_of<TargetFabrics>() {
  return {"box", "measured", "tags"};
}
template <>
std::vector<std::string> names_of<Perturb>() {
  return {"up", "either_way", "random"};
}
template <>
std::vector<std::string> names_of<EstimateStart>() {
  return {"guided", "continued"};
}
template <>
std::vector<std::string> names_of<FirstParameters>() {
  return {"perturbed", "weight", "tag"};
}
template <>
std::vector<std::string> names_of<PriorKind>() {
  return {"none", "start", "weight", "tag"};
}
template <>
std::vector<std::string> names_of<PhotographModel>() {
  return {"printed", "radius", "radius_softening"};
}
template <>
std::vector<std::string> names_of<Structure>() {
  return {"woven", "knit", "other"};
}
template <>
std::vector<std::string> names_of<CheckedLoss>() {
  return {"profile", "coverage", "drape_coefficient"};
}
template <>
std::vector<std::string> names_of<AblatedIngredient>() {
  std::vector<std::string> list;
  for (const Ingredient& i : ingredients()) list.emplace_back(i.name);
  return list;
}
template <>
std::vector<std::string> names_of<ComparedMethod>() {
  std::vector<std::string> names;
  for (const baselines::Method& m : baselines::methods()) names.emplace_back(m.name);
  return names;
}
template <>
std::vector<std::string> names_of<ComparedFit>() {
  return {"levenberg_marquardt", "bfgs",   "levenberg_marquardt_differences",
          "bfgs_differences",    "bobyqa", "nelder_mead"};
}
template <>
std::vector<std::string> names_of<BendingLaw>() {
  return {std::string(name(BendingLaw::tangent)), std::string(name(BendingLaw::secant))};
}
template <>
std::vector<std::string> names_of<BendingThreshold>() {
  return {std::string(name(BendingThreshold::printed)),
          std::string(name(BendingThreshold::radius))};
}
template <>
std::vector<std::string> names_of<Parameter>() {
  std::vector<std::string> names;
  for (Parameter p : all_parameters()) names.emplace_back(name(p));
  return names;
}

}  // namespace drape
