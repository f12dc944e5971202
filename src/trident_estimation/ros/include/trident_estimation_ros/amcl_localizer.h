// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "trident_estimation/amcl.h"
#include "trident_estimation_ros/amcl_node_params.h"
#include "trident_estimation_ros/scan_input.h"

namespace trident::estimation {

/// The filter of amcl's node with the transform that follows from it: a map, poses and scans in, a
/// pose and global -> odom out. Knows no topics. Not thread-safe.
class AmclLocalizer {
 public:
  /// `params` must outlive it.
  explicit AmclLocalizer(const AmclNodeParams& params) : params_(params) {}

  /// Starts again in this map, at the initial pose of the parameters. Throws Error for a map
  /// without a free cell; the one before then stays.
  void set_map(const OccupancyGrid& map);
  /// False until there is a map. Everything below but forget_odometry() requires one.
  bool has_map() const { return filter_ != nullptr; }
  /// Moves the estimate. `covariance` is that of (x [m], y [m], yaw [rad]) in the global frame.
  /// Throws Error as Amcl::set_pose() does.
  void set_pose(const SE2& T_global_base, const Eigen::Matrix3d& covariance);
  /// The robot may be anywhere in the map.
  void set_anywhere() { filter_->set_anywhere(); }
  /// The next scan is used even if the robot has not moved.
  void force_update() { filter_->force_update(); }
  /// Odometry begins again, after a jump of time.
  void forget_odometry();
  /// Takes the next scan.
  AmclStep update(const PlacedScan& placed);

  /// The particles and their estimate.
  const Amcl& filter() const { return *filter_; }
  /// std::nullopt until a scan has been used since the last map or pose.
  const std::optional<SE2>& T_global_odom() const { return T_global_odom_; }
  /// A scan has been used since the last map.
  bool has_pose() const { return has_pose_; }
  /// Scans that moved the estimate, in all maps.
  std::uint64_t updates() const { return updates_; }
  /// Scans that were searched for in the whole map.
  std::uint64_t searches() const { return searches_; }

 private:
  const AmclNodeParams& params_;
  std::unique_ptr<Amcl> filter_;
  std::optional<SE2> T_global_odom_;
  std::optional<SE2> T_odom_scan_;  ///< Odometry of the newest scan that was used.
  bool has_pose_ = false;
  std::uint64_t updates_ = 0, searches_ = 0;
};

}  // namespace trident::estimation
