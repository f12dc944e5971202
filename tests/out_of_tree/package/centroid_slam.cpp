// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A scan matcher and a SLAM method in addition to those of trident_slam, by public headers alone.
// Drives 0.5 m through a round room and prints the names of the methods, then where either method
// ends.
#include <trident_slam/point_scan.h>
#include <trident_slam/scan_matcher.h>
#include <trident_slam/slam_2d_factory.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

namespace {

using namespace trident;
using namespace trident::slam;

Eigen::Vector2d centroid(const PointScan& scan, const SE2& T) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const SurfacePoint& point : scan.points) sum += T * point.p.cast<double>();
  return sum / static_cast<double>(scan.points.size());
}

/// Shifts a scan until its points' mean lies on the reference's; the heading stays as guessed.
class CentroidMatcher : public ScanMatcher {
 private:
  void clear() override { reference_.setZero(); }
  void add(const SE2& T_ref_base, const PointScan& scan) override {
    reference_ = centroid(scan, T_ref_base);
  }
  ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior&) const override {
    ScanMatch match;
    const Eigen::Vector2d p = guess.p + reference_ - centroid(scan, guess);
    match.T_ref_base = SE2::from_xy_yaw(p.x(), p.y(), guess.angle);
    match.information.setIdentity();
    match.inlier_fraction = match.score = 1.0;
    match.is_converged = true;
    return match;
  }

  Eigen::Vector2d reference_ = Eigen::Vector2d::Zero();
};

struct CentroidSlamParams {
  double max_range = 20.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("max_range", max_range, Range::positive(), "farther returns are not used [m]");
  }
};

/// Matches every scan with the first one; odometry is not used.
class CentroidSlam : public Slam2d {
 public:
  explicit CentroidSlam(const CentroidSlamParams& params) : params_(params) {
    Registry<ScanMatcherFactory> matchers("scan matcher");
    register_builtin_scan_matchers(matchers);
    matchers.add("centroid",
                 [](const ScanMatcherOptions&) { return std::make_unique<CentroidMatcher>(); });
    matcher_ = matchers.get("centroid")({});
  }

  ScanPose2d add_scan(const LaserScan& scan, const SE2&) override {
    const PointScan points = make_point_scan(scan, {0.05, params_.max_range});
    if (trajectory_.empty()) matcher_->add_to_reference({}, points);
    ScanPose2d pose;
    const SE2 guess = trajectory_.empty() ? SE2{} : trajectory_.back().T_map_base;
    pose.T_map_base = matcher_->match(points, guess).T_ref_base;
    trajectory_.push_back({scan.stamp_ns, pose.T_map_base});
    return pose;
  }
  std::vector<StampedPose2d> trajectory() const override { return trajectory_; }
  OccupancyGrid map() const override { return {}; }

 private:
  CentroidSlamParams params_;
  std::unique_ptr<ScanMatcher> matcher_;
  std::vector<StampedPose2d> trajectory_;
};

/// What a laser at (x, 0) sees of a round wall of 5 m about the origin.
LaserScan scan_at(double x) {
  LaserScan scan;
  scan.angle_increment = 0.01745;
  scan.range_max = 30.0;
  for (int beam = 0; beam < 360; ++beam) {
    const double along = x * std::cos(scan.angle_increment * beam);
    scan.ranges.push_back(static_cast<float>(-along + std::sqrt(along * along + 25.0 - x * x)));
  }
  return scan;
}

}  // namespace

int main() {
  Registry<Slam2dFactory> methods = builtin_slam_2d();
  methods.add("centroid", slam_2d_factory<CentroidSlam, CentroidSlamParams>());
  for (const std::string& name : methods.names()) std::cout << name << ' ';
  Slam2dSetup setup;
  for (const char* name : {"centroid", "odometry"}) {
    const auto slam = methods.get(name)(setup);
    for (int step = 0; step <= 10; ++step) {
      const double x = 0.05 * step;
      slam->add_scan(scan_at(x), SE2::from_xy_yaw(x, 0.0, 0.0));
    }
    std::cout << '\n' << name << ' ' << slam->trajectory().back().T_map_base.p.x();
  }
  std::cout << '\n';
  return 0;
}
