// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "conformance/scan_world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"

namespace trident::slam::testing_world {
namespace {

constexpr std::size_t kBeams = 360;
constexpr double kRangeSigma = 0.01;
constexpr double kStepLength = 0.12;
constexpr int kLaps = 2;
const SE2 kBaseLaser = SE2::from_xy_yaw(0.1, 0.0, 0.05);

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A closed course as points at every step: an oval with a wobble.
std::vector<SE2> course() {
  std::vector<SE2> poses;
  constexpr double kLength = 18.0;
  const auto place = [](double s) {
    const double t = 2.0 * kPi * s / kLength;
    return Eigen::Vector2d(3.6 * std::cos(t) + 0.3 * std::cos(3.0 * t), 2.0 * std::sin(t));
  };
  for (double s = 0.0; s < kLaps * kLength; s += kStepLength) {
    const Eigen::Vector2d here = place(s);
    const Eigen::Vector2d ahead = place(s + 0.01) - here;
    poses.push_back(SE2::from_xy_yaw(here.x(), here.y(), std::atan2(ahead.y(), ahead.x())));
  }
  return poses;
}

}  // namespace

ScanWorld::ScanWorld(std::uint64_t seed) : noise_(seed, "scan_world") {
  add_box(-6.0, -4.0, 12.0, 8.0);
  add_box(-6.0, 2.8, 1.5, 1.2);
  add_box(5.2, -1.0, 0.8, 1.6);
  add_box(-0.6, -0.25, 1.2, 0.5);
  for (const auto& [x, y] : {std::pair{2.0, 0.4},
                             {-2.2, 0.3},
                             {4.8, 3.0},
                             {-4.9, -3.0},
                             {1.0, 3.2},
                             {-1.5, -3.1},
                             {3.2, -3.2}}) {
    posts_.push_back({{x, y}, 0.12});
  }
  const std::vector<SE2> poses = course();
  T_world_start_ = poses.front();
  SE2 T_odom_base = SE2::from_xy_yaw(3.0, -7.0, 0.4);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    if (k > 0) {
      const SE2 moved = poses[k - 1].inverse() * poses[k];
      T_odom_base =
          T_odom_base * SE2::from_xy_yaw(moved.p.x() * (1.0 + 0.02 * noise_.normal(k, 900)),
                                         moved.p.y() + 0.001 * noise_.normal(k, 901),
                                         moved.angle * 1.03 + 0.002 * noise_.normal(k, 902));
    }
    steps_.push_back({scan_at(poses[k], k), T_odom_base, T_world_start_.inverse() * poses[k]});
  }
}

void ScanWorld::add_box(double x, double y, double width, double height) {
  const Eigen::Vector2d corners[] = {
      {x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
  for (int i = 0; i < 4; ++i) walls_.push_back({corners[i], corners[(i + 1) % 4]});
}

double ScanWorld::range(const Eigen::Vector2d& from, double angle) const {
  const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) {
    const Eigen::Vector2d along = wall.b - wall.a;
    const double area = cross(d, along);
    if (std::abs(area) < 1e-12) continue;
    const double t = cross(wall.a - from, along) / area;
    const double u = cross(wall.a - from, d) / area;
    if (t > 0.0 && u >= 0.0 && u <= 1.0) nearest = std::min(nearest, t);
  }
  for (const Post& post : posts_) {
    const Eigen::Vector2d to = post.center - from;
    const double ahead = to.dot(d);
    const double half2 = post.radius * post.radius - (to.squaredNorm() - ahead * ahead);
    if (ahead > 0.0 && half2 > 0.0) nearest = std::min(nearest, ahead - std::sqrt(half2));
  }
  return nearest;
}

LaserScan ScanWorld::scan_at(const SE2& T_world_base, std::size_t k) const {
  LaserScan scan;
  scan.stamp_ns = static_cast<std::int64_t>(k) * 100'000'000;
  scan.angle_min = -kPi;
  scan.angle_increment = 2.0 * kPi / kBeams;
  scan.range_min = 0.05;
  scan.range_max = 10.0;
  scan.T_base_laser = kBaseLaser;
  const SE2 T_world_laser = T_world_base * kBaseLaser;
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    const double truth = range(T_world_laser.p, T_world_laser.angle + scan.angle(beam));
    const double seen = truth + kRangeSigma * noise_.normal(k, static_cast<std::uint32_t>(beam));
    scan.ranges.push_back(seen > scan.range_max ? std::numeric_limits<float>::infinity()
                                                : static_cast<float>(seen));
  }
  return scan;
}

double ScanWorld::distance_to_surface(const Eigen::Vector2d& p_start) const {
  const Eigen::Vector2d p = T_world_start_ * p_start;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) {
    const Eigen::Vector2d along = wall.b - wall.a;
    const double u = std::clamp((p - wall.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - wall.a - u * along).norm());
  }
  for (const Post& post : posts_) {
    nearest = std::min(nearest, std::abs((p - post.center).norm() - post.radius));
  }
  return nearest;
}

}  // namespace trident::slam::testing_world
