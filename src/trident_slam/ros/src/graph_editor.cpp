// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/graph_editor.h"

#include <sensor_msgs/LaserScan.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"

namespace trident::slam {
namespace {

using visualization_msgs::InteractiveMarkerControl;
using visualization_msgs::InteractiveMarkerFeedback;
using visualization_msgs::Marker;

constexpr char kScanFrame[] = "scan_visualization";
constexpr double kNodeDiameter = 0.3;  // [m]
constexpr std::size_t kBeams = 720;
constexpr double kFarthest = 1000.0;  // [m]

Marker marker(const std::string& frame, const std::string& name, int type) {
  Marker result;
  result.header.frame_id = frame;
  result.header.stamp = ros::Time::now();
  result.ns = name;
  result.type = type;
  result.pose.orientation.w = 1.0;
  result.color.a = 1.0F;
  return result;
}

geometry_msgs::Point point_of(const SE2& T_map_node) {
  geometry_msgs::Point point;
  point.x = T_map_node.p.x();
  point.y = T_map_node.p.y();
  return point;
}

InteractiveMarkerControl control(std::uint8_t mode) {
  InteractiveMarkerControl result;
  result.interaction_mode = mode;
  // Its x axis, which it moves across and turns about, points up.
  result.orientation.w = std::sqrt(0.5);
  result.orientation.y = std::sqrt(0.5);
  return result;
}

/// What a node saw as a scan from its base: the nearest point of each half degree.
sensor_msgs::LaserScan scan_of(const std::vector<Eigen::Vector2f>& points, const ros::Time& stamp) {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = kScanFrame;
  scan.header.stamp = stamp;
  scan.angle_min = static_cast<float>(-kPi);
  scan.angle_increment = static_cast<float>(2.0 * kPi / kBeams);
  scan.angle_max = scan.angle_min + static_cast<float>(kBeams - 1) * scan.angle_increment;
  scan.range_max = static_cast<float>(kFarthest);
  scan.ranges.assign(kBeams, std::numeric_limits<float>::infinity());
  for (const Eigen::Vector2f& p : points) {
    const double turn = (std::atan2(p.y(), p.x()) + kPi) / (2.0 * kPi);
    float& range = scan.ranges[static_cast<std::size_t>(std::lround(turn * kBeams)) % kBeams];
    range = std::min(range, p.norm());
  }
  return scan;
}

GraphEditable& editable(Slam2d& slam) {
  auto* result = dynamic_cast<GraphEditable*>(&slam);
  if (result == nullptr) throw Error("this method has no graph that can be changed");
  return *result;
}

}  // namespace

visualization_msgs::MarkerArray graph_markers(const GraphView2d& graph, const std::string& frame) {
  Marker nodes = marker(frame, "nodes", Marker::POINTS);
  nodes.scale.x = nodes.scale.y = 0.1;
  nodes.color.r = 1.0F;
  for (const SE2& node : graph.nodes) nodes.points.push_back(point_of(node));
  Marker path = marker(frame, "edges", Marker::LINE_LIST);
  path.scale.x = 0.03;
  path.color.b = 1.0F;
  Marker loops = path;
  loops.ns = "loops";
  loops.color.b = 0.0F;
  loops.color.g = 0.8F;
  for (const GraphView2d::Edge& edge : graph.edges) {
    Marker& lines = edge.is_loop ? loops : path;
    lines.points.push_back(point_of(graph.nodes[static_cast<std::size_t>(edge.from)]));
    lines.points.push_back(point_of(graph.nodes[static_cast<std::size_t>(edge.to)]));
  }
  visualization_msgs::MarkerArray array;
  array.markers = {nodes, path, loops};
  return array;
}

visualization_msgs::InteractiveMarker movable_marker(const std::string& name,
                                                     const std::string& frame, const SE2& T,
                                                     double diameter) {
  visualization_msgs::InteractiveMarker result;
  result.header.frame_id = frame;  // without a stamp: valid for viewers that come later, too
  result.name = name;
  result.pose = maps::to_pose_message(T);
  result.scale = static_cast<float>(diameter);
  InteractiveMarkerControl move = control(InteractiveMarkerControl::MOVE_PLANE);
  move.always_visible = 1;
  Marker disc = marker("", "", Marker::CYLINDER);
  disc.header = {};
  disc.scale.x = disc.scale.y = 0.5 * diameter;
  disc.scale.z = 0.1 * diameter;
  disc.color.r = 1.0F;
  move.markers.push_back(disc);
  result.controls = {move, control(InteractiveMarkerControl::ROTATE_AXIS)};
  return result;
}

GraphEditor::GraphEditor(const ros::NodeHandle& own, SlamNode& node, std::string map_frame)
    : own_(own), node_(node), map_frame_(std::move(map_frame)), markers_("slam_toolbox") {
  scan_publisher_ = own_.advertise<sensor_msgs::LaserScan>("scan_visualization", 10);
  own_.setParam("interactive_mode", false);
  own_.setParam("paused_processing", false);
}

void GraphEditor::toggle() {
  node_.with_slam([](Slam2d& slam) { editable(slam); });
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_on_ = !is_on_;
  }
  own_.setParam("interactive_mode", is_on_);
  own_.setParam("paused_processing", is_on_);
  node_.set_held(is_on_);
  ROS_INFO("interactive mode %s", is_on_ ? "on: scans wait" : "off");
  clear();
}

void GraphEditor::clear() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    moved_.clear();
  }
  show_markers();
}

void GraphEditor::apply() {
  std::map<int, SE2> moved;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    moved.swap(moved_);
  }
  std::vector<int> misfits;
  node_.with_slam([&](Slam2d& slam) {
    if (!moved.empty()) misfits = editable(slam).move_nodes(moved);
    if (moved.empty() || misfits.size() < moved.size()) editable(slam).realign();
  });
  if (is_on_) show_markers();
  if (!misfits.empty()) report_misfits(misfits, misfits.size() == moved.size());
}

/// Throws Error where none of the nodes fits, since nothing has changed then.
void GraphEditor::report_misfits(const std::vector<int>& misfits, bool are_all) {
  std::vector<std::string> names;
  names.reserve(misfits.size());
  for (const int node : misfits) names.push_back(std::to_string(node));
  const std::string text = "node " + join(names) + ": nothing that it saw fits where it was moved";
  if (are_all) throw Error(text);
  ROS_WARN("%s", text.c_str());
}

void GraphEditor::follow(const InteractiveMarkerFeedback& feedback) {
  if (feedback.event_type != InteractiveMarkerFeedback::POSE_UPDATE) return;
  try {
    const int node = std::stoi(feedback.marker_name) - 1;
    const SE2 T_map_node = maps::from_pose_message(feedback.pose);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_on_) return;
      moved_[node] = T_map_node;
    }
    show_scan(node, T_map_node);
  } catch (const std::exception& error) {
    node_.report("marker '" + ros_utils::quoted(feedback.marker_name) + "': " + error.what());
  }
}

void GraphEditor::show_scan(int node, const SE2& T_map_node) {
  geometry_msgs::TransformStamped place;
  place.header.frame_id = map_frame_;
  // The same stamp twice would be ignored by every listener, with a warning.
  shown_ = std::max(ros::Time::now(), shown_ + ros::Duration(0, 1));
  place.header.stamp = shown_;
  place.child_frame_id = kScanFrame;
  const geometry_msgs::Pose pose = maps::to_pose_message(T_map_node);
  place.transform.translation.x = pose.position.x;
  place.transform.translation.y = pose.position.y;
  place.transform.rotation = pose.orientation;
  broadcaster_.sendTransform(place);
  const std::vector<Eigen::Vector2f> points =
      node_.with_slam([node](Slam2d& slam) { return editable(slam).node_points(node); });
  scan_publisher_.publish(scan_of(points, shown_));
}

void GraphEditor::show_markers() {
  markers_.clear();
  if (is_on_) {
    const GraphView2d view = node_.with_slam([](const Slam2d& slam) {
      const auto* graph = dynamic_cast<const Slam2dGraph*>(&slam);
      return graph == nullptr ? GraphView2d() : graph->graph_view();
    });
    // Named by numbers from 1 on, as slam_toolbox' are.
    for (std::size_t i = 0; i < view.nodes.size(); ++i) {
      markers_.insert(
          movable_marker(std::to_string(i + 1), map_frame_, view.nodes[i], kNodeDiameter),
          [this](const visualization_msgs::InteractiveMarkerFeedbackConstPtr& feedback) {
            follow(*feedback);
          });
    }
  }
  markers_.applyChanges();
}

}  // namespace trident::slam
