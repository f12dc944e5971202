// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "planning/potential/start_search.h"

#include <algorithm>

namespace trident::nav {
StartSearch::Result StartSearch::search(const CostGrid& grid, const Potential& potential,
                                        const Limits& limits, const CancelFlag& cancel) {
  grid_ = &grid;
  potential_ = &potential;
  limits_ = limits;
  begin();
  const Result result = run(cancel);
  grid_ = nullptr;
  return result;
}

void StartSearch::begin() {
  const GridGeometry& g = grid_->geometry;
  columns_ = static_cast<std::size_t>(g.width + kSide - 1) / kSide;
  const std::size_t count = columns_ * (static_cast<std::size_t>(g.height + kSide - 1) / kSide);
  for (const std::size_t tile : used_) numbers_[tile] = 0;
  if (numbers_.size() != count) numbers_.assign(count, 0);
  used_.clear();
  tiles_.clear();
  best_ = {};
  expanded_ = 0;
  unsigned shift = 0;
  while ((potential_->steps().least_straight >> (shift + 3)) > 0) ++shift;
  const Cell start = potential_->start();
  queue_.reset(potential_->bound(start).value, shift);
  relax(start, 0, kRoot);
}

StartSearch::Result StartSearch::run(const CancelFlag& cancel) {
  while (queue_.advance()) {
    if (queue_.lower_bound() >= best_.cost) return Result::kFound;
    if (queue_.lower_bound() >= limits_.bound) return Result::kBound;
    const Cell c = unpack(queue_.pop());
    Node& at = node(c);
    if (at.is_closed) continue;
    at.is_closed = true;
    const std::uint32_t value = at.value;
    if (is_tail_free(c)) {
      join(c, value);
      continue;
    }
    if (++expanded_ > limits_.expansions) return Result::kTooLong;
    if ((expanded_ & 0x3FFU) == 0 && cancel.load(std::memory_order_relaxed)) {
      return Result::kCanceled;
    }
    expand(c, value);
  }
  if (best_.cost != kUnreached) return Result::kFound;
  return limits_.bound == kUnreached ? Result::kNoPath : Result::kBound;
}

void StartSearch::join(Cell c, std::uint32_t value) {
  const std::uint32_t cost = value + potential_->bound(c).value;
  if (cost < best_.cost) best_ = {cost, c};
}

// Whether the potential's path from a cell costs in the grid what the potential knows. All cells
// that are seen meanwhile keep the answer.
bool StartSearch::is_tail_free(Cell c) {
  if (!potential_->bound(c).is_exact) return false;
  Tail tail = node(c).tail;
  Cell end = c;
  while (tail == Tail::kNotSeen) {
    const std::optional<Cell> next = potential_->next(end);
    if (!next) {
      tail = Tail::kFree;
    } else if (potential_->is_dearer(*grid_, end, *next)) {
      tail = Tail::kDearer;
    } else {
      end = *next;
      tail = node(end).tail;
    }
  }
  for (Cell at = c;; at = *potential_->next(at)) {
    node(at).tail = tail;
    if (at == end) break;
  }
  return tail == Tail::kFree;
}

void StartSearch::expand(Cell c, std::uint32_t value) {
  const std::uint8_t cost = grid_->at(c);
  const std::uint32_t straight = potential_->steps().straight[cost];
  const std::uint32_t diagonal = potential_->steps().diagonal[cost];
  const Cell goal = potential_->goal();
  std::array<bool, 4> free{};
  for (std::size_t d = 0; d < 8; ++d) {
    const Cell next{c.x + kDx[d], c.y + kDy[d]};
    const bool next_free = is_free(next);
    if (d < 4) {
      free[d] = next_free;
    } else {
      const auto& cut = kCut[d - 4];
      if (!free[static_cast<std::size_t>(cut[0])] || !free[static_cast<std::size_t>(cut[1])]) {
        continue;
      }
    }
    if (!next_free && !(next == goal)) continue;
    relax(next, value + (d < 4 ? straight : diagonal), opposite(static_cast<int>(d)));
  }
}

void StartSearch::relax(Cell c, std::uint32_t value, int parent) {
  Node& to = node(c);
  if (value >= to.value) return;
  const std::uint64_t key = std::uint64_t{value} + potential_->bound(c).value;
  if (key >= std::min(best_.cost, limits_.bound)) return;
  to.value = value;
  to.parent = static_cast<std::uint8_t>(parent);
  to.is_closed = false;
  queue_.push(key, pack(c));
}

bool StartSearch::is_inside(Cell c) const {
  const GridGeometry& g = grid_->geometry;
  return c.x >= edge_ && c.y >= edge_ && c.x < g.width - edge_ && c.y < g.height - edge_;
}

bool StartSearch::is_free(Cell c) const {
  return is_inside(c) && potential_->steps().straight[grid_->at(c)] != Potential::kBlockedStep;
}

std::size_t StartSearch::tile_of(Cell c) const {
  return static_cast<std::size_t>(c.y / kSide) * columns_ + static_cast<std::size_t>(c.x / kSide);
}

StartSearch::Node& StartSearch::node(Cell c) {
  std::uint32_t& number = numbers_[tile_of(c)];
  if (number == 0) {
    used_.push_back(tile_of(c));
    tiles_.emplace_back();
    number = static_cast<std::uint32_t>(tiles_.size());
  }
  const int within = c.y % kSide * kSide + c.x % kSide;
  return tiles_[number - 1][static_cast<std::size_t>(within)];
}

std::vector<Cell> StartSearch::path() const {
  std::vector<Cell> cells;
  for (Cell c = best_.cell;;) {
    cells.push_back(c);
    const std::uint32_t number = numbers_[tile_of(c)];
    const int within = c.y % kSide * kSide + c.x % kSide;
    const std::size_t parent = tiles_[number - 1][static_cast<std::size_t>(within)].parent;
    if (parent == kRoot) break;
    c = {c.x + kDx[parent], c.y + kDy[parent]};
  }
  std::reverse(cells.begin(), cells.end());
  for (auto next = potential_->next(best_.cell); next; next = potential_->next(*next)) {
    cells.push_back(*next);
  }
  return cells;
}

}  // namespace trident::nav
