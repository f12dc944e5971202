// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/nmea/ais/target_table.h"

#include <algorithm>

namespace trident::bridges::nmea {
namespace {

constexpr std::size_t kHeaderBits = 38;

bool is_long_enough(const AisBits& bits, std::size_t needed, Refusal* refusal) {
  if (bits.size() >= needed) return true;
  *refusal = {RefusalKind::kBadPayload, "bits", static_cast<double>(bits.size()),
              static_cast<double>(needed), static_cast<double>(AisBits::kMaxBits)};
  return false;
}

template <class T>
bool merge_motion(const AisBits& bits, AisVessel* vessel) {
  vessel->motion = from_bits<T>(bits).motion;
  return true;
}

void merge_position(const AisBits& bits, AisVessel* vessel) {
  const auto message = from_bits<AisPosition>(bits);
  vessel->status = message.status;
  vessel->turn_rate_deg_min = message.turn_rate_deg_min;
  vessel->motion = message.motion;
}

void merge_voyage(const AisBits& bits, AisVessel* vessel) {
  const auto message = from_bits<AisVoyage>(bits);
  vessel->name = message.name;
  vessel->call_sign = message.call_sign;
  vessel->ship_type = message.ship_type;
  vessel->extent = message.extent;
}

void merge_description(const AisBits& bits, AisVessel* vessel) {
  const auto message = from_bits<AisDescription>(bits);
  if (message.part == 0) {
    vessel->name = message.name;
    return;
  }
  vessel->call_sign = message.call_sign;
  vessel->ship_type = message.ship_type;
  vessel->extent = message.extent;
}

/// How a type of message is read.
struct MessageType {
  std::uint32_t first, last;  ///< types
  std::size_t min_bits;
  void (*merge)(const AisBits&, AisVessel*);
};

constexpr std::array<MessageType, 4> kTypes{{
    {1, 3, AisPosition::kMinBits, merge_position},
    {5, 5, AisVoyage::kMinBits, merge_voyage},
    {18, 18, AisClassBPosition::kMinBits,
     [](const AisBits& bits, AisVessel* vessel) { merge_motion<AisClassBPosition>(bits, vessel); }},
    {24, 24, AisDescription::kMinBits, merge_description},
}};

}  // namespace

const AisBits* AisAssembler::add(const AisPart& part, double now_s, Refusal* refusal,
                                 bool* is_refused) {
  *is_refused = false;
  const std::size_t index = part.sequence ? static_cast<std::size_t>(*part.sequence) : kSlots - 1;
  Slot& slot = slots_[index];
  if (*part.number == 1) slot = Slot{{}, 1, *part.total, now_s};
  const bool is_next = slot.next_part == *part.number && slot.total == *part.total &&
                       now_s - slot.began_s <= kMaxAgeS;
  if (!is_next) {
    *refusal = {RefusalKind::kBadPayload, "sentence", static_cast<double>(*part.number),
                static_cast<double>(std::max(1, slot.next_part)),
                static_cast<double>(std::max(1, slot.next_part))};
    slot.next_part = 0;
    *is_refused = true;
    return nullptr;
  }
  if (!append_payload(part.payload.view(), &slot.bits)) {
    *refusal = {RefusalKind::kBadPayload, "payload", part.payload.view(),
                "characters 0 to W and ` to w, 1014 bits in all"};
    slot.next_part = 0;
    *is_refused = true;
    return nullptr;
  }
  if (*part.number < *part.total) {
    ++slot.next_part;
    return nullptr;
  }
  slot.next_part = 0;
  slot.bits.drop(std::min<std::size_t>(slot.bits.size(),
                                       static_cast<std::size_t>(part.fill_bits.value_or(0))));
  return &slot.bits;
}

const AisVessel* AisTargetTable::add(const AisBits& bits, double now_s, Refusal* refusal,
                                     bool* is_refused) {
  *is_refused = !is_long_enough(bits, kHeaderBits, refusal);
  if (*is_refused) return nullptr;
  const auto header = from_bits<AisHeader>(bits);
  const auto type = std::find_if(kTypes.begin(), kTypes.end(), [&](const MessageType& candidate) {
    return header.type >= candidate.first && header.type <= candidate.last;
  });
  if (type == kTypes.end()) return nullptr;
  *is_refused = !is_long_enough(bits, type->min_bits, refusal);
  if (*is_refused) return nullptr;
  if (header.mmsi == 0 || header.mmsi > kMaxMmsi) {
    *refusal = {RefusalKind::kBadPayload, "MMSI", static_cast<double>(header.mmsi), 1.0, kMaxMmsi};
    *is_refused = true;
    return nullptr;
  }
  AisVessel& known = vessel(header.mmsi);
  known.message_type = header.type;
  known.heard_s = now_s;
  type->merge(bits, &known);
  return &known;
}

AisVessel& AisTargetTable::vessel(std::uint32_t mmsi) {
  const auto is_before = [](const AisVessel& known, std::uint32_t number) {
    return known.mmsi < number;
  };
  auto place = std::lower_bound(vessels_.begin(), vessels_.end(), mmsi, is_before);
  if (place != vessels_.end() && place->mmsi == mmsi) return *place;
  if (vessels_.size() == kMaxVessels) {
    vessels_.erase(std::min_element(
        vessels_.begin(), vessels_.end(),
        [](const AisVessel& a, const AisVessel& b) { return a.heard_s < b.heard_s; }));
    place = std::lower_bound(vessels_.begin(), vessels_.end(), mmsi, is_before);
  }
  AisVessel fresh;
  fresh.mmsi = mmsi;
  return *vessels_.insert(place, fresh);
}

}  // namespace trident::bridges::nmea
