// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/control/scan_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

double separation(const Point2& a, const Point2& b) { return distance(a.x, a.y, b.x, b.y); }

void require_legal(const ScanPoints& scan) {
  if (!std::isfinite(scan.sensor.x) || !std::isfinite(scan.sensor.y)) {
    throw Error("scan: the sensor's position is not finite");
  }
  if (!(scan.angle_increment > 0.0) || !std::isfinite(scan.angle_increment)) {
    throw Error("scan: angle_increment is " + number_text(scan.angle_increment) + " rad (> 0)");
  }
}

}  // namespace

bool ScanPoints::sees(const Point2& point) const {
  // What ends a little before a point may be the surface of what is there.
  constexpr double kSurface_m = 0.4;
  if (ends.empty() || !(angle_increment > 0.0)) return false;
  const double bearing = std::atan2(point.y - sensor.y, point.x - sensor.x) - first_angle;
  const double ahead = wrap_angle(is_clockwise ? -bearing : bearing);
  const double turned = ahead < 0.0 ? ahead + 2.0 * kPi : ahead;
  auto beam = static_cast<std::size_t>(std::lround(turned / angle_increment));
  if (beam >= ends.size()) {
    if (!is_full_turn) return false;
    beam %= ends.size();
  }
  const double range_m = separation(sensor, ends[beam]);
  return !std::isfinite(range_m) || range_m + kSurface_m >= separation(sensor, point);
}

void ScanClusterer::collect_beams(const ScanPoints& scan) {
  beams_.clear();
  ranges_m_.assign(scan.ends.size(), kNothing);
  for (std::size_t i = 0; i < scan.ends.size(); ++i) {
    const double range_m = separation(scan.sensor, scan.ends[i]);
    if (!std::isfinite(range_m)) continue;
    ranges_m_[i] = range_m;
    beams_.push_back({i, range_m});
  }
}

// Beams between that saw nothing widen the angle that the surface spans.
bool ScanClusterer::is_break(const ScanPoints& scan, const Beam& a, const Beam& b) const {
  const std::size_t count = scan.ends.size();
  const std::size_t skipped = (b.index + count - a.index) % count;
  const double angle = scan.angle_increment * static_cast<double>(skipped);
  if (angle >= params_.incidence_angle) return true;
  const double most_m = a.range_m * std::sin(angle) / std::sin(params_.incidence_angle - angle);
  return separation(scan.ends[a.index], scan.ends[b.index]) > params_.min_gap + most_m;
}

// Whether the beam next to an end is cut short by something else.
bool ScanClusterer::is_hidden(const ScanPoints& scan, const Beam& end, int direction) const {
  const std::size_t count = scan.ends.size();
  const bool is_edge = direction > 0 ? end.index + 1 == count : end.index == 0;
  if (is_edge && !scan.is_full_turn) return true;
  const std::size_t next = (end.index + (direction > 0 ? 1 : count - 1)) % count;
  return ranges_m_[next] < end.range_m;
}

void ScanClusterer::add(const ScanPoints& scan, std::size_t first, std::size_t count) {
  if (count < static_cast<std::size_t>(params_.min_points)) return;
  const auto beam = [&](std::size_t k) -> const Beam& {
    return beams_[(first + k) % beams_.size()];
  };
  const Point2& a = scan.ends[beam(0).index];
  const Point2& b = scan.ends[beam(count - 1).index];
  ScanCluster cluster;
  cluster.center = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  cluster.points = static_cast<int>(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double r = separation(cluster.center, scan.ends[beam(k).index]);
    cluster.radius_m = std::max(cluster.radius_m, r);
  }
  if (cluster.radius_m > params_.max_radius) return;
  cluster.is_partial = is_hidden(scan, beam(0), -1) || is_hidden(scan, beam(count - 1), 1);
  clusters_.push_back(cluster);
}

/// A full turn begins at a break, so that no object is cut by the scan's ends.
std::size_t ScanClusterer::first_beam(const ScanPoints& scan) const {
  std::size_t start = 0;
  while (scan.is_full_turn && start + 1 < beams_.size() &&
         !is_break(scan, beams_[(start + beams_.size() - 1) % beams_.size()], beams_[start])) {
    ++start;
  }
  return start;
}

const std::vector<ScanCluster>& ScanClusterer::cluster(const ScanPoints& scan) {
  require_legal(scan);
  clusters_.clear();
  collect_beams(scan);
  if (beams_.empty()) return clusters_;
  const std::size_t start = first_beam(scan);
  std::size_t first = 0;
  for (std::size_t k = 1; k <= beams_.size(); ++k) {
    const Beam& before = beams_[(start + k - 1) % beams_.size()];
    if (k < beams_.size() && !is_break(scan, before, beams_[(start + k) % beams_.size()])) continue;
    add(scan, start + first, k - first);
    first = k;
  }
  return clusters_;
}

}  // namespace trident::nav
