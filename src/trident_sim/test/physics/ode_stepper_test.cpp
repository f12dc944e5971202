// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/contacts/ode_stepper.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "core/physics/ode_context.h"

namespace trident::sim {
namespace {

class OdeStepperTest : public testing::TestWithParam<int (*)(dWorldID, dReal)> {
 protected:
  OdeStepperTest() { init_ode(); }
  ~OdeStepperTest() override {
    stepper_.reset();
    dWorldDestroy(world_);
  }
  dWorldID world_ = dWorldCreate();
  std::unique_ptr<OdeStepper> stepper_ = std::make_unique<OdeStepper>(world_);
};

TEST_P(OdeStepperTest, AStepWithoutASolutionFailsAndTheNextIsFine) {
  const dBodyID lost = dBodyCreate(world_), other = dBodyCreate(world_);
  for (int i = 0; i < 3; ++i) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    dBodySetTorque(lost, none, none, none);
    EXPECT_FALSE(stepper_->run(GetParam(), 0.01));
    dBodySetTorque(lost, 0, 0, 0);
    const dQuaternion level = {1, 0, 0, 0};
    dBodySetQuaternion(lost, level);
    dBodySetAngularVel(lost, 0, 0, 0);
    dBodySetForce(other, 0, 0, 0);
    dBodySetPosition(other, 0, 0, 0);
    dBodySetLinearVel(other, 1, 0, 0);
    EXPECT_TRUE(stepper_->run(GetParam(), 0.01));
    EXPECT_DOUBLE_EQ(dBodyGetPosition(other)[0], 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, OdeStepperTest, testing::Values(dWorldStep, dWorldQuickStep));

}  // namespace
}  // namespace trident::sim
