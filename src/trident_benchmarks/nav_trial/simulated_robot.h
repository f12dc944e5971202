// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odometry.h"
#include "trial_config.h"
#include "trident_base/laser_scan.h"
#include "trident_base/random_stream.h"
#include "trident_base/se2.h"
#include "trident_nav/core/geometry.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/resources.h"
#include "trident_sim/world.h"

namespace trident::benchmarks {

class WheelOdometry;

/// A scan, and where its laser was as odometry has it.
struct PlacedScan {
  LaserScan scan;
  SE3 T_odom_laser;      ///< At the first beam.
  SE3 T_odom_laser_end;  ///< At the last one.
  SE2 T_odom_base;       ///< At the first beam.
  SE2 T_start_end;       ///< The robot's motion from the first beam to the last one.

  /// The laser's poses from the first beam to the last; one where all beams are of one time.
  std::vector<SE3> laser_poses() const;
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

  const Odometry& odometry() const { return *odometry_; }
  /// When odometry was last computed.
  double odometry_time_s() const { return seen_.odometry_s; }
  /// The newest scan, once, as soon as odometry says where all of it was taken.
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
  void listen_to_odometry(const TrialConfig& config, std::uint64_t seed);
  void read_drive();
  void read_gyro();
  void read_encoders();
  void receive_scan();
  PlacedScan placed(LaserScan scan) const;

  sim::PluginRegistry registry_;
  sim::Resources resources_;
  std::unique_ptr<sim::World> world_;
  sim::Model* robot_ = nullptr;
  struct Ports {
    sim::OutPort<sim::LaserScanSample>* scan = nullptr;
    sim::OutPort<sim::ImuSample>* imu = nullptr;
    sim::OutPort<sim::OdometrySample>* drive = nullptr;
    sim::InPort<sim::TwistCommand>* command = nullptr;
  };
  Ports ports_;
  SE3 T_base_laser_;
  std::vector<const sim::Joint*> left_, right_;
  /// One of the two; `odometry_` is it.
  std::unique_ptr<WheelOdometry> wheels_;
  std::unique_ptr<DriftingOdometry> drifting_;
  Odometry* odometry_ = nullptr;
  PoseHistory history_;
  double odometry_period_s_;
  /// When each was last read, and how many of each have been.
  struct Seen {
    double odometry_s = 0.0, gyro_s = 0.0;
    std::uint64_t scans = 0, rates = 0, drives = 0;
  };
  Seen seen_;
  struct Ranging {
    RandomStream random;
    std::array<double, 2> noise;
    std::optional<LaserScan> waiting;  ///< For odometry.
  };
  Ranging ranging_;
};

}  // namespace trident::benchmarks
