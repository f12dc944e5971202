// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/fusion_messages.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_ros/message_checks.h"

namespace trident::estimation {
namespace {

using Eigen::MatrixXd;

constexpr double kAsymmetry = 1e-6;  // of the largest entry: some drivers send floats
constexpr double kMinVariance = 1e-8;
constexpr double kMaxVariance = 1e12;

template <class Message>
Message read(const std::string& bytes) {
  Message message;
  // Only read from.
  ros::serialization::IStream stream(
      const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(bytes.data())),
      static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, message);
  return message;
}

void check(const std::string& problem) {
  if (!problem.empty()) throw Error(problem);
}

// Symmetric, and with variances that a filter can compute with.
MatrixXd checked_covariance(const MatrixXd& matrix) {
  if (!matrix.allFinite()) throw Error("covariance is not finite");
  const double largest = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > kAsymmetry * largest) {
    throw Error("covariance is not symmetric");
  }
  if (largest > kMaxVariance) {
    throw Error("covariance has " + number_text(largest) + ", legal: up to +-" +
                number_text(kMaxVariance));
  }
  MatrixXd result = 0.5 * (matrix + matrix.transpose());
  result.diagonal().array() += kMinVariance;
  if (matrix.diagonal().minCoeff() <= 0.0 || result.llt().info() != Eigen::Success) {
    throw Error("covariance is not positive definite");
  }
  return result;
}

template <class Array>
MatrixXd matrix_of(const Array& numbers, Eigen::Index size) {
  MatrixXd matrix(size, size);
  for (Eigen::Index i = 0; i < size * size; ++i) {
    matrix(i / size, i % size) = numbers[static_cast<std::size_t>(i)];
  }
  return matrix;
}

bool has_planar_zeros(const MatrixXd& matrix) {
  return matrix.middleRows(2, 3).isZero(0.0) && matrix.middleCols(2, 3).isZero(0.0);
}

MatrixXd planar_part(const MatrixXd& matrix) {
  constexpr Eigen::Index kRow[] = {0, 1, 5};
  MatrixXd part(3, 3);
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) part(i, j) = matrix(kRow[i], kRow[j]);
  }
  return part;
}

}  // namespace

bool is_pose_type(const std::string& type) {
  return type == "nav_msgs/Odometry" || type == "geometry_msgs/PoseStamped" ||
         type == "geometry_msgs/PoseWithCovarianceStamped";
}

StampedPose pose_from_bytes(const std::string& type, const std::string& bytes) {
  StampedPose result;
  try {
    if (type == "nav_msgs/Odometry") {
      const auto message = read<nav_msgs::Odometry>(bytes);
      return {message.header, message.pose, true};
    }
    if (type == "geometry_msgs/PoseWithCovarianceStamped") {
      const auto message = read<geometry_msgs::PoseWithCovarianceStamped>(bytes);
      return {message.header, message.pose, true};
    }
    const auto message = read<geometry_msgs::PoseStamped>(bytes);
    result.header = message.header;
    result.pose.pose = message.pose;
  } catch (const ros::serialization::StreamOverrunException&) {
    throw Error(std::to_string(bytes.size()) + " bytes are too few for a " + type);
  }
  return result;
}

SimTime checked_stamp(const std_msgs::Header& header, const ros::Time& now) {
  if (header.stamp.isZero()) throw Error("stamp is 0 s, legal: when it was measured");
  check(ros_utils::stamp_problem(header.stamp, now));
  if (!now.isZero() && header.stamp > now + ros::Duration(kMaxLead_s)) {
    throw Error("stamp is " + number_text((header.stamp - now).toSec()) +
                " s ahead of the clock, legal: up to " + number_text(kMaxLead_s) + " s");
  }
  return {static_cast<std::int64_t>(header.stamp.toNSec())};
}

SE3 from_pose(const geometry_msgs::Pose& pose) {
  check(ros_utils::pose_problem(pose));
  const Eigen::Quaterniond R(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                             pose.orientation.z);
  return {R.normalized(), {pose.position.x, pose.position.y, pose.position.z}};
}

geometry_msgs::Pose to_pose(const SE3& T) {
  geometry_msgs::Pose pose;
  pose.position.x = T.p.x();
  pose.position.y = T.p.y();
  pose.position.z = T.p.z();
  pose.orientation.w = T.R.w();
  pose.orientation.x = T.R.x();
  pose.orientation.y = T.R.y();
  pose.orientation.z = T.R.z();
  return pose;
}

PoseCovariance pose_covariance(const geometry_msgs::PoseWithCovariance& pose, bool is_planar) {
  const MatrixXd all = matrix_of(pose.covariance, 6);
  PoseCovariance result;
  if (!all.allFinite()) throw Error("covariance is not finite");
  const bool has_zeros = has_planar_zeros(all);
  if (is_planar || (has_zeros && !all.isZero(0.0))) result.rows = PoseRows::kPlanar;
  const MatrixXd part = result.rows == PoseRows::kPlanar ? planar_part(all) : all;
  if (!part.isZero(0.0)) result.matrix = checked_covariance(part);
  return result;
}

GnssFix gnss_fix(const sensor_msgs::NavSatFix& fix, const GeodeticPlace& origin, double sigma) {
  if (fix.status.status < 0) throw Error("there is no fix: status is below 0");
  check(ros_utils::number_problem(fix.latitude, 90.0, "latitude"));
  check(ros_utils::number_problem(fix.longitude, 360.0, "longitude"));
  check(ros_utils::number_problem(fix.altitude, 1e5, "altitude"));
  GnssFix result;
  result.p_world_antenna = enu_from_geodetic({fix.latitude, fix.longitude, fix.altitude}, origin);
  const MatrixXd covariance = matrix_of(fix.position_covariance, 3);
  const bool is_known =
      fix.position_covariance_type != sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN &&
      !covariance.isZero(0.0);
  result.covariance = is_known ? Eigen::Matrix3d(checked_covariance(covariance))
                               : Eigen::Matrix3d(sigma * sigma * Eigen::Matrix3d::Identity());
  return result;
}

double pressure_height(const sensor_msgs::FluidPressure& message, double reference) {
  const double pressure = message.fluid_pressure;
  if (!(pressure >= 1e4 && pressure <= 2e5)) {
    throw Error("fluid_pressure is " + number_text(pressure) + " Pa, legal: in [10000, 200000]");
  }
  return height_of_pressure(pressure, reference);
}

Sighting sighting_of(const trident_msgs::Detection& detection, double angle_sigma) {
  const geometry_msgs::Point& p = detection.pose.pose.position;
  check(ros_utils::point_problem(p.x, p.y, p.z, "position"));
  Sighting result;
  result.direction_base_target = {p.x, p.y, p.z};
  result.range = result.direction_base_target.norm();
  if (result.range < 0.01) {
    throw Error("position is " + number_text(result.range) + " m away, legal: at least 0.01 m");
  }
  const MatrixXd covariance = matrix_of(detection.pose.covariance, 6).topLeftCorner(3, 3);
  if (covariance.isZero(0.0)) {
    result.direction_variance = angle_sigma * angle_sigma;
    result.range_variance = 0.01 * result.range * result.range;
    return result;
  }
  const MatrixXd known = checked_covariance(covariance);
  const Eigen::Vector3d unit = result.direction_base_target / result.range;
  result.range_variance = unit.dot(known * unit);
  // Of the two directions across, in the mean.
  const double across = 0.5 * (known.trace() - result.range_variance);
  result.direction_variance = std::max(across / (result.range * result.range), kMinVariance);
  return result;
}

}  // namespace trident::estimation
