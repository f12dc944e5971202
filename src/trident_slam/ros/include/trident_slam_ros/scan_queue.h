// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "trident_base/mutex.h"
#include "trident_slam/scan_source.h"

namespace trident::slam {

/// Scans between the thread that receives them and the one that feeds the algorithm.
class ScanQueue {
 public:
  /// `keeps_all`: every scan waits its turn; else a newer scan replaces those that wait.
  explicit ScanQueue(bool keeps_all) : keeps_all_(keeps_all) {}

  /// Adds scans in this order.
  void push(std::vector<ScanRecord> records);
  /// Waits for the next scan; returns std::nullopt after end().
  std::optional<ScanRecord> pop();
  /// Wakes pop() for the last time.
  void end();
  /// Forgets the scans that wait.
  void clear();
  /// Held, scans wait: all of them where all are kept, else the newest.
  void set_held(bool is_held);

  /// Scans that wait.
  std::size_t size();
  /// Scans that were replaced by newer ones.
  std::size_t replaced();

 private:
  const bool keeps_all_;
  Mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<ScanRecord> records_ TRIDENT_GUARDED_BY(mutex_);
  std::size_t replaced_ TRIDENT_GUARDED_BY(mutex_) = 0;
  bool is_ending_ TRIDENT_GUARDED_BY(mutex_) = false;
  bool is_held_ TRIDENT_GUARDED_BY(mutex_) = false;
};

}  // namespace trident::slam
