// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_trajectories/spline_basis.h"

#include <algorithm>

namespace trident::trajectories {
namespace {

/// Gauss-Legendre on 0 ... 1 with 3 points: exact for the squares of second degree pieces.
constexpr std::array<double, 3> kGaussPlace = {0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> kGaussWeight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

}  // namespace

SplineBasis::SplineBasis(int segments) : segments_(segments), h_(1.0 / segments) {
  for (int derivative = 0; derivative < 4; ++derivative) {
    for (int segment = 0; segment < segments_; ++segment) {
      Weights weights;
      for (int k = 0; k < kSamplesPerSegment; ++k)
        weights.row(k) = weights_at(derivative, segment, sample(segment * kSamplesPerSegment + k));
      weights_[derivative].push_back(weights);
      transposed_[derivative].emplace_back(weights.transpose());
    }
  }
  jerk_gram_ = Eigen::MatrixXd::Zero(control_points(), control_points());
  for (int segment = 0; segment < segments_; ++segment) {
    for (std::size_t i = 0; i < kGaussPlace.size(); ++i) {
      const PointWeights w = weights_at(3, segment, (segment + kGaussPlace[i]) * h_);
      jerk_gram_.block<kOrder, kOrder>(segment, segment) +=
          kGaussWeight[i] * h_ * w * w.transpose();
    }
  }
}

double SplineBasis::knot(int i) const { return std::clamp(i - kDegree, 0, segments_) * h_; }

int SplineBasis::segment_of(double s) const {
  return std::clamp(static_cast<int>(s * segments_), 0, segments_ - 1);
}

// Equation (A2.2) of The NURBS Book (Piegl, Tiller, 1997): the degree + 1 basis functions that are
// not zero on a segment, behind as many zeros as the degree is short of kDegree.
SplineBasis::PointWeights SplineBasis::shape(int segment, double s, int degree) const {
  PointWeights n = PointWeights::Zero();
  const int span = segment + kDegree;
  n[kDegree] = 1.0;
  for (int p = 1; p <= degree; ++p) {
    for (int j = kDegree - p; j <= kDegree; ++j) {
      const int i = span - kDegree + j;  // basis function
      const double left = j == kDegree - p ? 0.0 : (s - knot(i)) / (knot(i + p) - knot(i)) * n[j];
      const double right =
          j == kDegree ? 0.0 : (knot(i + p + 1) - s) / (knot(i + p + 1) - knot(i + 1)) * n[j + 1];
      n[j] = left + right;
    }
  }
  return n;
}

SplineBasis::PointWeights SplineBasis::weights_at(int derivative, int segment, double s) const {
  const int span = segment + kDegree;
  PointWeights n = shape(segment, s, kDegree - derivative);
  // Equation (2.7) of the same book, once for each derivative.
  for (int p = kDegree - derivative + 1; p <= kDegree; ++p) {
    for (int j = kDegree - p; j <= kDegree; ++j) {
      const int i = span - kDegree + j;
      const double left = j == kDegree - p ? 0.0 : n[j] / (knot(i + p) - knot(i));
      const double right = j == kDegree ? 0.0 : n[j + 1] / (knot(i + p + 1) - knot(i + 1));
      n[j] = p * (left - right);
    }
  }
  return n;
}

void SplineBasis::sample(int derivative, const ControlPoints& points, Samples& out) const {
  for (int segment = 0; segment < segments_; ++segment)
    out.middleRows<kSamplesPerSegment>(segment * kSamplesPerSegment).noalias() =
        weights_[derivative][segment] * points.middleRows<kOrder>(segment);
}

void SplineBasis::pull_back(int derivative, const Samples& gradient, ControlPoints& out) const {
  for (int segment = 0; segment < segments_; ++segment) {
    const Eigen::Matrix<double, kSamplesPerSegment, 3> own =
        gradient.middleRows<kSamplesPerSegment>(segment * kSamplesPerSegment);
    if ((own.array() == 0.0).all()) continue;
    const Eigen::Matrix<double, kOrder, 3> by_points = transposed_[derivative][segment] * own;
    out.middleRows<kOrder>(segment) += by_points;
  }
}

}  // namespace trident::trajectories
