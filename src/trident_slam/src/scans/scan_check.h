// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trident_base/laser_scan.h"

namespace trident::slam {

/// Distinguishes scans that a map can be made of from those that would harm it. A scanner may send
/// several beam patterns by turns (one beam more or less, other start angles, other steps): each
/// scan is seen by its own angles.
class ScanCheck {
 public:
  /// Empty, or what is wrong with the scan, with values and what is legal. Beams that look through
  /// nearly the same field of view in nearly the same steps as a known pattern are that scanner's,
  /// too; any other pattern is believed when it has come `kPatience` times in `kPatienceScans`.
  std::string problem(const LaserScan& scan);

  static constexpr int kPatience = 10;
  static constexpr int kPatienceScans = 200;
  static constexpr std::size_t kMinReturns = 5;

 private:
  /// How beams lie.
  struct Pattern {
    std::size_t beams = 0;
    double angle_min = 0.0;        ///< [rad]
    double angle_increment = 0.0;  ///< [rad]

    double angle_max() const {
      return angle_min + static_cast<double>(beams - 1) * angle_increment;
    }
    bool is_like(const Pattern& other) const;
    std::string text() const;
  };
  /// A pattern that is not believed yet.
  struct Newcomer {
    Pattern pattern;
    int first_scan = 0;
    int count = 0;
  };
  std::vector<Newcomer>::iterator newcomer_of(const Pattern& pattern);
  bool is_believed(const Pattern& pattern);

  std::vector<Pattern> patterns_;    ///< believed ones that are not like each other
  std::vector<Newcomer> newcomers_;  ///< the latest few
  int scans_ = 0;
};

}  // namespace trident::slam
