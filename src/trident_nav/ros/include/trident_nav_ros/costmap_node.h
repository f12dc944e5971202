// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Polygon.h>
#include <geometry_msgs/PolygonStamped.h>
#include <ros/ros.h>
#include <tf2/buffer_core.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/costmap_config.h"
#include "trident_nav_ros/costmap_inputs.h"
#include "trident_nav_ros/voxel_topics.h"
#include "trident_ros/refusals.h"

namespace trident::nav {

/// The layers of this package.
Registry<LayerType> builtin_layer_types();

/// A costmap with costmap_2d's topics: `costmap`, `costmap_updates`, `footprint` out and in, and
/// those of voxel layers. Its owner calls update() at whatever times; it is published at its own
/// rate.
class CostmapNode {
 public:
  /// `node`: with the name of the costmap. Throws ConfigError.
  CostmapNode(const ros::NodeHandle& node, const CostmapConfig& config,
              const tf2::BufferCore& buffer, ros_utils::Refusals& refusals);

  const std::string& frame() const { return frame_; }
  const std::string& base_frame() const { return base_frame_; }
  /// From any thread, and so is what changes parameters.
  double update_period_s() const { return update_period_s_; }

  /// The costmap's parameters that may be changed while it runs, with their values as defaults.
  std::vector<ConfigField> live_fields();
  /// Takes over those of them that a map has. Throws ConfigError, and changes nothing.
  void change(const ConfigNode& values);
  /// The layers as they were configured.
  const std::vector<LayerSpec>& layer_specs() const { return layers_; }
  /// Gives a layer other values of all its parameters. Throws ConfigError, and changes nothing.
  void change_layer(const std::string& name, const ConfigNode& values);

  /// Locks the costmap against updates.
  std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }
  /// While locked.
  Costmap& costmap() { return *costmap_; }

  /// The newest pose of the robot and its time; else a sentence says why it is unknown.
  std::optional<Pose2> robot(double now_s, std::string* problem, double* stamp_s = nullptr) const;
  /// See CostmapInputs; called by update(), with the costmap locked. To be set before its first
  /// call.
  void set_scan_listener(CostmapInputs::ScanListener listener) {
    inputs_.set_scan_listener(std::move(listener));
  }
  /// Publishes the voxels of the layers that want it, from now on; before the first update.
  void advertise_voxels(const VoxelAdvertiser& advertiser) {
    topics_.voxels->advertise_voxels(advertiser);
  }
  /// Called after another node has changed the footprint, in the thread of callbacks.
  void set_footprint_listener(std::function<void()> listener) {
    const std::lock_guard lock(mutex_);
    topics_.on_footprint = std::move(listener);
  }
  /// See CostmapInputs.
  void set_lockstep() { inputs_.set_lockstep(); }
  std::optional<double> await_scan(double now_s) { return inputs_.await_scan(now_s); }
  /// What says where the robot is in place of the newest transforms; before the first update.
  using RobotSource = std::function<std::optional<Pose2>(double now_s, std::string* problem)>;
  void set_robot_source(RobotSource source) { robot_source_ = std::move(source); }
  /// Takes in what has come, and publishes what is due.
  void update(double now_s);
  /// What is missing before the costmap can be used: a map; empty: nothing.
  std::string missing();

 private:
  void note_params(const CostmapParams& params);
  void hear_footprints(const std::string& topic, ros_utils::Refusals& refusals);
  void take_footprint(const geometry_msgs::Polygon& polygon, ros_utils::Refusals& refusals);
  void publish(double now_s, const Pose2& robot);
  void publish_all(double now_s);
  void publish_part(double now_s, const CellBox& box);
  void publish_footprint(double now_s, const Pose2& robot);

  ros::NodeHandle root_, node_;
  const tf2::BufferCore& buffer_;
  std::unique_ptr<Costmap> costmap_;
  std::string frame_, base_frame_;
  std::vector<LayerSpec> layers_;
  RobotSource robot_source_;
  CostmapInputs inputs_;
  std::atomic<double> update_period_s_{0.2}, transform_tolerance_s_{0.3};
  std::mutex mutex_;  // guards the costmap and what follows
  struct Topics {
    ros::Publisher all, parts, footprint;
    std::unique_ptr<VoxelTopics> voxels;
    ros::Subscriber footprint_input;
    std::function<void()> on_footprint;
  };
  Topics topics_;
  /// What subscribers do not know yet.
  struct News {
    CellBox box;
    bool is_all = true;
    double published_s = -1.0;
  };
  News news_;
};

}  // namespace trident::nav
