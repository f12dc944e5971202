// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "curves/robot_motion.h"
#include "trident_trajectories/problem.h"

namespace trident::trajectories {

/// The vector x that an optimizer changes, and the team's control points and durations that follow
/// from it: free control points of each robot and axis, then places of places, then durations.
///
/// The free points are c = R c_ends + s L^-T x, with L L' the integral of squared jerk by them and
/// R the path of least jerk between the ends. So x = 0 is the undisturbed team, and the cost of
/// jerk is a sphere in x, whatever the number of points is: steepest descent is Newton's method.
class Decision {
 public:
  /// Both must live as long as this.
  Decision(const Problem& problem, std::shared_ptr<const SplineBasis> basis);

  int variables() const { return variables_; }  ///< dimension of x
  /// The bounds of x, infinite but for durations.
  const std::vector<double>& lower() const { return lower_; }
  const std::vector<double>& upper() const { return upper_; }

  /// Sets points and duration of each motion, and updates it with derivatives up to `highest`.
  void apply(const double* x, int highest, std::vector<RobotMotion>& motions);

  /// Adds the gradient by x that motions have collected. Not for those whose `robots` is false.
  void pull_back(std::vector<RobotMotion>& motions, const std::vector<char>& robots,
                 double* gradient);

  /// x whose curve of robot `i` passes nearest to its present one plus `offset` [m, per free
  /// control point]: adds the change to x.
  void add_offset(std::size_t robot, const Eigen::Matrix<double, Eigen::Dynamic, 3>& offset,
                  double* x) const;

  /// x with given control points and durations, as far as the ends allow.
  void fit(const std::vector<ControlPoints>& points, const std::vector<double>& durations,
           double* x) const;

  /// Sum of the integrals of squared jerk on the undisturbed path, not below that of a path of 1 m.
  double jerk_scale() const { return jerk_scale_; }
  /// Instant at which the last robot arrives, of the x applied last [s].
  double horizon() const { return horizon_; }
  /// Durations of the x applied last [s].
  const std::vector<double>& durations() const { return durations_; }
  /// Where a robot's last position is chosen.
  bool has_free_end(std::size_t robot) const { return problem_.robots[robot].goal.place >= 0; }

 private:
  struct End {
    Eigen::Vector3d p, v, a;     ///< at the end
    Eigen::Vector3d dp, dv, da;  ///< their derivatives by the duration
  };
  int axes(std::size_t robot) const;
  void add_duration(const Duration& duration);
  void add_variables();
  void set_scales();
  End end_of(std::size_t robot, double duration, const double* x) const;
  void set_ends(std::size_t robot, const End& end, RobotMotion& motion) const;
  double duration_pull(std::size_t robot, const End& end, const RobotMotion& motion,
                       const Eigen::Matrix<double, 6, 3>& gradient) const;
  void pull_back_robot(std::size_t robot, RobotMotion& motion, const double* x, double* gradient);
  double undisturbed_jerk(const ControlPoints& points, double duration) const;

  const Problem& problem_;
  std::shared_ptr<const SplineBasis> basis_;
  Eigen::MatrixXd from_ends_;   ///< R
  Eigen::MatrixXd from_x_;      ///< L^-T
  Eigen::MatrixXd to_x_;        ///< L^T
  std::vector<double> scales_;  ///< s of each robot
  std::vector<int> robot_offset_, place_offset_, duration_offset_;
  std::vector<double> lower_, upper_, durations_, x_;
  double place_scale_ = 1.0, jerk_scale_ = 1.0, horizon_ = 1.0;
  std::size_t last_ = 0;  ///< duration that is the horizon
  int variables_ = 0;
  Eigen::Matrix<double, 6, 3> ends_;
};

}  // namespace trident::trajectories
