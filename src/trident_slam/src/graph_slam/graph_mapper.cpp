// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/graph_mapper.h"

#include <algorithm>
#include <cmath>

#include "graph_slam/pair_linker.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

/// Part of a keyframe's points that must lie on an older stretch's surfaces to tie it to them.
constexpr double kReuseShare = 0.25;
/// Stretches before the newest one that are its own surroundings, not a place come back to.
constexpr int kOwnStretches = 3;
/// Of the edges but the chain's [standard deviations].
constexpr double kLoopKernel = 3.0;
constexpr int kIterations = 20;
/// A loop that the optimised graph misses by more is not believed [m], [rad].
constexpr double kLoopMisfit = 0.3;
constexpr double kLoopMisfitYaw = 0.1;

ScanTrackerOptions tracker_options(const GraphSlamOptions& options) {
  ScanTrackerOptions result;
  result.noise.distance_per_metre = options.odometry_distance_noise;
  result.noise.yaw_per_radian = options.odometry_heading_noise;
  return result;
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

GraphMapper::GraphMapper(const GraphSlamOptions& options)
    : options_(options),
      tracker_(tracker_options(options)),
      graph_(options.loop_match_minimum_chain_size),
      closer_(closer_options(options)) {
  options.validate();
  tracker_.set_pose(SE2::from_xy_yaw(options.map_start_pose[0], options.map_start_pose[1],
                                     options.map_start_pose[2]));
}

GraphMapper::Motion GraphMapper::motion_since_last_scan(const SE2& T_odom_base) {
  Motion motion;
  constexpr double kDoubt = 0.5;  // [m]
  if (!T_odom_base.p.allFinite() || !std::isfinite(T_odom_base.angle)) {
    motion.problem = "odometry is not a number";
    motion.doubt = kDoubt;
    return motion;
  }
  if (T_odom_last_) motion.T_last_base = T_odom_last_->inverse() * T_odom_base;
  T_odom_last_ = T_odom_base;
  const double metres = motion.T_last_base.p.norm();
  const double radians = std::abs(motion.T_last_base.angle);
  if (metres > options_.odometry_jump_distance || radians > options_.odometry_jump_heading) {
    motion.problem = "odometry jumped by " + number_text(metres) + " m, " + number_text(radians) +
                     " rad, believed up to " + number_text(options_.odometry_jump_distance) +
                     " m, " + number_text(options_.odometry_jump_heading) + " rad";
    motion.doubt = kDoubt;
    motion.T_last_base = SE2::identity();
  }
  travelled_ += motion.T_last_base.p.norm();
  return motion;
}

Eigen::Vector3d GraphMapper::twist_of(const LaserScan& scan, const SE2& T_last_base) const {
  const double dt = 1e-9 * static_cast<double>(scan.stamp_ns - last_stamp_ns_);
  constexpr double kLongestGap = 1.0;  // [s]; a motion over a longer one says little about now
  if (!options_.deskew || scan.time_increment == 0.0 || dt <= 0.0 || dt > kLongestGap) {
    return Eigen::Vector3d::Zero();
  }
  return T_last_base.log() / dt;
}

ScanPose2d GraphMapper::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  const Motion motion = motion_since_last_scan(T_odom_base);
  final_poses_.clear();
  ScanPose2d result;
  result.problem = check_.problem(scan);
  result.is_used = result.problem.empty();
  ScanArchive::Entry entry;
  entry.stamp_ns = scan.stamp_ns;
  entry.is_used = result.is_used;
  MatchResult match;
  if (result.is_used) {
    const Eigen::Vector3d twist = twist_of(scan, motion.T_last_base);
    entry.twist = twist.cast<float>();
    const auto points = std::make_shared<const PointScan>(
        make_point_scan(scan, {options_.min_laser_range, options_.max_laser_range}, twist));
    if (options_.use_scan_matching) {
      match = tracker_.track(*points, motion.T_last_base, motion.doubt);
    } else {
      tracker_.coast(motion.T_last_base);
    }
    if (is_keyframe_due()) add_keyframe(points, match);
  } else {
    tracker_.coast(motion.T_last_base);
  }
  last_stamp_ns_ = scan.stamp_ns;
  if (result.problem.empty()) result.problem = motion.problem;
  result.T_map_base = tracker_.T_map_base();
  result.covariance = match.covariance;
  entry.keyframe = graph_.size() - 1;
  entry.T_keyframe_base = entry.keyframe < 0
                              ? result.T_map_base
                              : graph_.pose(entry.keyframe).inverse() * result.T_map_base;
  archive_.add(scan, entry, options_.max_laser_range);
  return result;
}

bool GraphMapper::is_keyframe_due() const {
  if (graph_.size() == 0) return true;
  const SE2 moved = graph_.pose(graph_.size() - 1).inverse() * tracker_.T_map_base();
  return moved.p.norm() > options_.minimum_travel_distance ||
         std::abs(moved.angle) > options_.minimum_travel_heading;
}

void GraphMapper::add_keyframe(const std::shared_ptr<const PointScan>& scan,
                               const MatchResult& match) {
  const SE2& T = tracker_.T_map_base();
  const int k = graph_.add({T, scan, travelled_});
  if (k > 0) {
    Eigen::Matrix3d spread = match.covariance;
    spread.diagonal() += Eigen::Vector3d(1e-4, 1e-4, 1e-5);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<2, 2>() = T.rotation();
    graph_.add_edge({k - 1, k, graph_.pose(k - 1).inverse() * T,
                     R.transpose() * spread.inverse() * R, EdgeKind::kChain});
    link_to_reused_surfaces(k, *scan);
  }
  if (k % 5 == 0) hide_what_drifted();
  tracker_.insert(T, scan, graph_.stretch_of(k));
  const int stretch = graph_.stretch_of(k);
  if (options_.do_loop_closing && graph_.size() == (stretch + 1) * graph_.stretch_size()) {
    close_loops(stretch);
  }
}

void GraphMapper::link_to_reused_surfaces(int keyframe, const PointScan& scan) {
  const int stretch = graph_.stretch_of(keyframe);
  const double enough = kReuseShare * static_cast<double>(scan.points.size());
  for (const auto& [owner, points] : tracker_.owners_under(scan)) {
    if (owner >= stretch - kOwnStretches || points < enough) continue;
    const std::pair<int, int> link(owner, stretch);
    if (std::find(reuse_links_.begin(), reuse_links_.end(), link) != reuse_links_.end()) continue;
    reuse_links_.push_back(link);
    const int j = graph_.anchor_of(owner);
    graph_.add_edge({j, keyframe, graph_.pose(j).inverse() * graph_.pose(keyframe),
                     information(0.03, 0.01), EdgeKind::kReuse});
  }
}

void GraphMapper::hide_what_drifted() {
  const std::vector<double> ways = graph_.distances_from(graph_.stretch_of(graph_.size() - 1));
  std::vector<char> hidden(ways.size());
  for (std::size_t s = 0; s < ways.size(); ++s) hidden[s] = ways[s] > options_.reuse_distance;
  tracker_.hide(std::move(hidden));
}

void GraphMapper::close_loops(int stretch) {
  const std::vector<GraphEdge> loops =
      closer_.search(graph_, stretch, graph_.distances_from(stretch));
  if (loops.empty() || !accept_loops(loops)) return;
  rebuild_surfaces();
  hide_what_drifted();
}

bool GraphMapper::accept_loops(const std::vector<GraphEdge>& loops) {
  const KeyframeGraph before = graph_;
  for (const GraphEdge& loop : loops) graph_.add_edge(loop);
  graph_.optimize(kLoopKernel, kIterations);
  for (const GraphEdge& loop : loops) {
    const Eigen::Vector3d error = edge_error(loop, graph_.pose(loop.from), graph_.pose(loop.to));
    if (error.head<2>().norm() < kLoopMisfit && std::abs(error.z()) < kLoopMisfitYaw) continue;
    graph_ = before;  // the rest of the graph contradicts
    return false;
  }
  return true;
}

void GraphMapper::rebuild_surfaces() {
  const int newest = graph_.size() - 1;
  const SE2 T_keyframe_base = graph_.pose(newest).inverse() * tracker_.T_map_base();
  tracker_.clear_surfaces();
  for (int i = 0; i <= newest; ++i) {
    tracker_.insert(graph_.pose(i), graph_[i].scan, graph_.stretch_of(i));
  }
  tracker_.set_pose(graph_.pose(newest) * T_keyframe_base);
}

void GraphMapper::finish() {
  if (graph_.size() < 2) return;
  PairLinkOptions options;
  options.line.max_points = 120;
  const std::vector<GraphEdge> links = link_pairs(graph_, options);
  const std::vector<GraphEdge> edges = graph_.edges();
  std::vector<GraphEdge> all;
  for (const GraphEdge& edge : edges) {
    if (edge.kind != EdgeKind::kChain) continue;
    all.push_back(edge);
    all.back().information *= 0.1;
  }
  for (const GraphEdge& link : links) {
    all.push_back(link);
    all.back().information *= 0.1;
  }
  const SE2 T_before = graph_.pose(graph_.size() - 1);
  graph_.edges() = all;
  graph_.optimize(3.0, 10);
  graph_.edges() = edges;
  tracker_.set_pose(graph_.pose(graph_.size() - 1) * T_before.inverse() * tracker_.T_map_base());
  rebuild_surfaces();
  match_all_scans_once_more();
}

void GraphMapper::match_all_scans_once_more() {
  SurfelMap surfaces;
  for (int i = 0; i < graph_.size(); ++i) surfaces.insert(graph_.pose(i), *graph_[i].scan);
  LineMatchOptions line;
  line.max_points = 120;
  line.search_rings = 2;
  PosePrior prior;
  prior.information = information(0.02, 0.01);
  final_poses_.resize(archive_.size());
  for (std::size_t i = 0; i < archive_.size(); ++i) {
    const ScanArchive::Entry& entry = archive_[i];
    SE2& T = final_poses_[i];
    T = entry.keyframe < 0 ? entry.T_keyframe_base
                           : graph_.pose(entry.keyframe) * entry.T_keyframe_base;
    if (!entry.is_used || !options_.use_scan_matching) continue;
    prior.T_ref_base = T;
    const PointScan points =
        make_point_scan(archive_.scan(i), {options_.min_laser_range, options_.max_laser_range},
                        entry.twist.cast<double>());
    T = match_lines(surfaces, points, T, prior, line).T_ref_base;
  }
}

std::vector<StampedPose2d> GraphMapper::trajectory() const {
  std::vector<StampedPose2d> poses(archive_.size());
  for (std::size_t i = 0; i < archive_.size(); ++i) {
    const ScanArchive::Entry& entry = archive_[i];
    poses[i].stamp_ns = entry.stamp_ns;
    if (!final_poses_.empty()) {
      poses[i].T_map_base = final_poses_[i];
    } else {
      poses[i].T_map_base = entry.keyframe < 0
                                ? entry.T_keyframe_base
                                : graph_.pose(entry.keyframe) * entry.T_keyframe_base;
    }
  }
  return poses;
}

}  // namespace trident
