// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Scans whose beams are measured one after the other while the base moves.
#include <utility>

#include "graph_mapper.h"
#include "trident_slam/sweep_motion.h"

namespace trident::slam {
namespace {

/// A motion over a longer time says little about now [s].
constexpr double kLongestGap = 1.0;
/// A guess that was wrong by less over the sweep is good enough [m], [rad].
constexpr double kGoodGuess = 0.002;
/// How well the guess's error tells where the base was instead: 3 cm, 0.03 rad.
constexpr double kShiftInformation = 1100.0;

}  // namespace

void GraphMapper::settle_rolling_scan(std::int64_t next_stamp_ns,
                                      const OdometryMotion::Step& motion) {
  if (!rolling_) return;
  RollingScan rolling = *std::exchange(rolling_, std::nullopt);
  const double passed = 1e-9 * static_cast<double>(next_stamp_ns - rolling.scan.stamp_ns);
  const bool is_known = motion.problem.empty() && passed > 0.0 && passed <= kLongestGap;
  const Eigen::Vector3d twist =
      is_known ? sweep_twist(rolling.scan, motion.T_before_now, passed) : rolling.twist;
  const auto points = std::make_shared<const PointScan>(points_of(rolling.scan, twist));
  const double sweep = sweep_duration(rolling.scan);
  const Eigen::Vector3d error = (twist - rolling.twist) * sweep;
  if (options_.use_scan_matching && !tracker_.surfels().empty() &&
      error.cwiseAbs().maxCoeff() > kGoodGuess) {
    // In the middle of the sweep both motions put the base at the same place.
    PosePrior prior;
    prior.T_ref_base = tracker_.T_map_base() * SE2::exp(rolling.twist * (0.5 * sweep)) *
                       SE2::exp(twist * (0.5 * sweep)).inverse();
    prior.information.diagonal().setConstant(kShiftInformation);
    rolling.match =
        match_lines(tracker_.surfels(), *points, prior.T_ref_base, prior, tracker_.options().line);
    tracker_.set_pose(rolling.match.T_ref_base);
  }
  if (is_keyframe_due()) add_keyframe(points, rolling.match);
  if (!rolling.is_archived) return;
  ScanArchive::Entry& entry = archive_[archive_.size() - 1];
  entry.twist = twist.cast<float>();
  entry.keyframe = graph_.size() - 1;
  entry.T_keyframe_base = entry.keyframe < 0
                              ? tracker_.T_map_base()
                              : graph_.pose(entry.keyframe).inverse() * tracker_.T_map_base();
}

}  // namespace trident::slam
