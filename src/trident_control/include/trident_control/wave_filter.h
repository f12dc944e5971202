// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "trident_control/vessel_model.h"

namespace trident::control {

/// Takes the motion that waves make out of a vessel's state, so that thrusters do not fight it: a
/// notch (s^2 + 2 a w s + w^2) / (s + w)^2, a = 0.1, about the frequency w of the waves, on each
/// quantity (Fossen 2011, 11.1). Below a fifth of w it costs less than 20 degrees of phase.
class WaveFilter {
 public:
  /// 0: the state passes as it is.
  explicit WaveFilter(double frequency) : frequency_(frequency) {}

  void reset() { is_started_ = false; }  ///< the next state passes as it is
  /// The state without motion near the waves' frequency. `dt_s`: since the state before.
  VesselState filter(const VesselState& state, double dt_s);

 private:
  /// In the form of two lags in a row: y = x - 2 (1 - a) (first - second), which needs no
  /// derivative and holds at any step.
  struct Notch {
    double first = 0.0, second = 0.0;
    double step(double x, double decay, double angle);
  };

  double frequency_;
  std::array<Notch, 6> notches_;
  double heading_ = 0.0;  // counts turns
  bool is_started_ = false;
};

}  // namespace trident::control
