// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/relay/best_effort_flow.h"

#include <algorithm>

namespace trident::sim {
namespace {

// Messages of which some parts have come; what is older has lost a part for good.
constexpr std::size_t kBegun = 4;

}  // namespace

std::optional<RelayMessage> BestEffortReceiver::take(const PartDatagram& part, SimTime now,
                                                     RelayCounts* counts) {
  if (part.parts == 0) return std::nullopt;
  if (part.number < next_) {
    ++counts->doubles;
    return std::nullopt;
  }
  Assembly& assembly = begun_[part.number];
  if (assembly.parts.empty()) {
    assembly.parts.resize(part.parts);
    assembly.has.resize(part.parts);
    assembly.missing = part.parts;
  }
  if (part.part >= assembly.parts.size() || assembly.has[part.part]) {
    ++counts->doubles;
    return std::nullopt;
  }
  assembly.has[part.part] = true;
  assembly.parts[part.part] = part.data;
  if (--assembly.missing > 0) {
    if (begun_.size() > kBegun) begun_.erase(begun_.begin());
    return std::nullopt;
  }
  std::string whole;
  for (const std::string& piece : assembly.parts) whole += piece;
  next_ = part.number + 1;
  begun_.erase(begun_.begin(), begun_.upper_bound(part.number));
  if (deadline_.ns > 0 && now - part.born > deadline_) {
    ++counts->expired;
    return std::nullopt;
  }
  return RelayMessage{part.born, std::make_shared<const std::string>(std::move(whole))};
}

}  // namespace trident::sim
