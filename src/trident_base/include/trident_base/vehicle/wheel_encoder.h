// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "trident_base/angle.h"
#include "trident_base/error.h"

namespace trident {

/// An incremental encoder: it counts the marks that a shaft has passed since zero, down as the
/// shaft turns back. The measured angle is too low, by less than a tick.
class WheelEncoder {
 public:
  /// Throws Error unless `ticks_per_turn` >= 1.
  explicit WheelEncoder(std::int64_t ticks_per_turn) : ticks_per_turn_(ticks_per_turn) {
    if (ticks_per_turn < 1) {
      throw Error("wheel encoder: ticks_per_turn is " + std::to_string(ticks_per_turn) +
                  ", must be >= 1");
    }
  }

  std::int64_t ticks_per_turn() const { return ticks_per_turn_; }  ///< as constructed
  /// Of an angle that counts turns [rad].
  std::int64_t ticks(double angle) const {
    const double turns = angle / (2.0 * kPi);
    return static_cast<std::int64_t>(std::floor(turns * static_cast<double>(ticks_per_turn_)));
  }
  /// What a count stands for [rad].
  double angle(std::int64_t ticks) const {
    return 2.0 * kPi * static_cast<double>(ticks) / static_cast<double>(ticks_per_turn_);
  }

 private:
  std::int64_t ticks_per_turn_;
};

}  // namespace trident
