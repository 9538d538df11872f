#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "core/fabric.h"

namespace drape {
namespace {

std::string refusal(const Fabric& fabric) {
  try {
    validate(fabric);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

Fabric with(Parameter p, double value) {
  Fabric fabric;
  fabric[p] = value;
  return fabric;
}

TEST(Fabric, NamesGoThereAndBack) {
  std::set<std::string_view> names;
  for (const Parameter p : all_parameters()) {
    names.insert(name(p));
    EXPECT_EQ(parameter_from_name(name(p)), p);
    EXPECT_FALSE(info(p).meaning.empty());
    EXPECT_FALSE(info(p).unit.empty());
  }
  EXPECT_EQ(names.size(), 13u);
  EXPECT_EQ(parameter_from_name("k_w"), std::nullopt);
  EXPECT_EQ(parameter_from_name(""), std::nullopt);
}

TEST(Fabric, EveryParameterHasItsMemberAndItsPlace) {
  const Fabric fabric{.areal_density = 1,
                      .k_u = 2,
                      .k_v = 3,
                      .k_h = 4,
                      .k_bu = 5,
                      .k_bv = 6,
                      .k_bh = 7,
                      .s_bu = 8,
                      .s_bv = 9,
                      .s_bh = 10,
                      .t_bu = 11,
                      .t_bv = 12,
                      .t_bh = 13};
  const ParameterVector values = to_vector(fabric);
  for (int i = 0; i < kParameterCount; ++i) EXPECT_EQ(values[i], i + 1);
  EXPECT_EQ(to_vector(to_fabric(values)), values);
  EXPECT_EQ(fabric[*parameter_from_name("k_bv")], 6);
  EXPECT_EQ(fabric[*parameter_from_name("t_bu")], 11);
}

TEST(Fabric, EveryParameterIsCheckedOnEitherSideOfItsRange) {
  validate(Fabric{});
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Parameter p : all_parameters()) {
    const bool control = name(p).starts_with("t_");
    EXPECT_EQ(refusal(with(p, 1e-300)), "");
    EXPECT_EQ(refusal(with(p, 1)), "");
    EXPECT_EQ(refusal(with(p, 0)).empty(), control) << name(p);
    EXPECT_EQ(refusal(with(p, std::nextafter(1.0, 2))).empty(), !control) << name(p);
    for (const double bad : {-1e-300, -1.0, infinity, -infinity, std::nan("")}) {
      const std::string message = refusal(with(p, bad));
      EXPECT_NE(message.find(std::string(name(p)) + " = "), std::string::npos)
          << name(p) << " = " << bad << ": " << message;
    }
  }
}

TEST(Fabric, MessageNamesValueAndRange) {
  std::string message = refusal(with(Parameter::k_h, -3));
  EXPECT_NE(message.find("k_h = -3"), std::string::npos) << message;
  EXPECT_NE(message.find("> 0 N/m"), std::string::npos) << message;
  message = refusal(with(Parameter::t_bv, 1.5));
  EXPECT_NE(message.find("t_bv = 1.5"), std::string::npos) << message;
  EXPECT_NE(message.find(">= 0 and <= 1"), std::string::npos) << message;
}

TEST(Fabric, ReadingsGoThereAndBack) {
  for (const BendingLaw law : {BendingLaw::tangent, BendingLaw::secant})
    EXPECT_EQ(bending_law_from_name(name(law)), law);
  for (const BendingThreshold t : {BendingThreshold::printed, BendingThreshold::radius})
    EXPECT_EQ(bending_threshold_from_name(name(t)), t);
  EXPECT_THROW(bending_law_from_name("printed"), std::invalid_argument);
  EXPECT_THROW(bending_threshold_from_name("Radius"), std::invalid_argument);
  // the defaults
  EXPECT_EQ(BendingReading{}.law, BendingLaw::tangent);
  EXPECT_EQ(BendingReading{}.threshold, BendingThreshold::printed);
}

}  // namespace
}  // namespace drape
