// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "homotopy_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace trident::nav {
namespace {

// Whether some obstacle was circled in part twice: its field is 2.
bool is_loop(HSignature signature) {
  constexpr HSignature kHighBits = 0xAAAAAAAAAAAAAAAAULL;
  const HSignature high = signature & kHighBits;
  const HSignature low = (signature << 1U) & kHighBits;
  return (high & ~low) != 0;
}

// A lattice's corners are rounded off, where that stays free.
void smooth(std::vector<Point2>* points) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < points->size(); ++i) {
      const Point2& a = (*points)[i - 1];
      const Point2& b = (*points)[i + 1];
      Point2& p = (*points)[i];
      p = {0.5 * p.x + 0.25 * (a.x + b.x), 0.5 * p.y + 0.25 * (a.y + b.y)};
    }
  }
}

}  // namespace

HomotopySearch::HomotopySearch(const HomotopyMap& map, const Point2& from, const Point2& to)
    : map_(map),
      from_(from),
      to_(to),
      goal_(map.node_at(to)),
      closed_(static_cast<std::size_t>(map.width_ * map.height_)) {
  const int start = map.node_at(from);
  push({start, map.crossed(from, map.point(start)), 0.0, -1});
}

void HomotopySearch::push(const State& state) {
  const Point2 p = map_.point(state.node);
  open_.push({state.length_m + distance(p.x, p.y, to_.x, to_.y), states_.size()});
  states_.push_back(state);
}

/// False: the state is not the first of its class here, or enough classes have come by.
bool HomotopySearch::close(const State& state, std::size_t count) {
  std::vector<HSignature>& closed = closed_[static_cast<std::size_t>(state.node)];
  if (closed.size() >= count) return false;
  if (std::find(closed.begin(), closed.end(), state.signature) != closed.end()) return false;
  closed.push_back(state.signature);
  return true;
}

/// Whether the lattice has a node there that a path may pass, or end at.
bool HomotopySearch::can_enter(int x, int y) const {
  if (!map_.contains(x, y)) return false;
  const int node = y * map_.width_ + x;
  return node == goal_ || map_.is_blocked_[static_cast<std::size_t>(node)] == 0;
}

void HomotopySearch::expand(std::size_t index) {
  const State from = states_[index];
  const int x = from.node % map_.width_;
  const int y = from.node / map_.width_;
  const Point2 here = map_.point(from.node);
  for (int k = 0; k < 9; ++k) {
    const int nx = x + k % 3 - 1;
    const int ny = y + k / 3 - 1;
    if (k == 4 || !can_enter(nx, ny)) continue;
    const int next = ny * map_.width_ + nx;
    const Point2 there = map_.point(next);
    const HSignature signature = added(from.signature, map_.crossed(here, there));
    if (is_loop(signature)) continue;
    const double length_m = from.length_m + distance(here.x, here.y, there.x, there.y);
    push({next, signature, length_m, static_cast<int>(index)});
  }
}

HomotopyPath HomotopySearch::path_to(std::size_t index) const {
  HomotopyPath path;
  path.signature = added(states_[index].signature, map_.crossed(map_.point(goal_), to_));
  path.length_m = states_[index].length_m;
  path.points.push_back(to_);
  // The nodes nearest to the ends are left out: the ends themselves stand for them.
  for (int i = states_[index].parent; i >= 0; i = states_[static_cast<std::size_t>(i)].parent) {
    const State& state = states_[static_cast<std::size_t>(i)];
    if (state.parent >= 0) path.points.push_back(map_.point(state.node));
  }
  path.points.push_back(from_);
  std::reverse(path.points.begin(), path.points.end());
  smooth(&path.points);
  return path;
}

std::vector<HomotopyPath> HomotopySearch::run(std::size_t count, double max_ratio) {
  constexpr std::size_t kMaxStates = 60000;
  std::vector<HomotopyPath> paths;
  double longest_m = std::numeric_limits<double>::infinity();
  while (!open_.empty() && paths.size() < count && states_.size() < kMaxStates) {
    const auto [least_m, index] = open_.top();
    open_.pop();
    if (least_m > longest_m) break;
    if (!close(states_[index], count)) continue;
    if (states_[index].node != goal_) {
      expand(index);
      continue;
    }
    paths.push_back(path_to(index));
    if (paths.size() == 1) longest_m = max_ratio * least_m;
  }
  return paths;
}

}  // namespace trident::nav
