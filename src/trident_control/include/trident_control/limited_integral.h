// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::control {

/// An integral that does not wind up: it stands still while the actuators give less than they are
/// asked for, unless it moves to ask for less (conditional integration).
class LimitedIntegral {
 public:
  /// `gain_error`: what grows per second; `shortfall`: asked for less given, of the last step.
  void add(double gain_error, double dt_s, double shortfall, double tolerance) {
    const bool is_short = shortfall > tolerance || shortfall < -tolerance;
    if (is_short && gain_error * shortfall > 0.0) return;
    value_ += gain_error * dt_s;
  }
  double value() const { return value_; }             ///< within the limits
  void reset(double value = 0.0) { value_ = value; }  ///< continues from `value`

 private:
  double value_ = 0.0;
};

}  // namespace trident::control
