// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/node_poll_loop.h"

#include <chrono>

namespace trident::bridges {
namespace {

using namespace std::chrono_literals;

// Nothing wakes the loop when roscpp shuts down by a signal.
constexpr double kLookAtRos_s = 0.1;

}  // namespace

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

void NodePollLoop::run() {
  while (ros::ok() && loop_.run_once(kLookAtRos_s)) {
  }
}

}  // namespace trident::bridges
