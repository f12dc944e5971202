// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/error.h"
#include "trident_nav_ros/costmap_node.h"
#include "trident_nav_ros/move_base_params.h"
#include "trident_nav_ros/potential_topic.h"
#include "trident_ros/refusals.h"
#include "trident_ros/transform_input.h"

namespace trident::nav {

/// A costmap that is updated by itself, without a robot to drive: `costmap_2d_node`, and what the
/// stand-alone planners plan on. Its parameters and topics are below `~costmap`.
class CostmapServer {
 public:
  /// Throws Error for parameters that are not legal; logs warnings about those without effect.
  explicit CostmapServer(const ros::NodeHandle& private_node);

  /// Updates the costmap until the node is to end. Callbacks need threads of their own.
  void run();
  CostmapNode& costmap() { return *costmap_; }
  const std::string& frame() const { return costmap_->frame(); }
  const tf2_ros::Buffer& buffer() const { return buffer_; }
  ros_utils::Refusals& refusals() { return refusals_; }

 private:
  ros::NodeHandle node_;
  tf2_ros::Buffer buffer_;
  ros_utils::Refusals refusals_;
  ros_utils::TransformInput transforms_;
  std::unique_ptr<CostmapNode> costmap_;
};

/// A planner on a costmap of its own, without a robot to drive: upstream's `navfn/navfn_node` and
/// `global_planner/planner`. Subscribes `~goal`, to which it plans from where the robot is, and
/// publishes `~NAME/plan` and `~NAME/potential`.
class PlannerNode {
 public:
  /// `plugin`: "navfn/NavfnROS"; `name`: of the planner's parameters and topics. Throws Error.
  PlannerNode(const ros::NodeHandle& private_node, const std::string& plugin,
              const std::string& name);

  void run() { server_.run(); }

  /// The service `~make_plan` for a type of upstream's, navfn/MakeNavPlan.
  template <class MakePlan>
  void serve() {
    boost::function<bool(typename MakePlan::Request&, typename MakePlan::Response&)> callback =
        [this](typename MakePlan::Request& request, typename MakePlan::Response& response) {
          response.path = plan(request.start, request.goal, &response.error_message);
          response.plan_found = static_cast<std::uint8_t>(!response.path.empty());
          return true;
        };
    service_ = node_.advertiseService("make_plan", callback);
  }

 private:
  using Poses = std::vector<geometry_msgs::PoseStamped>;
  /// A start without a frame: from where the robot is. Empty, with a problem, when it does not
  /// exist.
  Poses plan(const geometry_msgs::PoseStamped& start, const geometry_msgs::PoseStamped& goal,
             std::string* problem);
  std::optional<Pose2> placed(const geometry_msgs::PoseStamped& pose, double now_s,
                              std::string* problem) const;
  void on_goal(const geometry_msgs::PoseStamped& goal);

  ros::NodeHandle node_;
  CostmapServer server_;
  std::mutex mutex_;  // guards the planner
  std::unique_ptr<Planner> planner_;
  std::unique_ptr<PotentialTopic> potential_;
  ros::Publisher plan_;
  ros::Subscriber goal_;
  ros::ServiceServer service_;
};

/// The program costmap_2d/costmap_2d_node. `voxels`: of voxel_advertiser().
int costmap_main(int argc, char** argv, const VoxelAdvertiser& voxels);

/// The program of a stand-alone planner; MakePlan: navfn::MakeNavPlan.
template <class MakePlan>
int planner_main(int argc, char** argv, const char* node_name, const char* plugin,
                 const char* planner_name) {
  ros::init(argc, argv, node_name);
  ros::AsyncSpinner spinner(2);
  try {
    PlannerNode node(ros::NodeHandle("~"), plugin, planner_name);
    node.serve<MakePlan>();
    spinner.start();
    node.run();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::nav
