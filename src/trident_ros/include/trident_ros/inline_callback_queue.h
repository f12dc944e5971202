// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/callback_queue_interface.h>

namespace trident::ros_utils {

/// Runs a callback where roscpp hands it in, on its socket thread, instead of waking a second
/// thread. All subscriptions of one node that use it are served by that one thread, so their
/// callbacks never overlap. A callback must be short, and must not (un)subscribe or shut down.
class InlineCallbackQueue : public ros::CallbackQueueInterface {
 public:
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t) override {
    callback->call();
  }
  /// Nothing ever waits here.
  void removeByID(std::uint64_t) override {}
};

}  // namespace trident::ros_utils
