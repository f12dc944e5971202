// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/plugins/link_reporter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trident::sim {

LinkStatusSample LinkReporter::status(const RadioLink& link, double elapsed_s) const {
  RadioLink before;
  const auto known = last_.find({link.source, link.destination});
  // Counts that have fallen are those of a robot that was replaced.
  if (known != last_.end() && known->second.sent <= link.sent) before = known->second;
  LinkStatusSample result;
  result.link = link;
  const auto count = static_cast<double>(link.delivered - before.delivered);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const double mean_s = (link.delay_s - before.delay_s) / count;
  const double mean_square = (link.squared_delay_s2 - before.squared_delay_s2) / count;
  result.latency_s = count > 0.0 ? mean_s : nothing;
  result.jitter_s = count > 0.0 ? std::sqrt(std::max(mean_square - mean_s * mean_s, 0.0)) : nothing;
  if (elapsed_s > 0.0) {
    result.goodput_bit_s = 8.0 * static_cast<double>(link.bytes - before.bytes) / elapsed_s;
    result.airtime_share = (link.airtime_s - before.airtime_s) / elapsed_s;
  }
  return result;
}

void LinkReporter::report(const std::vector<RadioLink>& links, const RelayReport* relay,
                          SimTime now, LinkStatusArraySample* sample) {
  const double elapsed_s = (now - last_time_).seconds();
  sample->stamp = now;
  sample->links.clear();
  for (const RadioLink& link : links) {
    sample->links.push_back(status(link, elapsed_s));
    std::vector<std::string>& route = sample->links.back().route;
    route = {link.source, link.destination};
    if (relay != nullptr) route = relay->route(link.source, link.destination);
  }
  for (const RadioLink& link : links) last_[{link.source, link.destination}] = link;
  last_time_ = now;
}

}  // namespace trident::sim
