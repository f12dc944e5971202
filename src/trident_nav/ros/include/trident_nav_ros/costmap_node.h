// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/costmap_config.h"
#include "trident_nav_ros/costmap_inputs.h"
#include "trident_ros/refusals.h"

namespace trident::nav {

/// The layers of this package.
Registry<LayerType> builtin_layer_types();

/// A costmap with costmap_2d's topics: `costmap`, `costmap_updates`, `footprint`. Its owner calls
/// update() at whatever times; it is published at its own rate.
class CostmapNode {
 public:
  /// `node`: with the name of the costmap. Throws ConfigError.
  CostmapNode(const ros::NodeHandle& node, const CostmapConfig& config,
              const tf2::BufferCore& buffer, ros_utils::Refusals& refusals);

  const std::string& frame() const { return frame_; }
  const std::string& base_frame() const { return base_frame_; }
  double update_period_s() const;

  /// Locks the costmap against updates.
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }
  /// While locked.
  Costmap& costmap() { return *costmap_; }

  /// The newest pose of the robot; else a sentence says why it is unknown.
  std::optional<Pose2> robot(double now_s, std::string* problem) const;
  /// Takes in what has come, and publishes what is due.
  void update(double now_s);
  /// What is missing before the costmap can be used: a map; empty: nothing.
  std::string missing();

 private:
  void publish(double now_s, const Pose2& robot);
  void publish_all(double now_s);
  void publish_part(double now_s, const CellBox& box);
  void publish_footprint(double now_s, const Pose2& robot);

  ros::NodeHandle root_, node_;
  const tf2::BufferCore& buffer_;
  std::unique_ptr<Costmap> costmap_;
  std::string frame_, base_frame_;
  CostmapInputs inputs_;
  std::mutex mutex_;  // guards the costmap and what follows
  ros::Publisher all_, parts_, footprint_;
  CellBox unpublished_;
  bool is_all_unpublished_ = true;
  double published_s_ = -1.0;
};

}  // namespace trident::nav
