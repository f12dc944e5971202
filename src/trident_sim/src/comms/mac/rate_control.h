// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "comms/phy/vht.h"

namespace trident::sim {

/// What the next frame to a station is sent with.
struct RateChoice {
  int mcs = 0;
  bool is_probe = false;  ///< of a mode that may be better: a short frame will do
};

/// Chooses the mode with the highest expected goodput by what was acknowledged, as Minstrel does:
/// a moving mean of each mode's success, and now and then a frame of the next faster mode, the
/// rarer the more often it failed. Without chance and clocks: a function of what was reported.
class RateControl {
 public:
  /// `width_mhz` 20, 40 or 80.
  RateControl(int width_mhz, bool has_short_guard);

  /// For a frame that carries so many bytes.
  RateChoice choose(std::size_t bytes);
  /// Of `sent` subframes with that mode `acknowledged` arrived.
  void report(int mcs, std::size_t sent, std::size_t acknowledged);

  /// The mode that frames have now, but for probes.
  int mcs() const { return best_; }

 private:
  struct Mode {
    double success = 1.0;        ///< moving mean; 1 before the first report
    std::uint64_t frame = 0;     ///< of the last report
    std::uint64_t interval = 1;  ///< of frames between two probes of it
  };
  double goodput(int mcs, std::size_t bytes) const;
  int faster(int mcs) const;
  int slower(int mcs) const;
  void step_down(std::size_t bytes);

  int width_mhz_;
  bool has_short_guard_;
  int best_ = 0;
  std::array<Mode, vht::kModes> modes_;
  std::uint64_t frames_ = 0, probed_frame_ = 0;
};

}  // namespace trident::sim
