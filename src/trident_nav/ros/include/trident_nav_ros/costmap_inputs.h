// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "trident_nav/costmap/beam_layer.h"
#include "trident_nav/costmap/costmap.h"
#include "trident_nav/costmap/source_age.h"
#include "trident_nav/costmap/static_layer.h"
#include "trident_ros/refusals.h"

namespace trident::nav {

/// Subscribes what the layers of a costmap want and hands it over, each message as soon as tf knows
/// where its sensor was. Callbacks come from any thread; apply() from the one that updates.
class CostmapInputs {
 public:
  /// `costmap`, `buffer` and `refusals` outlive it. Topics are names of `node`.
  CostmapInputs(ros::NodeHandle& node, Costmap& costmap, const tf2::BufferCore& buffer,
                ros_utils::Refusals& refusals);

  /// Called in apply() with each scan of a source that marks, and the poses of its laser in the
  /// costmap's frame at its begin and end (one: all beams are of one time).
  using ScanListener = std::function<void(const BeamSource& source, const LaserScan& scan,
                                          Span<const SE3> T_costmap_laser)>;
  void set_scan_listener(ScanListener listener) { on_scan_ = std::move(listener); }

  /// Called in apply() with all that a source has seen, before the layer has it.
  using ObservationListener =
      std::function<void(const BeamSource& source, const Observation& observation)>;
  void set_observation_listener(ObservationListener listener) {
    on_observation_ = std::move(listener);
  }

  /// For a simulator that waits for the node: from now on an update takes exactly what is older
  /// than itself by some milliseconds, and waits for scans that are to come by then as their
  /// sources' periods say. What is used does not depend on which message comes first.
  void set_lockstep() { is_lockstep_ = true; }
  /// In lockstep, after a wait for it: the stamp of the newest scan that an update at `now_s`
  /// takes, of the first source of scans; nothing: none has come.
  std::optional<double> await_scan(double now_s);

  /// Hands over what has come, but for what tf does not reach yet. The costmap is locked.
  void apply(double now_s);
  bool has_news();

 private:
  /// Makes an observation of a message; nothing: it was refused. Throws tf2's exceptions.
  using Observe = std::function<std::optional<Observation>()>;
  struct Pending {
    BeamSource* source;
    Observe observe;
    double stamp_s;
    ros::WallTime since;
  };

  void subscribe_map(ros::NodeHandle& node, StaticLayer& layer);
  void subscribe_beams(ros::NodeHandle& node, BeamLayer& layer);
  void subscribe_scans(ros::NodeHandle& node, BeamSource& source);
  template <class Cloud>
  void subscribe_clouds(ros::NodeHandle& node, BeamSource& source);
  bool is_refused(const BeamSource& source, const ros::Time& stamp);
  void await_data(double now_s);
  bool is_late(double now_s);
  void note_scan(const BeamSource& source, double stamp_s);
  void add(BeamSource& source, const ros::Time& stamp, Observe observe);
  void hand_over(const Pending& pending);
  static bool is_early(const Pending& pending, const tf2::TransformException& error);
  void apply_pending(Pending& pending, std::deque<Pending>* waiting);
  void apply_maps(const std::vector<std::function<void()>>& maps);
  std::optional<Observation> observe(const sensor_msgs::LaserScan& scan, const BeamSource& source);
  SE3 sensor_pose(const std::string& frame, const BeamSourceParams& params,
                  const ros::Time& stamp) const;

  Costmap& costmap_;
  const tf2::BufferCore& buffer_;
  ros_utils::Refusals& refusals_;
  std::string frame_;
  ScanListener on_scan_;
  ObservationListener on_observation_;
  bool is_lockstep_ = false;
  std::mutex mutex_;  // guards what follows
  std::deque<Pending> pending_;
  std::map<const BeamSource*, SourceAge> received_;
  /// Of the first source of scans, in lockstep: the stamps of its newest ones [s].
  struct ScanTimes {
    const BeamSource* source = nullptr;
    std::deque<double> stamps_s;
  };
  ScanTimes scan_times_;
  std::vector<std::function<void()>> maps_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace trident::nav
