// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/control_topics.h"

#include <cmath>
#include <utility>

#include "trident_nav/control/reported_obstacle.h"
#include "trident_nav_ros/control_messages.h"
#include "trident_nav_ros/frames.h"

namespace trident::nav {
namespace {

constexpr double kObstacleWait_s = 1.0;  // for the transform of what was heard

bool is_heard(const ros::Publisher& publisher) {
  return publisher && publisher.getNumSubscribers() > 0;
}

bool has_name(const std::string& plugin, const char* upstream, const char* own) {
  return plugin.find(upstream) != std::string::npos || plugin == own;
}

Point2 turned(const Point2& v, double yaw) { return transform({0.0, 0.0, yaw}, v); }

Tracks tracks_of(const costmap_converter::ObstacleArrayMsg& message, const Pose2& T_costmap_from) {
  Tracks tracks;
  for (const costmap_converter::ObstacleMsg& one : message.obstacles) {
    ReportedObstacle obstacle = to_reported(one);
    for (Point2& corner : obstacle.outline) corner = transform(T_costmap_from, corner);
    obstacle.velocity = turned(obstacle.velocity, T_costmap_from.yaw);
    const Tracks covering = covering_tracks(obstacle);
    tracks.insert(tracks.end(), covering.begin(), covering.end());
  }
  return tracks;
}

}  // namespace

ControlTopics::ControlTopics(ros::NodeHandle node, const std::string& plugin, std::string frame,
                             const tf2::BufferCore& buffer, ros_utils::Refusals& refusals)
    : frame_(std::move(frame)), buffer_(buffer), refusals_(refusals) {
  advertise(node, plugin);
  hear(node);
}

void ControlTopics::advertise(ros::NodeHandle& node, const std::string& plugin) {
  out_.local_plan = node.advertise<nav_msgs::Path>("local_plan", 1);
  if (has_name(plugin, "TebLocalPlannerROS", "teb")) {
    out_.teb_poses = node.advertise<geometry_msgs::PoseArray>("teb_poses", 100);
    out_.teb_markers = node.advertise<visualization_msgs::Marker>("teb_markers", 1000);
    out_.teb_feedback = node.advertise<teb_local_planner::FeedbackMsg>("teb_feedback", 10);
  }
  const bool is_dwa = has_name(plugin, "DWAPlannerROS", "dwa");
  if (is_dwa)
    out_.trajectory_cloud = node.advertise<sensor_msgs::PointCloud2>("trajectory_cloud", 1);
  if (is_dwa || has_name(plugin, "TrajectoryPlannerROS", "trajectory_planner")) {
    out_.cost_cloud = node.advertise<sensor_msgs::PointCloud2>("cost_cloud", 1);
  }
  if (has_name(plugin, "MPPIController", "mppi")) {
    out_.trajectories = node.advertise<visualization_msgs::MarkerArray>("trajectories", 1);
    out_.optimal = node.advertise<nav_msgs::Path>("optimal_trajectory", 1);
  }
}

void ControlTopics::hear(ros::NodeHandle& node) {
  obstacles_in_ = node.subscribe<costmap_converter::ObstacleArrayMsg>(
      "obstacles", 1, [this](const costmap_converter::ObstacleArrayMsgConstPtr& message) {
        const std::string problem = obstacles_problem(*message, ros::Time::now());
        if (!problem.empty()) {
          refusals_.note("obstacles",
                         "obstacles on " + obstacles_in_.getTopic() + " are not used: " + problem);
          return;
        }
        const std::lock_guard lock(mutex_);
        heard_.obstacles = message;
      });
  via_points_in_ = node.subscribe<nav_msgs::Path>(
      "via_points", 1, [this](const nav_msgs::PathConstPtr& message) {
        const std::string problem = via_points_problem(*message);
        if (!problem.empty()) {
          refusals_.note("via_points",
                         "points on " + via_points_in_.getTopic() + " are not used: " + problem);
          return;
        }
        const std::lock_guard lock(mutex_);
        heard_.via_points = message;
      });
}

/// Obstacles whose frame tf does not know yet are tried again until they are too old.
void ControlTopics::take_obstacles(double now_s, MovingObstacles& moving) {
  costmap_converter::ObstacleArrayMsgConstPtr message;
  {
    const std::lock_guard lock(mutex_);
    message = std::exchange(heard_.obstacles, nullptr);
  }
  if (!message) return;
  const std_msgs::Header& header = message->header;
  const double stamp_s = header.stamp.isZero() ? now_s : header.stamp.toSec();
  const std::string from = header.frame_id.empty() ? frame_ : frame_name(header.frame_id);
  std::string problem;
  const auto T_costmap_from = newest_pose(buffer_, frame_, from, now_s, INFINITY, &problem);
  if (T_costmap_from) {
    moving.set_reported(tracks_of(*message, *T_costmap_from), stamp_s);
  } else if (!header.stamp.isZero() && now_s - stamp_s < kObstacleWait_s) {
    const std::lock_guard lock(mutex_);
    if (!heard_.obstacles) heard_.obstacles = message;
  } else {
    refusals_.note("transform",
                   "obstacles on " + obstacles_in_.getTopic() + " are not used: " + problem);
  }
}

std::optional<std::vector<Point2>> ControlTopics::via_points(double now_s) {
  nav_msgs::PathConstPtr message;
  {
    const std::lock_guard lock(mutex_);
    message = heard_.via_points;
  }
  if (!message) return std::nullopt;
  const std::string& id = message->header.frame_id;
  std::string problem;
  const auto T_costmap_from =
      newest_pose(buffer_, frame_, id.empty() ? frame_ : frame_name(id), now_s, INFINITY, &problem);
  if (!T_costmap_from) {
    refusals_.note("transform",
                   "points on " + via_points_in_.getTopic() + " are not used: " + problem);
    return std::nullopt;
  }
  std::vector<Point2> points;
  for (const geometry_msgs::PoseStamped& pose : message->poses) {
    points.push_back(transform(*T_costmap_from, {pose.pose.position.x, pose.pose.position.y}));
  }
  return points;
}

void ControlTopics::prepare(double now_s, Controller& controller, MovingObstacles& moving) {
  take_obstacles(now_s, moving);
  controller.set_via_points(via_points(now_s));
  WatchedDetails watched;
  for (const ros::Publisher* one :
       {&out_.local_plan, &out_.teb_poses, &out_.teb_markers, &out_.teb_feedback,
        &out_.trajectory_cloud, &out_.trajectories, &out_.optimal}) {
    watched.trajectories = watched.trajectories || is_heard(*one);
  }
  watched.cells = is_heard(out_.cost_cloud);
  controller.set_watched(watched);
}

void ControlTopics::publish_bands(const ControlDetails& details, const Tracks& moving,
                                  const std_msgs::Header& header) {
  if (is_heard(out_.teb_markers)) {
    for (const auto& marker : band_markers(details, header)) out_.teb_markers.publish(marker);
  }
  if (details.selected && details.wants_feedback && is_heard(out_.teb_feedback)) {
    out_.teb_feedback.publish(feedback_message(details, moving, header));
  }
}

void ControlTopics::publish_considered(const ControlDetails& details,
                                       const std_msgs::Header& header) {
  if (is_heard(out_.trajectories)) out_.trajectories.publish(fan_markers(details, header));
  if (is_heard(out_.cost_cloud)) out_.cost_cloud.publish(cost_cloud(details, header));
  if (is_heard(out_.trajectory_cloud)) {
    out_.trajectory_cloud.publish(trajectory_cloud(details, header));
  }
}

void ControlTopics::publish_selected(const ConsideredTrajectory& selected,
                                     const std_msgs::Header& header) {
  if (is_heard(out_.teb_poses)) out_.teb_poses.publish(poses_message(selected, header));
  const nav_msgs::Path plan = local_plan_message(selected, header);
  if (is_heard(out_.local_plan)) out_.local_plan.publish(plan);
  if (is_heard(out_.optimal)) out_.optimal.publish(plan);
}

void ControlTopics::publish(const Controller& controller, const Tracks& moving) {
  const ControlDetails details = controller.details();
  if (!details.time_s || details.time_s == published_s_) return;
  published_s_ = details.time_s;
  std_msgs::Header header;
  header.frame_id = frame_;
  header.stamp.fromSec(*details.time_s);
  publish_bands(details, moving, header);
  publish_considered(details, header);
  const ConsideredTrajectory* const selected = details.selected_trajectory();
  if (selected != nullptr) publish_selected(*selected, header);
}

}  // namespace trident::nav
