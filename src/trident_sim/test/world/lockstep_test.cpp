// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "trident_sim/lockstep.h"

namespace trident::sim {
namespace {

using Answer = LockstepVehicle::Answer;
SimTime step(std::int64_t k) { return {k * 10'000'000}; }

/// A controller that has answered state 1 and is thereby enrolled.
LockstepVehicle enrolled() {
  LockstepVehicle vehicle;
  vehicle.on_state(step(1), 0);
  EXPECT_EQ(vehicle.on_answer(step(1), 0), Answer::kEnrolled);
  return vehicle;
}

TEST(Lockstep, StatesFlowFreelyBeforeAnAnswer) {
  LockstepVehicle vehicle;
  for (int k = 1; k < 5; ++k) EXPECT_TRUE(vehicle.on_state(step(k), k));
  EXPECT_FALSE(vehicle.enrolled());
  EXPECT_TRUE(vehicle.answered_up_to(step(4)));
  EXPECT_EQ(vehicle.waiting_for(100), 0);
}

TEST(Lockstep, TheFirstAnswerToAStateEnrolls) {
  LockstepVehicle vehicle;
  vehicle.on_state(step(1), 0);
  vehicle.on_state(step(2), 0);
  EXPECT_EQ(vehicle.on_answer(step(1), 0), Answer::kEnrolled);
  EXPECT_TRUE(vehicle.enrolled());
}

TEST(Lockstep, AForeignStampDoesNotEnroll) {
  LockstepVehicle vehicle;
  vehicle.on_state(step(1), 0);
  EXPECT_EQ(vehicle.on_answer({123}, 0), Answer::kForeign);
  EXPECT_EQ(vehicle.on_answer({0}, 0), Answer::kForeign);
  EXPECT_FALSE(vehicle.enrolled());
}

TEST(Lockstep, OneStateIsInFlightAndTheOthersQueueInOrder) {
  LockstepVehicle vehicle = enrolled();
  EXPECT_TRUE(vehicle.on_state(step(2), 0));
  EXPECT_FALSE(vehicle.on_state(step(3), 0));
  EXPECT_FALSE(vehicle.on_state(step(4), 0));
  EXPECT_LT(vehicle.next_to_send(0).ns, 0);  // 2 is in flight
  EXPECT_EQ(vehicle.on_answer(step(2), 0), Answer::kExpected);
  EXPECT_EQ(vehicle.next_to_send(0), step(3));
  EXPECT_LT(vehicle.next_to_send(0).ns, 0);
  vehicle.on_answer(step(3), 0);
  EXPECT_EQ(vehicle.next_to_send(0), step(4));
  vehicle.on_answer(step(4), 0);
  EXPECT_LT(vehicle.next_to_send(0).ns, 0);
  EXPECT_TRUE(vehicle.on_state(step(5), 0));
}

TEST(Lockstep, AnsweredUpToFollowsTheOldestOpenState) {
  LockstepVehicle vehicle = enrolled();
  vehicle.on_state(step(2), 0);
  vehicle.on_state(step(3), 0);
  EXPECT_TRUE(vehicle.answered_up_to(step(1)));
  EXPECT_FALSE(vehicle.answered_up_to(step(2)));
  vehicle.on_answer(step(2), 0);
  EXPECT_TRUE(vehicle.answered_up_to(step(2)));
  EXPECT_FALSE(vehicle.answered_up_to(step(3)));
}

TEST(Lockstep, ADuplicateOrForeignAnswerDoesNotAnswerTheNextState) {
  LockstepVehicle vehicle = enrolled();
  vehicle.on_state(step(2), 0);
  vehicle.on_answer(step(1), 0);
  EXPECT_FALSE(vehicle.answered_up_to(step(2)));
  EXPECT_EQ(vehicle.on_answer({77}, 0), Answer::kForeign);
  EXPECT_FALSE(vehicle.answered_up_to(step(2)));
  EXPECT_LT(vehicle.next_to_send(0).ns, 0);
}

TEST(Lockstep, AStateThatWasNotSentYetCannotBeAnswered) {
  LockstepVehicle vehicle = enrolled();
  vehicle.on_state(step(2), 0);
  vehicle.on_state(step(3), 0);
  EXPECT_EQ(vehicle.on_answer(step(3), 0), Answer::kForeign);
  EXPECT_FALSE(vehicle.answered_up_to(step(2)));
}

TEST(Lockstep, WaitingIsMeasuredFromTheMomentOfSending) {
  LockstepVehicle vehicle = enrolled();
  EXPECT_EQ(vehicle.waiting_for(1000), 0);
  vehicle.on_state(step(2), 1000);
  EXPECT_EQ(vehicle.waiting_for(1700), 700);
  vehicle.on_state(step(3), 1800);
  vehicle.on_answer(step(2), 2000);
  EXPECT_EQ(vehicle.waiting_for(2500), 0);
  vehicle.next_to_send(3000);
  EXPECT_EQ(vehicle.waiting_for(3050), 50);
}

TEST(Lockstep, AReleasedControllerIsNotWaitedForAndRejoinsByAnswering) {
  LockstepVehicle vehicle = enrolled();
  vehicle.on_state(step(2), 0);
  vehicle.on_state(step(3), 0);
  vehicle.release();
  EXPECT_FALSE(vehicle.enrolled());
  EXPECT_TRUE(vehicle.answered_up_to(step(3)));
  EXPECT_EQ(vehicle.waiting_for(100), 0);
  EXPECT_TRUE(vehicle.on_state(step(4), 0));
  EXPECT_TRUE(vehicle.on_state(step(5), 0));
  EXPECT_EQ(vehicle.on_answer(step(5), 0), Answer::kEnrolled);
  EXPECT_TRUE(vehicle.on_state(step(6), 0));
  EXPECT_FALSE(vehicle.answered_up_to(step(6)));
}

TEST(Lockstep, AConnectedControllerIsWaitedForFromTheFirstState) {
  LockstepVehicle vehicle;
  vehicle.enroll();
  EXPECT_TRUE(vehicle.on_state(step(1), 0));
  EXPECT_FALSE(vehicle.on_state(step(2), 0));
  EXPECT_FALSE(vehicle.answered_up_to(step(1)));
  EXPECT_EQ(vehicle.on_answer(step(1), 0), Answer::kExpected);
}

TEST(Lockstep, AfterClearOldStampsAreForeignAndItStaysEnrolled) {
  LockstepVehicle vehicle = enrolled();
  vehicle.on_state(step(2), 0);
  vehicle.on_state(step(3), 0);
  vehicle.clear();
  EXPECT_TRUE(vehicle.enrolled());
  EXPECT_TRUE(vehicle.answered_up_to(step(3)));
  EXPECT_EQ(vehicle.on_answer(step(2), 0), Answer::kForeign);
  EXPECT_TRUE(vehicle.on_state(step(1), 0));
  EXPECT_EQ(vehicle.on_answer(step(1), 0), Answer::kExpected);
}

TEST(Lockstep, ALongFlightKeepsWorking) {
  LockstepVehicle vehicle = enrolled();
  for (int k = 2; k < 2000; ++k) {
    ASSERT_TRUE(vehicle.on_state(step(k), k));
    ASSERT_EQ(vehicle.on_answer(step(k), k), Answer::kExpected);
    ASSERT_TRUE(vehicle.answered_up_to(step(k)));
  }
}

}  // namespace
}  // namespace trident::sim
