// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation/fusion/team_model.h"

#include <cmath>
#include <utility>

#include "fusion/robot_motion.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/so3.h"
#include "trident_base/string_util.h"

namespace trident::estimation {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Index first_dof(std::size_t robot) { return TeamModel::kDofs * static_cast<Index>(robot); }

void check(const char* name, double value, bool is_zero_legal) {
  if (std::isfinite(value) && (value > 0.0 || (is_zero_legal && value == 0.0))) return;
  throw Error(std::string("motion: ") + name + " is " + number_text(value) + ", legal is " +
              (is_zero_legal ? "at least 0" : "above 0"));
}

}  // namespace

SE3 RobotState::T_world_map() const {
  return {so3_exp(yaw_world_map * Vector3d::UnitZ()), p_world_map};
}

void RobotMotion::validate() const {
  for (const double value : speed) check("speed", value, false);
  for (const double value : turn) check("turn", value, false);
  check("speed_time", speed_time, false);
  check("turn_time", turn_time, false);
  check("leveling", leveling, true);
  check("map_drift", map_drift, true);
  check("map_turn", map_turn, true);
}

TeamModel::TeamModel(std::vector<RobotMotion> robots) : robots_(std::move(robots)) {
  if (robots_.empty()) throw Error("team: there are 0 robots, legal is at least 1");
  for (const RobotMotion& robot : robots_) robot.validate();
}

RobotState TeamModel::robot(const VectorXd& x, std::size_t i) {
  const auto own = x.segment<kNumbers>(kNumbers * static_cast<Index>(i));
  RobotState robot;
  robot.T_world_base.p = own.head<3>();
  robot.T_world_base.R = Eigen::Quaterniond(own(3), own(4), own(5), own(6));
  robot.v_base = own.segment<3>(7);
  robot.w_base = own.segment<3>(10);
  robot.p_world_map = own.segment<3>(13);
  robot.yaw_world_map = own(16);
  return robot;
}

void TeamModel::set_robot(const RobotState& robot, std::size_t i, VectorXd& x) {
  auto own = x.segment<kNumbers>(kNumbers * static_cast<Index>(i));
  const Eigen::Quaterniond& R = robot.T_world_base.R;
  own.head<3>() = robot.T_world_base.p;
  own.segment<4>(3) << R.w(), R.x(), R.y(), R.z();
  own.segment<3>(7) = robot.v_base;
  own.segment<3>(10) = robot.w_base;
  own.segment<3>(13) = robot.p_world_map;
  own(16) = robot.yaw_world_map;
}

int TeamModel::dim() const { return static_cast<int>(first_dof(robots_.size())); }

VectorXd TeamModel::predict(const VectorXd& x, const VectorXd& /*u*/, double dt) const {
  VectorXd next(x.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    set_robot(moved(robots_[i], robot(x, i), dt), i, next);
  }
  return next;
}

MatrixXd TeamModel::jacobian(const VectorXd& x, const VectorXd& /*u*/, double dt) const {
  MatrixXd F = MatrixXd::Identity(dim(), dim());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    F.block<12, 12>(first_dof(i), first_dof(i)) = motion_jacobian(robots_[i], robot(x, i), dt);
  }
  return F;
}

MatrixXd TeamModel::noise(const VectorXd& x, double dt) const {
  MatrixXd Q = MatrixXd::Zero(dim(), dim());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotMotion& motion = robots_[i];
    auto own = Q.block<kDofs, kDofs>(first_dof(i), first_dof(i));
    own.topLeftCorner<12, 12>() = motion_noise(motion, robot(x, i), dt);
    own.diagonal().segment<3>(kMap).setConstant(dt * motion.map_drift * motion.map_drift);
    own(kYaw, kYaw) = dt * motion.map_turn * motion.map_turn;
  }
  return Q;
}

std::vector<DofRange> TeamModel::groups() const {
  std::vector<DofRange> groups;
  for (std::size_t i = 0; i < robots_.size(); ++i) groups.push_back({first_dof(i), kDofs});
  return groups;
}

VectorXd TeamModel::boxplus(const VectorXd& x, const VectorXd& d) const {
  VectorXd moved(x.size());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const auto own = d.segment<kDofs>(first_dof(i));
    RobotState next = robot(x, i);
    next.T_world_base.p += own.segment<3>(kPosition);
    const Eigen::Quaterniond turn = so3_exp(own.segment<3>(kRotation));
    next.T_world_base.R = (next.T_world_base.R * turn).normalized();
    next.v_base += own.segment<3>(kVelocity);
    next.w_base += own.segment<3>(kTurn);
    next.p_world_map += own.segment<3>(kMap);
    next.yaw_world_map = wrap_to_pi(next.yaw_world_map + own(kYaw));
    set_robot(next, i, moved);
  }
  return moved;
}

VectorXd TeamModel::boxminus(const VectorXd& a, const VectorXd& b) const {
  VectorXd d(dim());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotState to = robot(a, i), from = robot(b, i);
    d.segment<kDofs>(first_dof(i)) << to.T_world_base.p - from.T_world_base.p,
        so3_log(from.T_world_base.R.conjugate() * to.T_world_base.R), to.v_base - from.v_base,
        to.w_base - from.w_base, to.p_world_map - from.p_world_map,
        wrap_to_pi(to.yaw_world_map - from.yaw_world_map);
  }
  return d;
}

TeamStart team_start(const std::vector<RobotStart>& robots) {
  const auto count = static_cast<Index>(robots.size());
  const Index dim = TeamModel::kDofs * count;
  TeamStart start{VectorXd(TeamModel::kNumbers * count), MatrixXd::Zero(dim, dim)};
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotStart& own = robots[i];
    RobotState robot;
    robot.p_world_map = own.p_world_map;
    robot.yaw_world_map = own.yaw_world_map;
    robot.T_world_base = robot.T_world_map() * own.T_map_base;
    TeamModel::set_robot(robot, i, start.state);
    // How the degrees of freedom follow the independent ones: the base's in the map instead of in
    // the world, and the others as they are.
    Eigen::Matrix<double, 16, 16> J = Eigen::Matrix<double, 16, 16>::Identity();
    const Vector3d from_map = robot.T_world_base.p - robot.p_world_map;
    J.block<3, 3>(TeamModel::kPosition, TeamModel::kMap).setIdentity();
    J.block<3, 1>(TeamModel::kPosition, TeamModel::kYaw) = Vector3d::UnitZ().cross(from_map);
    J.block<3, 1>(TeamModel::kRotation, TeamModel::kYaw) =
        robot.T_world_base.R.conjugate() * Vector3d::UnitZ();
    Eigen::Matrix<double, 16, 1> sigma;
    sigma << Vector3d::Constant(own.base_sigma), Vector3d::Constant(own.base_turn_sigma),
        own.motion.speed, own.motion.turn, Vector3d::Constant(own.map_sigma), own.map_yaw_sigma;
    start.covariance.block<16, 16>(first_dof(i), first_dof(i)) =
        J * sigma.cwiseAbs2().asDiagonal() * J.transpose();
  }
  return start;
}

}  // namespace trident::estimation
