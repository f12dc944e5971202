// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <utility>

#include "trident_slam/low_priority.h"

namespace trident::slam {

/// One piece of work at a time in a thread of its own. All calls come from one thread.
class BackgroundTask {
 public:
  BackgroundTask() = default;
  ~BackgroundTask() { wait(); }
  BackgroundTask(const BackgroundTask&) = delete;
  BackgroundTask& operator=(const BackgroundTask&) = delete;

  /// Whether start() would have to wait.
  bool is_busy() const {
    return running_.valid() &&
           running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
  }
  /// Returns when nothing runs any more.
  void wait() const {
    if (running_.valid()) running_.wait();
  }
  /// Waits for the work that is running. `work` must not throw.
  void start(std::function<void()> work) {
    wait();
    running_ = std::async(std::launch::async, [work = std::move(work)] {
      lower_priority_of_this_thread();
      work();
    });
  }

 private:
  std::future<void> running_;
};

}  // namespace trident::slam
