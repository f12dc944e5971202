// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control/setpoint_queue.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace trident::control {
namespace {

constexpr SimTime kNoStamp{};

SimTime at(double seconds) { return SimTime::from_seconds(seconds); }

TimedSetpoint point(double x, double time_from_start = 0.0) {
  TimedSetpoint timed;
  timed.time_from_start = at(time_from_start);
  timed.point.p_world.x() = x;
  return timed;
}

/// One queue and the x of the set-point that acts at a stamp; -1 = none.
class SetpointQueueTest : public testing::Test {
 protected:
  SetpointResult push(SimTime stamp, const std::vector<TimedSetpoint>& points) {
    return queue.push(stamp, points);
  }
  double x_at(double seconds) {
    const TrajectoryPoint* active = queue.advance(at(seconds));
    return active ? active->p_world.x() : -1.0;
  }
  SetpointQueue queue;
};

TEST_F(SetpointQueueTest, nothing_acts_before_the_first_set_point) {
  EXPECT_EQ(x_at(0.01), -1.0);
  push(at(5.0), {point(1)});
  EXPECT_EQ(x_at(4.99), -1.0);
  EXPECT_EQ(x_at(5.0), 1.0);
}

TEST_F(SetpointQueueTest, an_unstamped_set_point_acts_at_the_next_state) {
  x_at(1.0);
  push(kNoStamp, {point(3)});
  EXPECT_EQ(x_at(1.01), 3.0);
}

TEST_F(SetpointQueueTest, a_past_stamp_acts_at_the_next_state) {
  x_at(1.0);
  push(at(0.5), {point(3)});
  EXPECT_EQ(x_at(1.01), 3.0);
}

TEST_F(SetpointQueueTest, a_stamp_between_two_states_acts_at_the_later) {
  push(at(1.005), {point(3)});
  EXPECT_EQ(x_at(1.0), -1.0);
  EXPECT_EQ(x_at(1.01), 3.0);
}

TEST_F(SetpointQueueTest, outcome_does_not_depend_on_when_the_message_came) {
  for (int states_before = 0; states_before < 50; ++states_before) {
    SetpointQueue queue;
    std::vector<double> seen;
    for (int k = 0; k < 100; ++k) {
      if (k == states_before) queue.push(at(0.5), std::vector{point(1, 0.0), point(2, 0.2)});
      const TrajectoryPoint* active = queue.advance(at(0.01 * k));
      seen.push_back(active ? active->p_world.x() : -1.0);
    }
    for (int k = 0; k < 100; ++k) EXPECT_EQ(seen[k], k < 50 ? -1.0 : k < 70 ? 1.0 : 2.0) << k;
  }
}

TEST_F(SetpointQueueTest, a_trajectory_acts_point_by_point) {
  push(at(1.0), {point(1, 0.0), point(2, 0.5), point(3, 1.5)});
  EXPECT_EQ(x_at(1.0), 1.0);
  EXPECT_EQ(x_at(1.49), 1.0);
  EXPECT_EQ(x_at(1.5), 2.0);
  EXPECT_EQ(x_at(2.5), 3.0);
  EXPECT_EQ(x_at(99.0), 3.0);
}

TEST_F(SetpointQueueTest, first_point_acts_at_the_start_and_the_rest_by_difference_as_in_rotors) {
  x_at(10.0);
  push(kNoStamp, {point(1, 60.0), point(2, 80.0)});
  EXPECT_EQ(x_at(10.01), 1.0);
  EXPECT_EQ(x_at(30.0), 1.0);
  EXPECT_EQ(x_at(30.01), 2.0);
}

TEST(SetpointQueue, every_point_waits_for_its_own_time_when_asked_to) {
  SetpointQueueParams params;
  params.first_point_at_start = false;
  SetpointQueue queue(params);
  queue.push(SimTime{}, std::vector{point(1, 60.0), point(2, 80.0)});
  EXPECT_EQ(queue.advance(at(10.0)), nullptr);
  EXPECT_EQ(queue.advance(at(69.99)), nullptr);
  EXPECT_EQ(queue.advance(at(70.0))->p_world.x(), 1.0);
  EXPECT_EQ(queue.advance(at(90.0))->p_world.x(), 2.0);
}

TEST_F(SetpointQueueTest, a_skipped_period_of_states_ends_at_the_latest_point) {
  push(at(1.0), {point(1, 0.0), point(2, 0.1), point(3, 0.2)});
  EXPECT_EQ(x_at(5.0), 3.0);
}

TEST_F(SetpointQueueTest, a_newer_message_keeps_what_lies_before_its_start) {
  push(at(1.0), {point(1, 0.0), point(2, 1.0), point(3, 2.0)});
  push(at(2.5), {point(9)});
  EXPECT_EQ(x_at(1.0), 1.0);
  EXPECT_EQ(x_at(2.0), 2.0);
  EXPECT_EQ(x_at(2.5), 9.0);
  EXPECT_EQ(x_at(3.5), 9.0);  // point 3 was dropped
}

TEST_F(SetpointQueueTest, a_newer_message_at_the_same_stamp_replaces) {
  push(at(1.0), {point(1)});
  push(at(1.0), {point(2)});
  EXPECT_EQ(x_at(1.0), 2.0);
}

TEST_F(SetpointQueueTest, a_message_that_comes_again_takes_nothing_back) {
  const std::vector<TimedSetpoint> first = {point(1), point(2, 0.5)}, second = {point(3)};
  push(at(1.0), first);
  push(at(2.0), second);
  x_at(1.2);
  push(at(1.0), first);  // the second one's repetition has not arrived yet
  EXPECT_EQ(x_at(1.6), 2.0);
  EXPECT_EQ(x_at(2.0), 3.0);
  push(at(1.0), first);
  EXPECT_EQ(x_at(2.1), 3.0);
}

TEST_F(SetpointQueueTest, an_old_message_acts_again_after_another_of_its_stamp) {
  push(at(1.0), {point(1)});
  push(at(1.0), {point(2)});
  EXPECT_EQ(x_at(1.0), 2.0);
  push(at(1.0), {point(1)});
  EXPECT_EQ(x_at(1.1), 1.0);
  push(kNoStamp, {point(5)});
  EXPECT_EQ(x_at(1.2), 5.0);
  push(at(1.0), {point(1)});
  EXPECT_EQ(x_at(1.3), 1.0);
}

TEST_F(SetpointQueueTest, the_message_of_a_life_before_acts_in_the_new_one) {
  push(at(1.0), {point(1)});
  EXPECT_EQ(x_at(5.0), 1.0);
  push(at(1.0), {point(1)});
  EXPECT_EQ(x_at(0.0), -1.0);
  EXPECT_EQ(x_at(1.0), 1.0);
}

TEST_F(SetpointQueueTest, an_unstamped_message_clears_the_trajectory) {
  push(at(1.0), {point(1, 0.0), point(2, 1.0)});
  EXPECT_EQ(x_at(1.0), 1.0);
  push(kNoStamp, {point(7)});
  EXPECT_EQ(x_at(1.5), 7.0);
  EXPECT_EQ(x_at(2.5), 7.0);
}

TEST_F(SetpointQueueTest, the_last_message_wins_even_with_an_older_stamp) {
  push(at(1.0), {point(1)});
  EXPECT_EQ(x_at(1.0), 1.0);
  push(at(0.9), {point(2)});
  EXPECT_EQ(x_at(1.01), 2.0);
}

TEST_F(SetpointQueueTest, a_late_trajectory_is_joined_where_it_is) {
  x_at(1.0);
  push(at(0.5), {point(1, 0.0), point(2, 0.4), point(3, 0.6)});
  EXPECT_EQ(x_at(1.01), 2.0);
  EXPECT_EQ(x_at(1.1), 3.0);
}

TEST_F(SetpointQueueTest, stamps_of_another_clock_act_at_once) {
  x_at(100.0);
  push(at(1.7e9), {point(1, 0.0), point(2, 1.0)});  // wall clock
  EXPECT_EQ(x_at(100.01), 1.0);
  EXPECT_EQ(x_at(101.01), 2.0);
  push(at(3.0), {point(3, 0.0), point(4, 1.0)});  // a stamp of long ago
  EXPECT_EQ(x_at(101.02), 3.0);
  EXPECT_EQ(x_at(102.01), 3.0);
  EXPECT_EQ(x_at(102.02), 4.0);
}

TEST_F(SetpointQueueTest, refuses_bad_messages_and_keeps_what_it_has) {
  push(kNoStamp, {point(1)});
  EXPECT_EQ(push(kNoStamp, {}), SetpointResult::empty);
  EXPECT_EQ(push(kNoStamp, {point(2), point(std::numeric_limits<double>::quiet_NaN(), 1.0)}),
            SetpointResult::non_finite);
  EXPECT_EQ(push(kNoStamp, {point(2, 1.0), point(3, 0.5)}), SetpointResult::unordered);
  EXPECT_EQ(push(kNoStamp, {point(2, -1.0)}), SetpointResult::unordered);
  EXPECT_EQ(push(kNoStamp, std::vector<TimedSetpoint>(SetpointQueue::kMaxPoints + 1)),
            SetpointResult::too_many_points);
  EXPECT_EQ(x_at(0.01), 1.0);
}

TEST_F(SetpointQueueTest, a_flood_without_states_stays_bounded_and_ends_with_the_newest) {
  const std::vector<TimedSetpoint> many(SetpointQueue::kMaxPoints, point(1));
  for (int i = 0; i < 10; ++i) EXPECT_EQ(push(kNoStamp, many), SetpointResult::accepted);
  push(kNoStamp, {point(5)});
  EXPECT_EQ(x_at(0.01), 5.0);
}

TEST_F(SetpointQueueTest, a_reset_of_the_world_forgets_everything) {
  push(kNoStamp, {point(1)});
  push(at(200.0), {point(2)});
  EXPECT_EQ(x_at(100.0), 1.0);
  EXPECT_FALSE(queue.was_reset());
  EXPECT_EQ(x_at(0.01), -1.0);
  EXPECT_TRUE(queue.was_reset());
  EXPECT_EQ(x_at(0.02), -1.0);
  EXPECT_FALSE(queue.was_reset());
  EXPECT_EQ(x_at(201.0), -1.0);
}

TEST_F(SetpointQueueTest, set_points_sent_after_a_reset_survive_it_though_no_state_announced_it) {
  push(kNoStamp, {point(1)});
  EXPECT_EQ(x_at(100.0), 1.0);
  push(at(100.1), {point(2)});  // of the old time
  push(at(0.5), {point(3)});    // of the new one
  EXPECT_EQ(x_at(0.01), -1.0);
  EXPECT_EQ(x_at(0.5), 3.0);
  EXPECT_EQ(x_at(101.0), 3.0);
}

TEST_F(SetpointQueueTest, an_unstamped_set_point_sent_after_a_reset_survives_it) {
  EXPECT_EQ(x_at(100.0), -1.0);
  push(kNoStamp, {point(3), point(4, 1.0)});
  EXPECT_EQ(x_at(0.01), 3.0);
  EXPECT_EQ(x_at(1.01), 4.0);
}

TEST(SetpointQueue, keeps_the_set_point_over_a_reset_when_asked_to) {
  SetpointQueueParams params;
  params.keep_setpoint_over_reset = true;
  SetpointQueue queue(params);
  queue.push(SimTime{}, std::vector{point(1), point(2, 50.0)});
  EXPECT_EQ(queue.advance(at(10.0))->p_world.x(), 1.0);
  EXPECT_EQ(queue.advance(at(0.01))->p_world.x(), 1.0);
  EXPECT_EQ(queue.advance(at(60.0))->p_world.x(), 1.0);
}

TEST_F(SetpointQueueTest, an_equal_stamp_is_no_reset) {
  push(kNoStamp, {point(1)});
  x_at(1.0);
  EXPECT_EQ(x_at(1.0), 1.0);
  EXPECT_FALSE(queue.was_reset());
}

TEST_F(SetpointQueueTest, a_message_that_comes_again_is_known_before_and_after_a_state) {
  const auto is_repetition = [this](SimTime stamp, double x) {
    push(stamp, {point(x)});
    return queue.repeats();
  };
  EXPECT_FALSE(is_repetition(at(1.0), 1));
  EXPECT_FALSE(is_repetition(at(2.0), 2));
  EXPECT_TRUE(is_repetition(at(1.0), 1)) << "no state has taken it yet";
  EXPECT_TRUE(is_repetition(at(2.0), 2)) << "behind one that was repeated itself";
  EXPECT_TRUE(is_repetition(at(1.0), 1));
  x_at(0.5);
  EXPECT_TRUE(is_repetition(at(2.0), 2)) << "a state has";
  EXPECT_FALSE(is_repetition(at(2.0), 3)) << "another plan";
  EXPECT_FALSE(is_repetition(kNoStamp, 3));
  EXPECT_FALSE(is_repetition(kNoStamp, 3)) << "without a stamp each is a new set-point";
  EXPECT_FALSE(is_repetition(at(2.0), 3)) << "what has no stamp took its place";
}

}  // namespace
}  // namespace trident::control
