// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "graph_slam/backend/keyframe_graph.h"
#include "graph_slam/session/binary_stream.h"
#include "trident_base/laser_scan.h"

namespace trident::slam {

/// Every scan that came: where it was (100 bytes), and, if wanted, what it saw, in millimetres and
/// two bytes a beam.
class ScanArchive {
 public:
  struct Entry {
    static constexpr std::uint64_t kNoRanges = ~std::uint64_t{0};

    std::int64_t stamp_ns = 0;
    int keyframe = -1;  ///< the newest one when the scan came
    SE2 T_keyframe_base;
    bool is_used = true;  ///< false: nothing but odometry is known of it
    std::uint32_t geometry = 0;
    std::uint64_t first_range = 0;  ///< or kNoRanges
    Eigen::Vector3f twist = Eigen::Vector3f::Zero();

    bool has_ranges() const { return first_range != kNoRanges; }
  };

  /// Ranges up to `max_range` [m] are kept; 0: none, where the scan was alone.
  void add(const LaserScan& scan, const Entry& entry, double max_range);
  /// Scans of another map whose origin is at `T_map_other`; its keyframe 0 is now `keyframe`.
  void append(const ScanArchive& other, int keyframe, const SE2& T_map_other);
  std::size_t size() const { return entries_.size(); }
  const Entry& operator[](std::size_t i) const { return entries_[i]; }
  Entry& operator[](std::size_t i) { return entries_[i]; }
  /// Of one that has ranges: as it was when it came, ranges rounded to a millimetre.
  LaserScan scan(std::size_t i) const;
  /// Where scan i was, by where its keyframe is now.
  SE2 pose(std::size_t i, const KeyframeGraph& graph) const;

  /// After keyframes were taken out. Scans without ranges whose keyframe has gone are forgotten;
  /// others stay where they were, relative to its stand-in.
  void follow(const KeyframeGraph::Removal& removal);

  void save(BinaryWriter* writer) const;
  void load(BinaryReader* reader);

 private:
  std::uint32_t geometry_of(const LaserScan& scan);

  std::vector<Entry> entries_;
  std::vector<LaserScan> geometries_;  ///< without ranges
  std::vector<std::uint16_t> ranges_;
};

}  // namespace trident::slam
