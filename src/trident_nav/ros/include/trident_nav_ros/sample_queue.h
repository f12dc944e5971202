// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>

namespace trident::nav {

/// Times of samples that one thread receives and another one answers, in their order.
class SampleQueue {
 public:
  void push(double stamp_s) {
    {
      const std::lock_guard lock(mutex_);
      stamps_s_.push_back(stamp_s);
    }
    changed_.notify_one();
  }
  /// The oldest one; nothing when none comes within a wall time.
  std::optional<double> pop(std::chrono::milliseconds limit) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, limit, [this] { return !stamps_s_.empty(); })) return std::nullopt;
    const double stamp_s = stamps_s_.front();
    stamps_s_.pop_front();
    return stamp_s;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<double> stamps_s_;
};

}  // namespace trident::nav
