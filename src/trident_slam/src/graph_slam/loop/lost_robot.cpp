// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lost_robot.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "place.h"
#include "relocalizer.h"

namespace trident::slam {
namespace {

/// The robot is sought after so many scans of which less than this part fits.
constexpr int kScansUntilSought = 5;
constexpr double kPoorFit = 0.75;
/// Scans that lie on surfaces to this part need no closer look.
constexpr double kGoodInliers = 0.9;
/// A rival must fit better by this, over this way, to be believed instead.
constexpr double kLead = 0.15;
constexpr double kTrialWay = 2.0;  // [m]; turns alone do not tell rooms apart
constexpr int kTrialScans = 10;
/// It is given up when it has not been better for so many scans.
constexpr int kScansToLead = 4;
/// Nearer than this it is the same place.
constexpr double kSamePlace = 0.5;    // [m]
constexpr double kSameHeading = 0.3;  // [rad]
/// Keyframes that tell what is free about a pose.
constexpr int kWitnesses = 20;
constexpr double kWitnessReach = 6.0;  // [m]
/// Less of the scan in what they saw says nothing.
constexpr double kLeastOverlap = 0.3;

std::vector<int> witnesses(const KeyframeGraph& graph, const SE2& T_map_base) {
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i < graph.size(); ++i) {
    const double distance = (graph.pose(i).p - T_map_base.p).norm();
    if (distance < kWitnessReach) near.emplace_back(distance, i);
  }
  const auto count = std::min<std::ptrdiff_t>(kWitnesses, static_cast<std::ptrdiff_t>(near.size()));
  std::partial_sort(near.begin(), near.begin() + count, near.end());
  std::vector<int> chosen;
  for (auto it = near.begin(); it != near.begin() + count; ++it) chosen.push_back(it->second);
  return chosen;
}

/// The part of a scan that fits, of that which could.
double fit(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
           const MatchResult& match) {
  if (match.inlier_fraction >= kGoodInliers) return match.inlier_fraction;
  const Place place(graph, witnesses(graph, match.T_ref_base));
  const Agreement agreement = place.agreement(surfels, scan, match.T_ref_base);
  return agreement.overlap < kLeastOverlap ? match.inlier_fraction : agreement.ratio;
}

}  // namespace

std::optional<MatchResult> LostRobot::check(const KeyframeGraph& graph, const SurfelMap& surfels,
                                            const PointScan& scan, const SE2& T_last_base,
                                            const MatchResult& own, const LineMatchOptions& line) {
  const double own_fit = fit(graph, surfels, scan, own);
  if (rival_) {
    follow(graph, surfels, scan, T_last_base, own_fit, line);
    if (!rival_ || rival_->way < kTrialWay || rival_->scans < kTrialScans) return std::nullopt;
    const Rival rival = *std::exchange(rival_, std::nullopt);
    if (rival.fit < kPoorFit * rival.scans) return std::nullopt;
    return rival.match;
  }
  poor_in_a_row_ = own_fit < kPoorFit ? poor_in_a_row_ + 1 : 0;
  if (poor_in_a_row_ >= kScansUntilSought) {
    poor_in_a_row_ = 0;
    seek(graph, surfels, scan, own, own_fit, line);
  }
  return std::nullopt;
}

void LostRobot::seek(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
                     const MatchResult& own, double own_fit, const LineMatchOptions& line) {
  const auto found = find_in_map(surfels, scan, line, 0.55);
  if (!found) return;
  const SE2 away = own.T_ref_base.inverse() * found->T_ref_base;
  if (away.p.norm() < kSamePlace && std::abs(away.angle) < kSameHeading) return;
  const double found_fit = fit(graph, surfels, scan, *found);
  if (found_fit < own_fit + kLead) return;
  rival_ = Rival{*found};
}

void LostRobot::follow(const KeyframeGraph& graph, const SurfelMap& surfels, const PointScan& scan,
                       const SE2& T_last_base, double own_fit, const LineMatchOptions& line) {
  PosePrior prior;
  prior.T_ref_base = rival_->match.T_ref_base * T_last_base;
  prior.information = Eigen::Vector3d(400.0, 400.0, 400.0).asDiagonal();  // 5 cm, 0.05 rad
  rival_->match = match_lines(surfels, scan, prior.T_ref_base, prior, line);
  const double rival_fit = fit(graph, surfels, scan, rival_->match);
  rival_->way += T_last_base.p.norm();
  rival_->fit += rival_fit;
  rival_->lead += rival_fit - own_fit;
  ++rival_->scans;
  if (rival_->scans >= kScansToLead && rival_->lead < kLead * rival_->scans) rival_.reset();
}

}  // namespace trident::slam
