// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <actionlib/server/action_server_base.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <ros/ros.h>

#include <string>

#include "trident_base/mutex.h"

namespace trident::nav {

/// The server of move_base's action: one goal at a time, the newest wins, as with actionlib's
/// SimpleActionServer. Unlike that, it takes no stamp from the future (see within_time()), which
/// ends that server's process or makes it deaf. This class has no topics. Thread-safe.
class GoalServer : public actionlib::ActionServerBase<move_base_msgs::MoveBaseAction> {
 public:
  using Goal = move_base_msgs::MoveBaseGoal;
  using Action = move_base_msgs::MoveBaseAction;

  GoalServer();

  /// Messages of the topics `goal` and `cancel`.
  void receive(const move_base_msgs::MoveBaseActionGoalConstPtr& message);
  void receive_cancel(const actionlib_msgs::GoalIDConstPtr& id);

  /// Whether take_new() would accept one.
  bool has_new();
  /// Accepts the newest goal, if it has not been accepted, in place of the one before.
  boost::shared_ptr<const Goal> take_new();
  bool is_active();
  /// Whether the client no longer wants the goal that is active.
  bool is_cancel_requested();

  void publish_feedback(const move_base_msgs::MoveBaseFeedback& feedback);
  void succeed(const std::string& text);
  void abort(const std::string& text);
  void cancel();

 private:
  void note_goal(GoalHandle goal);
  void note_cancel(GoalHandle goal);
  bool is_current_active() TRIDENT_REQUIRES(goals_mutex_);

  Mutex goals_mutex_;
  GoalHandle current_ TRIDENT_GUARDED_BY(goals_mutex_);
  GoalHandle next_ TRIDENT_GUARDED_BY(goals_mutex_);
  bool has_next_ TRIDENT_GUARDED_BY(goals_mutex_) = false;
  bool is_cancel_requested_ TRIDENT_GUARDED_BY(goals_mutex_) = false;
};

/// A GoalServer with the topics of an action: `NAME/goal`, `/cancel`, `/status`, `/feedback` and
/// `/result`. Call start() once.
class GoalTopics final : public GoalServer {
 public:
  GoalTopics(const ros::NodeHandle& node, const std::string& name);

 private:
  void initialize() override;
  void publishResult(const actionlib_msgs::GoalStatus& status,
                     const move_base_msgs::MoveBaseResult& result) override;
  void publishFeedback(const actionlib_msgs::GoalStatus& status,
                       const move_base_msgs::MoveBaseFeedback& feedback) override;
  void publishStatus() override;

  ros::NodeHandle node_;
  ros::Publisher status_, feedback_, result_;
  ros::Subscriber goals_, cancels_;
  ros::Timer timer_;
};

}  // namespace trident::nav
