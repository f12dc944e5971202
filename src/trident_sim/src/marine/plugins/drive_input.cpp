// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "drive_input.h"

#include <algorithm>
#include <cmath>

#include "trident_base/string_util.h"

namespace trident::sim {

DriveInput::DriveInput(const PluginContext& context, const std::string& topic)
    : owner_(context.params.owner()),
      topic_(topic),
      port_(subscribe<DriveCommand>(context, topic)) {}

std::optional<DriveCommand> DriveInput::take(World& world) {
  std::optional<DriveCommand> newest;
  for (seen_ = std::max(seen_, port_->oldest()); seen_ < port_->count(); ++seen_) {
    const DriveCommand command = port_->at(seen_);
    const std::string given = number_text(command.left) + ", " + number_text(command.right);
    if (!std::isfinite(command.left + command.right)) {
      world.diagnose(
          {Severity::kError,
           owner_,
           "drive command refused",
           topic_ + ": " + given + " is refused, the last good one stays; legal is [-1, 1]",
           {{"value", given}, {"legal", "[-1, 1]"}}});
      continue;
    }
    newest = command;
    newest->left = std::clamp(command.left, -1.0, 1.0);
    newest->right = std::clamp(command.right, -1.0, 1.0);
    if (newest->left != command.left || newest->right != command.right) {
      world.diagnose({Severity::kWarning,
                      owner_,
                      "drive command clamped",
                      topic_ + ": " + given + " is cut to the nearest; legal is [-1, 1]",
                      {{"value", given}, {"legal", "[-1, 1]"}}});
    }
  }
  return newest;
}

void DriveInput::reset() {
  port_->clear();
  seen_ = 0;
}

}  // namespace trident::sim
