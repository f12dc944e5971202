// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gazebo_msgs/DeleteModel.h>
#include <gazebo_msgs/GetWorldProperties.h>
#include <gazebo_msgs/SetModelConfiguration.h>
#include <gazebo_msgs/SpawnModel.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <thread>

#include "spawn_options.h"

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
using trident::sim::ModelSource;
using trident::sim::SpawnOptions;

// All waiting is on the wall clock: simulated time may stand still, or run a thousand times faster.
constexpr auto kPollPeriod = 20ms;
constexpr auto kNoticePeriod = 10s;

volatile std::sig_atomic_t g_must_end = 0;
void on_signal(int) { g_must_end = 1; }
bool must_end() { return g_must_end != 0 || !ros::ok(); }

struct Interrupted {};

/// Polls until `is_there`; says every 10 s what it waits for. Throws Interrupted on a signal.
template <typename Predicate>
void wait_until(const std::string& what, const Predicate& is_there) {
  auto notice = Clock::now() + kNoticePeriod;
  while (!is_there()) {
    if (must_end()) throw Interrupted{};
    if (Clock::now() >= notice) {
      ROS_WARN("spawn_model: still waiting for %s", what.c_str());
      notice += kNoticePeriod;
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
}

/// Waits for the service, then calls it. Throws std::runtime_error when the call breaks off.
template <typename Service>
void call(const std::string& name, Service& service) {
  wait_until("service " + name, [&] { return ros::service::exists(name, false); });
  if (!ros::service::call(name, service)) {
    throw std::runtime_error("the call of service " + name +
                             " broke off: the simulator ended or refused it");
  }
}

template <typename Service>
void call_and_expect_success(const std::string& name, Service& service) {
  call(name, service);
  if (!service.response.success) throw std::runtime_error(service.response.status_message);
}

std::string read_all(std::istream& in) {
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string read_standard_input() {
  std::string xml = read_all(std::cin);
  if (xml.empty()) throw std::runtime_error("there is no text on standard input");
  return xml;
}

std::string read_file(const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error("file '" + name + "' does not exist or cannot be read");
  std::string xml = read_all(file);
  if (xml.empty()) throw std::runtime_error("file '" + name + "' is empty");
  return xml;
}

std::string read_param(const std::string& name) {
  const std::string resolved = ros::names::resolve(name);
  std::string xml;
  if (!ros::param::get(resolved, xml)) {
    throw std::runtime_error("parameter '" + resolved + "' is not set, or is not a string");
  }
  if (xml.empty()) throw std::runtime_error("parameter '" + resolved + "' is empty");
  return xml;
}

std::string read_source(const SpawnOptions& options) {
  if (options.source == ModelSource::standard_input) return read_standard_input();
  if (options.source == ModelSource::file) return read_file(options.source_name);
  return read_param(options.source_name);
}

std::string model_xml(const SpawnOptions& options) {
  if (options.source == ModelSource::database) {
    return trident::sim::database_model_sdf(options.source_name);
  }
  std::string xml = read_source(options);
  return options.package_to_model ? trident::sim::meshes_from_package_to_model(xml) : xml;
}

geometry_msgs::Pose initial_pose(const SpawnOptions& o) {
  const double cr = std::cos(o.roll / 2), sr = std::sin(o.roll / 2);
  const double cp = std::cos(o.pitch / 2), sp = std::sin(o.pitch / 2);
  const double cy = std::cos(o.yaw / 2), sy = std::sin(o.yaw / 2);
  geometry_msgs::Pose pose;
  pose.position.x = o.x;
  pose.position.y = o.y;
  pose.position.z = o.z;
  // Rz(yaw) Ry(pitch) Rx(roll)
  pose.orientation.w = cy * cp * cr + sy * sp * sr;
  pose.orientation.x = cy * cp * sr - sy * sp * cr;
  pose.orientation.y = cy * sp * cr + sy * cp * sr;
  pose.orientation.z = sy * cp * cr - cy * sp * sr;
  return pose;
}

void wait_for_model(const SpawnOptions& options) {
  if (options.wait_for_model.empty()) return;
  const std::string service = options.gazebo_namespace + "/get_world_properties";
  wait_until("model " + options.wait_for_model, [&] {
    gazebo_msgs::GetWorldProperties world;
    call(service, world);
    const auto& names = world.response.model_names;
    return std::find(names.begin(), names.end(), options.wait_for_model) != names.end();
  });
}

void spawn(const SpawnOptions& options) {
  gazebo_msgs::SpawnModel model;
  model.request.model_name = options.model_name;
  model.request.model_xml = model_xml(options);
  model.request.robot_namespace = options.robot_namespace.value_or(ros::this_node::getNamespace());
  model.request.initial_pose = initial_pose(options);
  model.request.reference_frame = options.reference_frame;
  const char* const service =
      options.format == trident::sim::ModelFormat::urdf ? "/spawn_urdf_model" : "/spawn_sdf_model";
  call_and_expect_success(options.gazebo_namespace + service, model);
  ROS_INFO("%s", model.response.status_message.c_str());
}

void set_joints(const SpawnOptions& options) {
  if (options.joint_positions.empty()) return;
  gazebo_msgs::SetModelConfiguration configuration;
  configuration.request.model_name = options.model_name;
  if (options.source == ModelSource::parameter)
    configuration.request.urdf_param_name = options.source_name;
  for (const auto& [joint, position] : options.joint_positions) {
    configuration.request.joint_names.push_back(joint);
    configuration.request.joint_positions.push_back(position);
  }
  call_and_expect_success(options.gazebo_namespace + "/set_model_configuration", configuration);
}

void stay_then_delete(const SpawnOptions& options) {
  while (!must_end()) std::this_thread::sleep_for(kPollPeriod);
  gazebo_msgs::DeleteModel model;
  model.request.model_name = options.model_name;
  // The simulator may have gone first; then there is nothing to delete.
  ros::service::call(options.gazebo_namespace + "/delete_model", model);
}

void run(const SpawnOptions& options) {
  wait_for_model(options);
  spawn(options);
  set_joints(options);
  if (options.unpause) {
    std_srvs::Empty unpause;
    call(options.gazebo_namespace + "/unpause_physics", unpause);
  }
  if (options.delete_on_exit) stay_then_delete(options);
}

/// ros::init without the parts that a process of a tenth of a second does not need: /clock,
/// /rosout, and roscpp's handler for SIGINT, under which the last service call of -b would fail.
void init_ros(int argc, char** argv) {
  std::string no_clock = "/clock:=/clock_not_used";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.push_back(no_clock.data());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  ros::init(count, arguments.data(), "spawn_model",
            ros::init_options::NoSigintHandler | ros::init_options::NoRosout |
                ros::init_options::AnonymousName);
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  SpawnOptions options;
  try {
    options = trident::sim::parse_spawn_options({words.begin() + 1, words.end()});
  } catch (const std::invalid_argument& error) {
    std::cerr << "spawn_model: " << error.what() << "\n";
    return 1;
  }
  if (options.help) {
    std::cout << trident::sim::kSpawnUsage;
    return 0;
  }
  init_ros(argc, argv);
  const ros::NodeHandle keeps_ros_running;  // logging ends with the last one
  try {
    run(options);
  } catch (const Interrupted&) {
    return 1;
  } catch (const std::runtime_error& error) {
    ROS_ERROR("spawn_model: model '%s': %s", options.model_name.c_str(), error.what());
    return 1;
  }
  return 0;
}
