// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "simulated_robot.h"

#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/yaml_config.h"

namespace trident::benchmarks {
namespace {

SE3 planar(double x, double y, double yaw) { return SE3::from_xyz_rpy({x, y, 0.0}, 0.0, 0.0, yaw); }

double yaw_of(const SE3& T) {
  const Eigen::Vector3d ahead = T.R * Eigen::Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

double mean_position(const std::vector<const sim::Joint*>& joints) {
  double sum = 0.0;
  for (const sim::Joint* joint : joints) sum += joint->position();
  return sum / static_cast<double>(joints.size());
}

/// Where a sensor sits on a robot that stands level, from the model's own frame.
SE3 pose_of_sensor(const sim::Model& robot, const std::string& name) {
  for (const sim::LinkSpec& link : robot.spec.links) {
    for (const sim::SensorSpec& sensor : link.sensors) {
      if (sensor.name != name) continue;
      const SE3 T_world_link = robot.find_link(link.name)->T_world_link();
      return robot.T_world_model().inverse() * T_world_link * sensor.T_link_sensor;
    }
  }
  throw Error("lidar: the robot has no sensor " + name);
}

std::unique_ptr<sim::World> make_world(const TrialConfig& config, std::uint64_t seed,
                                       const sim::Resources& resources,
                                       sim::PluginRegistry& registry) {
  sim::register_builtin_plugins(registry);
  const sim::WorldSpec spec = sim::load_world_file(config.world, resources, {});
  sim::WorldOptions options;
  options.seed = seed;
  options.timing = sim::LoopTiming::kDirect;
  return std::make_unique<sim::World>(spec, resources, registry, options);
}

}  // namespace

SimulatedRobot::SimulatedRobot(const TrialConfig& config, std::uint64_t seed)
    : world_(make_world(config, seed, resources_, registry_)),
      odometry_(config.odometry, seed),
      odometry_period_s_(1.0 / config.odometry_rate_hz) {
  watch_obstacles(config.floor);
  sim::SpawnRequest request;
  request.name = config.robot_name;
  request.xml = read_config_file(config.robot);
  request.label = config.robot;
  request.T_world_model = planar(config.start[0], config.start[1], config.start[2]);
  robot_ = &world_->spawn(request);
  ports_.scan = &listen<sim::LaserScanSample>(config.scan_topic);
  ports_.imu = &listen<sim::ImuSample>(config.imu_topic);
  ports_.command = world_->ports().find_in<sim::TwistCommand>(config.command_topic);
  if (ports_.command == nullptr) {
    throw Error(config.robot + ": nothing takes velocities on " + config.command_topic);
  }
  T_base_laser_ = pose_of_sensor(*robot_, config.lidar);
  left_ = joints(config.odometry.left_joints);
  right_ = joints(config.odometry.right_joints);
}

SimulatedRobot::~SimulatedRobot() = default;

template <class T>
sim::OutPort<T>& SimulatedRobot::listen(const std::string& name) {
  auto* port = world_->ports().find_out<T>(name);
  if (port == nullptr) throw Error("the robot sends nothing of that type on " + name);
  port->add_listener();
  return *port;
}

std::vector<const sim::Joint*> SimulatedRobot::joints(const std::vector<std::string>& names) const {
  std::vector<const sim::Joint*> found;
  for (const std::string& name : names) {
    found.push_back(robot_->find_joint(name));
    if (found.back() == nullptr) throw Error("the robot has no joint " + name);
  }
  if (found.empty()) throw Error("odometry: a side has no joints, legal: one or more");
  return found;
}

/// Obstacles are watched instead of the robot, whose wheels are in contact with the floor always.
void SimulatedRobot::watch_obstacles(const std::string& floor) {
  for (const auto& [name, model] : world_->models()) {
    if (name == floor) continue;
    // The links of a static model share its shapes.
    for (const auto& link : model->links) {
      for (sim::Geom* geom : model->collision_shapes(*link)) geom->add_watcher();
      if (model->is_static) break;
    }
  }
}

void SimulatedRobot::step() {
  world_->step();
  read_gyro();
  // A quarter of a step is less than what times are rounded by.
  if (time_s() - seen_.encoders_s >= odometry_period_s_ - 0.25 * world_->dt().seconds())
    read_encoders();
}

void SimulatedRobot::read_gyro() {
  if (ports_.imu->count() == seen_.rates) return;
  seen_.rates = ports_.imu->count();
  odometry_.add_rate(ports_.imu->value.w_imu.z(), time_s() - seen_.gyro_s);
  seen_.gyro_s = time_s();
}

void SimulatedRobot::read_encoders() {
  odometry_.add_turns(mean_position(left_), mean_position(right_), time_s() - seen_.encoders_s);
  seen_.encoders_s = time_s();
}

void SimulatedRobot::command(const nav::Twist2& twist) {
  sim::TwistCommand command;
  command.v_base.x() = twist.vx;
  command.v_base.y() = twist.vy;
  command.w_base.z() = twist.wz;
  ports_.command->write(command);
}

std::optional<PlacedScan> SimulatedRobot::take_scan() {
  if (ports_.scan->count() == seen_.scans) return std::nullopt;
  seen_.scans = ports_.scan->count();
  const sim::LaserScanSample& sample = ports_.scan->value;
  PlacedScan placed;
  placed.scan.stamp_ns = sample.stamp.ns;
  placed.scan.angle_min = sample.angle_min_rad;
  placed.scan.angle_increment = sample.angle_increment_rad;
  placed.scan.time_increment = sample.time_increment_s;
  placed.scan.range_min = sample.range_min_m;
  placed.scan.range_max = sample.range_max_m;
  placed.scan.ranges = sample.ranges;
  const nav::Pose2& pose = odometry_.pose();
  // Robots on the ground do not tilt as far as their odometry knows.
  placed.T_odom_laser = planar(pose.x, pose.y, pose.yaw) * T_base_laser_;
  return placed;
}

nav::Pose2 SimulatedRobot::truth() const {
  const SE3 T = robot_->T_world_model();
  return {T.p.x(), T.p.y(), yaw_of(T)};
}

std::string SimulatedRobot::touched() const {
  const auto& contacts = world_->contacts();
  if (contacts.empty()) return "";
  return contacts.front().geom1->scoped_name() + ", " + contacts.front().geom2->scoped_name();
}

}  // namespace trident::benchmarks
