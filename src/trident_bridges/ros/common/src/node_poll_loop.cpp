// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/node_poll_loop.h"

#include <rosgraph_msgs/Clock.h>

#include <chrono>
#include <utility>
#include <vector>

namespace trident::bridges {
namespace {

using namespace std::chrono_literals;

// Nothing wakes the loop when roscpp shuts down by a signal.
constexpr double kLookAtRos_s = 0.1;

// Names are remapped once: roscpp's /clock is a topic that nobody publishes, and this is /clock.
constexpr const char* kClock = "/clock_of_the_loop";

}  // namespace

void init_node(int argc, char** argv, const std::string& name) {
  std::string no_clock = "/clock:=/clock_not_used";
  std::string own_clock = std::string(kClock) + ":=/clock";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.insert(arguments.end(), {no_clock.data(), own_clock.data()});
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  ros::init(count, arguments.data(), name);
}

void NodePollLoop::Queue::addCallback(const ros::CallbackInterfacePtr& callback,
                                      std::uint64_t owner) {
  CallbackQueue::addCallback(callback, owner);
  loop_.post([this] { callAvailable(); });
}

NodePollLoop::NodePollLoop() : queue_(loop_) {
  loop_.watch(inbox_.descriptor(), PollLoop::kReadable, [this](std::uint32_t) {
    if (inbox_.wait(0ms)) inbox_.read();
  });
}

NodePollLoop::~NodePollLoop() { loop_.forget(inbox_.descriptor()); }

bool NodePollLoop::follow_clock(ros::NodeHandle& node,
                                std::function<void(const ros::Time&)> handler) {
  if (!ros::Time::isSimTime()) return false;
  clock_ = subscribe<rosgraph_msgs::Clock>(
      node, kClock, 1, [handler = std::move(handler)](const rosgraph_msgs::Clock& message) {
        ros::Time::setNow(message.clock);
        handler(message.clock);
      });
  return true;
}

void NodePollLoop::warn_of_unreadable(const std::string& topic, std::size_t bytes) {
  ROS_WARN_THROTTLE(5.0, "%s: %zu bytes are not a message of its type; ignored", topic.c_str(),
                    bytes);
}

void NodePollLoop::run() {
  while (ros::ok() && loop_.run_once(kLookAtRos_s)) {
  }
}

}  // namespace trident::bridges
