// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "simulated_robot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "wheel_odometry.h"

namespace trident::benchmarks {
namespace {

SE3 planar(double x, double y, double yaw) { return SE3::from_xyz_rpy({x, y, 0.0}, 0.0, 0.0, yaw); }

double yaw_of(const SE3& T) {
  const Eigen::Vector3d ahead = T.R * Eigen::Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

// Times of steps are rounded to nanoseconds.
constexpr double kOdometrySlack_s = 1e-6;

/// When the last beam was taken.
double end_of(const LaserScan& scan) {
  return 1e-9 * static_cast<double>(scan.stamp_ns) +
         scan.time_increment * static_cast<double>(scan.size() - 1);
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
      odometry_period_s_(1.0 / config.odometry_rate_hz),
      ranging_{RandomStream(seed, "lidar_range_noise"), config.range_noise, std::nullopt} {
  watch_obstacles(config.floor);
  sim::SpawnRequest request;
  request.name = config.robot_name;
  request.xml = read_config_file(config.robot);
  request.label = config.robot;
  request.T_world_model = planar(config.start[0], config.start[1], config.start[2]);
  robot_ = &world_->spawn(request);
  ports_.scan = &listen<sim::LaserScanSample>(config.scan_topic);
  ports_.command = world_->ports().find_in<sim::TwistCommand>(config.command_topic);
  if (ports_.command == nullptr) {
    throw Error(config.robot + ": nothing takes velocities on " + config.command_topic);
  }
  T_base_laser_ = pose_of_sensor(*robot_, config.lidar);
  listen_to_odometry(config, seed);
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

void SimulatedRobot::listen_to_odometry(const TrialConfig& config, std::uint64_t seed) {
  if (!config.odometry.topic.empty()) {
    ports_.drive = &listen<sim::OdometrySample>(config.odometry.topic);
    drifting_ = std::make_unique<DriftingOdometry>(config.odometry, seed);
    odometry_ = drifting_.get();
    return;
  }
  ports_.imu = &listen<sim::ImuSample>(config.imu_topic);
  left_ = joints(config.odometry.left_joints);
  right_ = joints(config.odometry.right_joints);
  wheels_ = std::make_unique<WheelOdometry>(config.odometry, seed);
  odometry_ = wheels_.get();
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
  if (drifting_) {
    read_drive();
  } else {
    read_gyro();
    // A quarter of a step is less than what times are rounded by.
    const double slack_s = 0.25 * world_->dt().seconds();
    if (time_s() - seen_.odometry_s >= odometry_period_s_ - slack_s) read_encoders();
  }
  receive_scan();
}

void SimulatedRobot::read_drive() {
  if (ports_.drive->count() == seen_.drives) return;
  seen_.drives = ports_.drive->count();
  const sim::OdometrySample& sample = ports_.drive->value;
  drifting_->add(SE2::projected(sample.T_parent_child),
                 {sample.v_child.x(), sample.v_child.y(), sample.w_child.z()});
  seen_.odometry_s = sample.stamp.seconds();
  history_.add(seen_.odometry_s, odometry_->pose());
}

void SimulatedRobot::read_gyro() {
  if (ports_.imu->count() == seen_.rates) return;
  seen_.rates = ports_.imu->count();
  wheels_->add_rate(ports_.imu->value.w_imu.z(), time_s() - seen_.gyro_s);
  seen_.gyro_s = time_s();
}

void SimulatedRobot::read_encoders() {
  wheels_->add_turns(mean_position(left_), mean_position(right_), time_s() - seen_.odometry_s);
  seen_.odometry_s = time_s();
  history_.add(seen_.odometry_s, odometry_->pose());
}

void SimulatedRobot::command(const nav::Twist2& twist) {
  sim::TwistCommand command;
  command.v_base.x() = twist.vx;
  command.v_base.y() = twist.vy;
  command.w_base.z() = twist.wz;
  ports_.command->write(command);
}

void SimulatedRobot::receive_scan() {
  if (ports_.scan->count() == seen_.scans) return;
  seen_.scans = ports_.scan->count();
  const sim::LaserScanSample& sample = ports_.scan->value;
  LaserScan scan;
  scan.stamp_ns = sample.stamp.ns;
  scan.angle_min = sample.angle_min_rad;
  scan.angle_increment = sample.angle_increment_rad;
  scan.time_increment = sample.time_increment_s;
  scan.range_min = sample.range_min_m;
  scan.range_max = sample.range_max_m;
  scan.T_base_laser = SE2::projected(T_base_laser_);
  scan.ranges = sample.ranges;
  const auto [floor_m, part] = ranging_.noise;
  for (std::size_t i = 0; i < scan.size() && floor_m + part > 0.0; ++i) {
    const double range = static_cast<double>(scan.ranges[i]);
    if (!std::isfinite(range)) continue;
    const double spread_m = std::max(floor_m, part * range);
    const double drawn = ranging_.random.normal(seen_.scans, static_cast<std::uint32_t>(i));
    scan.ranges[i] = static_cast<float>(range + spread_m * drawn);
  }
  ranging_.waiting = std::move(scan);
}

std::optional<PlacedScan> SimulatedRobot::take_scan() {
  if (!ranging_.waiting || history_.is_empty()) return std::nullopt;
  const LaserScan& scan = *ranging_.waiting;
  // Robots stand before their first odometry.
  if (end_of(scan) > history_.newest_s() + kOdometrySlack_s) return std::nullopt;
  PlacedScan result = placed(std::move(*ranging_.waiting));
  ranging_.waiting.reset();
  return result;
}

PlacedScan SimulatedRobot::placed(LaserScan scan) const {
  PlacedScan result;
  const SE2 T_odom_end = history_.at(end_of(scan));
  result.T_odom_base = history_.at(1e-9 * static_cast<double>(scan.stamp_ns));
  result.T_start_end = result.T_odom_base.inverse() * T_odom_end;
  // Robots on the ground do not tilt as far as their odometry knows.
  result.T_odom_laser = result.T_odom_base.to_se3() * T_base_laser_;
  result.T_odom_laser_end = T_odom_end.to_se3() * T_base_laser_;
  result.scan = std::move(scan);
  return result;
}

std::vector<SE3> PlacedScan::laser_poses() const {
  if (scan.time_increment == 0.0) return {T_odom_laser};
  return {T_odom_laser, T_odom_laser_end};
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
