// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trial_config.h"
#include "trident_base/laser_scan.h"
#include "trident_nav/core/geometry.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/resources.h"
#include "trident_sim/world.h"
#include "wheel_odometry.h"

namespace trident::benchmarks {

/// A scan, and where its laser was as odometry has it.
struct PlacedScan {
  LaserScan scan;
  SE3 T_odom_laser;
};

/// A robot in a simulated world with what it measures, stepped in one thread.
class SimulatedRobot {
 public:
  /// Loads the world and puts the robot at its start. Throws Error naming file, port or joint.
  SimulatedRobot(const TrialConfig& config, std::uint64_t seed);
  ~SimulatedRobot();
  SimulatedRobot(const SimulatedRobot&) = delete;
  SimulatedRobot& operator=(const SimulatedRobot&) = delete;

  double time_s() const { return world_->time().seconds(); }
  /// One step of the physics. Whatever is measured at its end is then in odometry and scan.
  void step();
  void command(const nav::Twist2& twist);

  const WheelOdometry& odometry() const { return odometry_; }
  /// When odometry was last computed.
  double odometry_time_s() const { return seen_.encoders_s; }
  /// The newest scan, once.
  std::optional<PlacedScan> take_scan();
  /// Where the robot is in the world.
  nav::Pose2 truth() const;
  /// The world itself, for those who put other things into it.
  sim::World& world() { return *world_; }
  /// The robot in it.
  const sim::Model& model() const { return *robot_; }
  /// What the robot touches but the floor: "model::link::collision" of both; empty: nothing.
  std::string touched() const;

 private:
  template <class T>
  sim::OutPort<T>& listen(const std::string& name);
  std::vector<const sim::Joint*> joints(const std::vector<std::string>& names) const;
  void watch_obstacles(const std::string& floor);
  void read_gyro();
  void read_encoders();

  sim::PluginRegistry registry_;
  sim::Resources resources_;
  std::unique_ptr<sim::World> world_;
  sim::Model* robot_ = nullptr;
  struct Ports {
    sim::OutPort<sim::LaserScanSample>* scan = nullptr;
    sim::OutPort<sim::ImuSample>* imu = nullptr;
    sim::InPort<sim::TwistCommand>* command = nullptr;
  };
  Ports ports_;
  SE3 T_base_laser_;
  std::vector<const sim::Joint*> left_, right_;
  WheelOdometry odometry_;
  double odometry_period_s_;
  /// When each was last read, and how many of each have been.
  struct Seen {
    double encoders_s = 0.0, gyro_s = 0.0;
    std::uint64_t scans = 0, rates = 0;
  };
  Seen seen_;
};

}  // namespace trident::benchmarks
