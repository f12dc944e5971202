// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/heartbeat_monitor.h"

#include <algorithm>
#include <utility>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {

std::optional<Heartbeat> read_heartbeat(const Message& message) {
  if (!is<mavlink_heartbeat_t>(message)) return std::nullopt;
  const auto payload = unpack<mavlink_heartbeat_t>(message);
  return Heartbeat{payload.type, payload.autopilot, payload.base_mode, payload.custom_mode,
                   payload.system_status};
}

double age_s(const BothTimes& then, const BothTimes& now) {
  const double simulated_s = (now.simulated - then.simulated).seconds();
  if (!now.wall || !then.wall) return simulated_s;
  return std::min(simulated_s, (*now.wall - *then.wall).seconds());
}

HeartbeatMonitor::HeartbeatMonitor(double timeout_s,
                                   std::function<void(Address, const Heartbeat&)> appeared,
                                   std::function<void(Address, double age_s)> lost)
    : timeout_s_(timeout_s), appeared_(std::move(appeared)), lost_(std::move(lost)) {}

bool HeartbeatMonitor::handle(const Message& message, const BothTimes& now) {
  const std::optional<Heartbeat> heartbeat = read_heartbeat(message);
  if (!heartbeat) return false;
  const auto [it, is_new] = heard_.try_emplace(message.source);
  const bool appears = is_new || !it->second.is_there;
  it->second = {*heartbeat, now, true};
  if (appears && appeared_) appeared_(message.source, *heartbeat);
  return true;
}

void HeartbeatMonitor::update(const BothTimes& now) {
  for (auto& [source, heard] : heard_) {
    const double age = mavlink::age_s(heard.when, now);
    if (!heard.is_there || age < timeout_s_) continue;
    heard.is_there = false;
    if (lost_) lost_(source, age);
  }
}

double HeartbeatMonitor::age_s(Address source, const BothTimes& now) const {
  const auto it = heard_.find(source);
  return it == heard_.end() ? std::numeric_limits<double>::infinity()
                            : mavlink::age_s(it->second.when, now);
}

double HeartbeatMonitor::ground_station_age_s(const BothTimes& now) const {
  double youngest = std::numeric_limits<double>::infinity();
  for (const auto& [source, heard] : heard_) {
    if (heard.heartbeat.is_ground_station())
      youngest = std::min(youngest, mavlink::age_s(heard.when, now));
  }
  return youngest;
}

const Heartbeat* HeartbeatMonitor::find(Address source) const {
  const auto it = heard_.find(source);
  return it == heard_.end() ? nullptr : &it->second.heartbeat;
}

}  // namespace trident::bridges::mavlink
