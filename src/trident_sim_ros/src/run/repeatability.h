// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// What of a run would not come again: whatever acted on the world in a moment that the wall clock
/// chose. As long as it is empty, another run of the same ends in the same state to the bit. All
/// functions may be called from any thread.
class Repeatability {
 public:
  struct Note {
    std::string who, why;
    SimTime time;             ///< of the first time
    std::uint64_t count = 1;  ///< how often the same was noted
  };
  static constexpr std::size_t kMaxNotes = 20;  ///< different ones that are kept

  /// Whether steps are made without being asked for one by one. What comes while the world stands
  /// acts in its next step, whenever that is made.
  void set_running(bool running) { running_ = running; }
  bool running() const { return running_; }

  /// Notes it whether the world runs or not.
  void spoil(const std::string& who, SimTime time, const std::string& why);
  /// True once after a new kind of note: it is to be logged.
  bool take_unlogged(Note* note);
  std::vector<Note> notes() const;
  /// Of kinds, kept or not.
  std::size_t kinds() const;
  /// Time is back at zero: it is another run.
  void clear();

 private:
  mutable std::mutex mutex_;
  std::atomic<bool> running_{false};
  std::vector<Note> notes_;
  std::size_t kinds_ = 0, logged_ = 0;
};

}  // namespace trident::sim
