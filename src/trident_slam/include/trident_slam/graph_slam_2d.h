// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_slam/graph_slam_options.h"
#include "trident_slam/pose_graph_optimizer.h"
#include "trident_slam/slam_2d.h"
#include "trident_slam/slam_2d_capabilities.h"

namespace trident::slam {

/// Graph SLAM: each scan is matched against the surfaces of the map so far; keyframes and the
/// measurements between them form a graph; loops are found by branch and bound and believed when
/// several of them agree; at the end every scan is matched against the map once more. The graph's
/// nodes are the keyframes.
///
/// All calls come from one thread. With `is_asynchronous` loops are searched for in a thread of its
/// own and take effect at a later `add_scan`, so that poses may differ from run to run; without it
/// they are closed within `add_scan`. No call but `finish`, `relocalize` and those that load or
/// save then takes longer as the map grows.
class GraphSlam2d : public Slam2d,
                    public Slam2dSession,
                    public Slam2dMapSnapshot,
                    public PoseInitializable,
                    public Slam2dLocalizing,
                    public Slam2dOdometryUse,
                    public Slam2dCalibrated,
                    public Slam2dGraph,
                    public GraphEditable {
 public:
  /// `solver` optimises the graph; empty: ours.
  explicit GraphSlam2d(const GraphSlamOptions& options = {}, PoseGraphSolverMaker solver = {});
  ~GraphSlam2d() override;

  ScanPose2d add_scan(const LaserScan& scan, const SE2& T_odom_base) override;
  void finish() override;
  std::vector<StampedPose2d> trajectory() const override;
  OccupancyGrid map() const override;

  std::vector<CalibrationEstimate> odometry_calibration() const override;

  void set_uses_odometry(bool uses_odometry) override;

  /// Paused, scans are placed in the map but do not become part of it.
  void set_paused(bool is_paused);
  /// See set_paused().
  bool is_paused() const;
  /// Forgets everything; the next scan is at `map_start_pose`.
  void clear();
  /// From the next scan on; the map stays.
  void set_mode(SlamMode mode);

  void save_session(const std::string& path) const override;
  std::function<void(const std::string&)> session_snapshot() const override;
  void load_session(const std::string& path, SessionStart start, const SE2& T_map_base) override;
  /// Starts at `T_map_base`, or where the session ended. Throws Error as the one above.
  void load_session(const std::string& path, const std::optional<SE2>& T_map_base = std::nullopt);
  /// Made in the order of the calls, a map costs only what has changed since the last one.
  std::function<OccupancyGrid()> map_snapshot() const override;

  /// With `is_asynchronous` in the background, else as `finish`.
  void realign() override;
  /// Loops are being searched for, or the graph optimised, in the background.
  bool is_busy() const;

  void set_pose(const SE2& T_map_base) override;
  void clear_localization_buffer() override;
  /// Searches for a scan in the whole map. The pose is taken over if at least `min_inliers` of the
  /// points lie on surfaces of the map.
  std::optional<SE2> relocalize(const LaserScan& scan, double min_inliers = 0.7);

  /// Ties keyframe `newer` to keyframe `older` where a user put it; scans about both refine the
  /// transform. False if they do not fit to each other. Throws Error for an unknown keyframe.
  bool close_loop(int older, int newer, const SE2& T_older_newer);
  /// Ties keyframes to whatever lies where a user moved them, if their surroundings fit there
  /// within a metre; everything follows.
  std::vector<int> move_nodes(const std::map<int, SE2>& T_map_base) override;
  /// Adds the keyframes of a session file, whose origin is at `T_map_session`, roughly, and
  /// searches for loops between both. Returns how many it found. Throws Error as `load_session`
  /// does.
  int append_session(const std::string& path, const SE2& T_map_session);

  int nodes() const;  ///< how many keyframes there are
  std::vector<Eigen::Vector2f> node_points(int node) const override;
  GraphView2d graph_view() const override;
  std::vector<GraphLoop2d> loops() const override;
  /// Loops that were believed so far.
  int loops_closed() const;
  void save_g2o(const std::string& path) const override;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trident::slam
