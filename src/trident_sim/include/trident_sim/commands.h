// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_base/sim_time.h"

namespace trident {

/// Something that is to be done once, a picture to be taken say (std_msgs/Empty on a topic).
struct TriggerCommand {
  SimTime stamp;  ///< not looked at: it acts in the next step
};

/// The same, asked for by a service without arguments (std_srvs/Empty).
struct ServiceCommand {
  SimTime stamp;  ///< not looked at: it acts in the next step
};

}  // namespace trident
