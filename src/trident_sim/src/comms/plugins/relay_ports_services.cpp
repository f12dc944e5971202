// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What RelayPorts has to do with services.
#include <algorithm>

#include "comms/plugins/relay_ports.h"
#include "trident_base/error.h"

namespace trident::sim {

std::vector<CallFlow> RelayPorts::calls() const {
  std::vector<CallFlow> result;
  for (const auto& [key, counts] : calls_.counts()) {
    const RelayRule& rule = relay_.rules()[key.rule];
    result.push_back({rule.text(key.rule), rule.deadline_s, key.source, key.destination, counts});
  }
  return result;
}

std::vector<RelayService> RelayPorts::services() const {
  std::vector<RelayService> result;
  const std::vector<RelayRule>& rules = relay_.rules();
  for (const std::string& caller : robots_) {
    for (const std::string& server : robots_) {
      for (std::size_t i = 0; i < rules.size(); ++i) {
        const RelayRule& rule = rules[i];
        const bool is_allowed = rule.is_service() && rule.is_from(caller) && rule.is_to(server);
        if (!is_allowed || caller == server) continue;
        result.push_back({rule.text(i), caller, server, rule.service});
      }
    }
  }
  return result;
}

std::uint64_t RelayPorts::call(const RelayService& service,
                               std::shared_ptr<const std::string> request) {
  const std::vector<RelayRule>& rules = relay_.rules();
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const RelayRule& rule = rules[i];
    const bool is_it = rule.service == service.name && rule.is_from(service.caller) &&
                       rule.is_to(service.server) && service.caller != service.server;
    // Names of robots are sorted.
    const bool are_there = std::binary_search(robots_.begin(), robots_.end(), service.caller) &&
                           std::binary_search(robots_.begin(), robots_.end(), service.server);
    if (!is_it || !are_there) continue;
    return calls_.begin({i, service.caller, service.server}, *request, world_.time(), &relay_);
  }
  throw Error(file_ + ": no rule lets '" + service.caller + "' call '" + service.server + "/" +
              service.name + "'");
}

}  // namespace trident::sim
