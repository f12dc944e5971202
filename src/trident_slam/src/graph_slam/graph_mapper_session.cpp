// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What users do to a map: keep it, go on with it, correct it.
#include <algorithm>
#include <cmath>

#include "graph_mapper.h"
#include "graph_slam/backend/final_match.h"
#include "graph_slam/loop/relocalizer.h"

namespace trident::slam {
namespace {

/// The graph and its surfaces are made anew after so many scans were forgotten or thinned.
constexpr int kForgottenBatch = 20;

}  // namespace

void MapperState::save(BinaryWriter* writer) const {
  graph.save(writer);
  archive.save(writer);
  writer->put_pose(T_map_base);
  writer->put(travelled);
}

void MapperState::load(BinaryReader* reader) {
  MapperState read{KeyframeGraph(1, graph.solver()), {}, {}, 0.0};
  read.graph.load(reader);
  read.archive.load(reader);
  for (std::size_t i = 0; i < read.archive.size(); ++i) {
    if (read.archive[i].keyframe >= read.graph.size()) reader->fail();
  }
  read.T_map_base = reader->get_pose();
  read.travelled = reader->get<double>();
  *this = std::move(read);
}

void GraphMapper::set_state(MapperState state, const std::optional<SE2>& T_map_base) {
  worker_.clear();
  graph_ = std::move(state.graph);
  archive_ = std::move(state.archive);
  travelled_ = state.travelled;
  reuse_links_.clear();
  stale_scans_.clear();
  final_poses_.clear();
  check_ = ScanCheck();
  motion_source_.forget_odometry();
  rebuild_surfaces();
  tracker_.hide({});
  set_pose(T_map_base.value_or(state.T_map_base));
}

void GraphMapper::set_pose(const SE2& T_map_base) {
  tracker_.set_pose(T_map_base);
  calibration_.interrupt();
  is_chain_broken_ = graph_.size() > 0;
  recent_scans_.clear();
  lost_robot_.reset();
  rolling_.reset();
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
  realign(Realign::kEdges);
  return true;
}

void GraphMapper::realign(Realign realign) {
  worker_.ask(realign);
  worker_.start(graph_, tracker_.options().surfel_cell);
  if (options_.is_asynchronous) return;
  worker_.wait();
  take_from_worker();
}

void GraphMapper::forget_replaced_scans() {
  StaleVerdict verdict = stale_scans_.weigh(graph_);
  for (const int i : verdict.stale) graph_.forget_scan(i);
  for (auto& [i, scan] : verdict.thinned) graph_.set_scan(i, std::move(scan));
  forgotten_scans_ += static_cast<int>(verdict.stale.size() + verdict.thinned.size());
  if (forgotten_scans_ >= kForgottenBatch && !worker_.is_busy()) take_out_forgotten_keyframes();
}

void GraphMapper::take_out_forgotten_keyframes() {
  std::vector<char> is_removed(static_cast<std::size_t>(graph_.size()));
  for (int i = 0; i < graph_.size(); ++i) is_removed[i] = graph_[i].scan->points.empty() ? 1 : 0;
  is_removed.back() = 0;
  const KeyframeGraph::Removal removal = graph_.remove(is_removed);
  stale_scans_.keep(removal.kept);
  archive_.follow(removal);
  // Stretches have other numbers now.
  worker_.clear();
  reuse_links_.clear();
  rebuild_surfaces();
  hide_what_drifted();
}

}  // namespace trident::slam
