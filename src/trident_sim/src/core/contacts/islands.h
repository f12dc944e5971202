// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace trident::sim {

/// Which bodies touch or are jointed, directly or through others, and how many constraint rows each
/// such island has. Disjoint sets over body numbers; allocates only when the number of bodies
/// grows.
class Islands {
 public:
  void reset(std::size_t bodies) {
    parent_.resize(bodies);
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    rows_.assign(bodies, 0);
  }
  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    rows_[a] += rows_[b];
  }
  void add_rows(std::size_t body, int rows) { rows_[find(body)] += rows; }
  /// The lowest number of its bodies names an island.
  std::size_t first_of_island(std::size_t body) { return find(body); }
  int rows_of_island(std::size_t body) { return rows_[find(body)]; }

 private:
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<std::size_t> parent_;
  std::vector<int> rows_;  ///< valid at the root of a set
};

}  // namespace trident::sim
