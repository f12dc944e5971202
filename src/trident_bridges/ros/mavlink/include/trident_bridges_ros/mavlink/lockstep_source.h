// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "trident_base/sim_time.h"
#include "trident_bridges/transport/poll_loop.h"

namespace trident::bridges {

/// Enrols the node as a source of set-points in a simulator's lockstep, as soon as there is one.
class LockstepSource {
 public:
  /// What is enrolled.
  struct Setup {
    std::vector<std::string> vehicles;  ///< models that get set-points
    double period_s = 0.0;              ///< from one set-point to the next
  };
  /// Asks in a thread of its own, because services are waited for. `enrolled` is called in the
  /// thread of `loop`, which must outlive this, with the stamp of the first set-point; never where
  /// no simulator waits.
  LockstepSource(Setup setup, PollLoop& loop, std::function<void(SimTime)> enrolled);
  ~LockstepSource();
  LockstepSource(const LockstepSource&) = delete;
  LockstepSource& operator=(const LockstepSource&) = delete;

 private:
  void ask();
  bool await_service();

  Setup setup_;
  PollLoop& loop_;
  std::function<void(SimTime)> enrolled_;
  std::atomic<bool> is_ending_{false};
  std::thread thread_;
};

}  // namespace trident::bridges
