// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "pose_graph_backend.h"

#include <algorithm>

#include "final_match.h"

namespace trident::slam {
namespace {

LoopCloserOptions closer_options(const GraphSlamOptions& options) {
  LoopCloserOptions result;
  result.reuse_distance = options.reuse_distance;
  result.search_distance = options.loop_search_maximum_distance;
  result.min_agreement = options.loop_match_minimum_response_fine;
  result.search = options.back_end.loop_search;
  result.verification = options.back_end.loop_verification;
  result.free_space = options.back_end.free_space;
  return result;
}

}  // namespace

PoseGraphBackend::PoseGraphBackend(const GraphSlamOptions& options, KeyframeGraph* graph,
                                   ScanArchive* archive, ScanTracker* tracker)
    : options_(options),
      graph_(graph),
      archive_(archive),
      tracker_(tracker),
      worker_(closer_options(options), options.back_end),
      scan_pruner_(options.lifelong, options.back_end.pruning, options.back_end.free_space) {}

void PoseGraphBackend::add_keyframe(const std::shared_ptr<const PointScan>& scan,
                                    const MatchResult& match, double travelled) {
  // 1. Graph: a node, an edge to the keyframe before, and edges to revisited submaps.
  const int k = graph_->add({tracker_->T_map_base(), scan, travelled});
  if (k > 0) {
    add_odometry_edge(k, match);
    add_revisit_edges(k, *scan);
  }
  // 2. Submaps: those that may have drifted since are not matched with.
  if (k % options_.back_end.keyframe_edges.deactivation_period == 0) deactivate_drifted_submaps();
  // 3. Surfaces: the scan becomes part of the local map.
  const int submap = graph_->submap_of(k);
  tracker_->insert(tracker_->T_map_base(), *scan, submap);
  // 4. Prune: older scans that this one has replaced are removed.
  if (options_.mode == SlamMode::kLifelong) prune_replaced_scans();
  // 5. Close loops: when the submap is complete.
  if (options_.do_loop_closing && graph_->size() == (submap + 1) * graph_->submap_size()) {
    close_loops(submap);
  }
}

// The covariance of the match, rotated into the frame of the keyframe.
void PoseGraphBackend::add_odometry_edge(int keyframe, const MatchResult& match) {
  const KeyframeEdgeOptions& edges = options_.back_end.keyframe_edges;
  const SE2& T = graph_->pose(keyframe);
  GraphEdge edge;
  edge.from = keyframe - 1;
  edge.to = keyframe;
  edge.T_from_to = graph_->pose(keyframe - 1).inverse() * T;
  Eigen::Matrix3d covariance = match.covariance;
  covariance.diagonal() += Eigen::Vector3d(edges.sigma, edges.sigma, edges.sigma_yaw).cwiseAbs2();
  if (is_path_broken_) {
    covariance.diagonal() +=
        Eigen::Vector3d(edges.gap_variance, edges.gap_variance, edges.gap_variance_yaw);
  }
  is_path_broken_ = false;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = T.rotation();
  const Eigen::Matrix3d rotated = R.transpose() * covariance.inverse() * R;
  edge.information = 0.5 * (rotated + rotated.transpose());
  graph_->add_edge(edge);
}

// A scan that was matched with the surfaces of an older submap measures its pose relative to it.
// One edge per pair of submaps is enough.
void PoseGraphBackend::add_revisit_edges(int keyframe, const PointScan& scan) {
  const KeyframeEdgeOptions& edges = options_.back_end.keyframe_edges;
  const int submap = graph_->submap_of(keyframe);
  const double enough = edges.revisit_fraction * static_cast<double>(scan.points.size());
  for (const auto& [owner, points] : tracker_->owners_under(scan)) {
    if (owner >= submap - edges.own_submaps || points < enough) continue;
    const std::pair<int, int> link(owner, submap);
    if (std::find(revisit_links_.rbegin(), revisit_links_.rend(), link) != revisit_links_.rend())
      continue;
    revisit_links_.push_back(link);
    const int j = graph_->anchor_of(owner);
    graph_->add_edge({j, keyframe, graph_->pose(j).inverse() * graph_->pose(keyframe),
                      sigma_information(edges.revisit_sigma, edges.revisit_sigma_yaw),
                      EdgeKind::kRevisit});
  }
}

void PoseGraphBackend::deactivate_drifted_submaps() {
  const std::vector<double> path_lengths =
      graph_->distances_from(graph_->submap_of(graph_->size() - 1));
  std::vector<char> hidden(path_lengths.size());
  for (std::size_t s = 0; s < path_lengths.size(); ++s) {
    hidden[s] = path_lengths[s] > options_.reuse_distance ? 1 : 0;
  }
  tracker_->hide(std::move(hidden));
}

void PoseGraphBackend::close_loops(int submap) {
  if (!options_.is_asynchronous) {
    apply(worker_.search(*graph_, submap, tracker_->options().tracking.surfel_cell));
    return;
  }
  worker_.ask(submap);
  worker_.start(*graph_, tracker_->options().tracking.surfel_cell);
}

void PoseGraphBackend::apply_finished_search() {
  std::optional<LoopOutcome> outcome = worker_.take();
  if (!outcome) return;
  apply(std::move(*outcome));
  worker_.start(*graph_, tracker_->options().tracking.surfel_cell);
}

void PoseGraphBackend::finish_searches() {
  while (worker_.is_busy()) {
    worker_.wait();
    apply_finished_search();
  }
}

void PoseGraphBackend::finish_running_search() {
  worker_.wait();
  if (std::optional<LoopOutcome> outcome = worker_.take()) apply(std::move(*outcome));
}

// Keyframes that the search did not know move along with the last one that it knew.
void PoseGraphBackend::apply(LoopOutcome outcome) {
  if (outcome.poses.empty()) return;
  const int known = static_cast<int>(outcome.poses.size());
  const SE2 T_new_old = outcome.poses.back() * graph_->pose(known - 1).inverse();
  for (const GraphEdge& loop : outcome.loops) graph_->add_edge(loop);
  for (int i = 0; i < graph_->size(); ++i) {
    graph_->set_pose(i, i < known ? outcome.poses[i] : T_new_old * graph_->pose(i));
  }
  tracker_->set_surfels(std::move(outcome.surfels));
  for (int i = known; i < graph_->size(); ++i) {
    tracker_->insert(graph_->pose(i), *(*graph_)[i].scan, graph_->submap_of(i));
  }
  tracker_->set_pose(T_new_old * tracker_->T_map_base());
  deactivate_drifted_submaps();
}

void PoseGraphBackend::realign(Realign realign) {
  worker_.ask(realign);
  worker_.start(*graph_, tracker_->options().tracking.surfel_cell);
  if (options_.is_asynchronous) return;
  worker_.wait();
  apply_finished_search();
}

std::vector<GraphEdge> PoseGraphBackend::align() {
  const int last = graph_->size() - 1;
  const SE2 T_before_base = graph_->pose(last).inverse() * tracker_->T_map_base();
  std::vector<GraphEdge> edges = align_all_keyframes(graph_, options_.back_end);
  tracker_->set_pose(graph_->pose(last) * T_before_base);
  rebuild_surfaces();
  deactivate_drifted_submaps();
  return edges;
}

void PoseGraphBackend::reoptimize() {
  worker_.clear();
  const int last = graph_->size() - 1;
  const SE2 T_newest_base = graph_->pose(last).inverse() * tracker_->T_map_base();
  graph_->optimize(options_.back_end.optimization);
  rebuild_surfaces();
  tracker_->set_pose(graph_->pose(last) * T_newest_base);
  deactivate_drifted_submaps();
}

void PoseGraphBackend::reset() {
  worker_.clear();
  revisit_links_.clear();
  scan_pruner_.clear();
  rebuild();
}

void PoseGraphBackend::rebuild() {
  rebuild_surfaces();
  tracker_->hide({});
}

int PoseGraphBackend::close_loops_across(int first_newer) {
  for (int s = graph_->submap_of(first_newer); s < graph_->submaps(); ++s) {
    apply(worker_.search(*graph_, s, tracker_->options().tracking.surfel_cell));
  }
  return static_cast<int>(std::count_if(
      graph_->edges().begin(), graph_->edges().end(), [first_newer](const GraphEdge& edge) {
        const bool is_across = std::min(edge.from, edge.to) < first_newer &&
                               std::max(edge.from, edge.to) >= first_newer;
        return edge.kind == EdgeKind::kLoop && is_across;
      }));
}

void PoseGraphBackend::rebuild_surfaces() {
  SurfelMap surfels(tracker_->options().tracking.surfel_cell);
  for (int i = 0; i < graph_->size(); ++i) {
    surfels.insert(graph_->pose(i), *(*graph_)[i].scan, graph_->submap_of(i));
  }
  tracker_->set_surfels(std::move(surfels));
  pruned_scans_ = 0;
}

void PoseGraphBackend::prune_replaced_scans() {
  PruneResult result = scan_pruner_.update(*graph_);
  for (const int i : result.replaced) {
    graph_->set_scan(i, std::make_shared<const PointScan>());
  }
  for (auto& [i, scan] : result.thinned) graph_->set_scan(i, std::move(scan));
  pruned_scans_ += static_cast<int>(result.replaced.size() + result.thinned.size());
  if (pruned_scans_ >= options_.back_end.pruning.batch && !worker_.is_busy()) {
    remove_pruned_keyframes();
  }
}

// Afterwards submaps have other numbers, which invalidates links and searches.
void PoseGraphBackend::remove_pruned_keyframes() {
  std::vector<char> is_removed(static_cast<std::size_t>(graph_->size()));
  for (int i = 0; i < graph_->size(); ++i) {
    is_removed[i] = (*graph_)[i].scan->points.empty() ? 1 : 0;
  }
  is_removed.back() = 0;
  const KeyframeGraph::Removal removal = graph_->remove(is_removed);
  scan_pruner_.keep(removal.kept);
  archive_->follow(removal);
  worker_.clear();
  revisit_links_.clear();
  rebuild_surfaces();
  deactivate_drifted_submaps();
}

}  // namespace trident::slam
