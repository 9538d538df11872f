// A fabric: the thirteen parameters of the cloth model of Ju et al. 2024 (supplement, section 2).
//
// u is the weft and v the warp everywhere (section 2.1; section 2.2 lists the bending stiffnesses
// in the other order). All values in SI units. A bending stiffness k_b belongs to a wing of the
// mesh; the plate it makes has a flexural rigidity B of about 4 k_b (see bending.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "core/types.h"

namespace drape {

/// The parameters of one fabric, in the order of every parameter vector and derivative matrix.
enum class Parameter : int {
  areal_density,
  k_u,
  k_v,
  k_h,
  k_bu,
  k_bv,
  k_bh,
  s_bu,
  s_bv,
  s_bh,
  t_bu,
  t_bv,
  t_bh,
};

inline constexpr int kParameterCount = 13;

/// One value a parameter, ordered as `Parameter`.
using ParameterVector = Eigen::Matrix<double, kParameterCount, 1>;

/// What a parameter is called, what it means, its unit and the values it may take.
struct ParameterInfo {
  std::string_view name;
  std::string_view meaning;
  std::string_view unit;
  double minimum;
  bool minimum_allowed;  ///< whether `minimum` itself is a valid value
  double maximum;        ///< may be infinite; always allowed if finite
};

const ParameterInfo& info(Parameter parameter);
inline std::string_view name(Parameter parameter) { return info(parameter).name; }
std::optional<Parameter> parameter_from_name(std::string_view name);
/// All parameters in order, for range-based loops.
const std::array<Parameter, kParameterCount>& all_parameters();

struct Fabric {
  double areal_density = 0.2;  ///< mass per area [kg/m^2]
  double k_u = 2000;           ///< stretch stiffness, weft [N/m]
  double k_v = 2000;           ///< stretch stiffness, warp [N/m]
  double k_h = 60;             ///< shear stiffness, bias pair [N/m]
  double k_bu = 2.5e-6;        ///< bending stiffness, weft [N m]
  double k_bv = 2.5e-6;        ///< bending stiffness, warp [N m]
  double k_bh = 2.5e-6;        ///< bending stiffness, bias [N m]
  double s_bu = 1;             ///< factor on k_bu past the threshold [1]
  double s_bv = 1;             ///< factor on k_bv past the threshold [1]
  double s_bh = 1;             ///< factor on k_bh past the threshold [1]
  double t_bu = 0.3;           ///< threshold control, weft [1]
  double t_bv = 0.3;           ///< threshold control, warp [1]
  double t_bh = 0.3;           ///< threshold control, bias [1]

  double& operator[](Parameter parameter);
  double operator[](Parameter parameter) const;
};

ParameterVector to_vector(const Fabric& fabric);
Fabric to_fabric(const ParameterVector& values);

/// Throws std::invalid_argument that names the parameter, its value and the range it should be in.
void validate(const Fabric& fabric);

/// How the energy continues past the bending threshold, Eq. 6.
enum class BendingLaw {
  tangent,  ///< piecewise constant tangent stiffness: the energy is C1
  secant,   ///< the literal E = s_b k_b w delta^2: the energy jumps at the threshold
};

/// What lies past the threshold, Eqs. 6 and 7.
enum class BendingThreshold {
  printed,  ///< cos(delta/2) <= L_avg/(2 R_b): to the letter; t_b = 0 always past, t_b = 1 never
  radius,   ///< sin(delta/2) >= L_avg/(2 R_b): bent to a radius below R_b; t_b = 0 never, 1 at once
};

/// The two readings that the text of the source leaves open.
struct BendingReading {
  BendingLaw law = BendingLaw::tangent;
  BendingThreshold threshold = BendingThreshold::printed;
};

std::string_view name(BendingLaw law);
std::string_view name(BendingThreshold threshold);
/// Throw std::invalid_argument listing the known names.
BendingLaw bending_law_from_name(std::string_view name);
BendingThreshold bending_threshold_from_name(std::string_view name);

}  // namespace drape
