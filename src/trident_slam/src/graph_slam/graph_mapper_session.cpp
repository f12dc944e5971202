// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What users do to a map: keep it, go on with it, correct it.
#include <algorithm>
#include <cmath>

#include "graph_slam/final_match.h"
#include "graph_slam/graph_mapper.h"
#include "graph_slam/relocalizer.h"

namespace trident {
namespace {

/// A newer scan replaces older ones that were taken this near to it [m], [rad], by way this long
/// ago [m].
constexpr double kSamePlace = 0.5;
constexpr double kSameHeading = 0.5;
constexpr double kLongAgo = 20.0;
/// Scans of one place that are kept beside the newest one.
constexpr int kKeptScans = 2;
/// Surfaces are made anew after so many scans were forgotten.
constexpr int kForgottenBatch = 20;

}  // namespace

void GraphMapper::save(BinaryWriter* writer) const {
  graph_.save(writer);
  archive_.save(writer);
  writer->put_pose(tracker_.T_map_base());
  writer->put(travelled_);
}

GraphMapper::Session GraphMapper::read(BinaryReader* reader, const PoseGraphSolverMaker& solver) {
  Session session{KeyframeGraph(1, solver), {}, {}, 0.0};
  session.graph.load(reader);
  session.archive.load(reader);
  for (std::size_t i = 0; i < session.archive.size(); ++i) {
    if (session.archive[i].keyframe >= session.graph.size()) reader->fail();
  }
  session.T_map_base = reader->get_pose();
  session.travelled = reader->get<double>();
  return session;
}

void GraphMapper::load(BinaryReader* reader, const std::optional<SE2>& T_map_base) {
  Session session = read(reader, graph_.solver());
  worker_.clear();
  graph_ = std::move(session.graph);
  archive_ = std::move(session.archive);
  travelled_ = session.travelled;
  reuse_links_.clear();
  final_poses_.clear();
  check_ = ScanCheck();
  odometry_.forget();
  rebuild_surfaces();
  tracker_.hide({});
  set_pose(T_map_base.value_or(session.T_map_base));
}

void GraphMapper::set_pose(const SE2& T_map_base) {
  tracker_.set_pose(T_map_base);
  calibration_.interrupt();
  is_chain_broken_ = graph_.size() > 0;
  lost_robot_.reset();
}

std::optional<SE2> GraphMapper::relocalize(const PointScan& scan, double min_inliers) {
  const auto found = find_in_map(tracker_.surfels(), scan, tracker_.options().line);
  if (!found || found->inlier_fraction < min_inliers) return std::nullopt;
  set_pose(found->T_ref_base);
  return found->T_ref_base;
}

bool GraphMapper::close_loop(int older, int newer, const SE2& T_older_newer) {
  SurfelMap reference(tracker_.options().surfel_cell);
  reference.insert(SE2::identity(), *graph_[older].scan);
  const MatchResult match =
      match_lines(reference, *graph_[newer].scan, T_older_newer, {}, tracker_.options().line);
  if (match.inlier_fraction < 0.4) return false;
  GraphEdge edge;
  edge.from = older;
  edge.to = newer;
  edge.T_from_to = match.T_ref_base;
  edge.information = Eigen::Vector3d(1e3, 1e3, 1e4).asDiagonal();
  edge.kind = EdgeKind::kLoop;
  graph_.add_edge(edge);
  optimize_anew();
  return true;
}

void GraphMapper::forget_replaced_scans(int keyframe) {
  const SE2 T_keyframe_map = graph_.pose(keyframe).inverse();
  int kept = 0;
  for (int i = keyframe - 1; i >= 0; --i) {
    if (graph_[i].scan->points.empty()) continue;
    const SE2 T = T_keyframe_map * graph_.pose(i);
    if (T.p.norm() > kSamePlace || std::abs(T.angle) > kSameHeading) continue;
    if (travelled_ - graph_[i].travelled < kLongAgo || ++kept <= kKeptScans) continue;
    graph_.forget_scan(i);
    ++forgotten_scans_;
  }
  if (forgotten_scans_ >= kForgottenBatch) rebuild_surfaces();
}

}  // namespace trident
