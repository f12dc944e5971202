// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace trident::trajectories {

constexpr int kDegree = 5;              ///< of all curves: jerk is continuous, and one more
constexpr int kOrder = kDegree + 1;     ///< control points that act at one instant
constexpr int kEndPoints = 3;           ///< control points that position to acceleration fix
constexpr int kSamplesPerSegment = 10;  ///< where costs and limits are looked at

/// Control points of one robot, a row each [m].
using ControlPoints = Eigen::Matrix<double, Eigen::Dynamic, 3>;
/// Values at the samples of all segments, in order.
using Samples = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Clamped B-splines of degree 5 with equal segments on s = 0 ... 1 (de Boor, 1978): everything
/// about them that does not depend on control points, computed once.
class SplineBasis {
 public:
  using Weights = Eigen::Matrix<double, kSamplesPerSegment, kOrder>;
  using PointWeights = Eigen::Matrix<double, kOrder, 1>;

  /// segments >= 2, so that the ends' control points are distinct.
  explicit SplineBasis(int segments);

  int segments() const { return segments_; }                             ///< polynomial pieces
  int control_points() const { return segments_ + kDegree; }             ///< of each curve
  int free_points() const { return control_points() - 2 * kEndPoints; }  ///< between the ends
  int samples() const { return segments_ * kSamplesPerSegment; }         ///< of each curve
  double sample(int k) const { return (k + 0.5) / samples(); }  ///< s of sample k, midpoints

  /// Weights of the 6 control points from `segment` on, at the segment's samples, for derivative
  /// 0 ... 3 with respect to s.
  const Weights& weights(int derivative, int segment) const {
    return weights_[derivative][segment];
  }

  /// The segment that s lies in; that of the nearest end outside of 0 ... 1.
  int segment_of(double s) const;

  /// Weights of the 6 control points from `segment` on, at s, for derivative 0 ... 5. s may lie on
  /// the segment's border.
  PointWeights weights_at(int derivative, int segment, double s) const;

  /// All samples of a derivative 0 ... 3. No allocation where `out` has the right size.
  void sample(int derivative, const ControlPoints& points, Samples& out) const;

  /// Adds the gradient with respect to the control points, given that by the samples.
  void pull_back(int derivative, const Samples& gradient, ControlPoints& out) const;

  /// The first three control points are p, p + d1[0] v, p + d1[1] v + d2 a, where v and a are
  /// derivatives by s; the last three are so with -v, counted from the end.
  std::array<double, 2> end_velocity() const { return {h_ / 5.0, 3.0 * h_ / 5.0}; }
  double end_acceleration() const { return h_ * h_ / 10.0; }  ///< d2

  /// Integral over s of squared third derivatives is c' G c for the control points c of one axis.
  const Eigen::MatrixXd& jerk_gram() const { return jerk_gram_; }

 private:
  double knot(int i) const;
  PointWeights shape(int segment, double s, int degree) const;

  int segments_;
  double h_;  ///< length of a segment
  std::array<std::vector<Weights>, 4> weights_;
  std::array<std::vector<Eigen::Matrix<double, kOrder, kSamplesPerSegment>>, 4> transposed_;
  Eigen::MatrixXd jerk_gram_;
};

}  // namespace trident::trajectories
