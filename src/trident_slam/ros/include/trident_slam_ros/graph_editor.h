// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "trident_slam/slam_2d_capabilities.h"
#include "trident_slam_ros/slam_node.h"

namespace trident::slam {

/// Nodes as points, edges and loops as lines.
visualization_msgs::MarkerArray graph_markers(const GraphView2d& graph, const std::string& frame);

/// A disc that can be moved in the plane and turned about the vertical; `diameter` [m].
visualization_msgs::InteractiveMarker movable_marker(const std::string& name,
                                                     const std::string& frame, const SE2& T,
                                                     double diameter);

/// Corrections by hand, as slam_toolbox has them: in interactive mode scans wait, the graph's nodes
/// are interactive markers, and one that is dragged shows its scan there (topic
/// scan_visualization, in the frame of that name). `apply` ties what was moved to what lies there.
class GraphEditor {
 public:
  /// Advertises below `own`, the private namespace; interactive mode is off. `node` must outlive
  /// it.
  GraphEditor(const ros::NodeHandle& own, SlamNode& node, std::string map_frame);

  /// Begins or ends interactive mode; what was moved is forgotten. Throws Error when the method has
  /// no graph that can be changed.
  void toggle();
  bool is_on() const { return is_on_; }  ///< interactive mode
  /// Puts the markers back.
  void clear();
  /// Applies the moves, closes loops and optimises. Throws Error when nothing of what was moved
  /// fits where it is now; then the graph is as before.
  void apply();

 private:
  void follow(const visualization_msgs::InteractiveMarkerFeedback& feedback);
  void show_scan(int node, const SE2& T_map_node);
  void show_markers();
  static void report_misfits(const std::vector<int>& misfits, bool are_all);

  ros::NodeHandle own_;
  SlamNode& node_;
  std::string map_frame_;
  interactive_markers::InteractiveMarkerServer markers_;
  tf2_ros::TransformBroadcaster broadcaster_;
  ros::Publisher scan_publisher_;
  ros::Time shown_;
  bool is_on_ = false;
  std::mutex mutex_;  // services and markers come in threads of their own
  std::map<int, SE2> moved_;
};

}  // namespace trident::slam
