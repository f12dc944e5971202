// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "rate_ticker.h"

namespace trident::sim {

RateTicker::RateTicker(double rate_hz)
    : period_(rate_hz > 0.0 ? SimTime::from_seconds(1.0 / rate_hz) : SimTime{}) {}

bool RateTicker::tick(const StepInfo& info) {
  if (period_.ns <= 0) return true;
  elapsed_ = elapsed_ + info.dt;
  if (elapsed_ < period_) return false;
  elapsed_.ns %= period_.ns;
  return true;
}

}  // namespace trident::sim
