// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/scan_queue.h"

#include <utility>

namespace trident::slam {

void ScanQueue::push(std::vector<ScanRecord> records) {
  if (records.empty()) return;
  {
    const Lock lock(mutex_);
    for (ScanRecord& record : records) {
      if (!keeps_all_ && !records_.empty()) {
        replaced_ += records_.size();
        records_.clear();
      }
      records_.push_back(std::move(record));
    }
  }
  changed_.notify_all();
}

std::optional<ScanRecord> ScanQueue::pop() {
  const Lock lock(mutex_);
  // The analysis does not see that wait_until() calls the condition with the mutex held.
  wait_until(changed_, mutex_, [this]() TRIDENT_NO_THREAD_SAFETY_ANALYSIS {
    return is_ending_ || (!is_held_ && !records_.empty());
  });
  if (is_ending_) return std::nullopt;
  ScanRecord record = std::move(records_.front());
  records_.pop_front();
  return record;
}

void ScanQueue::end() {
  {
    const Lock lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
}

void ScanQueue::clear() {
  const Lock lock(mutex_);
  records_.clear();
}

void ScanQueue::set_held(bool is_held) {
  {
    const Lock lock(mutex_);
    is_held_ = is_held;
  }
  changed_.notify_all();
}

std::size_t ScanQueue::size() {
  const Lock lock(mutex_);
  return records_.size();
}

std::size_t ScanQueue::replaced() {
  const Lock lock(mutex_);
  return replaced_;
}

}  // namespace trident::slam
