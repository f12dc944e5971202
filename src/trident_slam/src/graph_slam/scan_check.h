// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "trident_base/laser_scan.h"

namespace trident {

/// Tells scans that a map can be made of from those that would harm it.
class ScanCheck {
 public:
  /// Empty, or what is wrong with the scan, with values and what is legal. A scanner that changes
  /// its beams is believed after `kPatience` scans in a row.
  std::string problem(const LaserScan& scan);

  static constexpr int kPatience = 10;
  static constexpr std::size_t kFewestReturns = 5;

 private:
  struct Geometry {
    std::size_t beams = 0;
    double angle_min = 0.0;
    double angle_increment = 0.0;
    bool operator==(const Geometry& other) const;
  };

  bool has_geometry_ = false;
  Geometry geometry_;
  Geometry changed_;
  int changed_in_a_row_ = 0;
};

}  // namespace trident
