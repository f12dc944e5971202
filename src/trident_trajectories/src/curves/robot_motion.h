// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "trident_trajectories/spline_basis.h"

namespace trident::trajectories {

/// One robot's curve at its samples, and the gradient of something with respect to all of that,
/// which is collected before it is pulled back to control points and duration. Nothing allocates
/// after construction.
class RobotMotion {
 public:
  explicit RobotMotion(std::shared_ptr<const SplineBasis> basis);

  ControlPoints points;   ///< the curve [m]
  double duration = 1.0;  ///< [s]

  /// Samples of derivatives 0 ... `highest` by time, from points and duration. `horizon` [s] is
  /// the time that the team's common samples are spread over.
  void update(int highest, double horizon);

  /// At the robot's own samples: m, m/s, m/s^2, m/s^3 for derivative 0 ... 3.
  const Samples& at_samples(int derivative) const { return own_[derivative]; }
  /// Positions at the samples of the horizon, at rest or straight on after the end.
  const Samples& at_common() const { return is_common_ ? own_[0] : common_; }

  /// Sets the collected gradient to zero.
  void clear();
  /// Where the gradient by at_samples(derivative) is added to.
  Samples& gradient(int derivative) {
    is_touched_[derivative] = true;
    return gradient_[derivative];
  }
  /// Where the gradient by at_common() is added to.
  Samples& common_gradient() {
    if (is_common_) return gradient(0);
    is_common_touched_ = true;
    return common_gradient_;
  }
  ControlPoints points_gradient;   ///< by the control points
  double duration_gradient = 0.0;  ///< by the duration
  double horizon_gradient = 0.0;   ///< by the horizon

  /// Pulls the gradients by samples back into the three above.
  void pull_back();

 private:
  struct CommonSample {
    int segment = 0;
    SplineBasis::PointWeights weights, slope;  ///< of the position, and of its derivative by s
  };
  void sample_common(double horizon);
  void pull_back_common();

  std::shared_ptr<const SplineBasis> basis_;
  std::array<Samples, 4> own_, gradient_;
  std::array<bool, 4> is_touched_ = {};
  bool is_common_ = true, is_common_touched_ = false;
  double horizon_ = 1.0;
  Samples common_, common_gradient_;
  std::vector<CommonSample> common_samples_;
};

}  // namespace trident::trajectories
