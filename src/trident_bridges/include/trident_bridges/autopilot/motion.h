// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "trident_base/sim_time.h"

namespace trident::bridges {

/// Place, velocity and acceleration that a position controller shall follow, world frame.
struct Reference {
  Eigen::Vector3d p_m = Eigen::Vector3d::Zero();     ///< place
  Eigen::Vector3d v_m_s = Eigen::Vector3d::Zero();   ///< velocity
  Eigen::Vector3d a_m_s2 = Eigen::Vector3d::Zero();  ///< acceleration
};

/// Bounds of a motion.
struct MotionLimits {
  double horizontal_m_s = 5.0;  ///< speed in the plane
  double up_m_s = 2.5;          ///< climbing
  double down_m_s = 1.5;        ///< sinking
  double a_m_s2 = 2.5;          ///< of each part of the motion
};

/// References along straight lines, continuous in place and velocity whenever a new goal comes. A
/// motion is the sum of two: what is left of the present velocity dies away evenly, so that the
/// same goal may come as often as it likes, and a line with a smooth (cubic) start and end leads
/// from where that stops to the goal. Speed keeps to the limits where the vehicle had stopped
/// before, acceleration to twice the limit in every case.
class Motion {
 public:
  /// At rest.
  void stop_at(const Eigen::Vector3d& p_m, SimTime now);
  /// From the present reference to rest at `goal_m`.
  void go_to(const Eigen::Vector3d& goal_m, const MotionLimits& limits, SimTime now);
  /// Comes to rest as soon as the limits allow, wherever that is.
  void brake(const MotionLimits& limits, SimTime now);
  /// Changes to a velocity and keeps it.
  void set_velocity(const Eigen::Vector3d& v_m_s, const MotionLimits& limits, SimTime now);
  /// Takes over what somebody else has computed for now; without news it continues in a line.
  void follow(const Reference& reference, SimTime now);
  /// The reference at a time that is not before that of the last change.
  Reference at(SimTime now) const;
  /// Whether the goal is reached; never while a velocity is kept.
  bool is_at_rest(SimTime now) const;
  /// Whether the velocity no longer changes, in a line or at rest.
  bool is_settled(SimTime now) const;
  /// Where it ends; where it is while a velocity is kept.
  Eigen::Vector3d goal(SimTime now) const;

 private:
  SimTime begin_;
  Eigen::Vector3d p_begin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_begin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d v_end_ = Eigen::Vector3d::Zero();
  double change_s_ = 0.0;  // from v_begin_ to v_end_
  Eigen::Vector3d line_ = Eigen::Vector3d::Zero();
  double ramp_s_ = 0.0;    // of the line, at both ends
  double cruise_s_ = 0.0;  // between them
  double line_m_s_ = 0.0;  // while cruising
};

}  // namespace trident::bridges
