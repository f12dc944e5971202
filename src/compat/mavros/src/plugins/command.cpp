// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/CommandAck.h>
#include <mavros_msgs/CommandBool.h>
#include <mavros_msgs/CommandHome.h>
#include <mavros_msgs/CommandInt.h>
#include <mavros_msgs/CommandLong.h>
#include <mavros_msgs/CommandTOL.h>
#include <mavros_msgs/CommandTOLLocal.h>
#include <mavros_msgs/CommandTriggerControl.h>
#include <mavros_msgs/CommandTriggerInterval.h>
#include <mavros_msgs/CommandVtolTransition.h>

#include <cmath>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "trident_bridges/mavlink/mission.h"

namespace trident::mavros {
namespace {

using Command = bridges::mavlink::Command;

Command long_command(std::uint16_t number, std::array<double, 7> params) {
  Command command;
  command.command = number;
  command.params = params;
  return command;
}

double one_if(bool is_on) { return is_on ? 1.0 : 0.0; }

/// Commands of the services below cmd/.
class CommandPlugin : public Plugin {
 public:
  explicit CommandPlugin(Hub& hub) : hub_(hub) {
    serve_raw();
    serve_places();
    serve_cameras();
  }

 private:
  void refuse(const Command& command, const CommandOutcome& end) {
    hub_.ros.refuse("commands refused",
                    "command " + std::to_string(command.command) + " refused: " + end.reply.reason);
  }

  /// Sends a command; the service's answer is the vehicle's.
  template <class Reply, class Response>
  void send(const Command& command, const Reply& reply, Response response,
            bool is_for_all = false) {
    if (is_for_all) {
      hub_.vehicle.command(command, true, [](const CommandOutcome&) {});
      response.success = 1U;
      return reply(response);
    }
    hub_.vehicle.command(command, false, [this, command, reply, response](const auto& end) {
      Response answer = response;
      answer.success =
          end.is_answered && end.reply.result == bridges::mavlink::CommandResult::kAccepted;
      set_result(answer, end);
      if (answer.success == 0U) refuse(command, end);
      reply(answer);
    });
  }
  template <class Response>
  static auto set_result(Response& response, const CommandOutcome& end)
      -> decltype(response.result, void()) {
    response.result = static_cast<std::uint8_t>(end.reply.result);
  }
  static void set_result(mavros_msgs::CommandInt::Response& /*none*/, const CommandOutcome&) {}

  /// A service whose request becomes a command.
  template <class Service, class Convert>
  void serve(const std::string& name, Convert convert) {
    hub_.ros.serve_waiting<Service>("cmd/" + name,
                                    [this, convert](const auto& request, auto reply) {
                                      send(convert(request), reply, typename Service::Response());
                                    });
  }

  void serve_raw() {
    using mavros_msgs::CommandInt;
    using mavros_msgs::CommandLong;
    hub_.ros.serve_waiting<CommandLong>("cmd/command", [this](const auto& q, auto reply) {
      send(long_command(q.command,
                        {q.param1, q.param2, q.param3, q.param4, q.param5, q.param6, q.param7}),
           reply, CommandLong::Response(), q.broadcast != 0U);
    });
    hub_.ros.serve_waiting<CommandInt>("cmd/command_int", [this](const auto& q, auto reply) {
      const double unit = bridges::mavlink::scale_of_place(q.command, q.frame);
      Command command = long_command(
          q.command, {q.param1, q.param2, q.param3, q.param4, q.x / unit, q.y / unit, q.z});
      command.is_int = true;
      command.frame = q.frame;
      send(command, reply, CommandInt::Response(), q.broadcast != 0U);
    });
    hub_.ros.serve<mavros_msgs::CommandAck>("cmd/command_ack", [this](const auto& q) {
      mavlink_command_ack_t payload{};
      payload.command = q.command;
      payload.result = q.result;
      payload.progress = q.progress;
      payload.result_param2 = static_cast<std::int32_t>(q.result_param2);
      send_to_target(hub_.vehicle, payload);
      mavros_msgs::CommandAck::Response response;
      response.success = 1U;
      return response;
    });
  }

  void serve_places() {
    using mavros_msgs::CommandTOL;
    using mavros_msgs::CommandTOLLocal;
    serve<mavros_msgs::CommandBool>("arming", [](const auto& q) {
      return long_command(MAV_CMD_COMPONENT_ARM_DISARM, {one_if(q.value != 0U)});
    });
    serve<mavros_msgs::CommandHome>("set_home", [](const auto& q) {
      return long_command(MAV_CMD_DO_SET_HOME, {one_if(q.current_gps != 0U), 0, 0, q.yaw,
                                                q.latitude, q.longitude, q.altitude});
    });
    const auto on_earth = [](std::uint16_t number) {
      return [number](const CommandTOL::Request& q) {
        return long_command(number,
                            {q.min_pitch, 0, 0, q.yaw, q.latitude, q.longitude, q.altitude});
      };
    };
    serve<CommandTOL>("takeoff", on_earth(MAV_CMD_NAV_TAKEOFF));
    serve<CommandTOL>("land", on_earth(MAV_CMD_NAV_LAND));
    serve<CommandTOLLocal>("takeoff_local", [](const auto& q) {
      const Eigen::Vector3d p = bridges::mavlink::swap_world(to_eigen(q.position));
      return long_command(
          MAV_CMD_NAV_TAKEOFF_LOCAL,
          {q.min_pitch, 0, q.rate, bridges::mavlink::swap_yaw(q.yaw), p.y(), p.x(), p.z()});
    });
    serve<CommandTOLLocal>("land_local", [](const auto& q) {
      const Eigen::Vector3d p = bridges::mavlink::swap_world(to_eigen(q.position));
      return long_command(
          MAV_CMD_NAV_LAND_LOCAL,
          {0, q.offset, q.rate, bridges::mavlink::swap_yaw(q.yaw), p.y(), p.x(), p.z()});
    });
    serve<mavros_msgs::CommandVtolTransition>("vtol_transition", [](const auto& q) {
      return long_command(MAV_CMD_DO_VTOL_TRANSITION, {static_cast<double>(q.state)});
    });
  }

  void serve_cameras() {
    serve<mavros_msgs::CommandTriggerControl>("trigger_control", [](const auto& q) {
      return long_command(MAV_CMD_DO_TRIGGER_CONTROL,
                          {one_if(q.trigger_enable != 0U), one_if(q.sequence_reset != 0U),
                           one_if(q.trigger_pause != 0U)});
    });
    serve<mavros_msgs::CommandTriggerInterval>("trigger_interval", [](const auto& q) {
      return long_command(MAV_CMD_DO_SET_CAM_TRIGG_INTERVAL, {q.cycle_time, q.integration_time});
    });
  }

  Hub& hub_;
};

}  // namespace

std::unique_ptr<Plugin> make_command(Hub& hub) { return std::make_unique<CommandPlugin>(hub); }

}  // namespace trident::mavros
