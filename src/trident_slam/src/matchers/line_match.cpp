// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "line_match.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

#include "surface_information.h"
#include "trident_base/angle.h"

namespace trident::slam {
namespace {

/// R v, written out: Eigen does not inline products of this size.
Eigen::Vector2f turned_by(const Eigen::Matrix2f& R, const Eigen::Vector2f& v) {
  return {R(0, 0) * v.x() + R(0, 1) * v.y(), R(1, 0) * v.x() + R(1, 1) * v.y()};
}

/// How far a point is from a surfel's mean along its line [m]; 0 without a line.
float along(const Surfel& surfel, const Eigen::Vector2f& p) {
  const Eigen::Vector2f offset = p - surfel.mean;
  return std::abs(surfel.normal.x() * offset.y() - surfel.normal.y() * offset.x());
}

/// The points of a scan that are used, and the surfels that they were paired with last.
class Pairing {
 public:
  Pairing(const SurfelMap& reference, const PointScan& scan, const LineMatchOptions& options,
          bool wants_cost)
      : reference_(reference),
        options_(options),
        wants_cost_(wants_cost),
        kernel_(options.kernel * options.kernel),
        information_(kernel_ / (options.sigma * options.sigma)) {
    const std::size_t stride = (scan.points.size() + options.max_points - 1) / options.max_points;
    pairs_.reserve(std::min(scan.points.size(), options.max_points));
    for (std::size_t i = 0; i < scan.points.size(); i += stride) {
      pairs_.push_back({&scan.points[i], nullptr});
    }
  }

  /// Pairs again if the scan has moved since the last pairing.
  NormalEquations sums_at(const SE2& T, double range) {
    const Eigen::Matrix2f R = T.rotation().cast<float>();
    const Eigen::Vector2f t = T.p.cast<float>();
    if (!is_paired_ || moved_to(T, range) > options_.settled) pair(R, t, T);
    NormalEquations sums;
    sums.used = pairs_.size();
    for (const Pair& pair : pairs_) {
      if (pair.surfel != nullptr) add(turned_by(R, pair.point->p), t, *pair.surfel, &sums);
    }
    sums.H.triangularView<Eigen::StrictlyLower>() = sums.H.transpose();
    return sums;
  }
  /// How far points at `range` [m] are from where they were paired last [m].
  double moved_to(const SE2& T, double range) const {
    return (T.p - T_paired_.p).norm() +
           std::abs(angle_difference(T.angle, T_paired_.angle)) * range;
  }
  std::size_t size() const { return pairs_.size(); }
  std::size_t paired() const { return paired_; }
  void forget() { is_paired_ = false; }

 private:
  struct Pair {
    const SurfacePoint* point;
    const Surfel* surfel;
  };

  void pair(const Eigen::Matrix2f& R, const Eigen::Vector2f& t, const SE2& T) {
    paired_ = 0;
    const auto reach = static_cast<float>(options_.reach_along);
    for (Pair& pair : pairs_) {
      const Eigen::Vector2f normal = turned_by(R, pair.point->normal);
      const Eigen::Vector2f p = turned_by(R, pair.point->p) + t;
      pair.surfel = reference_.nearest(p, normal, options_.search_rings);
      if (pair.surfel != nullptr && along(*pair.surfel, p) > reach) pair.surfel = nullptr;
      if (pair.surfel != nullptr) ++paired_;
    }
    T_paired_ = T;
    is_paired_ = true;
  }

  /// A surface with a normal resists motion across it only, so that scans slide along walls; one
  /// without holds the point in both directions, with less weight.
  void add(const Eigen::Vector2f& turned, const Eigen::Vector2f& t, const Surfel& surfel,
           NormalEquations* sums) const {
    const Eigen::Vector2d offset = (turned + t - surfel.mean).cast<double>();
    const Eigen::Vector2d side(-static_cast<double>(turned.y()), static_cast<double>(turned.x()));
    double distance = 0.0;
    if (surfel.has_normal()) {
      const Eigen::Vector2d normal = surfel.normal.cast<double>();
      const double residual = normal.dot(offset);
      add_row(normal, side, residual, 1.0, sums);
      distance = std::abs(residual);
    } else {
      add_row(Eigen::Vector2d::UnitX(), side, offset.x(), options_.point_weight, sums);
      add_row(Eigen::Vector2d::UnitY(), side, offset.y(), options_.point_weight, sums);
      distance = offset.norm();
    }
    if (distance > options_.inlier_distance) return;
    ++sums->inliers;
    sums->squared_inliers += distance * distance;
  }

  /// One residual n . (R p + t - m) and its derivatives by x, y and yaw; H's upper half.
  void add_row(const Eigen::Vector2d& n, const Eigen::Vector2d& side, double residual, double scale,
               NormalEquations* sums) const {
    const double weight = scale * information_ / (kernel_ + residual * residual);
    const double J[3] = {n.x(), n.y(), n.dot(side)};
    for (int row = 0; row < 3; ++row) {
      const double weighted = weight * J[row];
      for (int column = row; column < 3; ++column) sums->H(row, column) += weighted * J[column];
      sums->g(row) += weighted * residual;
    }
    if (wants_cost_) sums->cost += 0.5 * scale * std::log1p(residual * residual / kernel_);
  }

  const SurfelMap& reference_;
  const LineMatchOptions& options_;
  bool wants_cost_;
  double kernel_;       ///< squared [m^2]
  double information_;  ///< of a residual of 0 [1/m^2], times kernel_
  std::vector<Pair> pairs_;
  SE2 T_paired_;
  bool is_paired_ = false;
  std::size_t paired_ = 0;
};

Eigen::Vector3d offset_from(const SE2& prior, const SE2& T) {
  return {T.p.x() - prior.p.x(), T.p.y() - prior.p.y(), angle_difference(T.angle, prior.angle)};
}

/// A prior that errs by an offset is doubted as a point is: wheels slip.
double trust_in(const PosePrior& prior, const Eigen::Vector3d& off) {
  constexpr double kPriorKernel = 9.0;  // squared standard deviations
  return prior.is_firm ? 1.0 : 1.0 / (1.0 + off.dot(prior.information * off) / kPriorKernel);
}

/// How well the points fit where they were paired last.
void describe_fit(const NormalEquations& sums, std::size_t points, double range,
                  MatchResult* result) {
  result->information = sums.H;
  result->degeneracy = degeneracy_of(sums.H, range);
  if (points > 0) {
    result->inlier_fraction = static_cast<double>(sums.inliers) / static_cast<double>(points);
  }
  if (sums.inliers > 0) {
    result->rms = std::sqrt(sums.squared_inliers / static_cast<double>(sums.inliers));
  }
}

}  // namespace

Degeneracy degeneracy_of(const Eigen::Matrix3d& information, double mean_range) {
  const Eigen::Vector3d scale(1.0, 1.0, 1.0 / std::max(mean_range, 0.1));
  const Eigen::Matrix3d scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scaled);
  Degeneracy result;
  const double largest = solver.eigenvalues()(2);
  result.ratio = largest > 0.0 ? std::max(solver.eigenvalues()(0), 0.0) / largest : 0.0;
  result.weakest = solver.eigenvectors().col(0);
  return result;
}

NormalEquations line_match_sums(const SurfelMap& reference, const PointScan& scan,
                                const SE2& T_ref_base, const LineMatchOptions& options) {
  return Pairing(reference, scan, options, true).sums_at(T_ref_base, mean_range(scan));
}

MatchResult match_lines(const SurfelMap& reference, const PointScan& scan, const SE2& guess,
                        const PosePrior& prior, const LineMatchOptions& options) {
  Pairing pairing(reference, scan, options, false);
  MatchResult result;
  result.T_ref_base = guess;
  NormalEquations sums;
  const double range = mean_range(scan);
  const double fewest_pairs = options.least_paired * static_cast<double>(pairing.size());
  for (; result.iterations < options.max_iterations; ++result.iterations) {
    SE2& T = result.T_ref_base;
    sums = pairing.sums_at(T, range);
    if (static_cast<double>(pairing.paired()) < fewest_pairs) break;
    const Eigen::Vector3d off = offset_from(prior.T_ref_base, T);
    const double trust = trust_in(prior, off);
    Eigen::Matrix3d H = sums.H;
    Eigen::Vector3d g = sums.g;
    if (prior.is_independent) discard_degenerate(range, &H, &g);
    H += trust * prior.information;
    H.diagonal() += Eigen::Vector3d(1e-3, 1e-3, 1e-3);  // no returns at all: stay where we are
    g += trust * prior.information * off;
    const Eigen::Vector3d step = -H.ldlt().solve(g);
    T = SE2::from_xy_yaw(T.p.x() + step.x(), T.p.y() + step.y(), T.angle + step.z());
    result.covariance = H.inverse();
    if (step.head<2>().norm() + std::abs(step.z()) * range > options.converged) continue;
    if (pairing.moved_to(T, range) < options.converged_pairs) {
      result.is_converged = true;
      break;
    }
    pairing.forget();
  }
  describe_fit(sums, pairing.size(), range, &result);
  return result;
}

}  // namespace trident::slam
