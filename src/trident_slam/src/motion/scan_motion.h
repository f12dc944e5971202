// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "odometry_motion.h"
#include "trident_base/se2.h"

namespace trident::slam {

/// A motion between two scans before the second one has been looked at.
struct ExpectedMotion {
  SE2 T_before_now;
  MotionSpread spread;
};

/// Predicts the next motion between two scans from those before it, which scans measured: the
/// robot continues as it did. Stamps may lie (those of a log are often when a scan was delivered:
/// some come a millisecond apart, or go back). Two predictions are kept, one of the same motion
/// from scan to scan as before, one of the same velocity by the stamps, and the one that has erred
/// less of late is given out. Both are bounded, so that no pair of stamps sends the robot off.
class ScanMotion {
 public:
  /// The motion up to a scan of this stamp. It stands still before any motion was added.
  ExpectedMotion expected(std::int64_t stamp_ns) const;
  /// The motion from the last scan to one of this stamp. `is_sure` false: the scan did not show it.
  void add(std::int64_t stamp_ns, const SE2& T_before_now, bool is_sure);

 private:
  enum Kind { kByScans, kByStamps, kKinds };
  SE2::Tangent predicted(Kind kind, std::int64_t stamp_ns) const;
  Kind better() const { return error_[kByStamps] < error_[kByScans] ? kByStamps : kByScans; }
  double seconds_since_last(std::int64_t stamp_ns) const;
  void learn_errors(std::int64_t stamp_ns, const SE2::Tangent& seen);

  std::optional<std::int64_t> last_stamp_ns_;
  SE2::Tangent last_ = SE2::Tangent::Zero();  ///< the newest motion
  double last_seconds_ = 0.0;                 ///< in which it happened, by the stamps
  double usual_seconds_ = 0.0;                ///< between two scans; 0: not known yet
  std::array<double, kKinds> error_ = {};     ///< of late, squared, a radian as a metre [m^2]
  /// Of what was given out, squared [m^2], [rad^2]. At first nothing is known.
  double error_p_ = 0.01;
  double error_yaw_ = 0.01;
};

}  // namespace trident::slam
