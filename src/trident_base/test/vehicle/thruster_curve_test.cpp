// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/vehicle/thruster_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "trident_base/error.h"
#include "trident_base/random_stream.h"

namespace trident {
namespace {

ThrusterParams curve(ThrustMapping mapping) {
  ThrusterParams params;
  params.name = "left";
  params.mapping = mapping;
  params.coefficient_forward = 0.01;
  params.coefficient_reverse = 0.006;
  params.table_commands = {-1.0, -0.5, -0.1, 0.1, 0.6, 1.0};
  params.table_forces = {-20.0, -5.0, 0.0, 0.0, 21.0, 33.0};
  if (mapping == ThrustMapping::kQuadratic) {
    params.min_command = -90.0;
    params.max_command = 100.0;
  }
  return params;
}

class EveryCurve : public testing::TestWithParam<ThrustMapping> {};

TEST_P(EveryCurve, CommandGivesTheThrustBack) {
  const ThrusterParams params = curve(GetParam());
  const double least = thrust_at(params, params.min_command);
  const double most = thrust_at(params, params.max_command);
  const RandomStream random(1, "thruster curve test");
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double wanted = least + (most - least) * random.uniform(i, 0);
    const double command = command_for(params, wanted);
    ASSERT_GE(command, params.min_command);
    ASSERT_LE(command, params.max_command);
    // Below the first thrust of VRX' curve there is only that or none.
    const double gap = GetParam() == ThrustMapping::kGlf ? 0.7 : 0.0;
    ASSERT_NEAR(thrust_at(params, command), wanted, 1e-9 * std::abs(wanted) + gap) << command;
    if (std::abs(wanted) > 2.0) ASSERT_NEAR(thrust_at(params, command), wanted, 1e-6);
  }
}

TEST_P(EveryCurve, BeyondItsEndsTheEndsAreTaken) {
  const ThrusterParams params = curve(GetParam());
  const double most = thrust_at(params, params.max_command);
  EXPECT_NEAR(thrust_at(params, command_for(params, 1e4)), most, 1e-6);
  EXPECT_NEAR(thrust_at(params, command_for(params, -1e4)), thrust_at(params, params.min_command),
              1e-6);
  EXPECT_EQ(command_for(params, 0.0), 0.0);
}

TEST_P(EveryCurve, WithinTheDeadBandThereIsNothingOrItsEdge) {
  ThrusterParams params = curve(GetParam());
  params.dead_band = 0.3 * params.max_command;
  const double edge = thrust_at(params, params.dead_band);
  EXPECT_EQ(command_for(params, 0.4 * edge), 0.0);
  EXPECT_EQ(command_for(params, 0.6 * edge), params.dead_band);
}

INSTANTIATE_TEST_SUITE_P(Mappings, EveryCurve,
                         testing::Values(ThrustMapping::kLinear, ThrustMapping::kGlf,
                                         ThrustMapping::kQuadratic, ThrustMapping::kTable));

TEST(ThrusterCurve, OneThatOnlyPushesAheadGivesNothingAstern) {
  ThrusterParams params = curve(ThrustMapping::kLinear);
  params.min_command = 0.0;
  EXPECT_EQ(command_for(params, -10.0), 0.0);
  EXPECT_NEAR(command_for(params, 125.0), 0.5, 1e-12);
}

TEST(ThrusterCurve, ATableThatFallsCannotBeInverted) {
  ThrusterParams params = curve(ThrustMapping::kTable);
  EXPECT_NO_THROW(check_invertible(params));
  params.table_forces[4] = 40.0;
  EXPECT_THROW(check_invertible(params), Error);
}

}  // namespace
}  // namespace trident
