// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseWithCovariance.h>
#include <sensor_msgs/FluidPressure.h>
#include <sensor_msgs/NavSatFix.h>
#include <std_msgs/Header.h>

#include <Eigen/Core>
#include <string>

#include "trident_base/se3.h"
#include "trident_base/sim_time.h"
#include "trident_estimation/fusion/geodesy.h"
#include "trident_estimation/fusion/team_measurements.h"
#include "trident_msgs/Detection.h"

// What messages say, for the core. Functions that convert throw Error for what is not usable: the
// field, its value, what is legal.

namespace trident::estimation {

/// Largest lead of a stamp over the clock [s]: one that is farther ahead would make all others
/// late.
inline constexpr double kMaxLead_s = 1.0;

/// A pose with its stamp, of any of the types that poses have.
struct StampedPose {
  std_msgs::Header header;
  geometry_msgs::PoseWithCovariance pose;
  bool has_covariance = false;  ///< whether its type has one
};

/// Whether a type has poses: nav_msgs/Odometry, geometry_msgs/PoseStamped,
/// PoseWithCovarianceStamped.
bool is_pose_type(const std::string& type);
/// From the bytes of a message of such a type; throws Error where they are too few.
StampedPose pose_from_bytes(const std::string& type, const std::string& bytes);

/// The stamp; throws Error for one that is zero, malformed, or beyond the clock by kMaxLead_s.
/// `now`: zero where the clock is not known.
SimTime checked_stamp(const std_msgs::Header& header, const ros::Time& now);
/// Position [m] and rotation; throws Error for what is not finite, or no rotation.
SE3 from_pose(const geometry_msgs::Pose& pose);
/// The same as a message.
geometry_msgs::Pose to_pose(const SE3& T);

/// What is known of the errors of a pose.
struct PoseCovariance {
  Eigen::MatrixXd matrix;  ///< 6 x 6, or 3 x 3 for kPlanar; empty: nothing, all are zero
  PoseRows rows = PoseRows::kAll;
};

/// Where z, roll and pitch have zeros alone, x, y and yaw are what was measured. Throws Error for
/// what is not finite, not symmetric, or not positive definite.
PoseCovariance pose_covariance(const geometry_msgs::PoseWithCovariance& pose, bool is_planar);

/// A fix as a position in the world and its covariance; `sigma` [m] where that is not known.
struct GnssFix {
  Eigen::Vector3d p_world_antenna;  ///< [m]
  Eigen::Matrix3d covariance;       ///< [m^2]
};
/// Throws Error for no fix, a place off the earth, or a covariance that is not one.
GnssFix gnss_fix(const sensor_msgs::NavSatFix& fix, const GeodeticPlace& origin, double sigma);

/// Height by pressure [m]; throws Error for one that is not in [1e4, 2e5] Pa.
double pressure_height(const sensor_msgs::FluidPressure& message, double reference);

/// Bearing and range with variances from the covariance of the position, or `angle_sigma` [rad] and
/// a tenth of the range where that is zero; robots are left to the caller. Throws Error for what
/// is not finite, nearer than 1 cm, or a covariance that is not one.
Sighting sighting_of(const trident_msgs::Detection& detection, double angle_sigma);

}  // namespace trident::estimation
