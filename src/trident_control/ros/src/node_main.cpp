// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_control_ros/node_main.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>
#include <vector>

#include "trident_base/error.h"
#include "trident_control_ros/controller_params.h"

namespace trident::control {
namespace {

using namespace std::chrono_literals;

constexpr auto kShutdownLimit = 800ms;
constexpr auto kLookAtRosEvery = 100ms;

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

// Takes the signals on a thread of its own: ros::init and the first registration may wait for a
// master for ever, and ros::shutdown may wait for one that has gone.
void shut_down_on_signal(std::atomic<bool>& has_ended) {
  const sigset_t signals = ending_signals();
  int signal = 0;
  sigwait(&signals, &signal);
  std::thread([&has_ended] {
    std::this_thread::sleep_for(kShutdownLimit);
    if (!has_ended) _exit(0);
  }).detach();
  ros::shutdown();
}

// With /use_sim_time, roscpp subscribes to /clock in every node: thousands of messages a second,
// through a thread of their own, for a node that never asks for the time. Its log takes the stamps
// of the odometry.
void init_without_clock(int argc, char** argv, const std::string& name) {
  std::string no_clock = "/clock:=/clock_not_used";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.push_back(no_clock.data());
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  ros::init(count, arguments.data(), name, ros::init_options::NoSigintHandler);
}

}  // namespace

void log_notes(const ros_utils::NodeParams& params) {
  for (const std::string& note : absent_notes(params)) ROS_WARN("%s", note.c_str());
  params.log_warnings();
}

void set_log_time(const ros::Time& stamp) {
  if (ros::Time::isSimTime()) ros::Time::setNow(stamp);
}

int run_node(int argc, char** argv, const std::string& name, const NodeFactory& make_node) {
  static std::atomic<bool> has_ended{false};
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals,
                  nullptr);  // before any thread exists, so that all inherit it
  std::thread(shut_down_on_signal, std::ref(has_ended)).detach();

  init_without_clock(argc, argv, name);
  ros::NodeHandle node;  // outlives the catch: logging ends with the last handle
  int result = 0;
  try {
    ros_utils::NodeParams params(ros::NodeHandle("~"));
    const std::unique_ptr<RunningNode> running = make_node(node, params);
    log_notes(params);
    while (ros::ok()) running->spin_once(kLookAtRosEvery);
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    result = 1;
  }
  ros::shutdown();
  has_ended = true;
  return result;
}

}  // namespace trident::control
