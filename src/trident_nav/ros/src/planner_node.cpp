// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/planner_node.h"

#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_nav_ros/frames.h"
#include "trident_nav_ros/input_checks.h"
#include "trident_nav_ros/move_base_parts.h"
#include "trident_ros/node_params.h"

namespace trident::nav {
namespace {

const char* const kCostmap = "costmap";

void log_warnings(const Warnings& warnings) {
  for (const std::string& warning : warnings) ROS_WARN("%s", warning.c_str());
}

}  // namespace

CostmapServer::CostmapServer(const ros::NodeHandle& private_node)
    : refusals_(node_), transforms_(buffer_, [this](const std::string& problem) {
        refusals_.note("transform", problem);
      }) {
  Warnings warnings;
  const ConfigNode tree = parameters_below(private_node);
  costmap_ = std::make_unique<CostmapNode>(
      ros::NodeHandle(private_node, kCostmap),
      costmap_config_of(tree, private_node.getNamespace(), kCostmap, &warnings), buffer_,
      refusals_);
  log_warnings(warnings);
}

void CostmapServer::run() {
  // Short naps, as a simulated clock may run at any rate.
  ros::WallRate poll(200.0);
  double updated_s = -1.0;
  while (ros::ok()) {
    const double now_s = ros::Time::now().toSec();
    if (now_s < updated_s || now_s - updated_s >= costmap_->update_period_s() - 1e-6) {
      costmap_->update(now_s);
      updated_s = now_s;
    }
    poll.sleep();
  }
}

PlannerNode::PlannerNode(const ros::NodeHandle& private_node, const std::string& plugin,
                         const std::string& name)
    : node_(private_node), server_(private_node) {
  Warnings warnings;
  const ConfigNode tree = parameters_below(private_node);
  planner_ =
      make_planner(plugin, tree.find(name), private_node.getNamespace() + "/" + name, &warnings);
  log_warnings(warnings);
  plan_ = node_.advertise<nav_msgs::Path>(name + "/plan", 1, true);
  if (dynamic_cast<PotentialSource*>(planner_.get()) != nullptr) {
    potential_ = std::make_unique<PotentialTopic>(ros::NodeHandle(node_, name), plugin);
  }
  goal_ = node_.subscribe<geometry_msgs::PoseStamped>(
      "goal", 1, [this](const geometry_msgs::PoseStampedConstPtr& goal) { on_goal(*goal); });
}

std::optional<Pose2> PlannerNode::placed(const geometry_msgs::PoseStamped& pose, double now_s,
                                         std::string* problem) const {
  *problem = goal_problem(pose.pose);
  if (!problem->empty()) return std::nullopt;
  const std::string& frame = server_.frame();
  const auto T_costmap_from = newest_pose(server_.buffer(), frame, frame_name(pose.header.frame_id),
                                          now_s, INFINITY, problem);
  if (!T_costmap_from) return std::nullopt;
  return placed_in(*T_costmap_from, to_pose2(pose.pose));
}

PlannerNode::Poses PlannerNode::plan(const geometry_msgs::PoseStamped& start,
                                     const geometry_msgs::PoseStamped& goal, std::string* problem) {
  const double now_s = ros::Time::now().toSec();
  const bool starts_here = start.header.frame_id.empty();
  const auto from =
      starts_here ? server_.costmap().robot(now_s, problem) : placed(start, now_s, problem);
  const auto to = from ? placed(goal, now_s, problem) : std::nullopt;
  if (!to) return {};
  const std::lock_guard planning(mutex_);
  const auto lock = server_.costmap().lock();
  const Costmap& costmap = server_.costmap().costmap();
  const CancelFlag never{false};
  const PlanOutcome outcome =
      planner_->plan(costmap.grid(), costmap.footprint(), *from, *to, MotionLimits{}, never);
  *problem = outcome.reason;
  nav_msgs::Path message = path_message(outcome.path, server_.frame(), now_s);
  plan_.publish(message);
  if (potential_) {
    potential_->publish(dynamic_cast<PotentialSource*>(planner_.get()), costmap.grid().geometry,
                        message.header);
  }
  return std::move(message.poses);
}

void PlannerNode::on_goal(const geometry_msgs::PoseStamped& goal) {
  std::string problem;
  if (!plan({}, goal, &problem).empty()) return;
  server_.refusals().note("goal", "there is no plan to the goal: " + problem);
}

int costmap_main(int argc, char** argv, const VoxelAdvertiser& voxels) {
  ros::init(argc, argv, "costmap_2d_node");
  ros::AsyncSpinner spinner(2);
  try {
    CostmapServer server(ros::NodeHandle("~"));
    server.costmap().advertise_voxels(voxels);
    spinner.start();
    server.run();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::nav
