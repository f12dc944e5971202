// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/plugins/radio_inbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace trident::sim {
namespace {

// What waits in an inbox for somebody to ask, at most.
constexpr std::size_t kMaxMessages = 10000;
constexpr std::size_t kMaxInboxBytes = 4000000;

}  // namespace

std::uint64_t Inbox::add(RadioMessage message) {
  bytes_ += message.data.size();
  messages_.push_back(std::move(message));
  std::uint64_t gone = 0;
  for (; messages_.size() > kMaxMessages || bytes_ > kMaxInboxBytes; ++gone) {
    bytes_ -= messages_.front().data.size();
    messages_.pop_front();
  }
  return gone;
}

std::vector<RadioMessage> Inbox::take(SimTime now) {
  std::vector<RadioMessage> result;
  const auto later =
      std::stable_partition(messages_.begin(), messages_.end(),
                            [now](const RadioMessage& m) { return m.received <= now; });
  std::move(messages_.begin(), later, std::back_inserter(result));
  messages_.erase(messages_.begin(), later);
  for (const RadioMessage& message : result) bytes_ -= message.data.size();
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.received < b.received; });
  return result;
}

}  // namespace trident::sim
