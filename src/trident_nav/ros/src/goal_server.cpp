// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/goal_server.h"

#include <actionlib_msgs/GoalStatusArray.h>

#include <utility>

#include "trident_nav_ros/input_checks.h"

namespace trident::nav {
namespace {

constexpr std::uint32_t kQueueSize = 50;
constexpr double kStatusPeriod_s = 0.2;
constexpr double kStatusTimeout_s = 5.0;  // for which the end of a goal is reported
const char* const kReplaced = "This goal was replaced by a newer one.";

}  // namespace

GoalServer::GoalServer()
    : ActionServerBase([this](GoalHandle goal) { note_goal(std::move(goal)); },
                       [this](GoalHandle goal) { note_cancel(std::move(goal)); }, false) {
  status_list_timeout_ = ros::Duration(kStatusTimeout_s);
}

void GoalServer::receive(const move_base_msgs::MoveBaseActionGoalConstPtr& message) {
  auto checked = boost::make_shared<move_base_msgs::MoveBaseActionGoal>(*message);
  checked->goal_id = within_time(message->goal_id, ros::Time::now());
  goalCallback(checked);
}

void GoalServer::receive_cancel(const actionlib_msgs::GoalIDConstPtr& id) {
  cancelCallback(boost::make_shared<actionlib_msgs::GoalID>(within_time(*id, ros::Time::now())));
}

void GoalServer::note_goal(GoalHandle goal) {
  const Lock lock(goals_mutex_);
  const ros::Time stamp = goal.getGoalID().stamp;
  const auto is_older_than = [&](const GoalHandle& other) {
    return other.getGoal() && stamp < other.getGoalID().stamp;
  };
  if (is_older_than(current_) || is_older_than(next_)) {
    goal.setCanceled(move_base_msgs::MoveBaseResult(), kReplaced);
    return;
  }
  if (has_next_) next_.setCanceled(move_base_msgs::MoveBaseResult(), kReplaced);
  next_ = std::move(goal);
  has_next_ = true;
}

void GoalServer::note_cancel(GoalHandle goal) {
  const Lock lock(goals_mutex_);
  if (goal == current_) {
    is_cancel_requested_ = true;
  } else if (has_next_ && goal == next_) {
    next_.setCanceled(move_base_msgs::MoveBaseResult(), "");
    has_next_ = false;
  }
}

boost::shared_ptr<const GoalServer::Goal> GoalServer::take_new() {
  const Lock lock(goals_mutex_);
  if (!has_next_) return nullptr;
  if (is_current_active()) current_.setCanceled(move_base_msgs::MoveBaseResult(), kReplaced);
  current_ = next_;
  has_next_ = false;
  is_cancel_requested_ = false;
  current_.setAccepted("This goal is pursued.");
  return current_.getGoal();
}

bool GoalServer::is_current_active() {
  if (!current_.getGoal()) return false;
  const auto status = current_.getGoalStatus().status;
  return status == actionlib_msgs::GoalStatus::ACTIVE ||
         status == actionlib_msgs::GoalStatus::PREEMPTING;
}

bool GoalServer::has_new() {
  const Lock lock(goals_mutex_);
  return has_next_;
}

bool GoalServer::is_active() {
  const Lock lock(goals_mutex_);
  return is_current_active();
}

bool GoalServer::is_cancel_requested() {
  const Lock lock(goals_mutex_);
  return is_cancel_requested_ && is_current_active();
}

void GoalServer::publish_feedback(const move_base_msgs::MoveBaseFeedback& feedback) {
  const Lock lock(goals_mutex_);
  current_.publishFeedback(feedback);
}

void GoalServer::succeed(const std::string& text) {
  const Lock lock(goals_mutex_);
  current_.setSucceeded(move_base_msgs::MoveBaseResult(), text);
}

void GoalServer::abort(const std::string& text) {
  const Lock lock(goals_mutex_);
  current_.setAborted(move_base_msgs::MoveBaseResult(), text);
}

void GoalServer::cancel() {
  const Lock lock(goals_mutex_);
  current_.setCanceled(move_base_msgs::MoveBaseResult(), "");
  is_cancel_requested_ = false;
}

GoalTopics::GoalTopics(const ros::NodeHandle& node, const std::string& name) : node_(node, name) {}

void GoalTopics::initialize() {
  result_ = node_.advertise<move_base_msgs::MoveBaseActionResult>("result", kQueueSize);
  feedback_ = node_.advertise<move_base_msgs::MoveBaseActionFeedback>("feedback", kQueueSize);
  status_ = node_.advertise<actionlib_msgs::GoalStatusArray>("status", kQueueSize, true);
  timer_ = node_.createTimer(ros::Duration(kStatusPeriod_s),
                             [this](const ros::TimerEvent&) { publishStatus(); });
  goals_ = node_.subscribe<move_base_msgs::MoveBaseActionGoal>(
      "goal", kQueueSize,
      [this](const move_base_msgs::MoveBaseActionGoalConstPtr& message) { receive(message); });
  cancels_ = node_.subscribe<actionlib_msgs::GoalID>(
      "cancel", kQueueSize,
      [this](const actionlib_msgs::GoalIDConstPtr& id) { receive_cancel(id); });
}

void GoalTopics::publishResult(const actionlib_msgs::GoalStatus& status,
                               const move_base_msgs::MoveBaseResult& result) {
  move_base_msgs::MoveBaseActionResult message;
  message.header.stamp = ros::Time::now();
  message.status = status;
  message.result = result;
  result_.publish(message);
  publishStatus();
}

void GoalTopics::publishFeedback(const actionlib_msgs::GoalStatus& status,
                                 const move_base_msgs::MoveBaseFeedback& feedback) {
  move_base_msgs::MoveBaseActionFeedback message;
  message.header.stamp = ros::Time::now();
  message.status = status;
  message.feedback = feedback;
  feedback_.publish(message);
}

void GoalTopics::publishStatus() {
  const boost::recursive_mutex::scoped_lock lock(lock_);
  if (!started_) return;
  const ros::Time now = ros::Time::now();
  actionlib_msgs::GoalStatusArray message;
  message.header.stamp = now;
  for (const auto& tracker : status_list_) message.status_list.push_back(tracker.status_);
  status_list_.remove_if([&](const auto& tracker) {
    const ros::Time ended = tracker.handle_destruction_time_;
    return !ended.isZero() && ended + status_list_timeout_ < now;
  });
  status_.publish(message);
}

}  // namespace trident::nav
