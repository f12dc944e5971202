// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "core/plugins/plugin_util.h"
#include "trident_sim/commands.h"

namespace trident::sim {

/// Commands of both sides of a boat at once (heron_msgs/Drive). One with a number that is not
/// finite is refused, others are cut to [-1, 1]; both are counted among the world's diagnostics.
class DriveInput {
 public:
  DriveInput(const PluginContext& context, const std::string& topic);

  /// The newest legal command since the last call; none: nothing came.
  std::optional<DriveCommand> take(World& world);
  void reset();
  void state(StateArchive& archive) { archive(seen_); }

 private:
  std::string owner_, topic_;
  InHandle<DriveCommand> port_;
  std::uint64_t seen_ = 0;
};

}  // namespace trident::sim
