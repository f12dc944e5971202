// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "front_end/line_match.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "front_end/surface_information.h"
#include "trident_base/angle.h"

namespace trident {
namespace {

class Accumulator {
 public:
  Accumulator(const SurfelMap& reference, const LineMatchOptions& options)
      : reference_(reference), options_(options) {}

  NormalEquations at(const SE2& T, const PointScan& scan) const {
    NormalEquations sums;
    const Eigen::Matrix2f R = T.rotation().cast<float>();
    const Eigen::Vector2f t = T.p.cast<float>();
    const std::size_t stride = (scan.points.size() + options_.max_points - 1) / options_.max_points;
    for (std::size_t i = 0; i < scan.points.size(); i += stride) {
      const Eigen::Vector2f turned = R * scan.points[i].p;
      const Eigen::Vector2f normal = R * scan.points[i].normal;
      ++sums.used;
      const Surfel* surfel = reference_.nearest(turned + t, normal, options_.search_rings);
      if (surfel != nullptr) add(turned, t, *surfel, &sums);
    }
    return sums;
  }

 private:
  void add(const Eigen::Vector2f& turned, const Eigen::Vector2f& t, const Surfel& surfel,
           NormalEquations* sums) const {
    const Eigen::Vector2d offset = (turned + t - surfel.mean).cast<double>();
    const Eigen::Vector2d side(-static_cast<double>(turned.y()), static_cast<double>(turned.x()));
    const Eigen::Vector2d normal = surfel.normal.cast<double>();
    if (!surfel.normal.isZero(0.0F)) {
      add_row(normal, side, normal.dot(offset), 1.0, sums);
    } else {
      add_row(Eigen::Vector2d::UnitX(), side, offset.x(), options_.point_weight, sums);
      add_row(Eigen::Vector2d::UnitY(), side, offset.y(), options_.point_weight, sums);
    }
    const double distance =
        surfel.normal.isZero(0.0F) ? offset.norm() : std::abs(normal.dot(offset));
    if (distance > options_.inlier_distance) return;
    ++sums->inliers;
    sums->squared_inliers += distance * distance;
  }

  /// One residual n . (R p + t - m) and its derivatives by x, y and yaw.
  void add_row(const Eigen::Vector2d& n, const Eigen::Vector2d& side, double residual, double scale,
               NormalEquations* sums) const {
    const Eigen::Vector3d J(n.x(), n.y(), n.dot(side));
    const double k = residual / options_.kernel;
    const double weight = scale / ((1.0 + k * k) * options_.sigma * options_.sigma);
    sums->H += weight * J * J.transpose();
    sums->g += weight * residual * J;
    sums->cost += 0.5 * scale * std::log1p(k * k);
  }

  const SurfelMap& reference_;
  const LineMatchOptions& options_;
};

Eigen::Vector3d offset_from(const SE2& prior, const SE2& T) {
  return {T.p.x() - prior.p.x(), T.p.y() - prior.p.y(), angle_difference(T.angle, prior.angle)};
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
  return Accumulator(reference, options).at(T_ref_base, scan);
}

MatchResult match_lines(const SurfelMap& reference, const PointScan& scan, const SE2& guess,
                        const PosePrior& prior, const LineMatchOptions& options) {
  const Accumulator accumulator(reference, options);
  MatchResult result;
  result.T_ref_base = guess;
  NormalEquations sums;
  const double range = mean_range(scan);
  for (; result.iterations < options.max_iterations; ++result.iterations) {
    SE2& T = result.T_ref_base;
    sums = accumulator.at(T, scan);
    // A prior that errs is doubted as a point is: wheels slip.
    const Eigen::Vector3d off = offset_from(prior.T_ref_base, T);
    constexpr double kPriorKernel = 9.0;  // squared standard deviations
    const double trust = 1.0 / (1.0 + off.dot(prior.information * off) / kPriorKernel);
    Eigen::Matrix3d H = sums.H + trust * prior.information;
    H.diagonal() += Eigen::Vector3d(1e-3, 1e-3, 1e-3);  // no returns at all: stay where we are
    const Eigen::Vector3d g = sums.g + trust * prior.information * off;
    const Eigen::Vector3d step = -H.ldlt().solve(g);
    T = SE2::from_xy_yaw(T.p.x() + step.x(), T.p.y() + step.y(), T.angle + step.z());
    result.covariance = H.inverse();
    if (step.head<2>().norm() + std::abs(step.z()) * range < 5e-4) {
      result.is_converged = true;
      break;
    }
  }
  result.information = sums.H;
  result.degeneracy = degeneracy_of(sums.H, range);
  if (sums.used > 0) {
    result.inlier_fraction = static_cast<double>(sums.inliers) / static_cast<double>(sums.used);
  }
  if (sums.inliers > 0) {
    result.rms = std::sqrt(sums.squared_inliers / static_cast<double>(sums.inliers));
  }
  return result;
}

}  // namespace trident
