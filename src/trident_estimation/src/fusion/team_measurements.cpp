// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/fusion/team_measurements.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/angle.h"
#include "trident_base/so3.h"
#include "trident_estimation/fusion/team_model.h"

namespace trident::estimation {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kMinDistance = 1e-6;  // of directions and ranges, nearer ones have no slope [m]

MatrixXd scalar(double value) { return MatrixXd::Constant(1, 1, value); }

void depend_on(Measurement& measurement, std::size_t robot, Index first, Index count) {
  const Index offset = TeamModel::kDofs * static_cast<Index>(robot) + first;
  for (Index i = 0; i < count; ++i) measurement.dofs.push_back(offset + i);
}

Measurement measured(const Origin& origin, VectorXd z, MatrixXd covariance) {
  Measurement result;
  result.stamp = origin.stamp;
  result.source = origin.source;
  result.z = std::move(z);
  result.R = std::move(covariance);
  return result;
}

// A pose as position and rotation vector.
VectorXd pose_numbers(const SE3& T) {
  VectorXd numbers(6);
  numbers << T.p, so3_log(T.R);
  return numbers;
}

// Of poses as numbers: the rotation that is left, along the axes of the pose z_hat.
VectorXd pose_residual(const VectorXd& z, const VectorXd& z_hat) {
  VectorXd residual(6);
  const Eigen::Quaterniond back = so3_exp(z_hat.tail<3>()).conjugate();
  residual << z.head<3>() - z_hat.head<3>(), so3_log(back * so3_exp(z.tail<3>()));
  return residual;
}

SE3 T_map_base(const RobotState& robot) {
  return robot.T_world_map().inverse() * robot.T_world_base;
}

// Columns: position and rotation of the base, position and heading of the map.
MatrixXd map_pose_jacobian(const RobotState& robot) {
  MatrixXd H = MatrixXd::Zero(6, 10);
  const SE3 T = T_map_base(robot);
  const Matrix3d R_map_world = robot.T_world_map().R.conjugate().toRotationMatrix();
  H.block<3, 3>(0, 0) = R_map_world;
  H.block<3, 3>(0, 6) = -R_map_world;
  H.block<3, 1>(0, 9) = -Vector3d::UnitZ().cross(T.p);
  H.block<3, 3>(3, 3).setIdentity();
  H.block<3, 1>(3, 9) = -(T.R.conjugate() * Vector3d::UnitZ());
  return H;
}

// A point of the base in the world, by position and rotation of the base.
MatrixXd point_jacobian(const RobotState& robot, const Vector3d& p_base_point) {
  MatrixXd H(3, 6);
  H << Matrix3d::Identity(), -robot.T_world_base.R.toRotationMatrix() * skew(p_base_point);
  return H;
}

double yaw_of(const RobotState& robot) {
  const Matrix3d R = robot.T_world_base.R.toRotationMatrix();
  return std::atan2(R(1, 0), R(0, 0));
}

// How yaw follows a rotation about the base's axes.
Eigen::RowVector3d yaw_jacobian(const Eigen::Quaterniond& R_world_base) {
  const Matrix3d R = R_world_base.toRotationMatrix();
  const Matrix3d forward = -R * skew(Vector3d::UnitX());  // of the x axis
  const double square = R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0);
  return (R(0, 0) * forward.row(1) - R(1, 0) * forward.row(0)) /
         std::max(square, kMinDistance * kMinDistance);
}

// Two directions at right angles to a unit vector and to one another, as columns.
Eigen::Matrix<double, 3, 2> tangents(const Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> result;
  result.col(0) = direction.unitOrthogonal();
  result.col(1) = direction.cross(result.col(0));
  return result;
}

// From the observer's sensor to the target, along the observer's axes.
Vector3d seen(const VectorXd& x, const Sighting& sighting) {
  const RobotState observer = TeamModel::robot(x, sighting.observer);
  const RobotState target = TeamModel::robot(x, sighting.target);
  return observer.T_world_base.inverse() * target.T_world_base.p - sighting.p_base_sensor;
}

// Sines of the two angles from the measured direction; beyond a right angle they still grow, so
// that what is behind is far off.
Eigen::Vector2d off_direction(const Vector3d& to_target, const Vector3d& measured,
                              const Eigen::Matrix<double, 3, 2>& basis) {
  const Vector3d unit = to_target / std::max(to_target.norm(), kMinDistance);
  Eigen::Vector2d sines = basis.transpose() * unit;
  if (unit.dot(measured) >= 0.0) return sines;
  const double length = std::max(sines.norm(), kMinDistance);
  return (2.0 - length) / length * sines;
}

// How the vector from sensor to target follows position and rotation of the observer, and the
// position of the target.
Eigen::Matrix<double, 3, 9> seen_jacobian(const VectorXd& x, const Sighting& sighting) {
  const RobotState observer = TeamModel::robot(x, sighting.observer);
  const Matrix3d R_base_world = observer.T_world_base.R.conjugate().toRotationMatrix();
  Eigen::Matrix<double, 3, 9> J;
  J << -R_base_world, skew(seen(x, sighting) + sighting.p_base_sensor), R_base_world;
  return J;
}

}  // namespace

Measurement map_pose(const Origin& origin, std::size_t robot, const SE3& T_map_base_measured,
                     const MatrixXd& covariance, PoseRows rows) {
  Measurement result = measured(origin, pose_numbers(T_map_base_measured), covariance);
  depend_on(result, robot, TeamModel::kPosition, 6);
  depend_on(result, robot, TeamModel::kMap, 4);
  if (rows == PoseRows::kAll) {
    result.h = [robot](const VectorXd& x) {
      return pose_numbers(T_map_base(TeamModel::robot(x, robot)));
    };
    result.H = [robot](const VectorXd& x) { return map_pose_jacobian(TeamModel::robot(x, robot)); };
    result.residual = pose_residual;
    return result;
  }
  result.z =
      Vector3d(T_map_base_measured.p.x(), T_map_base_measured.p.y(), T_map_base_measured.rpy().z());
  result.h = [robot](const VectorXd& x) {
    const SE3 T = T_map_base(TeamModel::robot(x, robot));
    return VectorXd(Vector3d(T.p.x(), T.p.y(), T.rpy().z()));
  };
  result.H = [robot](const VectorXd& x) {
    const RobotState state = TeamModel::robot(x, robot);
    const MatrixXd all = map_pose_jacobian(state);
    MatrixXd H(3, 10);
    H << all.topRows(2), yaw_jacobian(T_map_base(state).R) * all.bottomRows(3);
    return H;
  };
  result.residual = [](const VectorXd& z, const VectorXd& z_hat) {
    return VectorXd(Vector3d(z(0) - z_hat(0), z(1) - z_hat(1), wrap_to_pi(z(2) - z_hat(2))));
  };
  return result;
}

Measurement world_pose(const Origin& origin, std::size_t robot, const SE3& T_world_base,
                       const MatrixXd& covariance, bool is_shared) {
  Measurement result = measured(origin, pose_numbers(T_world_base), covariance);
  const Index dofs = is_shared ? TeamModel::kDofs : 6;
  depend_on(result, robot, TeamModel::kPosition, dofs);
  result.h = [robot](const VectorXd& x) {
    return pose_numbers(TeamModel::robot(x, robot).T_world_base);
  };
  result.H = [dofs](const VectorXd&) { return MatrixXd(MatrixXd::Identity(6, dofs)); };
  result.residual = pose_residual;
  result.is_shared = is_shared;
  return result;
}

Measurement twist(const Origin& origin, std::size_t robot, const Vector3d& v_base,
                  const Vector3d& w_base, const MatrixXd& covariance) {
  VectorXd z(6);
  z << v_base, w_base;
  Measurement result = measured(origin, z, covariance);
  depend_on(result, robot, TeamModel::kVelocity, 6);
  result.h = [robot](const VectorXd& x) {
    const RobotState state = TeamModel::robot(x, robot);
    VectorXd both(6);
    both << state.v_base, state.w_base;
    return both;
  };
  result.H = [](const VectorXd&) { return MatrixXd(MatrixXd::Identity(6, 6)); };
  return result;
}

Measurement gnss(const Origin& origin, std::size_t robot, const Vector3d& p_world_antenna,
                 const Vector3d& p_base_antenna, const MatrixXd& covariance) {
  Measurement result = measured(origin, p_world_antenna, covariance);
  depend_on(result, robot, TeamModel::kPosition, 6);
  result.h = [robot, p_base_antenna](const VectorXd& x) {
    return VectorXd(TeamModel::robot(x, robot).T_world_base * p_base_antenna);
  };
  result.H = [robot, p_base_antenna](const VectorXd& x) {
    return point_jacobian(TeamModel::robot(x, robot), p_base_antenna);
  };
  return result;
}

Measurement compass(const Origin& origin, std::size_t robot, double yaw, double variance) {
  Measurement result = measured(origin, VectorXd::Constant(1, yaw), scalar(variance));
  depend_on(result, robot, TeamModel::kRotation, 3);
  result.h = [robot](const VectorXd& x) {
    return VectorXd(VectorXd::Constant(1, yaw_of(TeamModel::robot(x, robot))));
  };
  result.H = [robot](const VectorXd& x) {
    return MatrixXd(yaw_jacobian(TeamModel::robot(x, robot).T_world_base.R));
  };
  result.residual = [](const VectorXd& z, const VectorXd& z_hat) {
    return VectorXd(VectorXd::Constant(1, wrap_to_pi(z(0) - z_hat(0))));
  };
  return result;
}

Measurement sighting(const Origin& origin, const Sighting& sighting) {
  const bool has_range = sighting.range_variance > 0.0;
  const Index size = has_range ? 3 : 2;
  VectorXd z = VectorXd::Zero(size);
  VectorXd variances = VectorXd::Constant(size, sighting.direction_variance);
  if (has_range) {
    z(2) = sighting.range;
    variances(2) = sighting.range_variance;
  }
  Measurement result = measured(origin, z, variances.asDiagonal());
  depend_on(result, sighting.observer, TeamModel::kPosition, 6);
  depend_on(result, sighting.target, TeamModel::kPosition, 3);
  const Vector3d direction = sighting.direction_base_target.normalized();
  const Eigen::Matrix<double, 3, 2> basis = tangents(direction);
  result.h = [=](const VectorXd& x) {
    const Vector3d to_target = seen(x, sighting);
    VectorXd expected(size);
    expected.head<2>() = off_direction(to_target, direction, basis);
    if (has_range) expected(2) = to_target.norm();
    return expected;
  };
  result.H = [=](const VectorXd& x) {
    const Vector3d to_target = seen(x, sighting);
    const double range = std::max(to_target.norm(), kMinDistance);
    const Vector3d unit = to_target / range;
    const Eigen::Matrix<double, 3, 9> J = seen_jacobian(x, sighting);
    MatrixXd H(size, 9);
    H.topRows<2>() =
        basis.transpose() * (Matrix3d::Identity() - unit * unit.transpose()) * J / range;
    if (has_range) H.row(2) = unit.transpose() * J;
    return H;
  };
  return result;
}

Measurement radio_range(const Origin& origin, std::size_t robot, std::size_t other, double range,
                        double variance) {
  Measurement result = measured(origin, VectorXd::Constant(1, range), scalar(variance));
  depend_on(result, robot, TeamModel::kPosition, 3);
  depend_on(result, other, TeamModel::kPosition, 3);
  const auto between = [robot, other](const VectorXd& x) {
    return Vector3d(TeamModel::robot(x, other).T_world_base.p -
                    TeamModel::robot(x, robot).T_world_base.p);
  };
  result.h = [between](const VectorXd& x) {
    return VectorXd(VectorXd::Constant(1, between(x).norm()));
  };
  result.H = [between](const VectorXd& x) {
    const Vector3d difference = between(x);
    const Vector3d unit = difference / std::max(difference.norm(), kMinDistance);
    MatrixXd H(1, 6);
    H << -unit.transpose(), unit.transpose();
    return H;
  };
  return result;
}

Measurement altitude(const Origin& origin, std::size_t robot, double height,
                     const Vector3d& p_base_sensor, double variance) {
  Measurement result = measured(origin, VectorXd::Constant(1, height), scalar(variance));
  depend_on(result, robot, TeamModel::kPosition, 6);
  result.h = [robot, p_base_sensor](const VectorXd& x) {
    const Vector3d p = TeamModel::robot(x, robot).T_world_base * p_base_sensor;
    return VectorXd(VectorXd::Constant(1, p.z()));
  };
  result.H = [robot, p_base_sensor](const VectorXd& x) {
    return MatrixXd(point_jacobian(TeamModel::robot(x, robot), p_base_sensor).bottomRows(1));
  };
  return result;
}

}  // namespace trident::estimation
