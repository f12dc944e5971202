// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/core/path_cusps.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"

namespace trident::nav {
namespace {

double direction(const Pose2& from, const Pose2& to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

bool is_backward(const Pose2& from, const Pose2& to) {
  return std::fabs(wrap_angle(from.yaw - direction(from, to))) > 0.5 * kPi;
}

/// The last of the poses of each place.
std::vector<std::size_t> places_of(const Path& path) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool is_last = i + 1 == path.size() || distance(path[i].x, path[i].y, path[i + 1].x,
                                                          path[i + 1].y) >= kPointApart;
    if (is_last) places.push_back(i);
  }
  return places;
}

/// Headings along the path or against it, in all but a tenth of the points.
bool fit_direction(const Path& path, const std::vector<std::size_t>& places) {
  constexpr double kTolerance = 0.6;
  std::size_t odd = 0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const Pose2& pose = path[places[k]];
    const double off = std::fabs(wrap_angle(pose.yaw - direction(pose, path[places[k + 1]])));
    if (off > kTolerance && off < kPi - kTolerance) ++odd;
  }
  return 10 * odd <= places.size();
}

bool has_own_headings(const Path& path, const std::vector<std::size_t>& places) {
  if (places.size() < 2) return false;
  const bool are_zero = std::all_of(places.begin(), places.end() - 1,
                                    [&](std::size_t i) { return path[i].yaw == 0.0; });
  return !are_zero && fit_direction(path, places);
}

double tolerance_of(double before_m, double after_m) {
  constexpr double kShare = 0.25, kMin_m = 0.005, kMax_m = 0.05;
  return std::clamp(kShare * std::min(before_m, after_m), kMin_m, kMax_m);
}

/// Whether the robot changes gear at a pose, and turns back there.
bool is_cusp(const Pose2& before, const Pose2& at, const Pose2& after) {
  const double turn = std::fabs(wrap_angle(direction(at, after) - direction(before, at)));
  const bool changes_gear = is_backward(before, at) != is_backward(at, after);
  return changes_gear && turn > 0.5 * kPi;
}

}  // namespace

bool Cusp::is_passed(double left_m, double last_left_m) const {
  constexpr double kExact_m = 0.005;
  constexpr double kProgress_m = 0.001;
  if (left_m <= kExact_m) return true;
  return left_m <= tolerance_m && last_left_m - left_m < kProgress_m;
}

bool has_own_headings(const Path& path) { return has_own_headings(path, places_of(path)); }

std::vector<Cusp> cusps_of(const Path& path) {
  const std::vector<std::size_t> places = places_of(path);
  std::vector<Cusp> cusps;
  if (!has_own_headings(path, places)) return cusps;
  const auto at = [&](std::size_t k) -> const Pose2& { return path[places[k]]; };
  double part_m = 0.0;
  std::vector<double> parts_m;  // lengths between the cusps and the path's ends
  for (std::size_t k = 1; k < places.size(); ++k) {
    part_m += distance(at(k - 1).x, at(k - 1).y, at(k).x, at(k).y);
    if (k + 1 == places.size()) break;
    if (!is_cusp(at(k - 1), at(k), at(k + 1))) continue;
    cusps.push_back({places[k], 0.0});
    parts_m.push_back(part_m);
    part_m = 0.0;
  }
  parts_m.push_back(part_m);
  for (std::size_t i = 0; i < cusps.size(); ++i) {
    cusps[i].tolerance_m = tolerance_of(parts_m[i], parts_m[i + 1]);
  }
  return cusps;
}

}  // namespace trident::nav
