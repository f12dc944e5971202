// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// What is to be different from the next step on, as YAML (std_msgs/String). All of them reach
/// their plugin, in order.
struct TextCommand {
  SimTime stamp;     ///< not looked at
  std::string text;  ///< YAML; its keys are documented with the plugin
};

/// What a world's surroundings are like, as the YAML of config/environments
/// (trident_msgs/EnvironmentState). Latched: who comes later gets the newest.
struct EnvironmentSample {
  SimTime stamp;     ///< when it began to hold
  std::string yaml;  ///< complete: it can be given to a world as it is
};

/// A number as std_msgs/Float64, where ScalarSample is a Float32.
struct NumberSample {
  SimTime stamp;       ///< of a measurement; a command's is not looked at
  double value = 0.0;  ///< in the unit that the plugin documents
};

/// What an anemometer measures, as NMEA 0183's MWV has it.
struct WindReadingSample {
  SimTime stamp;           ///< of the state that was measured
  std::string frame;       ///< of the anemometer
  bool is_true = false;    ///< else as the sensor feels it while it moves
  double speed_m_s = 0.0;  ///< >= 0
  double angle_rad = 0.0;  ///< where it comes from, from the frame's x clockwise, [0, 2 pi)
};

}  // namespace trident::sim
