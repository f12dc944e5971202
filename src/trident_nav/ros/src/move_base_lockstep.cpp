// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// move_base for a simulator that waits for it.
#include <std_msgs/String.h>
#include <tf2/exceptions.h>

#include <chrono>
#include <cmath>
#include <utility>

#include "trident_base/string_util.h"
#include "trident_nav_ros/frames.h"
#include "trident_nav_ros/move_base_node.h"

namespace trident::nav {
namespace {

/// Waits until something is so, for some wall time at most; whether it is.
template <class Condition>
bool await(double limit_s, const Condition& is_so) {
  const ros::WallTime begun = ros::WallTime::now();
  while (!is_so()) {
    if (!ros::ok() || (ros::WallTime::now() - begun).toSec() >= limit_s) return false;
    ros::WallDuration(1e-4).sleep();
  }
  return true;
}

}  // namespace

void MoveBaseNode::run_in_lockstep() {
  constexpr std::chrono::milliseconds kPoll{100};  // whether the node is to end
  while (ros::ok()) {
    if (const auto stamp_s = lockstep_.samples.pop(kPoll)) answer(*stamp_s);
  }
}

/// The simulator continues with the answer: until then nothing newer than the sample comes, so that
/// equal samples give equal answers, however long they take.
void MoveBaseNode::answer(double stamp_s) {
  constexpr double kRounding_s = 1e-6;
  reconfiguration_->apply();
  if (lockstep_.cycled_s < 0.0) prepare_lockstep();
  await_transform(stamp_s);
  await_localization(stamp_s);
  const auto is_due = [&](double last_s, double period_s) {
    return stamp_s < last_s || stamp_s - last_s >= period_s - kRounding_s;
  };
  if (is_due(lockstep_.updated_s, parts_->global->update_period_s())) {
    lockstep_.updated_s = stamp_s;
    parts_->global->update(stamp_s);
  }
  if (is_due(lockstep_.cycled_s, 1.0 / parts_->navigator->params().controller_frequency)) {
    cycle_when_settled(stamp_s);
  }
  links_.command.publish(lockstep_.answer);
}

/// Goals wait until the periods of all sources are known: before, nobody knows what is late.
void MoveBaseNode::cycle_when_settled(double stamp_s) {
  constexpr double kSettle_s = 1.0;
  if (lockstep_.cycled_s < 0.0) lockstep_.begun_s = stamp_s;
  lockstep_.cycled_s = stamp_s;
  if (stamp_s - lockstep_.begun_s < kSettle_s) {
    parts_->local->update(stamp_s);
  } else {
    await_goal();
    cycle(stamp_s);
  }
}

/// The sample and its transform come on connections of their own.
void MoveBaseNode::await_transform(double stamp_s) {
  constexpr double kLimit_s = 2.0;  // wall time
  const ros::Time stamp(stamp_s);
  const std::string &local = parts_->local->frame(), &base = parts_->local->base_frame();
  if (!await(kLimit_s, [&] { return buffer_.canTransform(local, base, stamp); })) {
    note_unrepeatable("no transform from " + base + " to " + local + " has come for " +
                      number_text(stamp_s) + " s within " + number_text(kLimit_s) + " s");
  }
}

/// What wall time has decided is another thing in each run.
void MoveBaseNode::note_unrepeatable(const std::string& why) {
  refusals_.note("lockstep", "not repeatable: " + why);
  std_msgs::String message;
  message.data = why;
  links_.not_repeatable.publish(message);
}

/// The transform that follows from the newest scan, and no newer one, whatever has come.
void MoveBaseNode::await_localization(double stamp_s) {
  constexpr double kLimit_s = 10.0;  // wall time
  const double lead_s = parts_->params.localization_lead;
  if (lead_s < 0.0) return;
  const std::optional<double> scan_s = parts_->local->await_scan(stamp_s);
  if (!scan_s) return;
  const ros::Time stamp = ros::Time(*scan_s) + ros::Duration(lead_s);
  const auto is_there = [&] {
    return buffer_.canTransform(parts_->global->frame(), parts_->local->frame(), stamp);
  };
  if (await(kLimit_s, is_there)) {
    lockstep_.localized_ns = stamp.toNSec();
  } else {
    note_unrepeatable("no transform from " + parts_->local->frame() + " to " +
                      parts_->global->frame() + " has come for the scan at " +
                      number_text(*scan_s) + " s within " + number_text(kLimit_s) + " s");
  }
}

/// A client sends its next goal when it hears of the end of the one before; the sample at which
/// that comes would be another one in each run.
void MoveBaseNode::await_goal() {
  if (goals_->is_active()) return;
  if (std::exchange(lockstep_.awaits_goal, false)) {
    await(parts_->params.goal_patience, [this] { return goals_->has_new(); });
  } else if (goals_->has_new()) {
    note_unrepeatable("a goal has come after goal_patience of " +
                      number_text(parts_->params.goal_patience) + " s");
  }
}

/// The global costmap's window and the robot in it follow from the transforms that are waited for.
void MoveBaseNode::prepare_lockstep() {
  constexpr double kMapLimit_s = 30.0;  // wall time
  if (!await(kMapLimit_s, [this] { return parts_->global->missing().empty(); })) {
    note_unrepeatable(parts_->global->missing() + " within " + number_text(kMapLimit_s) + " s");
  }
  if (parts_->params.localization_lead < 0.0) return;
  parts_->global->set_robot_source(
      [this](double now_s, std::string* problem) -> std::optional<Pose2> {
        const auto local = parts_->local->robot(now_s, problem);
        const auto T = local ? T_global_local(now_s, problem) : std::nullopt;
        if (!T) return std::nullopt;
        return placed_in(*T, *local);
      });
}

std::optional<Pose2> MoveBaseNode::T_global_local(double now_s, std::string* problem) const {
  const std::string &global = parts_->global->frame(), &local = parts_->local->frame();
  const std::uint64_t localized_ns = lockstep_.localized_ns;
  if (parts_->params.localization_lead < 0.0) {
    return newest_pose(buffer_, global, local, now_s, INFINITY, problem);
  }
  try {
    if (localized_ns == 0) throw tf2::LookupException("localization has not begun");
    ros::Time stamp;
    stamp.fromNSec(localized_ns);
    return to_pose2(buffer_.lookupTransform(global, local, stamp).transform);
  } catch (const tf2::TransformException& error) {
    *problem = "there is no transform from " + local + " to " + global + ": " + error.what();
    return std::nullopt;
  }
}

}  // namespace trident::nav
