// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

#include "trial_config.h"
#include "trident_base/se2.h"
#include "trident_nav/core/geometry.h"

namespace trident::benchmarks {

/// Where a robot believes it is, in the frame that it began in.
class Odometry {
 public:
  Odometry() = default;
  Odometry(const Odometry&) = delete;
  Odometry& operator=(const Odometry&) = delete;
  virtual ~Odometry() = default;

  /// In the frame that the robot began in.
  virtual const nav::Pose2& pose() const = 0;
  /// Of the robot's base, from the latest measurements.
  virtual const nav::Twist2& twist() const = 0;
};

/// The odometry that a robot's own drive computes, with errors on top: a scale of distances and one
/// of turns, whose signs are the seed's, and a random walk of the heading.
class DriftingOdometry : public Odometry {
 public:
  DriftingOdometry(const OdometryParams& params, std::uint64_t seed);

  /// What the drive says: the base's pose in a fixed frame, and its velocity.
  void add(const SE2& T_fixed_base, const nav::Twist2& twist);

  const nav::Pose2& pose() const override { return pose_; }
  const nav::Twist2& twist() const override { return twist_; }

 private:
  OdometryParams params_;
  std::uint64_t seed_;
  double distance_scale_, turn_scale_;
  SE2 T_fixed_last_, T_odom_base_;
  std::uint64_t count_ = 0;  ///< Of what was added.
  nav::Pose2 pose_;
  nav::Twist2 twist_;
};

/// The newest poses of a robot, so that what was measured a little earlier finds its place.
class PoseHistory {
 public:
  /// Times must not decrease.
  void add(double time_s, const nav::Pose2& pose);
  bool is_empty() const { return poses_.empty(); }
  double newest_s() const { return poses_.back().time_s; }
  /// At a time, between the two poses about it; the first or the last one beyond them.
  SE2 at(double time_s) const;

 private:
  struct Stamped {
    double time_s;
    SE2 pose;
  };
  std::deque<Stamped> poses_;
};

}  // namespace trident::benchmarks
