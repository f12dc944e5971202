// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/control_messages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/string_util.h"
#include "trident_nav_ros/frames.h"
#include "trident_nav_ros/input_checks.h"
#include "trident_nav_ros/point_cloud.h"
#include "trident_ros/message_checks.h"

namespace trident::nav {
namespace {

constexpr double kMaxRadius_m = 1e3;  // of a reported obstacle
constexpr double kLineWidth_m = 0.01;
constexpr double kPointWidth_m = 0.05;

geometry_msgs::Point to_point(double x, double y) {
  geometry_msgs::Point point;
  point.x = x;
  point.y = y;
  return point;
}

struct Color {
  float r, g, b, a;
};

std_msgs::ColorRGBA to_color(const Color& color) {
  std_msgs::ColorRGBA message;
  message.r = color.r;
  message.g = color.g;
  message.b = color.b;
  message.a = color.a;
  return message;
}

visualization_msgs::Marker make_marker(const std_msgs::Header& header, const char* name_space,
                                       int type, double width_m, const Color& color) {
  visualization_msgs::Marker marker;
  marker.header = header;
  marker.ns = name_space;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = width_m;
  marker.scale.y = width_m;
  marker.color = to_color(color);
  constexpr double kLifetime_s = 2.0;
  marker.lifetime = ros::Duration(kLifetime_s);
  return marker;
}

void add_line(const ConsideredTrajectory& trajectory, visualization_msgs::Marker* marker) {
  const auto& points = trajectory.points;
  for (std::size_t i = 1; i < points.size(); ++i) {
    marker->points.push_back(to_point(points[i - 1].pose.x, points[i - 1].pose.y));
    marker->points.push_back(to_point(points[i].pose.x, points[i].pose.y));
  }
}

visualization_msgs::Marker points_marker(const std::vector<Point2>& points,
                                         const std_msgs::Header& header, const char* name_space,
                                         const Color& color) {
  auto marker =
      make_marker(header, name_space, visualization_msgs::Marker::POINTS, kPointWidth_m, color);
  for (const Point2& p : points) marker.points.push_back(to_point(p.x, p.y));
  return marker;
}

geometry_msgs::Twist to_twist(const Twist2& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.vx;
  message.linear.y = twist.vy;
  message.angular.z = twist.wz;
  return message;
}

// From this point's velocity to the next one's; none at the end.
Twist2 acceleration_at(const ConsideredTrajectory& trajectory, std::size_t i) {
  if (i + 1 >= trajectory.points.size()) return {};
  const TrajectoryPoint &a = trajectory.points[i], &b = trajectory.points[i + 1];
  const double dt_s = b.after_s - a.after_s;
  if (dt_s <= 0.0) return {};
  return {(b.twist.vx - a.twist.vx) / dt_s, (b.twist.vy - a.twist.vy) / dt_s,
          (b.twist.wz - a.twist.wz) / dt_s};
}

teb_local_planner::TrajectoryMsg to_trajectory(const ConsideredTrajectory& trajectory,
                                               const std_msgs::Header& header) {
  teb_local_planner::TrajectoryMsg message;
  message.header = header;
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const TrajectoryPoint& point = trajectory.points[i];
    teb_local_planner::TrajectoryPointMsg one;
    one.pose = to_message(point.pose);
    one.velocity = to_twist(point.twist);
    one.acceleration = to_twist(acceleration_at(trajectory, i));
    one.time_from_start = ros::Duration(point.after_s);
    message.trajectory.push_back(one);
  }
  return message;
}

costmap_converter::ObstacleMsg to_obstacle(const Point2& point, const std_msgs::Header& header) {
  costmap_converter::ObstacleMsg message;
  message.header = header;
  message.orientation.w = 1.0;
  geometry_msgs::Point32 corner;
  corner.x = static_cast<float>(point.x);
  corner.y = static_cast<float>(point.y);
  message.polygon.points.push_back(corner);
  return message;
}

// From green for the least cost to red for the greatest of the admissible ones; gray: none of them.
Color color_of(double cost, double least, double greatest) {
  constexpr float kOpacity = 0.6F;
  if (cost < 0.0) return {0.5F, 0.5F, 0.5F, 0.3F};
  const double span = std::max(greatest - least, 1e-9);
  const auto t = static_cast<float>(std::clamp((cost - least) / span, 0.0, 1.0));
  return {t, 1.0F - t, 0.1F, kOpacity};
}

}  // namespace

nav_msgs::Path local_plan_message(const ConsideredTrajectory& trajectory,
                                  const std_msgs::Header& header) {
  nav_msgs::Path message;
  message.header = header;
  for (const TrajectoryPoint& point : trajectory.points) {
    geometry_msgs::PoseStamped pose;
    pose.header = header;
    pose.pose = to_message(point.pose);
    message.poses.push_back(pose);
  }
  return message;
}

geometry_msgs::PoseArray poses_message(const ConsideredTrajectory& trajectory,
                                       const std_msgs::Header& header) {
  geometry_msgs::PoseArray message;
  message.header = header;
  for (const TrajectoryPoint& point : trajectory.points) {
    message.poses.push_back(to_message(point.pose));
  }
  return message;
}

std::vector<visualization_msgs::Marker> band_markers(const ControlDetails& details,
                                                     const std_msgs::Header& header) {
  constexpr int kLines = visualization_msgs::Marker::LINE_LIST;
  auto all = make_marker(header, "TebContainer", kLines, kLineWidth_m, {0.5F, 1.0F, 0.0F, 1.0F});
  for (const ConsideredTrajectory& trajectory : details.trajectories) add_line(trajectory, &all);
  auto best =
      make_marker(header, "SelectedTeb", kLines, 2.0 * kLineWidth_m, {0.0F, 0.4F, 1.0F, 1.0F});
  if (const auto* selected = details.selected_trajectory()) add_line(*selected, &best);
  return {all, best,
          points_marker(details.obstacles, header, "PointObstacles", {1.0F, 0.0F, 0.0F, 1.0F}),
          points_marker(details.via_points, header, "ViaPoints", {0.0F, 0.0F, 1.0F, 1.0F})};
}

teb_local_planner::FeedbackMsg feedback_message(const ControlDetails& details, const Tracks& moving,
                                                const std_msgs::Header& header) {
  teb_local_planner::FeedbackMsg message;
  message.header = header;
  for (const ConsideredTrajectory& trajectory : details.trajectories) {
    message.trajectories.push_back(to_trajectory(trajectory, header));
  }
  message.selected_trajectory_idx = static_cast<std::uint16_t>(details.selected.value());
  message.obstacles_msg.header = header;
  for (const Point2& point : details.obstacles) {
    message.obstacles_msg.obstacles.push_back(to_obstacle(point, header));
  }
  for (const Track& track : moving) {
    costmap_converter::ObstacleMsg one = to_obstacle(track.position, header);
    one.id = track.id;
    one.radius = track.radius_m;
    one.velocities.twist.linear.x = track.velocity.x;
    one.velocities.twist.linear.y = track.velocity.y;
    message.obstacles_msg.obstacles.push_back(one);
  }
  return message;
}

visualization_msgs::MarkerArray fan_markers(const ControlDetails& details,
                                            const std_msgs::Header& header) {
  visualization_msgs::MarkerArray array;
  auto samples = make_marker(header, "Candidate Trajectories", visualization_msgs::Marker::POINTS,
                             kLineWidth_m, {0.0F, 1.0F, 0.0F, 1.0F});
  double least = INFINITY, greatest = 0.0;
  for (const ConsideredTrajectory& one : details.trajectories) {
    least = std::min(least, one.cost);
    greatest = std::max(greatest, one.cost);
  }
  for (std::size_t i = 0; i < details.trajectories.size(); ++i) {
    if (details.selected == i) continue;
    const ConsideredTrajectory& one = details.trajectories[i];
    const std_msgs::ColorRGBA color = to_color(color_of(one.cost, least, greatest));
    for (const TrajectoryPoint& point : one.points) {
      samples.points.push_back(to_point(point.pose.x, point.pose.y));
      samples.colors.push_back(color);
    }
  }
  array.markers.push_back(std::move(samples));
  auto best = make_marker(header, "Optimal Trajectory", visualization_msgs::Marker::LINE_LIST,
                          2.0 * kLineWidth_m, {0.0F, 0.4F, 1.0F, 1.0F});
  if (const auto* selected = details.selected_trajectory()) add_line(*selected, &best);
  array.markers.push_back(std::move(best));
  return array;
}

sensor_msgs::PointCloud2 trajectory_cloud(const ControlDetails& details,
                                          const std_msgs::Header& header) {
  PointCloudWriter cloud({"x", "y", "z", "theta", "cost"});
  for (const ConsideredTrajectory& trajectory : details.trajectories) {
    for (const TrajectoryPoint& point : trajectory.points) {
      cloud.add({static_cast<float>(point.pose.x), static_cast<float>(point.pose.y), 0.0F,
                 static_cast<float>(wrap_angle(point.pose.yaw)),
                 static_cast<float>(trajectory.cost)});
    }
  }
  return cloud.message(header);
}

sensor_msgs::PointCloud2 cost_cloud(const ControlDetails& details, const std_msgs::Header& header) {
  PointCloudWriter cloud({"x", "y", "z", "path_cost", "goal_cost", "occ_cost", "total_cost"});
  for (const CellScore& cell : details.cells) {
    cloud.add({static_cast<float>(cell.center.x), static_cast<float>(cell.center.y), 0.0F,
               static_cast<float>(cell.path), static_cast<float>(cell.goal),
               static_cast<float>(cell.occupied), static_cast<float>(cell.total)});
  }
  return cloud.message(header);
}

ReportedObstacle to_reported(const costmap_converter::ObstacleMsg& message) {
  ReportedObstacle obstacle;
  obstacle.id = message.id;
  obstacle.radius_m = message.radius;
  for (const geometry_msgs::Point32& p : message.polygon.points) {
    obstacle.outline.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
  }
  const geometry_msgs::TwistWithCovariance& velocities = message.velocities;
  obstacle.velocity = {velocities.twist.linear.x, velocities.twist.linear.y};
  const auto variance = [&](std::size_t i) {
    return std::isfinite(velocities.covariance[i]) ? std::max(velocities.covariance[i], 0.0) : 0.0;
  };
  constexpr std::size_t kYy = 7;
  obstacle.velocity_variance = {variance(0), variance(kYy)};
  return obstacle;
}

namespace {

std::string polygon_problem(const geometry_msgs::Polygon& polygon) {
  if (polygon.points.empty()) return "polygon has no points, legal: at least one";
  for (const geometry_msgs::Point32& p : polygon.points) {
    std::string problem = ros_utils::point_problem(
        static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z), "polygon");
    if (!problem.empty()) return problem;
  }
  return "";
}

std::string obstacle_problem(const costmap_converter::ObstacleMsg& obstacle) {
  std::string of_polygon = polygon_problem(obstacle.polygon);
  if (!of_polygon.empty()) return of_polygon;
  if (!(obstacle.radius >= 0.0 && obstacle.radius <= kMaxRadius_m)) {
    return "radius = " + number_text(obstacle.radius) + " m, legal: 0 to " +
           number_text(kMaxRadius_m);
  }
  const geometry_msgs::Vector3& v = obstacle.velocities.twist.linear;
  const std::string problem = ros_utils::number_problem(v.x, kFastest, "velocities.linear.x");
  return problem.empty() ? ros_utils::number_problem(v.y, kFastest, "velocities.linear.y")
                         : problem;
}

}  // namespace

std::string obstacles_problem(const costmap_converter::ObstacleArrayMsg& message,
                              const ros::Time& now) {
  if (!message.header.stamp.isZero()) {
    const std::string problem = ros_utils::stamp_problem(message.header.stamp, now);
    if (!problem.empty()) return problem;
  }
  for (std::size_t i = 0; i < message.obstacles.size(); ++i) {
    const std::string problem = obstacle_problem(message.obstacles[i]);
    if (!problem.empty()) return "obstacles[" + std::to_string(i) + "]: " + problem;
  }
  return "";
}

std::string via_points_problem(const nav_msgs::Path& message) {
  for (std::size_t i = 0; i < message.poses.size(); ++i) {
    const geometry_msgs::Point& p = message.poses[i].pose.position;
    const std::string problem = ros_utils::point_problem(p.x, p.y, p.z, "position");
    if (!problem.empty()) return "poses[" + std::to_string(i) + "]: " + problem;
  }
  return "";
}

}  // namespace trident::nav
