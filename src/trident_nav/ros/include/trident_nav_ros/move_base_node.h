// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/GetPlan.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "trident_nav/navigator/navigator.h"
#include "trident_nav_ros/control_topics.h"
#include "trident_nav_ros/goal_server.h"
#include "trident_nav_ros/loop_watch.h"
#include "trident_nav_ros/move_base_parts.h"
#include "trident_nav_ros/potential_topic.h"
#include "trident_nav_ros/reconfiguration.h"
#include "trident_nav_ros/sample_queue.h"
#include "trident_ros/refusals.h"
#include "trident_ros/transform_input.h"

namespace trident::nav {

/// The node move_base: its action, topics and services about a Navigator with two costmaps.
class MoveBaseNode {
 public:
  /// Throws Error for parameters that are not legal.
  MoveBaseNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
               const VoxelAdvertiser& voxels);
  ~MoveBaseNode();

  /// Controls until the node is to end. Callbacks need threads of their own.
  void run();

 private:
  void serve(ros::NodeHandle& node, ros::NodeHandle private_node);
  void serve_plugins(const ros::NodeHandle& private_node);
  void update_global();
  void run_by_clock();
  void run_in_lockstep();
  void answer(double stamp_s);
  void prepare_lockstep();
  void cycle_when_settled(double stamp_s);
  void await_transform(double stamp_s);
  void note_unrepeatable(const std::string& why);
  void await_localization(double stamp_s);
  void await_goal();
  std::optional<Pose2> T_global_local(double now_s, std::string* problem) const;
  void warn_of_rivals();
  void cycle(double now_s);
  void note_time(double now_s);
  void note_step(const char* step);
  void log_missed_periods(double now_s);
  void take_goals(double now_s);
  bool place_goal(double now_s, std::string* problem);
  void give_up_frame(double now_s, const std::string& problem);
  std::optional<NavigatorInput> sense(double now_s, std::string* problem);
  void act(const NavigatorInput& input, const NavigatorOutput& output);
  void stand(double now_s, const std::string& why);
  bool is_warning_due(double now_s);
  void send(const Twist2& twist);
  void end_goal(NavigatorStatus status, const std::string& text);
  void note_recovery(const RecoveryNote& note, const NavigatorInput& input);
  void publish_path(double now_s);
  void on_simple_goal(const geometry_msgs::PoseStamped& message);
  void on_odometry(const nav_msgs::Odometry& message);
  std::optional<Pose2> placed_globally(const geometry_msgs::PoseStamped& pose, double now_s,
                                       std::string* problem) const;
  bool make_plan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);
  bool clear_costmaps(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);

  tf2_ros::Buffer buffer_;
  ros_utils::Refusals refusals_;
  ros_utils::TransformInput transforms_;
  std::unique_ptr<MoveBaseParts> parts_;
  std::unique_ptr<GoalTopics> goals_;
  std::unique_ptr<Reconfiguration> reconfiguration_;

  /// Publishers, subscribers and services.
  struct Links {
    ros::Publisher command, current_goal, action_goal, recovery, global_path, local_path;
    ros::Publisher not_repeatable;  ///< In lockstep alone: for the simulator's verdict.
    ros::Subscriber simple_goal, odometry;
    ros::ServiceServer make_plan, planner_make_plan, clear_costmaps;
    std::unique_ptr<ControlTopics> control;
    std::unique_ptr<PotentialTopic> potential;
  };
  Links links_;

  std::mutex odometry_mutex_;
  Twist2 measured_;
  /// A goal whose pose in the global costmap is not known yet.
  struct UnplacedGoal {
    geometry_msgs::PoseStamped pose;
    double since_s;  ///< That time the robot's own pose is known.
  };
  std::optional<UnplacedGoal> unplaced_goal_;
  std::atomic<bool> is_driving_{false};  // the last command was not zero
  /// The latest warnings.
  struct Warned {
    std::string rivals;  ///< Of the command's topic; of the global costmap's thread.
    double waiting_s = -1e9;
    double cycled_s = -1e9;  ///< The time of the last cycle.
  };
  Warned warned_;
  /// Of a run in lockstep; the controlling thread's but for the queue.
  struct Lockstep {
    SampleQueue samples;
    geometry_msgs::Twist answer;  ///< The command at present.
    double cycled_s = -1.0, updated_s = -1.0, begun_s = 0.0;
    /// Time of the transform that localization has made of the newest scan [ns]; 0: none yet.
    std::atomic<std::uint64_t> localized_ns{0};
    bool awaits_goal = true;  ///< Nobody has been waited for since the last goal ended.
  };
  Lockstep lockstep_;
  LoopWatch watch_;
  /// The global costmap's updates, outside of lockstep.
  struct GlobalUpdates {
    std::atomic<bool> is_ending{false};
    std::thread thread;
  };
  GlobalUpdates global_updates_;
};

/// The program of the package move_base. `voxels`: of voxel_advertiser().
int move_base_main(int argc, char** argv, const VoxelAdvertiser& voxels);

}  // namespace trident::nav
