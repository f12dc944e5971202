// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "team_scene.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <utility>

#include "trident_base/random_stream.h"
#include "trident_base/so3.h"

namespace trident::estimation {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kOutlier_m = 5.0;
constexpr double kGate = 0.99;

const Vector3d kUavAntenna(0.0, 0.1, 0.1), kUgvAntenna(-0.3, 0.0, 0.6), kUsvAntenna(-1.5, 0.4, 2.0);

RobotStart robot_start(const RobotMotion& motion, const Vector3d& p_world_map, double yaw) {
  RobotStart start;
  start.motion = motion;
  start.p_world_map = p_world_map;
  start.yaw_world_map = yaw;
  start.map_sigma = 0.5;
  start.base_sigma = 0.3;
  return start;
}

std::vector<RobotStart> coast_team(bool is_ugv_followed) {
  RobotMotion uav, ugv, usv;
  uav.speed = {4.0, 4.0, 0.7};
  ugv.speed = {1.5, 0.05, 0.05};
  ugv.turn = {0.05, 0.05, 0.4};
  usv.speed = {2.0, 0.3, 0.2};
  usv.turn = {0.1, 0.05, 0.2};
  uav.speed_time = 10.0;
  ugv.speed_time = 6.0;
  usv.speed_time = 15.0;
  if (is_ugv_followed) {
    ugv.map_drift = 0.2;
    uav.speed = {1.0, 1.0, 0.3};
    ugv.speed.x() = 0.8;
  }
  const Vector3d uav_place =
      is_ugv_followed ? Vector3d(-18.0, 52.0, 20.0) : Vector3d(10.0, 57.0, 25.0);
  return {robot_start(uav, uav_place, 0.0), robot_start(ugv, {-20.0, 51.5, 1.5}, 0.4),
          robot_start(usv, {10.0, 5.0, 0.0}, -1.6)};
}

// Normal numbers one after another.
class Draws {
 public:
  Draws(std::uint64_t seed, const std::string& name) : stream_(seed, name) {}
  double normal() { return stream_.normal(count_++, 0); }
  double uniform() { return stream_.uniform(count_++, 0); }
  VectorXd normals(Eigen::Index size) {
    VectorXd values(size);
    for (double& value : values) value = normal();
    return values;
  }
  Vector3d direction() { return normals(3).normalized(); }

 private:
  RandomStream stream_;
  std::uint64_t count_ = 0;
};

VectorXd disturbed(const TeamModel& model, const VectorXd& x, const MatrixXd& covariance,
                   Draws& draws) {
  const MatrixXd root = covariance.llt().matrixL();
  return model.boxplus(x, root * draws.normals(model.dim()));
}

// A sensor of the team.
struct Sensor {
  std::string name;
  int period;  // [ticks]
  std::function<Measurement(const Origin&, const VectorXd& x, const Vector3d& off, Draws&)> measure;
};

SE3 noisy(const SE3& T, const Vector3d& off, const VectorXd& sigma, Draws& draws) {
  const VectorXd noise = sigma.cwiseProduct(draws.normals(6));
  return {T.R * so3_exp(noise.tail<3>()), T.p + noise.head<3>() + off};
}

Sensor slam(const std::string& name, std::size_t robot, int period, double sigma,
            double turn_sigma) {
  VectorXd sigmas(6);
  sigmas << Vector3d::Constant(sigma), Vector3d::Constant(turn_sigma);
  return {name, period,
          [=](const Origin& origin, const VectorXd& x, const Vector3d& off, Draws& draws) {
            const RobotState state = TeamModel::robot(x, robot);
            const SE3 T_map_base = state.T_world_map().inverse() * state.T_world_base;
            return map_pose(origin, robot, noisy(T_map_base, off, sigmas, draws),
                            sigmas.cwiseAbs2().asDiagonal());
          }};
}

Sensor planar_slam(const std::string& name, std::size_t robot, double sigma, double turn_sigma) {
  const Vector3d sigmas(sigma, sigma, turn_sigma);
  return {name, 3, [=](const Origin& origin, const VectorXd& x, const Vector3d& off, Draws& draws) {
            const RobotState state = TeamModel::robot(x, robot);
            const SE3 T = state.T_world_map().inverse() * state.T_world_base;
            const Vector3d noise = sigmas.cwiseProduct(Vector3d(draws.normals(3)));
            const SE3 planar = SE3::from_xyz_rpy({T.p.x() + noise.x(), T.p.y() + noise.y(), 0.0},
                                                 0.0, 0.0, T.rpy().z() + noise.z());
            return map_pose(origin, robot, {planar.R, planar.p + off},
                            sigmas.cwiseAbs2().asDiagonal(), PoseRows::kPlanar);
          }};
}

Sensor receiver(const std::string& name, std::size_t robot, const Vector3d& antenna) {
  const Vector3d sigmas(0.8, 0.8, 1.2);
  return {name, 6, [=](const Origin& origin, const VectorXd& x, const Vector3d& off, Draws& draws) {
            const Vector3d noise = sigmas.cwiseProduct(Vector3d(draws.normals(3)));
            return gnss(origin, robot,
                        TeamModel::robot(x, robot).T_world_base * antenna + noise + off, antenna,
                        sigmas.cwiseAbs2().asDiagonal());
          }};
}

Sensor height(const std::string& name, std::size_t robot, double sigma) {
  return {name, 3, [=](const Origin& origin, const VectorXd& x, const Vector3d& off, Draws& draws) {
            const double z = TeamModel::robot(x, robot).T_world_base.p.z();
            const double far = off.z() == 0.0 ? 0.0 : std::copysign(off.norm(), off.z());
            return altitude(origin, robot, z + sigma * draws.normal() + far, Vector3d::Zero(),
                            sigma * sigma);
          }};
}

Sensor north(const std::string& name, std::size_t robot) {
  constexpr double kSigma = 0.03;
  return {name, 3,
          [=](const Origin& origin, const VectorXd& x, const Vector3d& /*off*/, Draws& draws) {
            const double yaw = TeamModel::robot(x, robot).T_world_base.rpy().z();
            return compass(origin, robot, yaw + kSigma * draws.normal(), kSigma * kSigma);
          }};
}

Sensor eye(const std::string& name, std::size_t observer, std::size_t target) {
  constexpr double kAngle = 0.01, kRange = 0.3;
  return {name, 6, [=](const Origin& origin, const VectorXd& x, const Vector3d& off, Draws& draws) {
            const RobotState from = TeamModel::robot(x, observer);
            const RobotState to = TeamModel::robot(x, target);
            const Vector3d d = from.T_world_base.inverse() * to.T_world_base.p;
            const Vector3d unit = d.normalized(), across = unit.unitOrthogonal();
            Sighting seen;
            seen.observer = observer;
            seen.target = target;
            seen.direction_base_target = unit + kAngle * draws.normal() * across +
                                         kAngle * draws.normal() * unit.cross(across) +
                                         off / d.norm();
            seen.direction_variance = kAngle * kAngle;
            seen.range = std::abs(d.norm() + kRange * draws.normal() + off.x());
            seen.range_variance = kRange * kRange;
            return sighting(origin, seen);
          }};
}

Sensor radio(const std::string& name, std::size_t robot, std::size_t other) {
  constexpr double kSigma = 1.0;
  return {
      name, 15, [=](const Origin& origin, const VectorXd& x, const Vector3d& off, Draws& draws) {
        const Vector3d d =
            TeamModel::robot(x, other).T_world_base.p - TeamModel::robot(x, robot).T_world_base.p;
        const double far = off.x() == 0.0 ? 0.0 : std::copysign(off.norm(), off.x());
        const double range = std::abs(d.norm() + kSigma * draws.normal() + far);
        return radio_range(origin, robot, other, range, kSigma * kSigma);
      }};
}

std::vector<Sensor> sensors() {
  return {slam("uav/pose", kUav, 1, 0.05, 0.01),   receiver("uav/gnss", kUav, kUavAntenna),
          height("uav/altitude", kUav, 0.3),       planar_slam("ugv/pose", kUgv, 0.05, 0.01),
          receiver("ugv/gnss", kUgv, kUgvAntenna), slam("usv/pose", kUsv, 3, 0.1, 0.01),
          receiver("usv/gnss", kUsv, kUsvAntenna), north("usv/compass", kUsv),
          height("usv/waterline", kUsv, 0.1),      eye("uav/sees/ugv", kUav, kUgv),
          radio("uav/radio/usv", kUav, kUsv)};
}

bool is_due(const Sensor& sensor, std::size_t tick, const SceneOptions& options) {
  if (sensor.name == "ugv/gnss" && tick_time(tick).seconds() >= options.gnss_gone_from)
    return false;
  return options.is_every_tick || tick % static_cast<std::size_t>(sensor.period) == 0;
}

}  // namespace

SimTime tick_time(std::size_t tick) {
  return SimTime::from_seconds(kTick_s * static_cast<double>(tick));
}

TeamScene make_scene(const SceneOptions& options) {
  const std::vector<RobotStart> robots = coast_team(options.is_ugv_followed);
  std::vector<RobotMotion> motions;
  for (const RobotStart& robot : robots) motions.push_back(robot.motion);
  TeamScene scene{std::make_shared<TeamModel>(motions), team_start(robots), {}, {}};
  const TeamModel& model = *scene.model;
  Draws moves(options.seed, "team_scene/truth");
  VectorXd x = disturbed(model, scene.start.state, scene.start.covariance, moves);
  scene.truth.push_back(x);
  const std::vector<Sensor> all = sensors();
  std::vector<Draws> noises;
  for (const Sensor& sensor : all) noises.emplace_back(options.seed, "team_scene/" + sensor.name);
  const auto ticks = static_cast<std::size_t>(std::lround(options.duration / kTick_s));
  for (std::size_t tick = 1; tick <= ticks; ++tick) {
    const double dt = (tick_time(tick) - tick_time(tick - 1)).seconds();
    x = disturbed(model, model.predict(x, {}, dt), model.noise(x, dt), moves);
    scene.truth.push_back(x);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!is_due(all[i], tick, options)) continue;
      const bool is_off = noises[i].uniform() < options.outliers;
      const Vector3d off = is_off ? Vector3d(kOutlier_m * noises[i].direction()) : Vector3d::Zero();
      Measurement one = all[i].measure({tick_time(tick), all[i].name}, x, off, noises[i]);
      one.gate = gate_of(kGate, one.z.size());
      scene.measurements.push_back(std::move(one));
    }
  }
  return scene;
}

Filter first_belief(const TeamScene& scene, FilterKind kind) {
  return {kind, scene.model, SimTime{}, scene.start.state, scene.start.covariance};
}

double nees(const Filter& filter, const VectorXd& truth, Eigen::Index first, Eigen::Index count) {
  const Eigen::Index size = count < 0 ? filter.covariance().rows() - first : count;
  const VectorXd error = filter.model().boxminus(truth, filter.state()).segment(first, size);
  return error.dot(filter.covariance().block(first, first, size, size).llt().solve(error));
}

double position_error(const Filter& filter, const VectorXd& truth, std::size_t robot) {
  return (TeamModel::robot(filter.state(), robot).T_world_base.p -
          TeamModel::robot(truth, robot).T_world_base.p)
      .norm();
}

}  // namespace trident::estimation
