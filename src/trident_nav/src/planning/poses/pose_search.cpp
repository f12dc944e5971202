// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/poses/pose_search.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

constexpr float kKeysPerCell = 32.0F;

Cell cell_of(double x, double y) {
  return {static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y))};
}

}  // namespace

PoseSearch::PoseSearch(const MotionSet& motions, const TravelCosts& costs,
                       const PoseSearchOptions& options)
    : motions_(motions), costs_(costs), options_(options) {}

PoseSearch::Result PoseSearch::search(const CostGrid& grid, const Query& query,
                                      const CancelFlag& cancel) {
  begin(grid, query);
  add_start();
  return run(cancel);
}

void PoseSearch::begin(const CostGrid& grid, const Query& query) {
  grid_ = grid;
  query_ = query;
  rotation_.cos = std::cos(query.offset);
  rotation_.sin = std::sin(query.offset);
  ends_.clear();
  for (const Primitive& p : motions_.primitives()) {
    ends_.push_back(
        {rotation_.cos * p.dx - rotation_.sin * p.dy, rotation_.sin * p.dx + rotation_.cos * p.dy});
  }
  closed_.reset(grid.geometry, motions_.heading_count());
  nodes_.clear();
  iterations_ = 0;
  until_expansion_ = 0;
  best_.cost = std::numeric_limits<float>::infinity();
  nearest_.distance = std::numeric_limits<double>::infinity();
}

void PoseSearch::add_start() {
  const Cell cell = cell_of(query_.start.x, query_.start.y);
  base_key_ = static_cast<std::uint64_t>(0.8F * kKeysPerCell * options_.estimate_weight *
                                         estimate(cell.x, cell.y));
  queue_.reset(base_key_, 0);
  closed_.insert(cell.x, cell.y, query_.start_heading);
  add_node({query_.start.x, query_.start.y, 0.0F, 0,
            static_cast<std::uint16_t>(query_.start_heading), kNoPrimitive});
}

PoseSearch::Result PoseSearch::run(const CancelFlag& cancel) {
  std::size_t found_at = 0;
  for (unsigned count = 0;; ++count) {
    if (count % static_cast<unsigned>(options_.check_interval) == 0) {
      if (const auto result = interrupted(cancel)) return *result;
    }
    if (!queue_.advance() || is_done(found_at)) break;
    if (!take(queue_.pop())) continue;
    if (found_at == 0 && std::isfinite(best_.cost)) found_at = iterations_;
  }
  return std::isfinite(best_.cost) ? Result::kFound : Result::kNoPath;
}

std::optional<PoseSearch::Result> PoseSearch::interrupted(const CancelFlag& cancel) const {
  if (cancel.load(std::memory_order_relaxed)) return Result::kCanceled;
  if (std::isfinite(best_.cost)) return std::nullopt;
  if (std::chrono::steady_clock::now() > query_.deadline) return Result::kTimeout;
  if (query_.max_iterations < 0) return std::nullopt;
  if (static_cast<std::int64_t>(iterations_) < query_.max_iterations) return std::nullopt;
  return Result::kTooManyIterations;
}

bool PoseSearch::is_done(std::size_t found_at) const {
  if (nearest_.distance < query_.stop_within) return true;
  if (!std::isfinite(best_.cost)) return false;
  if (queue_.lower_bound() >= key_of(best_.cost)) return true;
  return iterations_ - found_at >= static_cast<std::size_t>(options_.max_on_approach_iterations);
}

// Makes a node of a candidate; false when it is known, in contact, or has to wait.
bool PoseSearch::take(const Candidate& candidate) {
  const Node& from = nodes_[candidate.parent];
  const Primitive& p = motions_.primitives()[candidate.primitive];
  const Offset& end = ends_[candidate.primitive];
  const Node node{from.x + end.x,   from.y + end.y, candidate.g,
                  candidate.parent, p.end_heading,  candidate.primitive};
  const Cell cell = cell_of(node.x, node.y);
  if (closed_.contains(cell.x, cell.y, node.heading)) return false;
  if (!candidate.has_curve && is_deferred(candidate, node)) return false;
  if (!query_.checker->is_free({from.x, from.y, pose_of(from).yaw}, motions_.poses(p), p.pose_count,
                               rotation_.cos, rotation_.sin)) {
    return false;
  }
  closed_.insert(cell.x, cell.y, node.heading);
  add_node(node);
  return true;
}

// The curve to the goal is only measured for motions whose turn has come.
bool PoseSearch::is_deferred(const Candidate& candidate, const Node& node) {
  const Cell cell = cell_of(node.x, node.y);
  const float around = estimate(cell.x, cell.y);
  const double line = distance(node.x, node.y, query_.goal.x, query_.goal.y);
  if (line > options_.curve_window) return false;
  const float least = costs_.factor[kFreeCost];
  if (around >= least * static_cast<float>(line + max_excess(options_.model) * options_.radius)) {
    return false;
  }
  const float direct = curve_estimate(node);
  if (direct <= around) return false;
  const std::uint64_t key = key_of(candidate.g + options_.estimate_weight * direct);
  if (key <= queue_.lower_bound()) return false;
  queue_.push(key, {candidate.parent, candidate.g, candidate.primitive, true});
  return true;
}

void PoseSearch::add_node(const Node& node) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  ++iterations_;
  const double line = distance(node.x, node.y, query_.goal.x, query_.goal.y);
  if (line < nearest_.distance) {
    nearest_.distance = line;
    nearest_.node = index;
  }
  if (--until_expansion_ <= 0) {
    if (line <= options_.max_expansion_length) try_goal(index);
    const Cell cell = cell_of(node.x, node.y);
    const double rest = std::max(static_cast<double>(estimate(cell.x, cell.y)), line);
    until_expansion_ = static_cast<int>(std::min(rest / options_.expansion_ratio, 1e6));
  }
  expand(index);
}

void PoseSearch::expand(std::uint32_t index) {
  const Node from = nodes_[index];
  const std::uint32_t end = motions_.begin(from.heading + 1U);
  for (std::uint32_t i = motions_.begin(from.heading); i < end; ++i) {
    const Primitive& p = motions_.primitives()[i];
    const Cell cell = cell_of(from.x + ends_[i].x, from.y + ends_[i].y);
    if (!grid_.geometry.contains(cell)) continue;
    if (closed_.contains(cell.x, cell.y, p.end_heading)) continue;
    const float rest = estimate(cell.x, cell.y);
    const float g = from.g + motion_cost(from, p, grid_.at(cell));
    if (!(g + rest < best_.cost)) continue;
    queue_.push(key_of(g + options_.estimate_weight * rest),
                {index, g, static_cast<std::uint16_t>(i), false});
  }
}

float PoseSearch::motion_cost(const Node& from, const Primitive& p, std::uint8_t cell_cost) const {
  float factor = p.factor;
  if (p.change != 0.0F && from.primitive != kNoPrimitive &&
      motions_.primitives()[from.primitive].turn != p.turn) {
    factor += p.change;
  }
  return p.length * factor * costs_.factor[cell_cost];
}

void PoseSearch::try_goal(std::uint32_t index) {
  const Node& node = nodes_[index];
  const Pose2 from = pose_of(node);
  const MotionCurve curve = motion_curve(options_.model, from, query_.goal, options_.radius);
  if (curve.length() > options_.max_expansion_length) return;
  const bool is_near =
      distance(from.x, from.y, query_.goal.x, query_.goal.y) < 6.283185307 * options_.radius;
  const int max_cost =
      options_.overrides_max_cost && is_near ? kLethalCost : options_.max_expansion_cost;
  const double rest = query_.checker->cost(curve, from, max_cost);
  if (!(node.g + rest < static_cast<double>(best_.cost))) return;
  if (!query_.checker->is_free(curve, from)) return;
  best_.cost = static_cast<float>(node.g + rest);
  best_.curve = curve;
  best_.node = index;
}

float PoseSearch::estimate(int x, int y) const {
  const float value = query_.heuristic->at(x, y);
  if (std::isfinite(value) || query_.exit_cost <= 0.0) return value;
  if (distance(x, y, query_.start.x, query_.start.y) > query_.exit_reach) return value;
  const double out = distance(x, y, query_.exit.x, query_.exit.y);
  return static_cast<float>(query_.exit_cost +
                            out * static_cast<double>(costs_.factor[kInscribedCost]));
}

float PoseSearch::curve_estimate(const Node& node) const {
  const MotionCurve curve =
      motion_curve(options_.model, pose_of(node), query_.goal, options_.radius);
  return static_cast<float>(curve.length()) * costs_.factor[kFreeCost];
}

std::uint64_t PoseSearch::key_of(float f) const {
  return std::max(base_key_, static_cast<std::uint64_t>(f * kKeysPerCell));
}

Pose2 PoseSearch::pose_of(const Node& node) const {
  return {node.x, node.y, motions_.heading(node.heading) + query_.offset};
}

TravelPath PoseSearch::trace(std::uint32_t node, bool to_goal) const {
  std::vector<std::uint32_t> chain;
  for (std::uint32_t i = node; nodes_[i].primitive != kNoPrimitive; i = nodes_[i].parent) {
    chain.push_back(i);
  }
  TravelPath path;
  path.points.push_back({query_.start, false, false});
  for (std::size_t i = chain.size(); i-- > 0;) {
    const Node& end = nodes_[chain[i]];
    append_motion(nodes_[end.parent], motions_.primitives()[end.primitive], path);
  }
  if (to_goal) query_.checker->append(best_.curve, path);
  return path;
}

// The poses of a motion, as many as are needed to lie within a cell of each other.
void PoseSearch::append_motion(const Node& from, const Primitive& p, TravelPath& path) const {
  const Pose2* poses = motions_.poses(p);
  const double yaw = pose_of(from).yaw;
  Pose2 last;
  for (std::uint32_t i = 0; i < p.pose_count; ++i) {
    const bool is_end = i + 1 == p.pose_count;
    if (!is_end && distance(last.x, last.y, poses[i + 1].x, poses[i + 1].y) <= 1.0) continue;
    last = poses[i];
    const Pose2 pose{from.x + rotation_.cos * last.x - rotation_.sin * last.y,
                     from.y + rotation_.sin * last.x + rotation_.cos * last.y, yaw + last.yaw};
    path.points.push_back({pose, p.turn != 0, p.reverses});
  }
}

}  // namespace trident::nav
