// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "trident_base/sim_time.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {

/// A message of a robot's topic that others are to hear.
struct RelayMessage {
  SimTime born;                             ///< from which its age is counted
  std::shared_ptr<const std::string> data;  ///< never nullptr
};

}  // namespace trident::sim
