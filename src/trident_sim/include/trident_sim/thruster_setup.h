// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// How a thruster of uuv_simulator stands, and how it makes a thrust of its state: what the
/// services of that name return.
struct ThrusterSetup {
  SimTime stamp;                          ///< when it began to hold
  bool is_on = true;                      ///< else its input is taken for 0
  double thrust_efficiency = 1.0;         ///< of the thrust, [0, 1]
  double dynamic_state_efficiency = 1.0;  ///< of the state, [0, 1]
  std::string conversion;                 ///< Basic, Bessa, LinearInterp
  std::vector<std::string> tags;          ///< names of `data`
  std::vector<double> data;               ///< parameters of the conversion
  std::vector<double> inputs, outputs;    ///< LinearInterp's table [N]
};

/// What is to be different from the next step on; what is not given stays. Efficiencies outside of
/// [0, 1] are not taken.
struct ThrusterChange {
  SimTime stamp;              ///< not looked at
  std::optional<bool> is_on;  ///< false: the thruster takes its input for 0
  /// In [0, 1], others are not taken.
  std::optional<double> thrust_efficiency, dynamic_state_efficiency;
};

/// False for NaN, too.
inline bool is_efficiency(double value) { return value >= 0.0 && value <= 1.0; }

/// Changes of `setup` what is given and legal; the rest stays.
inline void apply(const ThrusterChange& change, ThrusterSetup* setup) {
  const auto take = [](const std::optional<double>& given, double* value) {
    if (given && is_efficiency(*given)) *value = *given;
  };
  if (change.is_on) setup->is_on = *change.is_on;
  take(change.thrust_efficiency, &setup->thrust_efficiency);
  take(change.dynamic_state_efficiency, &setup->dynamic_state_efficiency);
}

/// Yes or no on a topic (std_msgs/Bool).
struct FlagSample {
  SimTime stamp;       ///< of a measurement; a command's is not looked at
  bool value = false;  ///< its meaning is the port's
};

}  // namespace trident::sim
