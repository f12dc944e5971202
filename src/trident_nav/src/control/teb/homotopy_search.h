// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

#include "homotopy_map.h"

namespace trident::nav {

/// A* over pairs of a node and the signature of the line that leads to it, so that lines of several
/// classes arrive one after another. `map` must outlive it.
class HomotopySearch {
 public:
  HomotopySearch(const HomotopyMap& map, const Point2& from, const Point2& to);

  std::vector<HomotopyPath> run(std::size_t count, double max_ratio);

 private:
  struct State {
    int node = 0;
    HSignature signature = 0;
    double length_m = 0.0;
    int parent = -1;
  };
  using Entry = std::pair<double, std::size_t>;  ///< Least length through a state, and its number.

  void push(const State& state);
  bool close(const State& state, std::size_t count);
  bool can_enter(int x, int y) const;
  void expand(std::size_t index);
  HomotopyPath path_to(std::size_t index) const;

  const HomotopyMap& map_;
  Point2 from_, to_;
  int goal_;
  std::vector<State> states_;
  std::vector<std::vector<HSignature>> closed_;  ///< Of each node, signatures that were expanded.
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace trident::nav
