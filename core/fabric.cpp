#include "core/fabric.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace drape {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr std::array<ParameterInfo, kParameterCount> kInfo{{
    {"areal_density", "mass per area", "kg/m^2", 0, false, kInfinity},
    {"k_u", "stretch stiffness along the weft", "N/m", 0, false, kInfinity},
    {"k_v", "stretch stiffness along the warp", "N/m", 0, false, kInfinity},
    {"k_h", "shear stiffness of the bias pair (k_h = 2 G)", "N/m", 0, false, kInfinity},
    {"k_bu", "bending stiffness, weft", "N m", 0, false, kInfinity},
    {"k_bv", "bending stiffness, warp", "N m", 0, false, kInfinity},
    {"k_bh", "bending stiffness, bias", "N m", 0, false, kInfinity},
    {"s_bu", "factor on k_bu past the bending threshold", "1", 0, false, kInfinity},
    {"s_bv", "factor on k_bv past the bending threshold", "1", 0, false, kInfinity},
    {"s_bh", "factor on k_bh past the bending threshold", "1", 0, false, kInfinity},
    {"t_bu", "threshold control, weft", "1", 0, true, 1},
    {"t_bv", "threshold control, warp", "1", 0, true, 1},
    {"t_bh", "threshold control, bias", "1", 0, true, 1},
}};

constexpr std::array<double Fabric::*, kParameterCount> kMember{
    &Fabric::areal_density, &Fabric::k_u,  &Fabric::k_v,  &Fabric::k_h,  &Fabric::k_bu,
    &Fabric::k_bv,          &Fabric::k_bh, &Fabric::s_bu, &Fabric::s_bv, &Fabric::s_bh,
    &Fabric::t_bu,          &Fabric::t_bv, &Fabric::t_bh};

}  // namespace

const ParameterInfo& info(Parameter parameter) { return kInfo[static_cast<size_t>(parameter)]; }

std::optional<Parameter> parameter_from_name(std::string_view name) {
  for (Parameter p : all_parameters())
    if (info(p).name == name) return p;
  return std::nullopt;
}

const std::array<Parameter, kParameterCount>& all_parameters() {
  static const auto all = [] {
    std::array<Parameter, kParameterCount> list{};
    for (int i = 0; i < kParameterCount; ++i)
      list[static_cast<size_t>(i)] = static_cast<Parameter>(i);
    return list;
  }();
  return all;
}

double& Fabric::operator[](Parameter parameter) {
  return this->*kMember[static_cast<size_t>(parameter)];
}

double Fabric::operator[](Parameter parameter) const {
  return this->*kMember[static_cast<size_t>(parameter)];
}

ParameterVector to_vector(const Fabric& fabric) {
  ParameterVector values;
  for (Parameter p : all_parameters()) values[static_cast<int>(p)] = fabric[p];
  return values;
}

Fabric to_fabric(const ParameterVector& values) {
  Fabric fabric;
  for (Parameter p : all_parameters()) fabric[p] = values[static_cast<int>(p)];
  return fabric;
}

void validate(const Fabric& fabric) {
  for (Parameter p : all_parameters()) {
    const ParameterInfo& about = info(p);
    const double value = fabric[p];
    const bool above = about.minimum_allowed ? value >= about.minimum : value > about.minimum;
    if (std::isfinite(value) && above && value <= about.maximum) continue;
    std::ostringstream message;
    message << "fabric parameter " << about.name << " = " << value << " (" << about.meaning
            << "): must be a finite number " << (about.minimum_allowed ? ">= " : "> ")
            << about.minimum;
    if (std::isfinite(about.maximum)) message << " and <= " << about.maximum;
    if (about.unit != "1") message << " " << about.unit;
    throw std::invalid_argument(message.str());
  }
}

std::string_view name(BendingLaw law) { return law == BendingLaw::tangent ? "tangent" : "secant"; }

std::string_view name(BendingThreshold threshold) {
  return threshold == BendingThreshold::printed ? "printed" : "radius";
}

BendingLaw bending_law_from_name(std::string_view text) {
  for (BendingLaw law : {BendingLaw::tangent, BendingLaw::secant})
    if (text == name(law)) return law;
  throw std::invalid_argument("bending law '" + std::string(text) +
                              "': must be \"tangent\" or \"secant\"");
}

BendingThreshold bending_threshold_from_name(std::string_view text) {
  for (BendingThreshold threshold : {BendingThreshold::printed, BendingThreshold::radius})
    if (text == name(threshold)) return threshold;
  throw std::invalid_argument("bending threshold '" + std::string(text) +
                              "': must be \"printed\" or \"radius\"");
}

}  // namespace drape
