// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_mapper.h"

#include <utility>

#include "graph_slam/backend/final_match.h"
#include "graph_slam/loop/relocalizer.h"

namespace trident::slam {
namespace {

/// The options themselves. Throws Error as `validate`, before anything is made of them.
const GraphSlamOptions& validated(const GraphSlamOptions& options) {
  options.validate();
  return options;
}

}  // namespace

GraphMapper::GraphMapper(const GraphSlamOptions& options, const PoseGraphSolverMaker& solver)
    : options_(validated(options)),
      graph_(options.loop_match_minimum_chain_size, solver),
      deskewer_(options),
      local_(options, &graph_),
      backend_(options, &graph_, &archive_, &local_.tracker()) {}

ScanPose2d GraphMapper::add_scan(const LaserScan& scan, const SE2& T_odom_base) {
  // 1. Collect: loops that a search in the background has closed move the map first.
  backend_.apply_finished_search();
  final_poses_.clear();
  // 2. Predict: the motion since the last scan, by odometry or by the scans themselves.
  LocalMapper::Motion motion = local_.predict(scan.stamp_ns, T_odom_base);
  // 3. Deskew: this motion shows where the beams of the last scan were measured; now it is mapped.
  finish_pending_scan(scan.stamp_ns, motion);
  // 4. Check: a scan that would harm the map is reported and not used.
  ScanPose2d result;
  result.problem = check_.problem(scan);
  result.is_used = result.problem.empty();
  // 5. Match, update the map and close loops: the pose in the local map, and perhaps a keyframe.
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  if (result.is_used) {
    twist = match_and_map(scan, &motion, &result);
  } else {
    local_.coast(motion);
  }
  // 6. Report: the pose, and what is wrong with scan or odometry.
  const std::string notice = local_.finish_motion(motion, result.is_used);
  deskewer_.set_last_stamp(scan.stamp_ns);
  if (result.problem.empty()) result.problem = motion.problem;
  if (result.problem.empty()) result.problem = notice;
  result.T_map_base = tracker().T_map_base();
  // 7. Archive: the scan relative to its keyframe, for the trajectory and the final match.
  if (!is_map_fixed()) archive(scan, twist, result.is_used);
  return result;
}

Eigen::Vector3d GraphMapper::match_and_map(const LaserScan& scan, LocalMapper::Motion* motion,
                                           ScanPose2d* result) {
  Eigen::Vector3d twist = deskewer_.predict_twist(scan, motion->T_before_now);
  const auto points = std::make_shared<const PointScan>(deskewer_.points(scan, twist));
  const MatchResult match = local_.match(points, scan.T_base_laser, motion);
  local_.report_uncertainty(*motion, match, *points, result);
  if (deskewer_.is_enabled() && scan.time_increment != 0.0) {
    pending_ = {scan, twist, match};
  } else if (is_keyframe_due()) {
    backend_.add_keyframe(points, match, local_.travelled());
  }
  return twist;
}

void GraphMapper::finish_pending_scan(std::int64_t next_stamp_ns,
                                      const LocalMapper::Motion& motion) {
  if (!pending_) return;
  PendingScan pending = *std::exchange(pending_, std::nullopt);
  // 1. Correct: the velocity during the sweep, and with it the points.
  const Eigen::Vector3d twist = deskewer_.correct_twist(pending, next_stamp_ns, motion);
  const auto points = std::make_shared<const PointScan>(deskewer_.points(pending.scan, twist));
  // 2. Match again: where the prediction was too far off.
  if (options_.use_scan_matching && !tracker().surfels().empty() &&
      deskewer_.is_match_outdated(pending, twist)) {
    const PosePrior prior = deskewer_.corrected_prior(pending, twist, tracker().T_map_base());
    pending.match = local_.match_again(*points, prior);
  }
  // 3. Update the map and close loops.
  if (is_keyframe_due()) backend_.add_keyframe(points, pending.match, local_.travelled());
  // 4. Correct the archive.
  if (!pending.is_archived) return;
  ScanArchive::Entry& entry = archive_[archive_.size() - 1];
  entry.twist = twist.cast<float>();
  place_relative_to_keyframe(&entry);
}

void GraphMapper::archive(const LaserScan& scan, const Eigen::Vector3d& twist, bool is_used) {
  if (pending_) pending_->is_archived = true;
  ScanArchive::Entry entry;
  entry.stamp_ns = scan.stamp_ns;
  entry.is_used = is_used;
  entry.twist = twist.cast<float>();
  place_relative_to_keyframe(&entry);
  archive_.add(scan, entry, options_.keep_scans ? options_.max_laser_range : 0.0);
}

// The pose of the newest scan is kept relative to the newest keyframe, which the graph may move.
void GraphMapper::place_relative_to_keyframe(ScanArchive::Entry* entry) const {
  const SE2& T_map_base = tracker().T_map_base();
  entry->keyframe = graph_.size() - 1;
  entry->T_keyframe_base =
      entry->keyframe < 0 ? T_map_base : graph_.pose(entry->keyframe).inverse() * T_map_base;
}

bool GraphMapper::is_keyframe_due() const {
  if (is_map_fixed()) return false;
  return graph_.size() == 0 || local_.has_moved_from(graph_.pose(graph_.size() - 1));
}

void GraphMapper::finish() {
  finish_pending_scan(deskewer_.last_stamp(), {});
  backend_.finish_searches();
  if (!options_.use_scan_matching || options_.mode == SlamMode::kLocalization) return;
  if (graph_.size() < 2) return;
  final_edges_ = backend_.align();
  final_poses_ =
      match_archive(archive_, graph_, {options_.min_laser_range, options_.max_laser_range},
                    options_.back_end.final_match);
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

void GraphMapper::set_session(Session session, const std::optional<SE2>& T_map_base) {
  graph_ = std::move(session.graph);
  archive_ = std::move(session.archive);
  local_.set_travelled(session.travelled);
  local_.forget_odometry();
  check_ = ScanCheck();
  final_poses_.clear();
  backend_.reset();
  set_pose(T_map_base.value_or(session.T_map_base));
}

int GraphMapper::append(BinaryReader* reader, const SE2& T_map_session) {
  Session session{KeyframeGraph(1, graph_.solver()), {}, {}, 0.0};
  session.load(reader);
  backend_.finish_running_search();
  // As if the robot had driven so far unseen that everything may have to be found again.
  const double gap = graph_.size() > 0 ? local_.travelled() + options_.reuse_distance + 1.0 : 0.0;
  const int first = editor().join(session.graph, T_map_session, gap);
  archive_.append(session.archive, first, T_map_session);
  local_.set_travelled(gap + session.travelled);
  final_poses_.clear();
  backend_.rebuild();
  set_pose(T_map_session * session.T_map_base);
  return first == 0 ? 0 : backend_.close_loops_across(first);
}

void GraphMapper::set_mode(SlamMode mode) {
  options_.mode = mode;
  local_.set_mode(mode);
  backend_.set_mode(mode);
}

void GraphMapper::set_pose(const SE2& T_map_base) {
  local_.set_pose(T_map_base);
  backend_.break_path();
  pending_.reset();
}

std::optional<SE2> GraphMapper::relocalize(const LaserScan& scan, double min_inliers) {
  const PointScan points = deskewer_.points(scan, Eigen::Vector3d::Zero());
  const auto found = relocalize_in_map(tracker().surfels(), points, tracker().options().line,
                                       options_.front_end.relocalization);
  if (!found || found->inlier_fraction < min_inliers) return std::nullopt;
  set_pose(found->T_ref_base);
  return found->T_ref_base;
}

bool GraphMapper::close_loop(int older, int newer, const SE2& T_older_newer) {
  return editor().close_loop(older, newer, T_older_newer, tracker().options());
}

std::vector<int> GraphMapper::move_keyframes(const std::map<int, SE2>& T_map_base) {
  std::vector<int> rejected = editor().move_keyframes(T_map_base);
  if (rejected.size() < T_map_base.size()) final_poses_.clear();
  return rejected;
}

}  // namespace trident::slam
