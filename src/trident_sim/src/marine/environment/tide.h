// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/yaml_config.h"

namespace trident::sim {

/// How the level of the still water moves: rate t + amplitude sin(2 pi t / period + phase), by
/// default with the period of the moon's main tide, M2.
struct TideParams {
  double amplitude = 0.0;
  double period = 44714.16;
  double phase = 0.0;
  double rate = 0.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("amplitude", amplitude, Range{0.0, 20.0}, "half of the range [m]");
    ar.field("period", period, Range::positive(), "12.42 h is M2's [s]");
    ar.field("phase", phase, Range{-6.3, 6.3}, "at time 0; 0: the water rises from its mean [rad]");
    ar.field("rate", rate, Range{-1.0, 1.0}, "constant rise besides [m/s]");
  }

  /// Above the mean level [m].
  double level_m(double time_s) const {
    double level = rate * time_s;
    if (amplitude > 0.0) level += amplitude * std::sin(2.0 * kPi * time_s / period + phase);
    return level;
  }
};

}  // namespace trident::sim
