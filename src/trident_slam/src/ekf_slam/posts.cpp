// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "posts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "trident_base/angle.h"

namespace trident::slam {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// `count` neighbouring beams from `first` on whose ranges differ by less than the clearance; in a
/// round scan beam 0 follows the last one.
struct Cluster {
  std::size_t first;
  std::size_t count;
};

double range_of(const LaserScan& scan, std::size_t beam) {
  if (scan.is_return(beam)) return scan.ranges[beam];
  return std::isnan(scan.ranges[beam]) || scan.ranges[beam] < scan.range_min ? 0.0 : kFar;
}

bool is_round(const LaserScan& scan) {
  return std::abs(scan.angle_increment) * static_cast<double>(scan.size()) > 2.0 * kPi - 0.05;
}

bool is_joined(const LaserScan& scan, std::size_t a, std::size_t b, double clearance) {
  return scan.is_return(a) && scan.is_return(b) &&
         std::abs(range_of(scan, a) - range_of(scan, b)) < clearance;
}

/// A beam that begins a cluster: 0, or in a round scan the first after a gap.
std::size_t first_beam(const LaserScan& scan, double clearance) {
  if (!is_round(scan)) return 0;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const std::size_t before = (beam + scan.size() - 1) % scan.size();
    if (!is_joined(scan, before, beam, clearance)) return beam;
  }
  return 0;
}

/// Neighbouring returns that lie within the clearance of each other. The search begins at a gap, so
/// that no cluster is cut where a full scan ends.
std::vector<Cluster> clusters(const LaserScan& scan, double clearance) {
  std::vector<Cluster> result;
  const std::size_t start = first_beam(scan, clearance);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::size_t beam = (start + i) % scan.size();
    if (!scan.is_return(beam)) continue;
    const std::size_t before = (beam + scan.size() - 1) % scan.size();
    if (i > 0 && is_joined(scan, before, beam, clearance)) {
      ++result.back().count;
    } else {
      result.push_back({beam, 1});
    }
  }
  return result;
}

/// The range of the beam before or after a cluster; 0 (nothing can be said) at the edge of the
/// view.
double adjacent_range(const LaserScan& scan, const Cluster& cluster, bool after) {
  const std::size_t n = scan.size();
  const bool is_edge = after ? cluster.first + cluster.count >= n : cluster.first == 0;
  if (is_edge && !is_round(scan)) return 0.0;
  return range_of(scan, (cluster.first + (after ? cluster.count : n - 1)) % n);
}

PointObservation middle_of(const LaserScan& scan, const Cluster& cluster, double nearest,
                           double radius, double range_sigma) {
  const auto beams = static_cast<double>(cluster.count);
  const double angle = scan.angle(cluster.first) + 0.5 * (beams - 1.0) * scan.angle_increment;
  const double distance = nearest + radius;
  const Eigen::Vector2d forward(std::cos(angle), std::sin(angle));
  const Eigen::Vector2d left(-forward.y(), forward.x());
  // The edges lie anywhere within one increment: so does the middle, and as much the diameter.
  const double edge = distance * std::abs(scan.angle_increment) / std::sqrt(12.0);
  const double along = std::hypot(range_sigma / std::sqrt(beams), edge);
  const Eigen::Matrix2d R = scan.T_base_laser.rotation();
  PointObservation post;
  post.p_base = scan.T_base_laser * Eigen::Vector2d(distance * forward);
  const double across = std::hypot(range_sigma * 0.1, edge);
  post.covariance =
      R *
      (along * along * forward * forward.transpose() + across * across * left * left.transpose()) *
      R.transpose();
  return post;
}

double nearest_range(const LaserScan& scan, const Cluster& cluster) {
  double nearest = kFar;
  for (std::size_t i = 0; i < cluster.count; ++i) {
    nearest = std::min(nearest, range_of(scan, (cluster.first + i) % scan.size()));
  }
  return nearest;
}

/// A round post of radius r whose nearest point is at d fills an angle of 2 asin(r / (d + r));
/// solved for r. What is wide, or has something close behind it on either side, is part of a wall.
std::optional<PointObservation> post_of(const LaserScan& scan, const Cluster& cluster,
                                        const PostParams& params) {
  const double nearest = nearest_range(scan, cluster);
  const double half = 0.5 * static_cast<double>(cluster.count) * std::abs(scan.angle_increment);
  if (half >= 0.25 * kPi || nearest > params.max_range) return std::nullopt;
  const double radius = nearest * std::sin(half) / (1.0 - std::sin(half));
  const double behind = nearest + radius + params.clearance;
  const bool stands_free =
      adjacent_range(scan, cluster, false) > behind && adjacent_range(scan, cluster, true) > behind;
  if (2.0 * radius > params.max_diameter || !stands_free) return std::nullopt;
  return middle_of(scan, cluster, nearest, radius, params.range_sigma);
}

}  // namespace

std::vector<PointObservation> find_posts(const LaserScan& scan, const PostParams& params) {
  std::vector<PointObservation> posts;
  for (const Cluster& cluster : clusters(scan, params.clearance)) {
    if (cluster.count < static_cast<std::size_t>(params.min_beams)) continue;
    if (const auto post = post_of(scan, cluster, params)) posts.push_back(*post);
  }
  return posts;
}

}  // namespace trident::slam
