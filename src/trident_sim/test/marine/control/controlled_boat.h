// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "../standalone_vessel.h"
#include "marine/environment/environment.h"
#include "marine/vessel/rudder.h"
#include "marine/vessel/thruster.h"
#include "trident_control/vessel_controller.h"

namespace trident::sim {

inline control::VesselControlParams shipped_control(const std::string& name) {
  return control::load_vessel_control(std::string(TRIDENT_REPOSITORY) + "/config/controllers/" +
                                      name + ".yaml");
}
inline control::VesselModel shipped_model(const std::string& name) {
  return control::load_vessel_model(std::string(TRIDENT_REPOSITORY) + "/config/vessels/" + name +
                                    ".yaml");
}

/// A vessel alone in the sea and the wind, under the controller's core at 100 Hz.
class ControlledBoat {
 public:
  ControlledBoat(const VesselParams& vessel, const control::VesselModel& model,
                 const control::VesselControlParams& control,
                 const EnvironmentParams& environment = {}, std::uint64_t seed = 1)
      : boat_(vessel),
        sea_(environment, seed),
        coefficients_(vessel.wind),
        controller_(model, control) {
    for (const ThrusterParams& params : vessel.thrusters) thrusters_.emplace_back(params);
    for (const RudderParams& params : vessel.rudders) rudders_.emplace_back(params);
    boat_.set_at_rest();
  }
  ControlledBoat(const std::string& vessel, const control::VesselControlParams& control,
                 const EnvironmentParams& environment = {}, std::uint64_t seed = 1)
      : ControlledBoat(shipped_vessel(vessel), shipped_model(vessel), control, environment, seed) {}

  void set_wind(const Eigen::Vector3d& v_world) { wind_world_ = v_world; }
  control::CommandVerdict command(const control::VesselCommand& command) {
    return controller_.push({}, command);
  }
  void place(double x, double y, double heading) {
    SE3 T = boat_.T_world_co();
    const Eigen::Vector3d rpy = T.rpy();
    boat_.set_pose(SE3::from_xyz_rpy({x, y, T.p.z()}, rpy.x(), rpy.y(), heading));
  }

  void step() {
    const SE3 T = boat_.T_world_co();
    const Vector6d nu = boat_.nu();
    controller_.update(SimTime{10'000'000} * ++step_, {T.p, T.R, nu.head<3>(), nu.tail<3>()});
    boat_.step(actuators() + wind(T, nu), kStep, sea_.water(), sea_.current());
  }
  void run(double duration_s) {
    for (int i = 0; i < duration_s / kStep; ++i) step();
  }

  double x() const { return boat_.T_world_co().p.x(); }
  double y() const { return boat_.T_world_co().p.y(); }
  double heading() const { return boat_.T_world_co().rpy().z(); }
  double time_s() const { return boat_.time_s(); }
  const StandaloneVessel& boat() const { return boat_; }
  StandaloneVessel& boat() { return boat_; }
  control::VesselController& controller() { return controller_; }

 private:
  static constexpr double kStep = 0.01;

  Vector6d actuators() {
    const auto commands = controller_.commands();
    std::size_t next = thrusters_.size();
    for (std::size_t i = 0; i < thrusters_.size(); ++i) {
      thrusters_[i].command(commands[i]);
      if (thrusters_[i].params().max_angle > 0.0) thrusters_[i].command_angle(commands[next++]);
    }
    Vector6d tau = Vector6d::Zero();
    for (Thruster& thruster : thrusters_) {
      thruster.step(kStep);
      tau += thruster.wrench();
    }
    for (Rudder& rudder : rudders_) {
      rudder.command(commands[next++]);
      rudder.step(kStep);
      tau += rudder.wrench(boat_.nu(), 1025.0);
    }
    return tau;
  }
  Vector6d wind(const SE3& T, const Vector6d& nu) const {
    const Eigen::Vector3d apparent = T.R.conjugate() * wind_world_ - nu.head<3>();
    return wind_wrench(coefficients_, apparent);
  }

  StandaloneVessel boat_;
  Environment sea_;
  Eigen::Vector3d coefficients_, wind_world_ = Eigen::Vector3d::Zero();
  control::VesselController controller_;
  std::vector<Thruster> thrusters_;
  std::vector<Rudder> rudders_;
  std::int64_t step_ = 0;
};

inline control::VesselCommand follow(std::vector<Eigen::Vector2d> waypoints) {
  control::VesselCommand command;
  command.kind = control::VesselCommand::Kind::kPath;
  command.waypoints = std::move(waypoints);
  return command;
}
inline control::VesselCommand keep(double x, double y, double heading) {
  control::VesselCommand command;
  command.kind = control::VesselCommand::Kind::kStation;
  command.waypoints = {{x, y}};
  command.angle = heading;
  return command;
}
inline control::VesselCommand velocity(double speed, double rate) {
  control::VesselCommand command;
  command.speed = speed;
  command.rate = rate;
  return command;
}
inline control::VesselCommand towards(control::VesselCommand::Kind kind, double angle) {
  control::VesselCommand command;
  command.kind = kind;
  command.angle = angle;
  return command;
}

/// A current of `speed` towards `direction`.
inline EnvironmentParams uniform_current(double speed, double direction) {
  EnvironmentParams environment;
  environment.waves.spectrum = WaveSpectrum::kNone;
  environment.current.kind = CurrentKind::kUniform;
  environment.current.speed = speed;
  environment.current.direction = direction;
  return environment;
}

}  // namespace trident::sim
