// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "kidnap_detector.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "place.h"
#include "relocalizer.h"

namespace trident::slam {
namespace {

/// The keyframes nearest to a pose, whose free space can contradict it.
std::vector<int> witnesses(const KeyframeGraph& graph, const SE2& T_map_base,
                           const LocalizationOptions& options) {
  std::vector<std::pair<double, int>> near;
  for (int i = 0; i < graph.size(); ++i) {
    const double distance = (graph.pose(i).p - T_map_base.p).norm();
    if (distance < options.witness_reach) near.emplace_back(distance, i);
  }
  const auto count =
      std::min<std::ptrdiff_t>(options.witnesses, static_cast<std::ptrdiff_t>(near.size()));
  std::partial_sort(near.begin(), near.begin() + count, near.end());
  std::vector<int> chosen;
  for (auto it = near.begin(); it != near.begin() + count; ++it) chosen.push_back(it->second);
  return chosen;
}

}  // namespace

double KidnapDetector::fit(const KeyframeGraph& graph, const SurfelMap& surfels,
                           const PointScan& scan, const MatchResult& match) const {
  if (match.inlier_fraction >= options_.good_inliers) return match.inlier_fraction;
  const Place place(graph, witnesses(graph, match.T_ref_base, options_), free_space_);
  const Agreement agreement = place.agreement(surfels, scan, match.T_ref_base);
  return agreement.overlap < options_.min_overlap ? match.inlier_fraction : agreement.ratio;
}

/// What has been on trial, when that is over and it has fitted all along.
std::optional<MatchResult> KidnapDetector::end_trial() {
  if (!hypothesis_ || hypothesis_->path_length < options_.trial_distance ||
      hypothesis_->scans < options_.trial_scans)
    return std::nullopt;
  const PoseHypothesis hypothesis = *std::exchange(hypothesis_, std::nullopt);
  if (hypothesis.fit < options_.min_fit * hypothesis.scans) return std::nullopt;
  return hypothesis.match;
}

/// A pose elsewhere is on trial for some distance and scans while tracking continues; it is
/// believed only if it fits over the whole trial, since a single scan fits in many places.
std::optional<MatchResult> KidnapDetector::check(const KeyframeGraph& graph,
                                                 const SurfelMap& surfels, const PointScan& scan,
                                                 const SE2& T_last_base, const MatchResult& own,
                                                 const LineMatchOptions& line) {
  const double own_fit = fit(graph, surfels, scan, own);
  if (hypothesis_) {
    follow(graph, surfels, scan, T_last_base, own_fit, line);
    return end_trial();
  }
  poor_in_a_row_ = own_fit < options_.min_fit ? poor_in_a_row_ + 1 : 0;
  if (poor_in_a_row_ >= options_.poor_scans) {
    poor_in_a_row_ = 0;
    search(graph, surfels, scan, own, own_fit, line);
  }
  return std::nullopt;
}

void KidnapDetector::search(const KeyframeGraph& graph, const SurfelMap& surfels,
                            const PointScan& scan, const MatchResult& own, double own_fit,
                            const LineMatchOptions& line) {
  const auto found = relocalize_in_map(surfels, scan, line, search_);
  if (!found) return;
  const SE2 away = own.T_ref_base.inverse() * found->T_ref_base;
  if (away.p.norm() < options_.same_place && std::abs(away.angle) < options_.same_heading) return;
  const double found_fit = fit(graph, surfels, scan, *found);
  if (found_fit < own_fit + options_.lead) return;
  hypothesis_ = PoseHypothesis{*found};
}

/// The hypothesis moves with the robot and is matched by itself; it is dropped as soon as it does
/// not lead the robot's own pose.
void KidnapDetector::follow(const KeyframeGraph& graph, const SurfelMap& surfels,
                            const PointScan& scan, const SE2& T_last_base, double own_fit,
                            const LineMatchOptions& line) {
  PosePrior prior;
  prior.T_ref_base = hypothesis_->match.T_ref_base * T_last_base;
  prior.information = Eigen::Vector3d::Constant(options_.prior_information).asDiagonal();
  hypothesis_->match = match_lines(surfels, scan, prior.T_ref_base, prior, line);
  const double hypothesis_fit = fit(graph, surfels, scan, hypothesis_->match);
  hypothesis_->path_length += T_last_base.p.norm();
  hypothesis_->fit += hypothesis_fit;
  hypothesis_->lead += hypothesis_fit - own_fit;
  ++hypothesis_->scans;
  if (hypothesis_->scans >= options_.scans_to_lead &&
      hypothesis_->lead < options_.lead * hypothesis_->scans)
    hypothesis_.reset();
}

}  // namespace trident::slam
