// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// controller_round_trip SECONDS NAMESPACE=PID...: sends `odometry` in each namespace, waits for
// every `command/motor_speed` of its stamp, sends the next: lockstep without a simulator. Prints
// steps per second and the CPU time per message of the controller processes PID.
#include <mav_msgs/Actuators.h>
#include <nav_msgs/Odometry.h>
#include <ros/poll_manager.h>
#include <ros/ros.h>
#include <time.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "trident_base/span.h"
#include "trident_ros/direct_publication.h"
#include "trident_ros/inline_callback_queue.h"
#include "trident_ros/subscriptions.h"

namespace {

using namespace std::chrono_literals;

double cpu_seconds(int pid) {
  clockid_t clock;
  timespec time{};
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0.0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Lockstep {
 public:
  explicit Lockstep(const std::vector<std::string>& name_spaces) {
    message_.header.frame_id = "world";
    message_.child_frame_id = "UAV1/odometry_sensor1";
    message_.pose.pose.orientation.w = 1.0;
    for (const std::string& name_space : name_spaces) {
      ros::NodeHandle node(name_space);
      publishers_.push_back(node.advertise<nav_msgs::Odometry>("odometry", 1));
      publications_.emplace_back(publishers_.back());
      auto options = trident::ros_utils::raw_subscription<mav_msgs::Actuators>(
          "command/motor_speed", 1,
          [this](trident::Span<const std::uint8_t> bytes) { on_answer(bytes); }, &queue_);
      subscribers_.push_back(node.subscribe(options));
    }
    // send() belongs on the socket thread, which calls this after every poll.
    ros::PollManager::instance()->addPollThreadListener([this] {
      if (start_requested.exchange(false)) send();
    });
  }

  bool is_connected() const {
    for (std::size_t i = 0; i < publishers_.size(); ++i) {
      if (publishers_[i].getNumSubscribers() == 0 || subscribers_[i].getNumPublishers() == 0)
        return false;
    }
    return true;
  }
  std::atomic<long> steps{0};
  std::atomic<bool> start_requested{false};

 private:
  void send() {
    message_.header.stamp += ros::Duration(0, 10'000'000);
    open_ = publications_.size();
    const auto serialized = ros::serialization::serializeMessage(message_);
    for (auto& publication : publications_)
      publication.send({serialized.buf.get(), serialized.num_bytes});
  }
  void on_answer(trident::Span<const std::uint8_t> bytes) {
    std::uint32_t stamp[2];
    std::memcpy(stamp, bytes.data() + 4, sizeof(stamp));
    if (ros::Time(stamp[0], stamp[1]) != message_.header.stamp || --open_ > 0) return;
    ++steps;
    send();
  }

  trident::ros_utils::InlineCallbackQueue queue_;
  nav_msgs::Odometry message_;
  std::size_t open_ = 0;
  std::vector<ros::Publisher> publishers_;
  std::vector<trident::ros_utils::DirectPublication> publications_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "controller_round_trip", ros::init_options::AnonymousName);
  std::vector<std::string> name_spaces;
  std::vector<int> pids;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    const auto split = argument.find('=');
    if (split == std::string::npos) continue;
    name_spaces.push_back(argument.substr(0, split));
    pids.push_back(std::atoi(argument.c_str() + split + 1));
  }
  if (name_spaces.empty()) {
    std::fprintf(stderr, "usage: controller_round_trip SECONDS NAMESPACE=PID...\n");
    return 2;
  }
  const ros::NodeHandle keeps_ros_running;
  Lockstep lockstep(name_spaces);
  while (ros::ok() && !lockstep.is_connected()) std::this_thread::sleep_for(10ms);
  std::this_thread::sleep_for(300ms);
  lockstep.start_requested = true;
  std::this_thread::sleep_for(200ms);

  const auto cpu = [&] {
    double sum = 0.0;
    for (const int pid : pids) sum += cpu_seconds(pid);
    return sum;
  };
  const double cpu_before = cpu(), own_before = cpu_seconds(0);
  const long before = lockstep.steps;
  const auto begin = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(std::chrono::duration<double>(std::atof(argv[1])));
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double steps = static_cast<double>(lockstep.steps - before);
  const double messages = steps * static_cast<double>(pids.size());
  std::printf(
      "%zu controllers: %.0f steps/s, %.1f us per step, CPU per message: controller %.2f us, "
      "sender %.2f us\n",
      pids.size(), steps / wall, 1e6 * wall / steps, 1e6 * (cpu() - cpu_before) / messages,
      1e6 * (cpu_seconds(0) - own_before) / messages);
  return steps > 0 ? 0 : 1;
}
