// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_archive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::slam {
namespace {

/// Beam patterns that a scanner sends by turns, which are kept once.
constexpr std::size_t kPatternsByTurns = 64;

bool is_same_geometry(const LaserScan& a, const LaserScan& b) {
  return a.size() == b.size() && a.angle_min == b.angle_min &&
         a.angle_increment == b.angle_increment && a.time_increment == b.time_increment &&
         a.range_min == b.range_min && a.range_max == b.range_max &&
         a.T_base_laser.p == b.T_base_laser.p && a.T_base_laser.angle == b.T_base_laser.angle;
}

void get(BinaryReader* reader, LaserScan& geometry) {
  const auto beams = reader->get<std::uint64_t>();
  if (beams > 1'000'000) reader->fail();
  geometry.ranges.assign(static_cast<std::size_t>(beams), 0.0F);
  for (double* value : {&geometry.angle_min, &geometry.angle_increment, &geometry.time_increment,
                        &geometry.range_min, &geometry.range_max}) {
    *value = reader->get<double>();
  }
  geometry.T_base_laser = reader->get_pose();
}

void get(BinaryReader* reader, ScanArchive::Entry& entry) {
  entry.stamp_ns = reader->get<std::int64_t>();
  entry.keyframe = reader->get<std::int32_t>();
  entry.T_keyframe_base = reader->get_pose();
  entry.is_used = reader->get<std::uint8_t>() != 0;
  entry.geometry = reader->get<std::uint32_t>();
  entry.first_range = reader->get<std::uint64_t>();
  for (int k = 0; k < 3; ++k) entry.twist(k) = reader->get<float>();
}

bool has_its_ranges(const ScanArchive::Entry& entry, const std::vector<LaserScan>& geometries,
                    std::size_t ranges) {
  if (!entry.has_ranges()) return true;
  if (entry.geometry >= geometries.size() || entry.first_range > ranges) return false;
  return ranges - entry.first_range >= geometries[entry.geometry].size();
}

}  // namespace

/// Ranges are kept as millimetres in 16 bits, which end at 65 m, since all scans of a drive stay in
/// memory; 0 stands for no return.
void ScanArchive::add(const LaserScan& scan, const Entry& entry, double max_range) {
  entries_.push_back(entry);
  entries_.back().first_range = Entry::kNoRanges;
  if (max_range <= 0.0) return;
  entries_.back().geometry = geometry_of(scan);
  entries_.back().first_range = ranges_.size();
  const double limit = std::min(max_range, 65.0);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const bool is_kept =
        entry.is_used && scan.is_return(i) && static_cast<double>(scan.ranges[i]) < limit;
    ranges_.push_back(is_kept ? static_cast<std::uint16_t>(std::lround(1000.0F * scan.ranges[i]))
                              : 0);
  }
}

std::uint32_t ScanArchive::geometry_of(const LaserScan& scan) {
  const std::size_t oldest = geometries_.size() - std::min(geometries_.size(), kPatternsByTurns);
  for (std::size_t i = geometries_.size(); i-- > oldest;) {
    if (is_same_geometry(geometries_[i], scan)) return static_cast<std::uint32_t>(i);
  }
  LaserScan geometry = scan;
  std::fill(geometry.ranges.begin(), geometry.ranges.end(), 0.0F);
  geometries_.push_back(std::move(geometry));
  return static_cast<std::uint32_t>(geometries_.size() - 1);
}

/// Indices of the other archive are moved behind those of this one. Scans that belong to no
/// keyframe are placed in the map, the others follow their keyframe.
void ScanArchive::append(const ScanArchive& other, int keyframe, const SE2& T_map_other) {
  const auto geometry = static_cast<std::uint32_t>(geometries_.size());
  const auto first_range = static_cast<std::uint64_t>(ranges_.size());
  for (Entry entry : other.entries_) {
    if (entry.has_ranges()) {
      entry.geometry += geometry;
      entry.first_range += first_range;
    }
    if (entry.keyframe < 0) {
      entry.T_keyframe_base = T_map_other * entry.T_keyframe_base;
    } else {
      entry.keyframe += keyframe;
    }
    entries_.push_back(entry);
  }
  geometries_.insert(geometries_.end(), other.geometries_.begin(), other.geometries_.end());
  ranges_.insert(ranges_.end(), other.ranges_.begin(), other.ranges_.end());
}

LaserScan ScanArchive::scan(std::size_t i) const {
  const Entry& entry = entries_[i];
  LaserScan scan = geometries_[entry.geometry];
  scan.stamp_ns = entry.stamp_ns;
  for (std::size_t beam = 0; beam < scan.size(); ++beam) {
    const std::uint16_t range_mm = ranges_[entry.first_range + beam];
    scan.ranges[beam] = range_mm > 0 ? 0.001F * static_cast<float>(range_mm)
                                     : std::numeric_limits<float>::infinity();
  }
  return scan;
}

SE2 ScanArchive::pose(std::size_t i, const KeyframeGraph& graph) const {
  const Entry& entry = entries_[i];
  if (entry.keyframe < 0) return entry.T_keyframe_base;
  return graph.pose(entry.keyframe) * entry.T_keyframe_base;
}

/// A scan of a keyframe that was taken out follows the one that stands in for it, at the same
/// place. Without ranges it has nothing to give to a map, and goes.
void ScanArchive::follow(const KeyframeGraph::Removal& removal) {
  std::vector<Entry> entries;
  for (Entry& entry : entries_) {
    if (entry.keyframe >= 0) {
      const auto old = static_cast<std::size_t>(entry.keyframe);
      const int stand_in = removal.stand_in[old];
      const bool is_kept = removal.kept[static_cast<std::size_t>(stand_in)] == entry.keyframe;
      if (!is_kept && !entry.has_ranges()) continue;
      entry.keyframe = stand_in;
      entry.T_keyframe_base = removal.T_stand_in_base[old] * entry.T_keyframe_base;
    }
    entries.push_back(entry);
  }
  entries_ = std::move(entries);
}

/// The order is that of load(); a change of it needs another version of the session file.
void ScanArchive::save(BinaryWriter* writer) const {
  writer->put<std::uint64_t>(geometries_.size());
  for (const LaserScan& scan : geometries_) {
    writer->put<std::uint64_t>(scan.size());
    for (const double value : {scan.angle_min, scan.angle_increment, scan.time_increment,
                               scan.range_min, scan.range_max}) {
      writer->put(value);
    }
    writer->put_pose(scan.T_base_laser);
  }
  writer->put<std::uint64_t>(entries_.size());
  for (const Entry& entry : entries_) {
    writer->put(entry.stamp_ns);
    writer->put<std::int32_t>(entry.keyframe);
    writer->put_pose(entry.T_keyframe_base);
    writer->put<std::uint8_t>(entry.is_used ? 1 : 0);
    writer->put(entry.geometry);
    writer->put(entry.first_range);
    for (int k = 0; k < 3; ++k) writer->put(entry.twist(k));
  }
  writer->put_all(ranges_);
}

void ScanArchive::load(BinaryReader* reader) {
  geometries_.resize(reader->get_count(9 * sizeof(double)));
  for (LaserScan& geometry : geometries_) get(reader, geometry);
  entries_.resize(reader->get_count(sizeof(double)));
  for (Entry& entry : entries_) get(reader, entry);
  ranges_ = reader->get_all<std::uint16_t>();
  for (const Entry& entry : entries_) {
    if (!has_its_ranges(entry, geometries_, ranges_.size())) reader->fail();
  }
}

}  // namespace trident::slam
