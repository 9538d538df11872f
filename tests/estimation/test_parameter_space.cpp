#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "estimation/parameter_space.h"
#include "tests/support/derivative_check.h"
#include "tests/support/shapes.h"

namespace drape::test {
namespace {

ParameterSpace whole_space() {
  return {{all_parameters().begin(), all_parameters().end()}, medium_fabric()};
}

TEST(ParameterSpace, DecodeUndoesEncode) {
  const ParameterSpace space = whole_space();
  const Fabric other = stiff_fabric();
  const ParameterVector back = to_vector(space.decode(space.encode(other)));
  const ParameterVector error = back - to_vector(other);
  for (int i = 0; i < kParameterCount; ++i)  // exp(ln p): |ln p| < 12 roundings of 1e-16
    EXPECT_LE(std::abs(error[i]), 4e-15 * std::abs(to_vector(other)[i])) << i;
}

TEST(ParameterSpace, WhatIsNotChosenStaysAtTheReference) {
  const ParameterSpace space{{Parameter::k_bv, Parameter::t_bu}, medium_fabric()};
  ASSERT_EQ(space.size(), 2);
  const Fabric fabric = space.decode(Eigen::Vector2d(std::log(7e-6), 0.9));
  for (const Parameter p : all_parameters()) {
    if (p == Parameter::k_bv)
      EXPECT_NEAR(fabric[p], 7e-6, 1e-19);  // rounding of exp(ln p)
    else if (p == Parameter::t_bu)
      EXPECT_EQ(fabric[p], 0.9);
    else
      EXPECT_EQ(fabric[p], medium_fabric()[p]) << name(p);
  }
}

TEST(ParameterSpace, ThresholdControlsAreLinear) {
  const ParameterSpace space = whole_space();
  const VecX z = space.encode(medium_fabric());
  for (const Parameter p : all_parameters()) {
    const bool threshold = p == Parameter::t_bu || p == Parameter::t_bv || p == Parameter::t_bh;
    EXPECT_EQ(is_logarithmic(p), !threshold) << name(p);
    const double value = medium_fabric()[p];
    EXPECT_EQ(z[static_cast<int>(p)], threshold ? value : std::log(value)) << name(p);
  }
  // their ends 0 and 1 belong to the range, which a logarithm would not allow
  VecX end = z;
  end.tail<3>() << 0, 1, 0;
  EXPECT_EQ(space.decode(end).t_bv, 1);
}

TEST(ParameterSpace, DerivativeAgainstDifferences) {
  const ParameterSpace space = whole_space();
  const VecX z = space.encode(medium_fabric()), derivative = space.derivative(z);
  for (int i = 0; i < space.size(); ++i) {
    const auto parameter = [&](double z_i) {
      VecX moved = z;
      moved[i] = z_i;
      return VecX::Constant(1, to_vector(space.decode(moved))[i]);
    };
    const DerivativeError check =
        check_derivative(parameter, z[i], VecX::Constant(1, derivative[i]), 0.1);
    EXPECT_LE(check.error, 1e-9) << check;  // rounding over the step at the best step
  }
}

TEST(ParameterSpace, RefusesUnknownsOutsideTheRange) {
  const ParameterSpace space{{Parameter::k_bu, Parameter::t_bu}, medium_fabric()};
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(space.decode(Eigen::Vector2d(-12, 1)));
  EXPECT_THROW(space.decode(Eigen::Vector2d(-12, 1 + 1e-12)), std::invalid_argument);
  EXPECT_THROW(space.decode(Eigen::Vector2d(-12, -1e-12)), std::invalid_argument);
  EXPECT_THROW(space.decode(Eigen::Vector2d(-infinity, 0.5)), std::invalid_argument);  // k_bu = 0
  EXPECT_THROW(space.decode(Eigen::Vector2d(infinity, 0.5)), std::invalid_argument);
  EXPECT_THROW(space.decode(Eigen::Vector2d(std::nan(""), 0.5)), std::invalid_argument);
}

}  // namespace
}  // namespace drape::test
