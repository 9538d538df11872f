// The names that the enumerators of Settings have in a config, in the order of their values.
#pragma once

#include <string>
#include <vector>

#include "experiments/config_value.h"
#include "experiments/settings.h"

namespace drape {

template <>
std::vector<std::string> names_of<Kind>();
template <>
std::vector<std::string> names_of<MeshKind>();
template <>
std::vector<std::string> names_of<FactorBackend>();
template <>
std::vector<std::string> names_of<StartProtocol>();
template <>
std::vector<std::string> names_of<ContactMode>();
template <>
std::vector<std::string> names_of<FitMethod>();
template <>
std::vector<std::string> names_of<OutlineLoss>();
template <>
std::vector<std::string> names_of<TargetFabrics>();
template <>
std::vector<std::string> names_of<Perturb>();
template <>
std::vector<std::string> names_of<EstimateStart>();
template <>
std::vector<std::string> names_of<FirstParameters>();
template <>
std::vector<std::string> names_of<PriorKind>();
template <>
std::vector<std::string> names_of<PhotographModel>();
template <>
std::vector<std::string> names_of<Structure>();
template <>
std::vector<std::string> names_of<CheckedLoss>();
template <>
std::vector<std::string> names_of<ComparedMethod>();
template <>
std::vector<std::string> names_of<AblatedIngredient>();
template <>
std::vector<std::string> names_of<ComparedFit>();
template <>
std::vector<std::string> names_of<BendingLaw>();
template <>
std::vector<std::string> names_of<BendingThreshold>();
template <>
std::vector<std::string> names_of<Parameter>();

}  // namespace drape
