// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/goal_server.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>

namespace trident::nav {
namespace {

using actionlib_msgs::GoalStatus;

/// Remembers how goals end, instead of topics.
class RecordedGoals final : public GoalServer {
 public:
  RecordedGoals() { start(); }

  void send(const std::string& id, const ros::Time& stamp) {
    auto message = boost::make_shared<move_base_msgs::MoveBaseActionGoal>();
    message->goal_id.id = id;
    message->goal_id.stamp = stamp;
    message->goal.target_pose.header.frame_id = id;
    receive(message);
  }
  void send_cancel(const std::string& id, const ros::Time& stamp) {
    auto message = boost::make_shared<actionlib_msgs::GoalID>();
    message->id = id;
    message->stamp = stamp;
    receive_cancel(message);
  }
  /// Of the goal that take_new() gives; empty: none.
  std::string taken() {
    const auto goal = take_new();
    return goal ? goal->target_pose.header.frame_id : "";
  }
  /// What a status timer computes. Throws as it does.
  void count_down() {
    for (const auto& tracker : status_list_) {
      static_cast<void>(tracker.handle_destruction_time_ + status_list_timeout_);
    }
  }

  std::map<std::string, GoalStatus> ended;

 private:
  void initialize() override {}
  void publishResult(const GoalStatus& status,
                     const move_base_msgs::MoveBaseResult& /*result*/) override {
    ended[status.goal_id.id] = status;
  }
  void publishFeedback(const GoalStatus& /*status*/,
                       const move_base_msgs::MoveBaseFeedback& /*feedback*/) override {}
  void publishStatus() override {}
};

class GoalServerTest : public testing::Test {
 protected:
  GoalServerTest() {
    ros::Time::init();
    ros::Time::setNow(now);
  }

  const ros::Time now{1000, 0};
  const ros::Time last{std::numeric_limits<std::uint32_t>::max(), 999'999'999};
  RecordedGoals goals;
};

TEST_F(GoalServerTest, AGoalIsTakenOnceAndEndsWithItsText) {
  EXPECT_EQ(goals.taken(), "");
  goals.send("a", now);
  EXPECT_FALSE(goals.is_active());
  EXPECT_EQ(goals.taken(), "a");
  EXPECT_TRUE(goals.is_active());
  EXPECT_EQ(goals.taken(), "");
  goals.succeed("Goal reached.");
  EXPECT_FALSE(goals.is_active());
  EXPECT_EQ(goals.ended.at("a").status, GoalStatus::SUCCEEDED);
  EXPECT_EQ(goals.ended.at("a").text, "Goal reached.");
}

TEST_F(GoalServerTest, TheNewestGoalReplacesThoseBefore) {
  goals.send("a", now);
  EXPECT_EQ(goals.taken(), "a");
  goals.send("b", now);
  goals.send("c", now);
  goals.send("of before", ros::Time(999, 0));
  EXPECT_EQ(goals.ended.at("b").status, GoalStatus::RECALLED);
  EXPECT_EQ(goals.ended.at("of before").status, GoalStatus::RECALLED);
  EXPECT_EQ(goals.taken(), "c");
  EXPECT_EQ(goals.ended.at("a").status, GoalStatus::PREEMPTED);
  EXPECT_EQ(goals.ended.count("c"), 0U);
}

TEST_F(GoalServerTest, ACanceledGoalIsLeftToTheOneWhoPursuesIt) {
  goals.send("a", now);
  goals.taken();
  goals.send_cancel("a", ros::Time());
  EXPECT_TRUE(goals.is_active());
  EXPECT_TRUE(goals.is_cancel_requested());
  goals.cancel();
  EXPECT_EQ(goals.ended.at("a").status, GoalStatus::PREEMPTED);
  EXPECT_FALSE(goals.is_cancel_requested());
  goals.send("b", now);
  goals.send_cancel("", ros::Time());
  EXPECT_EQ(goals.taken(), "");
  EXPECT_EQ(goals.ended.at("b").status, GoalStatus::RECALLED);
}

TEST_F(GoalServerTest, NoStampOfACancelRequestIsBeyondCounting) {
  goals.send_cancel("nobody's", last);
  EXPECT_NO_THROW(goals.count_down());
  const ros::Time later = now + ros::Duration(1.0);
  ros::Time::setNow(later);
  goals.send("a", later);
  EXPECT_EQ(goals.taken(), "a");
  goals.succeed("");
  goals.send("b", later);
  EXPECT_EQ(goals.taken(), "b");  // so that nothing holds the first any more
  goals.send("a", last);
  EXPECT_NO_THROW(goals.count_down());
}

TEST_F(GoalServerTest, AStampFromTheFutureDoesNotLockOutGoalsOfNow) {
  goals.send("a", now + ros::Duration(5000.0));
  EXPECT_EQ(goals.taken(), "a");
  goals.send("b", now);
  EXPECT_EQ(goals.taken(), "b");
  goals.send_cancel("nobody's", last);
  ros::Time::setNow(now + ros::Duration(1.0));
  goals.send("c", now + ros::Duration(1.0));
  EXPECT_EQ(goals.taken(), "c");
}

}  // namespace
}  // namespace trident::nav
