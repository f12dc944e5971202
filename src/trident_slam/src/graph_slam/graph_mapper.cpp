// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_mapper.h"

#include <algorithm>
#include <cmath>

#include "graph_slam/backend/final_match.h"

namespace trident::slam {
namespace {

/// Part of a keyframe's points that must lie on an older stretch's surfaces to tie it to them.
constexpr double kReuseShare = 0.25;
/// Stretches before the newest one that are its own surroundings, not a place come back to.
constexpr int kOwnStretches = 3;
/// What surfaces may be reused is found out anew every so many keyframes.
constexpr int kHidePeriod = 5;
/// Localising, recent scans are asked where less of a scan lies on the map's surfaces, and believed
/// where more lies on theirs.
constexpr double kExplained = 0.75;

ScanTrackerOptions tracker_options(const GraphSlamOptions& options) {
  ScanTrackerOptions result;
  result.noise.distance_per_metre = options.odometry_distance_noise;
  result.noise.yaw_per_radian = options.odometry_heading_noise;
  return result;
}

MotionFilter keyframe_filter(const GraphSlamOptions& options) {
  return MotionFilter({options.minimum_travel_distance, options.minimum_travel_heading});
}

LoopCloserOptions closer_options(const GraphSlamOptions& options) {
  LoopCloserOptions result;
  result.reuse_distance = options.reuse_distance;
  result.search_distance = options.loop_search_maximum_distance;
  result.min_agreement = options.loop_match_minimum_response_fine;
  return result;
}

/// Information of a transform from spreads along x, y [m] and of yaw [rad].
Eigen::Matrix3d information(double sigma, double sigma_yaw) {
  const double w = 1.0 / (sigma * sigma);
  return Eigen::Vector3d(w, w, 1.0 / (sigma_yaw * sigma_yaw)).asDiagonal();
}

}  // namespace

GraphMapper::GraphMapper(const GraphSlamOptions& options, const PoseGraphSolverMaker& solver)
    : options_(options),
      keyframe_filter_(keyframe_filter(options)),
      motion_source_(options.use_odometry,
                     OdometryMotion(options.odometry_jump_distance, options.odometry_jump_heading)),
      calibration_(options.calibrate_odometry),
      tracker_(tracker_options(options)),
      graph_(options.loop_match_minimum_chain_size, solver),
      worker_(closer_options(options)),
      stale_scans_(options.lifelong),
      recent_scans_(static_cast<std::size_t>(options.scan_buffer_size),
                    options.scan_buffer_maximum_scan_distance, tracker_.options().line) {
  options.validate();
  if (options.scan_matcher != GraphSlamOptions::kLinesOfTheMap) {
    submap_matcher_.emplace(options.scan_matcher);
    tracker_.set_refine(
        [this](const PointScan& scan, const SE2& guess, const PosePrior& prior) -> MatchResult {
          return submap_matcher_->match(graph_, tracker_.surfels(), scan, guess, prior);
        });
  }
  tracker_.set_pose(SE2::from_xy_yaw(options.map_start_pose[0], options.map_start_pose[1],
                                     options.map_start_pose[2]));
}

ScanPose2d GraphMapper::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  take_from_worker();
  OdometryMotion::Step motion = motion_source_.next(scan.stamp_ns, T_odom_base);
  if (!motion.by_scans) {
    travelled_ += motion.T_before_now.p.norm();
    motion.T_before_now = calibration_.calibrated(motion.T_before_now);
  }
  final_poses_.clear();
  settle_rolling_scan(scan.stamp_ns, motion);
  ScanPose2d result;
  result.problem = check_.problem(scan);
  result.is_used = result.problem.empty();
  ScanArchive::Entry entry;
  entry.stamp_ns = scan.stamp_ns;
  entry.is_used = result.is_used;
  if (result.is_used) {
    const Eigen::Vector3d twist = twist_of(scan, motion.T_before_now);
    entry.twist = twist.cast<float>();
    const auto points = std::make_shared<const PointScan>(points_of(scan, twist));
    motion_source_.measure(points, &motion);
    const MatchResult match = place(points, motion, scan.T_base_laser);
    tell_uncertainty(motion, match, *points, &result);
    if (options_.deskew && scan.time_increment != 0.0) {
      rolling_ = {scan, twist, match};
    } else if (is_keyframe_due()) {
      add_keyframe(points, match);
    }
  } else {
    tracker_.coast(motion);
    calibration_.interrupt();
  }
  const std::string news = settle_motion(motion, result.is_used);
  last_stamp_ns_ = scan.stamp_ns;
  if (result.problem.empty()) result.problem = motion.problem;
  if (result.problem.empty()) result.problem = news;
  result.T_map_base = tracker_.T_map_base();
  if (options_.mode == SlamMode::kLocalization || is_paused_) return result;
  if (rolling_) rolling_->is_archived = true;
  entry.keyframe = graph_.size() - 1;
  entry.T_keyframe_base = entry.keyframe < 0
                              ? result.T_map_base
                              : graph_.pose(entry.keyframe).inverse() * result.T_map_base;
  archive_.add(scan, entry, options_.keep_scans ? options_.max_laser_range : 0.0);
  return result;
}

MatchResult GraphMapper::place(const std::shared_ptr<const PointScan>& points,
                               const OdometryMotion::Step& motion, const SE2& T_base_laser) {
  if (!options_.use_scan_matching) {
    tracker_.coast(motion);
    return {};
  }
  const SE2 T_map_last = tracker_.T_map_base();
  tracker_.set_distance_noise(options_.odometry_distance_noise * calibration_.noise_share());
  MatchResult match = tracker_.track(*points, motion);
  if (motion.problem.empty() && !motion.by_scans) {
    calibration_.learn(T_base_laser, T_map_last.inverse() * match.T_ref_base, match);
  } else {
    calibration_.interrupt();
  }
  if (options_.mode != SlamMode::kLocalization) return match;
  go_on_from_recent_scans(points, &match);
  const auto found = lost_robot_.check(graph_, tracker_.surfels(), *points, motion.T_before_now,
                                       match, tracker_.options().line);
  if (!found) return match;
  tracker_.set_pose(found->T_ref_base);
  recent_scans_.clear();
  return *found;
}

// Where the map explains too little of a scan, the scans before it may: the map ends here, or what
// it shows has been moved.
void GraphMapper::go_on_from_recent_scans(const std::shared_ptr<const PointScan>& points,
                                          MatchResult* match) {
  if (match->inlier_fraction < kExplained) {
    MatchResult refined = *match;
    refined.inlier_fraction = recent_scans_.refine(*points, &refined);
    if (refined.inlier_fraction < kExplained) return;
    *match = refined;  // whose fit says that the robot is not lost
    tracker_.set_pose(match->T_ref_base);
  }
  const SE2& T = tracker_.T_map_base();
  if (!recent_scans_.empty() && !keyframe_filter_.is_due(recent_scans_.newest().inverse() * T))
    return;
  recent_scans_.add(T, points);
}

bool GraphMapper::is_keyframe_due() const {
  if (options_.mode == SlamMode::kLocalization || is_paused_) return false;
  if (graph_.size() == 0) return true;
  return keyframe_filter_.is_due(graph_.pose(graph_.size() - 1).inverse() * tracker_.T_map_base());
}

void GraphMapper::add_keyframe(const std::shared_ptr<const PointScan>& scan,
                               const MatchResult& match) {
  const int k = graph_.add({tracker_.T_map_base(), scan, travelled_});
  if (k > 0) tie_to_previous_keyframe(k, match);
  if (k > 0) tie_to_reused_surfaces(k, *scan);
  if (k % kHidePeriod == 0) hide_what_drifted();
  tracker_.insert(tracker_.T_map_base(), *scan, graph_.stretch_of(k));
  if (options_.mode == SlamMode::kLifelong) forget_replaced_scans();
  const int stretch = graph_.stretch_of(k);
  if (options_.do_loop_closing && graph_.size() == (stretch + 1) * graph_.stretch_size())
    close_loops(stretch);
}

void GraphMapper::tie_to_previous_keyframe(int keyframe, const MatchResult& match) {
  const SE2& T = graph_.pose(keyframe);
  GraphEdge edge;
  edge.from = keyframe - 1;
  edge.to = keyframe;
  edge.T_from_to = graph_.pose(keyframe - 1).inverse() * T;
  Eigen::Matrix3d spread = match.covariance;
  spread.diagonal() += Eigen::Vector3d(1e-4, 1e-4, 2.5e-5);
  if (is_chain_broken_) spread.diagonal() += Eigen::Vector3d(1.0, 1.0, 0.1);
  is_chain_broken_ = false;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = T.rotation();
  const Eigen::Matrix3d turned = R.transpose() * spread.inverse() * R;
  edge.information = 0.5 * (turned + turned.transpose());
  graph_.add_edge(edge);
}

void GraphMapper::tie_to_reused_surfaces(int keyframe, const PointScan& scan) {
  const int stretch = graph_.stretch_of(keyframe);
  const double enough = kReuseShare * static_cast<double>(scan.points.size());
  for (const auto& [owner, points] : tracker_.owners_under(scan)) {
    if (owner >= stretch - kOwnStretches || points < enough) continue;
    const std::pair<int, int> link(owner, stretch);
    if (std::find(reuse_links_.rbegin(), reuse_links_.rend(), link) != reuse_links_.rend())
      continue;
    reuse_links_.push_back(link);
    const int j = graph_.anchor_of(owner);
    graph_.add_edge({j, keyframe, graph_.pose(j).inverse() * graph_.pose(keyframe),
                     information(0.03, 0.01), EdgeKind::kReuse});
  }
}

void GraphMapper::hide_what_drifted() {
  const std::vector<double> ways = graph_.distances_from(graph_.stretch_of(graph_.size() - 1));
  std::vector<char> hidden(ways.size());
  for (std::size_t s = 0; s < ways.size(); ++s) {
    hidden[s] = ways[s] > options_.reuse_distance ? 1 : 0;
  }
  tracker_.hide(std::move(hidden));
}

void GraphMapper::close_loops(int stretch) {
  if (!options_.is_asynchronous) {
    apply(worker_.search(graph_, stretch, tracker_.options().surfel_cell));
    return;
  }
  worker_.ask(stretch);
  worker_.start(graph_, tracker_.options().surfel_cell);
}

void GraphMapper::take_from_worker() {
  std::optional<LoopOutcome> outcome = worker_.take();
  if (!outcome) return;
  apply(std::move(*outcome));
  worker_.start(graph_, tracker_.options().surfel_cell);
}

void GraphMapper::apply(LoopOutcome outcome) {
  if (outcome.poses.empty()) return;
  const int known = static_cast<int>(outcome.poses.size());
  const SE2 T_new_old = outcome.poses.back() * graph_.pose(known - 1).inverse();
  for (const GraphEdge& loop : outcome.loops) graph_.add_edge(loop);
  for (int i = 0; i < graph_.size(); ++i) {
    graph_.set_pose(i, i < known ? outcome.poses[i] : T_new_old * graph_.pose(i));
  }
  tracker_.set_surfels(std::move(outcome.surfels));
  for (int i = known; i < graph_.size(); ++i) {
    tracker_.insert(graph_.pose(i), *graph_[i].scan, graph_.stretch_of(i));
  }
  tracker_.set_pose(T_new_old * tracker_.T_map_base());
  hide_what_drifted();
}

void GraphMapper::rebuild_surfaces() {
  SurfelMap surfels(tracker_.options().surfel_cell);
  for (int i = 0; i < graph_.size(); ++i) {
    surfels.insert(graph_.pose(i), *graph_[i].scan, graph_.stretch_of(i));
  }
  tracker_.set_surfels(std::move(surfels));
  forgotten_scans_ = 0;
}

void GraphMapper::finish() {
  settle_rolling_scan(last_stamp_ns_, {});
  while (worker_.is_busy()) {
    worker_.wait();
    take_from_worker();
  }
  if (!options_.use_scan_matching || options_.mode == SlamMode::kLocalization) return;
  if (graph_.size() < 2) return;
  const SE2 T_before_base = graph_.pose(graph_.size() - 1).inverse() * tracker_.T_map_base();
  final_edges_ = align_all_keyframes(&graph_);
  tracker_.set_pose(graph_.pose(graph_.size() - 1) * T_before_base);
  rebuild_surfaces();
  hide_what_drifted();
  final_poses_ =
      match_archive(archive_, graph_, {options_.min_laser_range, options_.max_laser_range});
}

std::vector<std::size_t> GraphMapper::scans_of_keyframes() const {
  std::vector<std::size_t> scans(static_cast<std::size_t>(graph_.size()));
  for (std::size_t i = archive_.size(); i-- > 0;) {
    if (archive_[i].keyframe >= 0) scans[archive_[i].keyframe] = i;
  }
  return scans;
}

std::vector<StampedPose2d> GraphMapper::trajectory() const {
  std::vector<StampedPose2d> poses(archive_.size());
  for (std::size_t i = 0; i < archive_.size(); ++i) {
    poses[i].stamp_ns = archive_[i].stamp_ns;
    poses[i].T_map_base = final_poses_.empty() ? archive_.pose(i, graph_) : final_poses_[i];
  }
  return poses;
}

}  // namespace trident::slam
