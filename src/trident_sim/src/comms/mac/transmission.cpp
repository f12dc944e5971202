// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/mac/transmission.h"

#include <algorithm>
#include <cmath>

#include "comms/phy/packet_error.h"

namespace trident::sim {

void Reception::cut(std::int64_t now_ns) {
  const double sinr_db = 10.0 * std::log10(signal_mw / (noise_mw + interference_mw));
  segments.push_back({now_ns, sinr_db});
}

double Reception::success(int mcs, std::size_t bytes, std::int64_t begin_ns,
                          std::int64_t end_ns) const {
  double logarithm = 0.0;
  std::int64_t from = begin_ns;
  for (const Segment& segment : segments) {
    const std::int64_t to = std::min(segment.end_ns, end_ns);
    if (to <= from) continue;
    // Each segment has its part of the bits: success is the product of success_i^share_i.
    const double share = static_cast<double>(to - from) / static_cast<double>(end_ns - begin_ns);
    logarithm +=
        share * std::log1p(-std::min(packet_error_rate(mcs, segment.sinr_db, bytes), 1.0 - 1e-15));
    from = to;
  }
  return std::exp(logarithm);
}

Reception* Transmission::reception(int station) {
  const auto at = std::lower_bound(receptions.begin(), receptions.end(), station,
                                   [](const Reception& r, int s) { return r.station < s; });
  return at != receptions.end() && at->station == station ? &*at : nullptr;
}

}  // namespace trident::sim
