// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "trident_trajectories/prediction.h"
#include "trident_trajectories/spline_basis.h"

namespace trident::trajectories {

/// One robot's path through space and time.
class Trajectory {
 public:
  /// control_points: as many as the basis has [m]; duration > 0 [s].
  Trajectory(std::shared_ptr<const SplineBasis> basis, ControlPoints control_points,
             double duration);

  /// [s].
  double duration() const { return duration_; }
  const SplineBasis& basis() const { return *basis_; }  ///< of the curve
  const std::shared_ptr<const SplineBasis>& shared_basis() const { return basis_; }  ///< the same
  const ControlPoints& control_points() const { return control_points_; }            ///< [m]

  /// At time t [s]; on with the last velocity after the end, at the start before 0.
  MotionState at(double t) const;

  /// Derivative 0 ... 5 with respect to time, of the piece `segment` [m/s^derivative].
  Eigen::Vector3d derivative(int order, int segment, double t) const;

 private:
  std::shared_ptr<const SplineBasis> basis_;
  ControlPoints control_points_;
  double duration_;
};

/// The same path from time `from` on, 0 <= from < duration, on the same basis: as near as a curve
/// of as many segments comes to it (least squares). What the next plan begins with.
Trajectory rest_of(const Trajectory& trajectory, double from);

/// The integral of squared jerk over a trajectory [m^2/s^5].
double squared_jerk(const Trajectory& trajectory);

}  // namespace trident::trajectories
