// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Matchers by branch and bound, by lines, and by both.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "correlative_match.h"
#include "line_match.h"
#include "surface_information.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam/scan_matcher.h"

namespace trident::slam {
namespace {

constexpr double kSurfelCell = 0.1;  // [m]

/// The search, and the hits that it compares with.
class Correlator {
 public:
  explicit Correlator(const ScanMatcherOptions& options)
      : options_(options), hits_(options.search_resolution, kPyramidLevels) {
    check("search_distance", options.search_distance, 0.01, 50.0, "m");
    check("search_heading", options.search_heading, 0.001, kPi, "rad");
    check("search_resolution", options.search_resolution, 0.005, 1.0, "m");
  }

  void clear() { hits_ = MaxPyramid(options_.search_resolution, kPyramidLevels); }
  void add(const SE2& T_ref_base, const PointScan& scan) { hits_.insert(T_ref_base, scan); }
  const MaxPyramid& hits() const { return hits_; }

  std::optional<CorrelativeMatch> find(const std::vector<Eigen::Vector2f>& points, const SE2& guess,
                                       const PosePrior& prior) const {
    return match_by_branch_and_bound(hits_, points, guess, window(prior), kMinResponse);
  }
  std::string nothing_found() const {
    return "no pose within " + number_text(options_.search_distance) + " m of the guess brings " +
           number_text(kMinResponse) + " of the response";
  }

 private:
  static constexpr int kPyramidLevels = 6;
  static constexpr double kMinResponse = 0.2;

  static void check(const char* name, double value, double low, double high, const char* unit) {
    if (value >= low && value <= high) return;
    throw Error(std::string(name) + " = " + number_text(value) + " " + unit +
                ", legal: " + number_text(low) + " to " + number_text(high));
  }

  /// Three standard deviations of the prior to both sides, if there is one.
  SearchWindow window(const PosePrior& prior) const {
    SearchWindow result{options_.search_distance, options_.search_heading};
    if (prior.information.isZero(0.0)) return result;
    const Eigen::Vector3d sigma =
        (prior.information + 1e-6 * Eigen::Matrix3d::Identity()).inverse().diagonal().cwiseSqrt();
    result.linear = std::min(
        result.linear, 3.0 * std::max(sigma.x(), sigma.y()) + 2.0 * options_.search_resolution);
    result.angular = std::min(result.angular, 3.0 * sigma.z() + 0.02);
    return result;
  }

  ScanMatcherOptions options_;
  MaxPyramid hits_;
};

class LineMatcher : public ScanMatcher {
 private:
  void clear() override { surfels_ = SurfelMap(kSurfelCell); }
  void add(const SE2& T_ref_base, const PointScan& scan) override {
    surfels_.insert(T_ref_base, scan);
  }
  ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior& prior) const override {
    ScanMatch match;
    static_cast<MatchResult&>(match) = match_lines(surfels_, scan, guess, prior, {});
    match.score = match.inlier_fraction;
    return match;
  }

  SurfelMap surfels_{kSurfelCell};
};

/// A search for the place, lines for the last centimetre.
class HybridMatcher : public ScanMatcher {
 public:
  explicit HybridMatcher(const ScanMatcherOptions& options) : correlator_(options) {}

 private:
  void clear() override {
    correlator_.clear();
    surfels_ = SurfelMap(kSurfelCell);
  }
  void add(const SE2& T_ref_base, const PointScan& scan) override {
    correlator_.add(T_ref_base, scan);
    surfels_.insert(T_ref_base, scan);
  }
  ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior& prior) const override {
    ScanMatch match;
    const auto found = correlator_.find(thinned_points(scan, kSearchPoints), guess, prior);
    if (!found) {
      match.problem = correlator_.nothing_found();
      return match;
    }
    static_cast<MatchResult&>(match) = match_lines(surfels_, scan, found->T_ref_base, prior, {});
    match.score = found->score;
    return match;
  }

  static constexpr std::size_t kSearchPoints = 200;

  Correlator correlator_;
  SurfelMap surfels_{kSurfelCell};
};

class CorrelativeMatcher : public ScanMatcher {
 public:
  explicit CorrelativeMatcher(const ScanMatcherOptions& options)
      : correlator_(options), resolution_(options.search_resolution) {}

 private:
  static constexpr std::size_t kSearchPoints = 300;
  /// One point's standard deviation, by which the covariance is that of the errors [m].
  static constexpr double kSigma = 0.03;

  void clear() override { correlator_.clear(); }
  void add(const SE2& T_ref_base, const PointScan& scan) override {
    correlator_.add(T_ref_base, scan);
  }

  ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior& prior) const override {
    ScanMatch match;
    const std::vector<Eigen::Vector2f> points = thinned_points(scan, kSearchPoints);
    const auto found = correlator_.find(points, guess, prior);
    if (!found) {
      match.problem = correlator_.nothing_found();
      return match;
    }
    const SE2 T = mean_about(found->T_ref_base, points);
    const std::vector<char> hit = points_on_surface(scan, T);
    match.score = found->score;
    match.is_converged = true;
    match.iterations = 1;
    match.inlier_fraction = static_cast<double>(std::count(hit.begin(), hit.end(), 1)) /
                            static_cast<double>(hit.size());
    match.information = surface_information(scan, T, hit, kSigma);
    match.degeneracy = degeneracy_of(match.information, mean_range(scan));
    fuse(T, mean_range(scan), prior, &match);
    return match;
  }

  /// Sum of the cells under the points.
  double response(const SE2& T, const std::vector<Eigen::Vector2f>& points) const {
    const Eigen::Matrix2f R = T.rotation().cast<float>();
    const Eigen::Vector2f t = T.p.cast<float>();
    const MaxPyramid& hits = correlator_.hits();
    int sum = 0;
    for (const Eigen::Vector2f& p : points) {
      const Eigen::Vector2f q = R * p + t;
      sum += hits.bound(0, hits.cell_of(static_cast<double>(q.x())),
                        hits.cell_of(static_cast<double>(q.y())));
    }
    return sum / (255.0 * static_cast<double>(points.size()));
  }

  /// The mean of the poses about the best one, each weighed by its response: between the cells of
  /// the search (Olson 2009, section III).
  SE2 mean_about(const SE2& best, const std::vector<Eigen::Vector2f>& points) const {
    constexpr int kReach = 4;
    constexpr double kSharpness = 40.0;  // of exp(response), so that the tails do not count
    double farthest = 1.0;
    for (const Eigen::Vector2f& p : points) {
      farthest = std::max(farthest, static_cast<double>(p.norm()));
    }
    const Eigen::Vector3d step(0.5 * resolution_, 0.5 * resolution_,
                               std::max(0.5 * resolution_ / farthest, 0.002));
    const double top = response(best, points);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0.0;
    for (int k = -kReach; k <= kReach; ++k) {
      for (int j = -kReach; j <= kReach; ++j) {
        for (int i = -kReach; i <= kReach; ++i) {
          const Eigen::Vector3d off = step.cwiseProduct(Eigen::Vector3d(i, j, k));
          const SE2 T =
              SE2::from_xy_yaw(best.p.x() + off.x(), best.p.y() + off.y(), best.angle + off.z());
          const double weight = std::exp(kSharpness * (response(T, points) - top));
          sum += weight * off;
          weights += weight;
        }
      }
    }
    sum /= weights;
    return SE2::from_xy_yaw(best.p.x() + sum.x(), best.p.y() + sum.y(), best.angle + sum.z());
  }

  std::vector<char> points_on_surface(const PointScan& scan, const SE2& T) const {
    const MaxPyramid& hits = correlator_.hits();
    std::vector<char> flags;
    flags.reserve(scan.points.size());
    for (const SurfacePoint& point : scan.points) {
      const Eigen::Vector2d q = T * point.p.cast<double>();
      flags.push_back(hits.bound(0, hits.cell_of(q.x()), hits.cell_of(q.y())) > 0 ? 1 : 0);
    }
    return flags;
  }

  /// The search knows no prior but its window: what was found is weighed with it here.
  void fuse(const SE2& T, double range, const PosePrior& prior, ScanMatch* match) const {
    const double cell = resolution_ * resolution_ / 12.0;
    const Eigen::Matrix3d rounding = Eigen::Vector3d(cell, cell, 1e-6).asDiagonal();
    const Eigen::Matrix3d least = 1e-6 * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d denoised = without_noise(match->information, range);
    const Eigen::Matrix3d measured = ((denoised + least).inverse() + 0.1 * rounding).inverse();
    match->covariance = (measured + prior.information).inverse();
    const SE2& P = prior.T_ref_base;
    const Eigen::Vector3d off(P.p.x() - T.p.x(), P.p.y() - T.p.y(),
                              angle_difference(P.angle, T.angle));
    const Eigen::Vector3d pull = match->covariance * prior.information * off;
    match->T_ref_base =
        SE2::from_xy_yaw(T.p.x() + pull.x(), T.p.y() + pull.y(), T.angle + pull.z());
  }

  Correlator correlator_;
  double resolution_;
};

}  // namespace

/// Called by register_builtin_scan_matchers().
void add_line_scan_matchers(Registry<ScanMatcherFactory>& registry);
void add_line_scan_matchers(Registry<ScanMatcherFactory>& registry) {
  // Branch and bound over a window of poses (Olson 2009, Hess 2016), then the mean of the response
  // about the best one.
  registry.add("correlative", [](const ScanMatcherOptions& options) {
    return std::make_unique<CorrelativeMatcher>(options);
  });
  // The correlative matcher, then from its pose the line matcher.
  registry.add("hybrid", [](const ScanMatcherOptions& options) {
    return std::make_unique<HybridMatcher>(options);
  });
  // Gauss-Newton over distances to the nearest surfaces (Censi 2008).
  registry.add("point_to_line", [](const ScanMatcherOptions& /*options*/) {
    return std::make_unique<LineMatcher>();
  });
}

}  // namespace trident::slam
