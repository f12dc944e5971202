// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "trident_base/laser_scan.h"
#include "trident_base/se2.h"

namespace trident::slam {

/// One scan with the odometry that was logged with it.
struct ScanRecord {
  LaserScan scan;   ///< with readings at the range limit made infinite
  SE2 T_odom_base;  ///< at the scan's stamp
};

/// Many scanners report their range limit where they saw nothing: readings at or above `range_max`
/// become infinite, in logs and on topics alike.
void forget_readings_at_limit(LaserScan& scan);

/// What was wrong with a log: all are counted, the first few are kept as text with file and line.
class LogProblems {
 public:
  static constexpr std::size_t kKept = 10;  ///< texts

  /// Counts it; `text` is kept while fewer than kKept are.
  void add(std::string text) {
    ++count_;
    if (texts_.size() < kKept) texts_.push_back(std::move(text));
  }
  std::size_t count() const { return count_; }                      ///< all, kept or not
  const std::vector<std::string>& texts() const { return texts_; }  ///< the first kKept

 private:
  std::size_t count_ = 0;
  std::vector<std::string> texts_;
};

/// Scans in the order in which they were logged, one at a time.
class ScanSource {
 public:
  ScanSource() = default;
  ScanSource(const ScanSource&) = delete;
  ScanSource& operator=(const ScanSource&) = delete;
  virtual ~ScanSource() = default;

  /// False at the end of the log. A bad record is reported in `problems` and passed over.
  virtual bool next(ScanRecord& record) = 0;
  /// Of the records read so far.
  virtual const LogProblems& problems() const = 0;
  /// Part of the log that is read, 0 .. 1; 0 where its length is unknown.
  virtual double progress() const = 0;
  /// What was chosen to be read, in one line; empty where there was no choice.
  virtual std::string chosen() const { return {}; }
  /// False where the log has none: `T_odom_base` stays what it is.
  virtual bool has_odometry() const { return true; }
};

}  // namespace trident::slam
