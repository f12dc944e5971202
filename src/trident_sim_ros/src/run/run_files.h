// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "repeatability.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// What a run leaves in its folder: states.csv (every 0.05 s of simulated time), links.csv (every
/// 0.5 s, of a world with radios), progress.jsonl (every second of wall time), run.json (at the
/// end). Without a folder nothing is written.
class RunFiles {
 public:
  /// Throws Error when the folder cannot be written.
  RunFiles(const std::string& folder, std::uint64_t seed);
  ~RunFiles();
  RunFiles(const RunFiles&) = delete;
  RunFiles& operator=(const RunFiles&) = delete;

  void record(const World& world);
  void progress(const World& world, SimTime end, std::size_t vehicles, const std::string& state);
  struct End {
    std::string reason;
    std::string error;  ///< "" where the run has ended as it should
    double wall_s;      ///< since the first step
    SimTime simulated;  ///< since the first step
  };
  void finish(const World& world, const End& end, const Repeatability& repeatability);
  /// Time went back to zero: the record starts again.
  void restart();

 private:
  void record_states(const World& world);
  void record_links(const World& world);
  static void close(std::FILE** file);

  std::string folder_;
  std::uint64_t seed_;
  std::string line_;  ///< reused
  std::FILE* states_ = nullptr;
  std::FILE* links_ = nullptr;  ///< nullptr: no radio was there yet
  std::FILE* progress_ = nullptr;
  std::chrono::steady_clock::time_point last_progress_;
  SimTime last_progress_time_;
};

}  // namespace trident::sim
