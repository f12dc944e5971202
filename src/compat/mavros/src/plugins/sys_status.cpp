// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/EstimatorStatus.h>
#include <mavros_msgs/ExtendedState.h>
#include <mavros_msgs/MessageInterval.h>
#include <mavros_msgs/SetMode.h>
#include <mavros_msgs/State.h>
#include <mavros_msgs/StatusText.h>
#include <mavros_msgs/StreamRate.h>
#include <mavros_msgs/VehicleInfoGet.h>

#include <cstdio>
#include <optional>

#include "core/mode_names.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "plugins/vehicle_health.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::CommandResult;
using mavros_msgs::SetMode;

/// MAV_CMD_DO_SET_MODE: PX4 wants main and sub mode apart.
bridges::mavlink::Command mode_command(bool is_px4, std::uint8_t base, std::uint32_t custom) {
  bridges::mavlink::Command command;
  command.command = MAV_CMD_DO_SET_MODE;
  command.params[0] = base;
  command.params[1] = is_px4 ? (custom >> 16 & 0xFFU) : custom;
  command.params[2] = is_px4 ? (custom >> 24 & 0xFFU) : 0U;
  return command;
}

/// MAV_TYPE of a name without its prefix; nullopt: unknown.
std::optional<std::uint8_t> mav_type_of(const std::string& name) {
  if (name == "ONBOARD_CONTROLLER") return MAV_TYPE_ONBOARD_CONTROLLER;
  if (name == "GCS") return MAV_TYPE_GCS;
  if (name == "GENERIC") return MAV_TYPE_GENERIC;
  return std::nullopt;
}

/// Whole text of a version as AUTOPILOT_VERSION has it.
std::string hex_of(const std::uint8_t (&bytes)[8]) {  // NOLINT: as the generator makes them
  std::string result;
  for (const std::uint8_t byte : bytes) {
    char two[3];
    std::snprintf(two, sizeof(two), "%02x", byte);
    result += two;
  }
  return result;
}

class SysStatus : public Plugin {
 public:
  explicit SysStatus(Hub& hub) : hub_(hub), vehicle_(hub.vehicle), health_(hub) {
    advertise();
    vehicle_.on_connection([this](bool) { publish_state(); });
    on<mavlink_heartbeat_t>(vehicle_, [this](const mavlink_heartbeat_t&) { publish_state(); });
    on<mavlink_extended_sys_state_t>(vehicle_, [this](const auto& state) { on_extended(state); });
    on<mavlink_estimator_status_t>(vehicle_, [this](const auto& status) { on_estimator(status); });
    on<mavlink_autopilot_version_t>(vehicle_, [this](const auto& v) { version_ = v; });
    vehicle_.on(MAVLINK_MSG_ID_STATUSTEXT, [this](const Message& message) { on_text(message); });
    vehicle_.on_connection([this](bool is_there) {
      if (is_there) ask_version();
    });
    serve();
    const auto& conn = hub.params.conn;
    if (conn.heartbeat_rate > 0.0) {
      hub.ros.every(1.0 / conn.heartbeat_rate, [this] { send_heartbeat(); });
    }
    publish_state();
  }

 private:
  void advertise() {
    RosSide& ros = hub_.ros;
    state_ = ros.advertise_latched<mavros_msgs::State>("state");
    extended_ = ros.advertise<mavros_msgs::ExtendedState>("extended_state");
    texts_ = ros.advertise<mavros_msgs::StatusText>("statustext/recv");
    estimator_ = ros.advertise<mavros_msgs::EstimatorStatus>("estimator_status");
    ros.subscribe<mavros_msgs::StatusText>("statustext/send", [this](const auto& text) {
      mavlink_statustext_t payload{};
      payload.severity = text.severity;
      text.text.copy(payload.text, sizeof(payload.text));
      send(vehicle_, payload);
    });
  }

  void serve() {
    RosSide& ros = hub_.ros;
    ros.serve_waiting<SetMode>("set_mode", [this](const SetMode::Request& request, auto reply) {
      set_mode(request, reply);
    });
    ros.serve_waiting<mavros_msgs::MessageInterval>(
        "set_message_interval", [this](const auto& request, auto reply) {
          constexpr double kMicro = 1e6;
          bridges::mavlink::Command command;
          command.command = MAV_CMD_SET_MESSAGE_INTERVAL;
          command.params[0] = request.message_id;
          command.params[1] =
              request.message_rate > 0.0F ? kMicro / request.message_rate : request.message_rate;
          vehicle_.command(command, false, [reply](const CommandOutcome& end) {
            mavros_msgs::MessageInterval::Response response;
            response.success = end.is_answered && end.reply.result == CommandResult::kAccepted;
            reply(response);
          });
        });
    ros.serve<mavros_msgs::StreamRate>("set_stream_rate", [this](const auto& request) {
      mavlink_request_data_stream_t payload{};
      payload.req_stream_id = request.stream_id;
      payload.req_message_rate = request.message_rate;
      payload.start_stop = request.on_off ? 1 : 0;
      send_to_target(vehicle_, payload);
      return mavros_msgs::StreamRate::Response();
    });
    ros.serve<mavros_msgs::VehicleInfoGet>("vehicle_info_get",
                                           [this](const auto&) { return vehicle_info(); });
  }

  void set_mode(const SetMode::Request& request, const WaitingServices::Reply<SetMode>& reply) {
    const Heartbeat& beat = vehicle_.heartbeat();
    std::uint8_t base = request.base_mode;
    std::uint32_t custom = 0;
    if (!request.custom_mode.empty()) {
      const auto number = mode_number(beat.autopilot, beat.type, request.custom_mode);
      if (!number) {
        refuse("mode '" + request.custom_mode +
               "' is unknown, legal: " + mode_names_text(beat.autopilot, beat.type));
        reply(SetMode::Response());
        return;
      }
      custom = *number;
      base = MAV_MODE_FLAG_CUSTOM_MODE_ENABLED;
    }
    const auto done = [this, reply, base, custom,
                       name = request.custom_mode](const CommandOutcome& end) {
      SetMode::Response response;
      response.mode_sent = end.is_answered && end.reply.result == CommandResult::kAccepted;
      if (end.is_answered && end.reply.result == CommandResult::kUnsupported) {
        send_set_mode(base, custom);
        response.mode_sent = 1U;
      }
      if (response.mode_sent == 0U) refuse("mode " + name + " refused: " + end.reply.reason);
      reply(response);
    };
    vehicle_.command(mode_command(vehicle_.is_px4(), base, custom), false, done);
  }

  /// Of vehicles that know no command for it.
  void send_set_mode(std::uint8_t base, std::uint32_t custom) {
    mavlink_set_mode_t payload{};
    payload.target_system = vehicle_.target().system;
    payload.base_mode = base;
    payload.custom_mode = custom;
    send(vehicle_, payload);
  }

  void refuse(const std::string& text) { hub_.ros.refuse("commands refused", text); }

  void send_heartbeat() {
    mavlink_heartbeat_t payload{};
    payload.type =
        mav_type_of(hub_.params.conn.heartbeat_mav_type).value_or(MAV_TYPE_ONBOARD_CONTROLLER);
    payload.autopilot = MAV_AUTOPILOT_INVALID;
    payload.base_mode = MAV_MODE_MANUAL_ARMED;
    payload.system_status = MAV_STATE_ACTIVE;
    send(vehicle_, payload);
  }

  void ask_version() {
    bridges::mavlink::Command command;
    command.command = MAV_CMD_REQUEST_MESSAGE;
    command.params[0] = MAVLINK_MSG_ID_AUTOPILOT_VERSION;
    vehicle_.command(command, false, [](const CommandOutcome&) {});
  }

  void publish_state() {
    const Heartbeat& beat = vehicle_.heartbeat();
    mavros_msgs::State state;
    state.header.stamp = ros::Time::now();
    state.connected = vehicle_.is_connected();
    if (vehicle_.is_connected()) {
      state.armed = beat.is_armed();
      state.guided = (beat.base_mode & MAV_MODE_FLAG_GUIDED_ENABLED) != 0;
      state.manual_input = (beat.base_mode & MAV_MODE_FLAG_MANUAL_INPUT_ENABLED) != 0;
      state.mode = mode_name(beat.autopilot, beat.type, beat.custom_mode);
      state.system_status = beat.system_status;
    }
    state_.publish(state);
  }

  void on_extended(const mavlink_extended_sys_state_t& state) {
    mavros_msgs::ExtendedState message;
    message.header.stamp = ros::Time::now();
    message.vtol_state = state.vtol_state;
    message.landed_state = state.landed_state;
    extended_->publish(message);
  }

  void on_estimator(const mavlink_estimator_status_t& status) {
    const auto is_set = [&](unsigned flag) -> std::uint8_t { return (status.flags & flag) != 0; };
    mavros_msgs::EstimatorStatus message;
    message.header.stamp = vehicle_.stamp_us(status.time_usec);
    message.attitude_status_flag = is_set(ESTIMATOR_ATTITUDE);
    message.velocity_horiz_status_flag = is_set(ESTIMATOR_VELOCITY_HORIZ);
    message.velocity_vert_status_flag = is_set(ESTIMATOR_VELOCITY_VERT);
    message.pos_horiz_rel_status_flag = is_set(ESTIMATOR_POS_HORIZ_REL);
    message.pos_horiz_abs_status_flag = is_set(ESTIMATOR_POS_HORIZ_ABS);
    message.pos_vert_abs_status_flag = is_set(ESTIMATOR_POS_VERT_ABS);
    message.pos_vert_agl_status_flag = is_set(ESTIMATOR_POS_VERT_AGL);
    message.const_pos_mode_status_flag = is_set(ESTIMATOR_CONST_POS_MODE);
    message.pred_pos_horiz_rel_status_flag = is_set(ESTIMATOR_PRED_POS_HORIZ_REL);
    message.pred_pos_horiz_abs_status_flag = is_set(ESTIMATOR_PRED_POS_HORIZ_ABS);
    message.gps_glitch_status_flag = is_set(ESTIMATOR_GPS_GLITCH);
    message.accel_error_status_flag = is_set(ESTIMATOR_ACCEL_ERROR);
    estimator_->publish(message);
  }

  void on_text(const Message& part) {
    const auto text = reader_.handle(part, vehicle_.now());
    if (!text) return;
    using bridges::mavlink::Severity;
    if (text->severity <= Severity::kError) {
      ROS_ERROR("FCU: %s", text->text.c_str());
    } else if (text->severity == Severity::kWarning) {
      ROS_WARN("FCU: %s", text->text.c_str());
    } else {
      ROS_INFO("FCU: %s", text->text.c_str());
    }
    mavros_msgs::StatusText message;
    message.header.stamp = ros::Time::now();
    message.severity = static_cast<std::uint8_t>(text->severity);
    message.text = text->text;
    texts_->publish(message);
  }

  mavros_msgs::VehicleInfoGet::Response vehicle_info() const {
    mavros_msgs::VehicleInfoGet::Response response;
    const Heartbeat& beat = vehicle_.heartbeat();
    mavros_msgs::VehicleInfo info;
    info.header.stamp = ros::Time::now();
    info.available_info = mavros_msgs::VehicleInfo::HAVE_INFO_HEARTBEAT;
    info.sysid = vehicle_.target().system;
    info.compid = vehicle_.target().component;
    info.autopilot = beat.autopilot;
    info.type = beat.type;
    info.system_status = beat.system_status;
    info.base_mode = beat.base_mode;
    info.custom_mode = beat.custom_mode;
    info.mode = mode_name(beat.autopilot, beat.type, beat.custom_mode);
    info.mode_id = beat.custom_mode;
    if (version_) {
      info.available_info |= mavros_msgs::VehicleInfo::HAVE_INFO_AUTOPILOT_VERSION;
      info.capabilities = version_->capabilities;
      info.flight_sw_version = version_->flight_sw_version;
      info.middleware_sw_version = version_->middleware_sw_version;
      info.os_sw_version = version_->os_sw_version;
      info.board_version = version_->board_version;
      info.flight_custom_version = hex_of(version_->flight_custom_version);
      info.vendor_id = version_->vendor_id;
      info.product_id = version_->product_id;
      info.uid = version_->uid;
    }
    response.success = vehicle_.is_connected();
    if (vehicle_.is_connected()) response.vehicles.push_back(info);
    return response;
  }

  Hub& hub_;
  VehicleSide& vehicle_;
  VehicleHealth health_;
  ros::Publisher state_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::ExtendedState>> extended_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::StatusText>> texts_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::EstimatorStatus>> estimator_;
  bridges::mavlink::StatusTextReader reader_;
  std::optional<mavlink_autopilot_version_t> version_;
};

}  // namespace

std::unique_ptr<Plugin> make_sys_status(Hub& hub) { return std::make_unique<SysStatus>(hub); }

}  // namespace trident::mavros
