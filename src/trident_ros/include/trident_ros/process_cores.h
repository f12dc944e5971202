// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace trident::ros_utils {

/// Keeps processes on one core each. A node of roscpp hands every message from its socket thread to
/// its callbacks and every answer back; in lockstep that is most of its time, and twice as much of
/// it where the two threads sit on two cores and wake each other across them.
class ProcessCores {
 public:
  /// The cores are those that this process may use.
  ProcessCores();
  /// Gives all back to the cores that they had. When this process ends without its destructors, by
  /// SIGKILL for one, the program core_watcher does so, which the first `keep` starts.
  ~ProcessCores();
  ProcessCores(const ProcessCores&) = delete;
  ProcessCores& operator=(const ProcessCores&) = delete;

  std::size_t count() const { return cores_.size(); }  ///< cores that this process may use

  /// A node of roscpp has five threads and, with timers, six. One that has more works on several
  /// cores by design.
  static constexpr std::size_t kMaxThreads = 6;

  /// Restricts all threads of the process, and those that they will start, to core
  /// `index` modulo count(). Returns the core; -1 when it is left alone: it is this process, has
  /// more than kMaxThreads, was restricted before, here or by somebody else, or may not be; or
  /// there is one core only.
  int keep(pid_t process, std::size_t index);

 private:
  std::vector<int> cores_;
  cpu_set_t all_{};
  struct Impl;
  std::unique_ptr<Impl> impl_;  ///< What is kept, and who gives it back if this process cannot.
};

}  // namespace trident::ros_utils
