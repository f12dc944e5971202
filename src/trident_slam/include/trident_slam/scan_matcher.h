// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/registry.h"
#include "trident_slam/match_result.h"
#include "trident_slam/point_scan.h"

namespace trident::slam {

/// A scan of a reference, and where its base was.
struct PlacedPoints {
  SE2 T_ref_base;  ///< at the scan's stamp
  PointScan scan;  ///< in that base's frame
};

/// What a matcher answers. In addition to what MatchResult holds:
struct ScanMatch : MatchResult {
  /// 0 to 1, the higher the better the scan fits; each matcher's own measure.
  double score = 0.0;
  /// Empty, or one line on why there is no match. The pose is then the guess, and the covariance
  /// the prior's.
  std::string problem;
};

/// Finds the pose from which a scan was taken, in the frame of a reference that is made of one scan
/// or of several with known poses. No clock, no random numbers: the same calls give the same bits.
/// Calls of `match` change nothing.
///
/// `information` is that of the scan's points, `covariance` that of the pose with the prior, both
/// of (x [m], y [m], yaw [rad]) in the reference's frame. Along a direction in which the points
/// give too little information (`degeneracy`) a pose without a prior stays where it was guessed.
class ScanMatcher {
 public:
  ScanMatcher() = default;
  ScanMatcher(const ScanMatcher&) = delete;
  ScanMatcher& operator=(const ScanMatcher&) = delete;
  virtual ~ScanMatcher() = default;

  /// Replaces the reference. Points that are no numbers are left out.
  void set_reference(const std::vector<PlacedPoints>& scans);
  /// Adds a scan to the reference.
  void add_to_reference(const SE2& T_ref_base, const PointScan& scan);
  /// Nothing can be matched until there is a reference again.
  void clear_reference();

  /// `guess`: where to begin; `prior`: what is known of the pose, nothing by default. A guess or a
  /// point that is no number, fewer than `kMinPoints` points or an empty reference are reported
  /// in `problem`.
  ScanMatch match(const PointScan& scan, const SE2& guess, const PosePrior& prior = {}) const;

  static constexpr std::size_t kMinPoints = 5;  ///< fewer fix no pose

 private:
  /// The base class has seen to it that all is finite, and that there is enough of it.
  virtual void clear() = 0;
  virtual void add(const SE2& T_ref_base, const PointScan& scan) = 0;
  virtual ScanMatch find(const PointScan& scan, const SE2& guess, const PosePrior& prior) const = 0;

  std::string problem_of(const PointScan& scan, const SE2& guess, const PosePrior& prior) const;

  bool has_reference_ = false;
};

/// What all matchers of the registry can be made with.
struct ScanMatcherOptions {
  /// Of `correlative` and `hybrid`: how far from the guess the pose is searched for without a
  /// prior [m], [rad].
  double search_distance = 0.5;
  double search_heading = 0.35;     ///< [rad], see search_distance
  double search_resolution = 0.05;  ///< [m]
};

/// Throws Error naming field, value and range.
using ScanMatcherFactory =
    std::function<std::unique_ptr<ScanMatcher>(const ScanMatcherOptions& options)>;

/// Adds the matchers of this package; `Registry::names` lists their names, docs/howto/slam.md
/// describes each. Those of a new source are registered by its add_NAME() (see
/// line_scan_matchers.cpp) and a line in the list of CMakeLists.txt.
void register_builtin_scan_matchers(Registry<ScanMatcherFactory>& registry);

/// The matcher of that name. Throws Error with the legal names for an unknown one.
std::unique_ptr<ScanMatcher> make_scan_matcher(const std::string& name,
                                               const ScanMatcherOptions& options = {});

}  // namespace trident::slam
