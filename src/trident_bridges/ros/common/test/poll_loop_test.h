// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "trident_bridges_ros/node_poll_loop.h"

namespace trident::bridges {

/// A node whose loop runs while a test waits.
class PollLoopTest : public testing::Test {
 protected:
  /// Whether a condition holds within a minute.
  bool spin(const std::function<bool()>& condition) {
    const double limit_s = loop_.loop().now_s() + 60.0;
    while (!condition() && loop_.loop().now_s() < limit_s) loop_.run_once(0.01);
    return condition();
  }

  ros::NodeHandle node_;
  NodePollLoop loop_;
};

}  // namespace trident::bridges
