// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"
#include "trident_estimation/filter/measurement.h"

// What sensors of a team measure, as functions of a TeamModel's state, with their Jacobians. The
// gate is left to the caller. Robots are counted from 0; covariances have the units of what is
// measured.

namespace trident::estimation {

/// When, and by what.
struct Origin {
  SimTime stamp;       ///< of the state that was measured
  std::string source;  ///< e.g. a topic
};

/// Which of the six numbers of a pose were measured.
enum class PoseRows {
  kAll,    ///< position and rotation
  kPlanar  ///< x, y and yaw: of what sees the ground from above, such as planar SLAM
};

/// A robot's pose in its own map. `covariance`: of position along the map's axes [m^2] and of a
/// rotation about the base's axes [rad^2], 6 x 6, or 3 x 3 (x, y, yaw) for kPlanar.
Measurement map_pose(const Origin& origin, std::size_t robot, const SE3& T_map_base,
                     const Eigen::MatrixXd& covariance, PoseRows rows = PoseRows::kAll);

/// A robot's pose in the world, from anything that is not of the team, such as motion capture; or,
/// with `is_shared`, from a team mate's own estimate, whose errors may be anything to those of this
/// robot's pose, velocity and map. `covariance`: 6 x 6, as for map_pose().
Measurement world_pose(const Origin& origin, std::size_t robot, const SE3& T_world_base,
                       const Eigen::MatrixXd& covariance, bool is_shared);

/// A robot's velocity [m/s] and angular velocity [rad/s] along its axes. `covariance`: 6 x 6.
Measurement twist(const Origin& origin, std::size_t robot, const Eigen::Vector3d& v_base,
                  const Eigen::Vector3d& w_base, const Eigen::MatrixXd& covariance);

/// Where an antenna is in the world [m]; it is at `p_base_antenna` [m] on the robot. 3 x 3.
Measurement gnss(const Origin& origin, std::size_t robot, const Eigen::Vector3d& p_world_antenna,
                 const Eigen::Vector3d& p_base_antenna, const Eigen::MatrixXd& covariance);

/// A robot's heading: yaw in the world [rad], counter-clockwise from east; its variance [rad^2].
Measurement compass(const Origin& origin, std::size_t robot, double yaw, double variance);

/// What a robot sees of another one.
struct Sighting {
  std::size_t observer = 0, target = 0;   ///< different robots
  Eigen::Vector3d direction_base_target;  ///< along the observer's axes; of any length above 0
  double direction_variance = 0.0;        ///< of each of its two angles [rad^2]
  double range = 0.0;                     ///< [m]
  double range_variance = 0.0;            ///< [m^2]; 0: the range was not measured
  Eigen::Vector3d p_base_sensor = Eigen::Vector3d::Zero();  ///< on the observer [m]
};

/// Bearing, and range where it was measured. Both angles are about the direction that was measured,
/// so that none is singular, straight down either.
Measurement sighting(const Origin& origin, const Sighting& sighting);

/// Distance of two robots' bases, by radio [m]; its variance [m^2].
Measurement radio_range(const Origin& origin, std::size_t robot, std::size_t other, double range,
                        double variance);

/// Height of a point of the robot, e.g. a barometer, above the world's origin [m]; its variance
/// [m^2]. A vessel's waterline: the height of the water, at the point of the base that is wet.
Measurement altitude(const Origin& origin, std::size_t robot, double height,
                     const Eigen::Vector3d& p_base_sensor, double variance);

}  // namespace trident::estimation
