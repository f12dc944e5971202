// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "trident_base/sim_time.h"

namespace trident::bridges::mavlink {

/// When a message that was not answered is sent again: after a timeout that follows the round trips
/// (RFC 6298 without its doubling: a lossy radio is not a congested one). A message that was sent
/// twice measures nothing (Karn). Answers that come twice may show that the timeout is too short
/// for anything to be measured, and lengthen it until something is.
class RetryTimer {
 public:
  static constexpr double kFirst_s = 0.25;     ///< timeout before anything is measured
  static constexpr double kShortest_s = 0.05;  ///< timeout
  static constexpr double kLongest_s = 1.0;    ///< timeout

  /// A new exchange begins: its message is sent now.
  void start(SimTime now) {
    sent_ = begun_ = now;
    tries_ = 1;
  }
  /// The message is sent again.
  void retry(SimTime now) {
    sent_ = now;
    ++tries_;
  }
  /// The answer has come.
  void answered(SimTime now) {
    if (tries_ == 1) measure((now - sent_).seconds());
    if (tries_ > 1 && !is_measured_) guess((now - sent_).seconds());
    tries_ = 0;
  }
  /// An answer has come that was there before.
  void answered_twice() { lengthening_ = std::min(1.5 * lengthening_, kLongest_s / kShortest_s); }

  /// Whether the message is to be sent again.
  bool is_due(SimTime now) const { return tries_ > 0 && (now - sent_).seconds() >= timeout_s(); }
  /// Since the exchange began [s].
  double waited_s(SimTime now) const { return tries_ > 0 ? (now - begun_).seconds() : 0.0; }
  /// How often the message was sent; 0: nothing is waited for.
  std::uint32_t tries() const { return tries_; }
  /// [s].
  double timeout_s() const {
    const double measured = smoothed_s_ > 0.0 ? smoothed_s_ + 4.0 * deviation_s_ : kFirst_s;
    return std::clamp(measured * lengthening_, kShortest_s, kLongest_s);
  }

 private:
  void measure(double round_trip_s) {
    lengthening_ = 1.0;
    if (!is_measured_) {
      smoothed_s_ = round_trip_s;
      deviation_s_ = 0.5 * round_trip_s;
      is_measured_ = true;
      return;
    }
    deviation_s_ += 0.25 * (std::abs(round_trip_s - smoothed_s_) - deviation_s_);
    smoothed_s_ += 0.125 * (round_trip_s - smoothed_s_);
  }

  /// Of a message that was sent twice: if it answers the first, this is too short, and answers come
  /// twice.
  void guess(double round_trip_s) {
    smoothed_s_ = std::max(round_trip_s, 1e-3);
    deviation_s_ = 0.5 * smoothed_s_;
  }

  SimTime sent_, begun_;
  std::uint32_t tries_ = 0;
  bool is_measured_ = false;
  double smoothed_s_ = 0.0, deviation_s_ = 0.0, lengthening_ = 1.0;
};

}  // namespace trident::bridges::mavlink
