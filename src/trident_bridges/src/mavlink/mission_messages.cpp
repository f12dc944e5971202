// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mavlink/mission_messages.h"

#include <cmath>

#include "trident_bridges/mavlink/whole_number.h"

namespace trident::bridges::mavlink {
namespace {

/// Of x and y in their unit: a degree, a meter, or one where they are param5 and param6.
double scale_of(std::uint8_t frame) {
  if (is_global_frame(frame)) return 1e7;
  return frame == MAV_FRAME_MISSION ? 1.0 : 1e4;
}

bool fits(double scaled) { return std::abs(scaled) <= 2147483647.0; }  // false for NaN

template <class Payload>
MissionItem item_of(const Payload& payload) {
  MissionItem item;
  item.command = payload.command;
  item.frame = payload.frame;
  item.is_current = payload.current != 0;
  item.autocontinue = payload.autocontinue != 0;
  item.params = {payload.param1, payload.param2, payload.param3, payload.param4};
  item.z = payload.z;
  return item;
}

template <class Payload>
ItemHeader header_of(const Payload& payload) {
  return {{payload.target_system, payload.target_component}, payload.seq, payload.mission_type};
}

template <class Payload>
Payload payload_of(const MissionItem& item, const ItemHeader& header) {
  Payload payload{};
  payload.target_system = header.target.system;
  payload.target_component = header.target.component;
  payload.seq = header.sequence;
  payload.mission_type = header.type;
  payload.command = item.command;
  payload.frame = item.frame;
  payload.current = item.is_current ? 1 : 0;
  payload.autocontinue = item.autocontinue ? 1 : 0;
  payload.param1 = item.params[0];
  payload.param2 = item.params[1];
  payload.param3 = item.params[2];
  payload.param4 = item.params[3];
  payload.z = item.z;
  return payload;
}

ReceivedItem read_float_item(const mavlink_mission_item_t& payload) {
  ReceivedItem received{header_of(payload), item_of(payload), false, {}};
  const double scale = scale_of(payload.frame);
  const double x = scale * payload.x, y = scale * payload.y;
  if (!fits(x)) {
    received.verdict = {MissionResult::kInvalidParam5, "x is not a finite number of its range"};
  } else if (!fits(y)) {
    received.verdict = {MissionResult::kInvalidParam6, "y is not a finite number of its range"};
  } else {
    received.item.x = to_whole<std::int32_t>(x);
    received.item.y = to_whole<std::int32_t>(y);
  }
  return received;
}

}  // namespace

std::string item_text(MissionType type, std::size_t item) {
  return std::string(text_of(type)) + " item " + std::to_string(item);
}

std::optional<ReceivedItem> read_item(const Message& message) {
  if (is<mavlink_mission_item_int_t>(message)) {
    const auto payload = unpack<mavlink_mission_item_int_t>(message);
    ReceivedItem received{header_of(payload), item_of(payload), true, {}};
    received.item.x = payload.x;
    received.item.y = payload.y;
    return received;
  }
  if (is<mavlink_mission_item_t>(message)) {
    return read_float_item(unpack<mavlink_mission_item_t>(message));
  }
  return std::nullopt;
}

Message item_int_message(const MissionItem& item, const ItemHeader& header, Address self) {
  auto payload = payload_of<mavlink_mission_item_int_t>(item, header);
  payload.x = item.x;
  payload.y = item.y;
  return pack(payload, self);
}

Message item_message(const MissionItem& item, const ItemHeader& header, Address self) {
  auto payload = payload_of<mavlink_mission_item_t>(item, header);
  const double scale = scale_of(item.frame);
  payload.x = static_cast<float>(item.x / scale);
  payload.y = static_cast<float>(item.y / scale);
  return pack(payload, self);
}

Message ack_message(MissionResult result, Address target, std::uint8_t type, Address self) {
  mavlink_mission_ack_t payload{};
  payload.target_system = target.system;
  payload.target_component = target.component;
  payload.type = static_cast<std::uint8_t>(result);
  payload.mission_type = type;
  return pack(payload, self);
}

Message request_message(const ItemHeader& header, bool is_int, Address self) {
  if (!is_int) {
    mavlink_mission_request_t payload{};
    payload.target_system = header.target.system;
    payload.target_component = header.target.component;
    payload.seq = header.sequence;
    payload.mission_type = header.type;
    return pack(payload, self);
  }
  mavlink_mission_request_int_t payload{};
  payload.target_system = header.target.system;
  payload.target_component = header.target.component;
  payload.seq = header.sequence;
  payload.mission_type = header.type;
  return pack(payload, self);
}

Message count_message(std::size_t count, Address target, std::uint8_t type, Address self) {
  mavlink_mission_count_t payload{};
  payload.target_system = target.system;
  payload.target_component = target.component;
  payload.count = static_cast<std::uint16_t>(count);
  payload.mission_type = type;
  return pack(payload, self);
}

}  // namespace trident::bridges::mavlink
