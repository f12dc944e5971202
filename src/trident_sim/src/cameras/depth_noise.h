// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace trident::sim {

enum class DepthNoiseModel { kNone, kKinect, kD435 };

/// Noise of a depth along the axis, as RotorS has it. Depths outside of a range are not measured.
struct DepthNoise {
  DepthNoiseModel model = DepthNoiseModel::kNone;
  double min_m = 0.2, max_m = 1000.0;
  // Of the D435 alone:
  double focal_px = 0.0, baseline_m = 0.05;
  double subpixel_error_px = 0.1;  ///< of the disparity
  double max_stddev_m = 3.0;

  /// Standard deviation at a depth [m]. Kinect: 0.0012 + 0.0019 (z - 0.4)^2 (Nguyen, Izadi, Lovell,
  /// "Modeling Kinect sensor noise for improved 3D reconstruction and tracking", 3DIMPVT 2012,
  /// for surfaces aslant by 10 to 60 degrees). D435: z^2 error / (focal length * baseline) (Intel,
  /// "Best-known methods for tuning Intel RealSense D400 depth cameras"); RotorS takes the square
  /// of that for a standard deviation, which we do not.
  double stddev_m(double depth_m) const;
  /// `key`: random bits of this picture's own. What is out of range becomes not a number.
  void apply(std::uint64_t key, std::vector<float>& depths) const;
};

}  // namespace trident::sim
