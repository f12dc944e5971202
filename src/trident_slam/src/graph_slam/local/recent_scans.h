// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>

#include "matchers/line_match.h"

namespace trident::slam {

/// The last few scans of a robot that localises itself: where the map does not contain what it
/// sees, it continues from these. The map has no part in them.
class RecentScans {
 public:
  /// At most `size` scans, none farther from the newest than `reach` [m]; 0: none at all.
  RecentScans(std::size_t size, double reach, const LineMatchOptions& line)
      : size_(size), reach_(reach), line_(line) {}

  /// Matches a scan with these, too. Returns the part of its points that lie on their surfaces.
  double refine(const PointScan& scan, MatchResult* match) const;
  void add(const SE2& T_map_base, const std::shared_ptr<const PointScan>& scan);
  void clear();

  bool empty() const { return scans_.empty(); }
  const SE2& newest() const { return scans_.back().T_map_base; }

 private:
  struct Placed {
    SE2 T_map_base;
    std::shared_ptr<const PointScan> scan;
  };

  std::size_t size_;
  double reach_;
  LineMatchOptions line_;
  std::deque<Placed> scans_;
  SurfelMap surfels_;
};

}  // namespace trident::slam
