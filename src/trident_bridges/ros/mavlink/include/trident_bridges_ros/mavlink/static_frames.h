// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tf2_msgs/TFMessage.h>

#include <map>
#include <optional>
#include <string>

#include "trident_base/se3.h"

namespace trident::bridges {

/// Frames that never move, from /tf_static: where in the world a vehicle's odometry counts from.
class StaticFrames {
 public:
  /// `world`: name of the frame of the world.
  explicit StaticFrames(std::string world) : world_(std::move(world)) {}
  /// Takes over what a message has; returns what was wrong with a transform, empty: nothing.
  std::string add(const tf2_msgs::TFMessage& message);
  /// Coordinates of `frame` to those of the world; nullopt: nothing leads there yet.
  std::optional<SE3> world_from(const std::string& frame) const;
  /// Name of the frame of the world.
  const std::string& world() const { return world_; }

 private:
  bool is_world(const std::string& frame) const;

  struct Link {
    std::string parent;
    SE3 T_parent_child;
  };
  std::string world_;
  std::map<std::string, Link> parents_;
};

}  // namespace trident::bridges
