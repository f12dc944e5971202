// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// How a kept potential follows changes of the costs. After it, every value is the cost of a real
// path, and no cell that is not open could lower a neighbor: then continuing the search makes the
// start's value exact.
#include <algorithm>
#include <cstring>

#include "planning/grids/grid_directions.h"
#include "planning/grids/potential.h"

namespace trident::nav {

// False: so much lost its support that a new search is cheaper.
bool Potential::repair() {
  if (revision_ != 0 && source_->revision == revision_) return true;
  std::vector<Packed> changed;
  find_changes(changed);
  std::vector<Packed> invalid;
  if (!invalidate(changed, invalid)) return false;
  std::vector<Packed> opened;
  for (const Packed p : changed) {
    std::uint8_t& cost = cells_.cost[index(p)];
    if (steps_.straight[cost] == kBlockedStep) opened.push_back(p);
    cost = source_cost(x_of(p), y_of(p));
  }
  for (const Packed p : invalid) offer_from_neighbors(p);
  for (const Packed p : changed) offer_from_neighbors(p);
  for (const Packed p : opened) reopen_around(p);
  return true;
}

// The cells of tiles in use whose step cost is another one. Other differences are taken over.
void Potential::find_changes(std::vector<Packed>& changed) {
  for (int ty = 0; ty < tiles_.y; ++ty) {
    for (int tx = 0; tx < tiles_.x; ++tx) {
      const int number = ty * tiles_.x + tx;
      if (tiles_.state[static_cast<std::size_t>(number)] == TileState::kUnused) continue;
      for (int y = ty * kTile; y < (ty + 1) * kTile; ++y) compare_row(tx * kTile, y, changed);
    }
  }
}

void Potential::compare_row(int x0, int y, std::vector<Packed>& changed) {
  const int low = outline_ ? 2 : 1;
  const int from = std::max(x0, low);
  const int to = std::min(x0 + kTile, geometry_.width + 2 - low);
  if (y < low || y > geometry_.height + 1 - low || from >= to) return;
  std::uint8_t* kept = &cells_.cost[index(from, y)];
  const std::uint8_t* now = source_->cost + geometry_.index({from - 1, y - 1});
  const auto count = static_cast<std::size_t>(to - from);
  if (std::memcmp(kept, now, count) == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept[i] == now[i]) continue;
    if (steps_.straight[kept[i]] == steps_.straight[now[i]]) {
      kept[i] = now[i];
    } else {
      changed.push_back(pack(from + static_cast<int>(i), y));
    }
  }
}

// Unreaches all cells whose path to the goal contains a step that became dearer or impossible.
bool Potential::invalidate(const std::vector<Packed>& changed, std::vector<Packed>& invalid) {
  const std::size_t limit = expanded_.total / 2 + 4096;
  std::vector<Packed> stack;
  for (const Packed p : changed) {
    seed_invalid(p, stack);
    while (!stack.empty()) {
      const Packed top = stack.back();
      stack.pop_back();
      if (cells_.value[index(top)] == kUnreached || index(top) == index(ends_.goal.x, ends_.goal.y))
        continue;
      drop(top, stack);
      invalid.push_back(top);
      if (invalid.size() > limit) return false;
    }
  }
  return true;
}

void Potential::seed_invalid(Packed p, std::vector<Packed>& stack) {
  const std::size_t i = index(p);
  const std::uint32_t now = steps_.straight[source_cost(x_of(p), y_of(p))];
  if (now < steps_.straight[cells_.cost[i]]) return;
  stack.push_back(p);
  if (now != kBlockedStep) return;
  surround(x_of(p), y_of(p));
  // Neighbors that step diagonally past this cell.
  for (int d = 0; d < 4; ++d) {
    const std::size_t n = i + offset_[d];
    const int parent = cells_.state[n] & 0x0F;
    if (cells_.value[n] == kUnreached || parent < 4 || parent == kRoot) continue;
    const auto& cut = kCut[parent - 4];
    if (cut[0] == opposite(d) || cut[1] == opposite(d)) {
      stack.push_back(pack(x_of(p) + kDx[d], y_of(p) + kDy[d]));
    }
  }
}

void Potential::drop(Packed p, std::vector<Packed>& stack) {
  surround(x_of(p), y_of(p));
  const std::size_t i = index(p);
  cells_.value[i] = kUnreached;
  cells_.state[i] = 0;
  for (int d = 0; d < 8; ++d) {
    const std::size_t n = i + offset_[d];
    if (cells_.value[n] != kUnreached && (cells_.state[n] & 0x0F) == opposite(d)) {
      stack.push_back(pack(x_of(p) + kDx[d], y_of(p) + kDy[d]));
    }
  }
}

// Lowers the value of a cell to the best that its neighbors offer.
void Potential::offer_from_neighbors(Packed p) {
  const std::size_t i = index(p);
  const std::uint32_t straight = steps_.straight[cells_.cost[i]];
  if (straight == kBlockedStep || p == pack(ends_.goal.x, ends_.goal.y)) return;
  surround(x_of(p), y_of(p));
  std::array<bool, 4> free{};
  for (int d = 0; d < 8; ++d) {
    const std::size_t n = i + offset_[d];
    if (d < 4) {
      free[d] = steps_.straight[cells_.cost[n]] != kBlockedStep;
    } else if (!free[kCut[d - 4][0]] || !free[kCut[d - 4][1]]) {
      continue;
    }
    if (cells_.value[n] == kUnreached) continue;
    relax(n, x_of(p), y_of(p), static_cast<std::uint8_t>(d),
          d < 4 ? straight : steps_.diagonal[cells_.cost[i]]);
  }
}

// Diagonal steps past this cell have become possible.
void Potential::reopen_around(Packed p) {
  surround(x_of(p), y_of(p));
  for (int d = 0; d < 4; ++d) {
    const std::size_t n = index(p) + offset_[d];
    if (cells_.value[n] != kUnreached) open(x_of(p) + kDx[d], y_of(p) + kDy[d], n);
  }
}

}  // namespace trident::nav
