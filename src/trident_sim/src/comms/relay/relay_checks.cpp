// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Topics that are more than the radio can carry: one report each.
#include <algorithm>
#include <utility>

#include "comms/relay/relay.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr SimTime kSecond{1'000'000'000};

}  // namespace

/// A topic that has more than the air carries is a mistake of its rule, and is reported once.
void Relay::check_rate(const std::pair<std::size_t, std::string>& key, Topic* topic,
                       std::size_t bytes, SimTime now, Radio& radio) {
  topic->bytes += bytes;
  if (topic->has_reported_rate || now - topic->second < kSecond) return;
  const double bit_s = 8.0 * static_cast<double>(topic->bytes) / (now - topic->second).seconds();
  topic->second = now;
  topic->bytes = 0;
  constexpr double kSlowest_bit_s = 1e6;  // what every mode carries, and is not worth a look
  if (bit_s < kSlowest_bit_s) return;
  const auto& [index, source] = key;
  const RelayRule& rule = rules_[index];
  double carried_bit_s = 0.0;
  if (rule.is_broadcast()) {
    carried_bit_s = radio.limits(source).broadcast_bit_s;
  } else {
    for (const RadioLink& link : radio.links(source)) {
      if (rule.is_to(link.destination)) carried_bit_s = std::max(carried_bit_s, link.rate_bit_s);
    }
  }
  if (bit_s <= carried_bit_s) return;
  topic->has_reported_rate = true;
  report_(rule.text(index) + ": " + source + "/" + rule.topic + " has " +
          number_text(1e-6 * bit_s) + " Mbit/s, legal is less than its radio carries, " +
          number_text(1e-6 * carried_bit_s) + "; max_rate limits it");
}

bool Relay::is_too_large(const std::pair<std::size_t, std::string>& key, Topic* topic,
                         std::size_t bytes, Radio& radio) {
  const auto& [index, source] = key;
  const RelayRule& rule = rules_[index];
  std::size_t limit = kMaxBytes;
  // All parts of a message that is sent once wait in the queue; others follow as they are
  // acknowledged.
  if (!rule.is_reliable()) limit = std::min(limit, radio.limits(source).queue_bytes);
  if (bytes <= limit) return false;
  if (!std::exchange(topic->has_reported_size, true)) {
    report_(rule.text(index) + ": a message of " + source + "/" + rule.topic + " has " +
            std::to_string(bytes) + " bytes, legal: at most " + std::to_string(limit) +
            (rule.is_reliable() ? "" : ", its radio's queue; reliable rules take larger ones"));
  }
  return true;
}

}  // namespace trident::sim
