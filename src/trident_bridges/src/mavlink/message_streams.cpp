// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/message_streams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "trident_base/string_util.h"
#include "trident_bridges/mavlink/dialect.h"

namespace trident::bridges::mavlink {
namespace {

/// The messages of each MAV_DATA_STREAM, as ArduPilot groups them.
const std::vector<std::uint32_t>& messages_of(std::uint8_t stream) {
  static const std::map<std::uint8_t, std::vector<std::uint32_t>> kGroups{
      {MAV_DATA_STREAM_RAW_SENSORS,
       {MAVLINK_MSG_ID_HIGHRES_IMU, MAVLINK_MSG_ID_SCALED_IMU2, MAVLINK_MSG_ID_SCALED_PRESSURE}},
      {MAV_DATA_STREAM_EXTENDED_STATUS,
       {MAVLINK_MSG_ID_SYS_STATUS, MAVLINK_MSG_ID_GPS_RAW_INT, MAVLINK_MSG_ID_MISSION_CURRENT,
        MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT, MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED}},
      {MAV_DATA_STREAM_RC_CHANNELS, {MAVLINK_MSG_ID_RC_CHANNELS, MAVLINK_MSG_ID_SERVO_OUTPUT_RAW}},
      {MAV_DATA_STREAM_RAW_CONTROLLER, {MAVLINK_MSG_ID_ATTITUDE_TARGET}},
      {MAV_DATA_STREAM_POSITION,
       {MAVLINK_MSG_ID_GLOBAL_POSITION_INT, MAVLINK_MSG_ID_LOCAL_POSITION_NED}},
      {MAV_DATA_STREAM_EXTRA1, {MAVLINK_MSG_ID_ATTITUDE, MAVLINK_MSG_ID_ATTITUDE_QUATERNION}},
      {MAV_DATA_STREAM_EXTRA2, {MAVLINK_MSG_ID_VFR_HUD, MAVLINK_MSG_ID_ALTITUDE}},
      {MAV_DATA_STREAM_EXTRA3,
       {MAVLINK_MSG_ID_BATTERY_STATUS, MAVLINK_MSG_ID_SYSTEM_TIME, MAVLINK_MSG_ID_VIBRATION,
        MAVLINK_MSG_ID_WIND_COV, MAVLINK_MSG_ID_ESTIMATOR_STATUS}}};
  static const std::vector<std::uint32_t> kNothing;
  static const std::vector<std::uint32_t> kAll = [] {
    std::vector<std::uint32_t> all;
    for (const auto& [group, messages] : kGroups) {
      all.insert(all.end(), messages.begin(), messages.end());
    }
    return all;
  }();
  if (stream == MAV_DATA_STREAM_ALL) return kAll;
  const auto it = kGroups.find(stream);
  return it == kGroups.end() ? kNothing : it->second;
}

std::string numbered(double id) { return "message " + number_text(id); }

}  // namespace

std::vector<StreamRate> vehicle_stream_rates(bool is_px4) {
  // Those that change seldom are repeated by PX4 alone, for clients that come late.
  const double home_hz = is_px4 ? 0.5 : 0.0;
  const double origin_hz = is_px4 ? 1.0 : 0.0;
  return {{MAVLINK_MSG_ID_HEARTBEAT, 1.0},
          {MAVLINK_MSG_ID_SYS_STATUS, 1.0},
          {MAVLINK_MSG_ID_EXTENDED_SYS_STATE, 1.0},
          {MAVLINK_MSG_ID_BATTERY_STATUS, 1.0},
          {MAVLINK_MSG_ID_SYSTEM_TIME, 1.0},
          {MAVLINK_MSG_ID_ATTITUDE, 25.0},
          {MAVLINK_MSG_ID_ATTITUDE_QUATERNION, 25.0},
          {MAVLINK_MSG_ID_LOCAL_POSITION_NED, 25.0},
          {MAVLINK_MSG_ID_GLOBAL_POSITION_INT, 10.0},
          {MAVLINK_MSG_ID_GPS_RAW_INT, 5.0},
          {MAVLINK_MSG_ID_ODOMETRY, 0.0},
          {MAVLINK_MSG_ID_HIGHRES_IMU, 25.0},
          {MAVLINK_MSG_ID_SCALED_IMU2, 25.0},
          {MAVLINK_MSG_ID_SCALED_PRESSURE, 5.0},
          {MAVLINK_MSG_ID_VFR_HUD, 5.0},
          {MAVLINK_MSG_ID_ALTITUDE, 5.0},
          {MAVLINK_MSG_ID_RC_CHANNELS, 2.0},
          {MAVLINK_MSG_ID_SERVO_OUTPUT_RAW, 5.0},
          {MAVLINK_MSG_ID_NAV_CONTROLLER_OUTPUT, 5.0},
          {MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED, 5.0},
          {MAVLINK_MSG_ID_ATTITUDE_TARGET, 5.0},
          {MAVLINK_MSG_ID_ESTIMATOR_STATUS, 1.0},
          {MAVLINK_MSG_ID_VIBRATION, 1.0},
          {MAVLINK_MSG_ID_WIND_COV, 1.0},
          {MAVLINK_MSG_ID_MISSION_CURRENT, 2.0},
          {MAVLINK_MSG_ID_RADIO_STATUS, 1.0},
          {MAVLINK_MSG_ID_HOME_POSITION, home_hz},
          {MAVLINK_MSG_ID_GPS_GLOBAL_ORIGIN, origin_hz},
          {MAVLINK_MSG_ID_DISTANCE_SENSOR, 0.0}};
}

MessageStreams::MessageStreams(Address self, MessageSink send,
                               const std::vector<StreamRate>& defaults,
                               std::function<bool(std::uint32_t id)> emit)
    : self_(self), send_(std::move(send)), emit_(std::move(emit)) {
  for (const StreamRate& rate : defaults) {
    Stream stream;
    stream.default_hz = rate.rate_hz;
    set_rate(stream, rate.rate_hz, {});
    streams_[rate.id] = stream;
  }
}

double MessageStreams::rate_hz(std::uint32_t id) const {
  const auto it = streams_.find(id);
  if (it == streams_.end() || it->second.period_ns == 0) return 0.0;
  return 1e9 / static_cast<double>(it->second.period_ns);
}

void MessageStreams::set_rate(Stream& stream, double rate_hz, SimTime now) {
  stream.period_ns = rate_hz > 0.0 ? std::llround(1e9 / std::min(rate_hz, kMaxRate_hz)) : 0;
  stream.due = now;
  is_changed_ = true;
}

void MessageStreams::emit_if_due(std::uint32_t id, Stream& stream, SimTime now) {
  const bool is_set_back = (stream.due - now).ns > stream.period_ns;
  if (is_set_back) stream.due = now;
  if (now < stream.due) return;
  emit_(id);
  stream.due = stream.due + SimTime{stream.period_ns};
  // After a pause nothing is made up for.
  if (stream.due <= now) stream.due = now + SimTime{stream.period_ns};
}

void MessageStreams::update(SimTime now) {
  if (!is_changed_ && now >= updated_ && now < next_due_) return;
  is_changed_ = false;
  updated_ = now;
  next_due_ = SimTime{std::numeric_limits<std::int64_t>::max()};
  for (auto& [id, stream] : streams_) {
    if (stream.period_ns == 0) continue;
    emit_if_due(id, stream, now);
    next_due_ = std::min(next_due_, stream.due);
  }
}

bool MessageStreams::handle(const Message& message, SimTime now) {
  const auto payload = unpack_if_for<mavlink_request_data_stream_t>(message, self_);
  if (!payload) return false;
  for (const std::uint32_t id : messages_of(payload->req_stream_id)) {
    const auto it = streams_.find(id);
    if (it == streams_.end()) continue;
    set_rate(it->second, payload->start_stop != 0 ? payload->req_message_rate : 0.0, now);
  }
  return true;
}

std::optional<CommandReply> MessageStreams::execute(const Command& command, SimTime now) {
  switch (command.command) {
    case MAV_CMD_SET_MESSAGE_INTERVAL:
      return set_interval(command.params[0], command.params[1], now);
    case MAV_CMD_GET_MESSAGE_INTERVAL:
      return get_interval(command.params[0]);
    case MAV_CMD_REQUEST_MESSAGE:
      return request(command.params[0]);
    default:
      return std::nullopt;
  }
}

MessageStreams::Stream* MessageStreams::find(double id) {
  if (!(id >= 0.0 && id < 1e7)) return nullptr;
  const auto it = streams_.find(static_cast<std::uint32_t>(id));
  return it == streams_.end() ? nullptr : &it->second;
}

/// `interval_us`: -1 turns the message off, 0 asks for the default rate.
CommandReply MessageStreams::set_interval(double id, double interval_us, SimTime now) {
  Stream* const stream = find(id);
  if (stream == nullptr) {
    return {CommandResult::kDenied, numbered(id) + " is not sent by this vehicle", 0};
  }
  const double shortest_us = 1e6 / kMaxRate_hz;
  if (interval_us == -1.0) {
    set_rate(*stream, 0.0, now);
  } else if (interval_us == 0.0) {
    set_rate(*stream, stream->default_hz, now);
  } else if (interval_us >= shortest_us) {
    set_rate(*stream, 1e6 / interval_us, now);
  } else {
    return {CommandResult::kDenied,
            numbered(id) + ": interval " + number_text(interval_us) +
                " us, legal: >= " + number_text(shortest_us) + ", 0 or -1",
            0};
  }
  return {};
}

CommandReply MessageStreams::get_interval(double id) {
  if (!(id >= 0.0 && id < 65536.0)) {
    return {CommandResult::kDenied, numbered(id) + ", legal: 0 to 65535", 0};
  }
  mavlink_message_interval_t payload{};
  payload.message_id = static_cast<std::uint16_t>(id);
  const auto it = streams_.find(payload.message_id);
  // 0 says that the message does not exist here, -1 that it is off.
  if (it != streams_.end()) {
    payload.interval_us =
        it->second.period_ns == 0 ? -1 : static_cast<std::int32_t>(it->second.period_ns / 1000);
  }
  send_(pack(payload, self_));
  return {};
}

CommandReply MessageStreams::request(double id) {
  const bool is_id = id >= 0.0 && id < 16777216.0;
  if (is_id && emit_(static_cast<std::uint32_t>(id))) return {};
  const bool is_known = is_id && streams_.count(static_cast<std::uint32_t>(id)) > 0;
  return {is_known ? CommandResult::kDenied : CommandResult::kUnsupported,
          numbered(id) + " is not sent by this vehicle", 0};
}

}  // namespace trident::bridges::mavlink
