// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Matchers that go downhill on a cost of their own: NDT, and the occupancy grid.
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "map_match.h"
#include "ndt_match.h"
#include "surface_information.h"
#include "trident_slam/scan_matcher.h"

namespace trident::slam {
namespace {

/// One point's standard deviations, by which the covariances of these matchers are those of their
/// errors (the conformance suite measures it) [m].
constexpr double kNdtSigma = 0.03;
constexpr double kGridSigma = 0.06;

/// Points beyond these are not independent and weigh together as much as so many.
constexpr double kIndependentPoints = 200.0;

double point_weight(const PointScan& scan) {
  return std::min(1.0, kIndependentPoints / static_cast<double>(scan.points.size()));
}

double share(const std::vector<char>& flags) {
  return static_cast<double>(std::count(flags.begin(), flags.end(), 1)) /
         static_cast<double>(flags.size());
}

/// What is known once the pose is found.
ScanMatch finished(const NewtonResult& found, const PointScan& scan, const PosePrior& prior,
                   const std::vector<char>& is_on_surface, double sigma) {
  ScanMatch match;
  match.T_ref_base = found.T_ref_base;
  match.iterations = found.iterations;
  match.is_converged = found.is_converged;
  match.inlier_fraction = share(is_on_surface);
  match.information = surface_information(scan, found.T_ref_base, is_on_surface, sigma);
  match.degeneracy = degeneracy_of(match.information, mean_range(scan));
  match.covariance =
      (match.information + prior.information + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
  return match;
}

PoseCost scaled(const PoseCost& at, double scale) {
  return {scale * at.H, scale * at.g, scale * at.cost};
}

class NdtMatcher : public ScanMatcher {
 private:
  /// Cell and least standard deviation [m], from coarse to fine.
  struct Level {
    double cell;
    double least_sigma;
  };
  static constexpr std::array<Level, 4> kLevels = {
      {{2.0, 0.3}, {1.0, 0.12}, {0.5, 0.05}, {0.25, 0.03}}};

  void clear() override {
    for (NdtMap& map : maps_) map.clear();
  }
  void add(const SE2& T_ref_base, const PointScan& scan) override {
    for (NdtMap& map : maps_) map.insert(T_ref_base, scan);
  }

  ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior& prior) const override {
    const double range = mean_range(scan);
    const double weight = point_weight(scan);
    NewtonResult found;
    found.T_ref_base = guess;
    int iterations = 0;
    for (std::size_t level = first_level(prior); level < maps_.size(); ++level) {
      NewtonOptions options;
      options.longest_step = kLevels[level].least_sigma;
      found = minimize_pose(found.T_ref_base, range, options, [&](const SE2& T) {
        PoseCost cost = scaled(ndt_cost(maps_[level], scan, T), weight);
        return cost += prior_cost(prior, T);
      });
      iterations += found.iterations;
    }
    found.iterations = iterations;
    std::vector<char> is_on_surface;
    const PoseCost end = ndt_cost(maps_.back(), scan, found.T_ref_base, &is_on_surface);
    ScanMatch match = finished(found, scan, prior, is_on_surface, kNdtSigma);
    match.score = 1.0 - end.cost / static_cast<double>(scan.points.size());
    return match;
  }

  /// Wide distributions would only draw a pose that is nearly known away.
  static std::size_t first_level(const PosePrior& prior) {
    if (prior.information.isZero(0.0)) return 0;
    const Eigen::Matrix3d covariance =
        (prior.information + 1e-6 * Eigen::Matrix3d::Identity()).inverse();
    const double sigma = std::sqrt(covariance.topLeftCorner<2, 2>().diagonal().maxCoeff());
    std::size_t level = 0;
    while (level + 2 < kLevels.size() && kLevels[level].least_sigma > 2.0 * sigma) ++level;
    return level;
  }

  std::vector<NdtMap> maps_ = {{kLevels[0].cell, kLevels[0].least_sigma},
                               {kLevels[1].cell, kLevels[1].least_sigma},
                               {kLevels[2].cell, kLevels[2].least_sigma},
                               {kLevels[3].cell, kLevels[3].least_sigma}};
};

class GridMatcher : public ScanMatcher {
 private:
  static constexpr double kPassed = 0.4;  ///< as HectorSlam2d has them
  static constexpr double kEnded = 0.9;
  static constexpr std::array<double, 3> kResolutions = {0.2, 0.1, 0.05};  ///< [m]
  /// Of 1 - M at a point that is where it should be.
  static constexpr double kResidualSigma = 0.3;

  static std::vector<ProbabilityGrid> empty_grids() {
    std::vector<ProbabilityGrid> grids;
    grids.reserve(kResolutions.size());
    for (const double resolution : kResolutions) grids.emplace_back(resolution, kPassed, kEnded);
    return grids;
  }
  void clear() override { grids_ = empty_grids(); }
  void add(const SE2& T_ref_base, const PointScan& scan) override {
    for (ProbabilityGrid& grid : grids_) grid.insert(T_ref_base, scan);
  }

  ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior& prior) const override {
    const double range = mean_range(scan);
    const double gain = point_weight(scan) / (kResidualSigma * kResidualSigma);
    NewtonResult found;
    found.T_ref_base = guess;
    int iterations = 0;
    for (const ProbabilityGrid& grid : grids_) {
      NewtonOptions options;
      options.longest_step = grid.resolution();
      found = minimize_pose(found.T_ref_base, range, options, [&](const SE2& T) {
        const MapMatchSums sums = map_match_sums(grid, scan, T);
        PoseCost at{gain * sums.H, -gain * sums.g, 0.5 * gain * sums.cost};
        return at += prior_cost(prior, T);
      });
      iterations += found.iterations;
    }
    found.iterations = iterations;
    ScanMatch match =
        finished(found, scan, prior, points_on_surface(scan, found.T_ref_base), kGridSigma);
    const double cost = map_match_sums(grids_.back(), scan, found.T_ref_base).cost;
    match.score = std::max(0.0, 1.0 - std::sqrt(cost / static_cast<double>(scan.points.size())));
    return match;
  }

  std::vector<char> points_on_surface(const PointScan& scan, const SE2& T) const {
    std::vector<char> flags;
    const Eigen::Matrix2f R = T.rotation().cast<float>();
    const Eigen::Vector2f t = T.p.cast<float>();
    flags.reserve(scan.points.size());
    for (const SurfacePoint& point : scan.points) {
      // Within the second finest cell of a surface.
      flags.push_back(grids_[1].sample(R * point.p + t).value > 0.5F ? 1 : 0);
    }
    return flags;
  }

  std::vector<ProbabilityGrid> grids_ = empty_grids();
};

}  // namespace

/// Called by register_builtin_scan_matchers().
void add_newton_scan_matchers(Registry<ScanMatcherFactory>& registry);
void add_newton_scan_matchers(Registry<ScanMatcherFactory>& registry) {
  // Gauss-Newton over interpolated occupancy, from coarse to fine (Kohlbrecher 2011).
  registry.add("grid_gauss_newton", [](const ScanMatcherOptions& /*options*/) {
    return std::make_unique<GridMatcher>();
  });
  // Newton over normal distributions of the points of overlapping cells, from coarse to fine (Biber
  // and Strasser 2003).
  registry.add(
      "ndt", [](const ScanMatcherOptions& /*options*/) { return std::make_unique<NdtMatcher>(); });
}

}  // namespace trident::slam
