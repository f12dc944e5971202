// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/Param.h>
#include <mavros_msgs/ParamGet.h>
#include <mavros_msgs/ParamPull.h>
#include <mavros_msgs/ParamPush.h>
#include <mavros_msgs/ParamSet.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cmath>
#include <deque>
#include <optional>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "trident_bridges/mavlink/parameter_client.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::ParameterClient;
using bridges::mavlink::ParameterEncoding;
using bridges::mavlink::ParameterType;
using mavros_msgs::ParamGet;
using mavros_msgs::ParamPull;
using mavros_msgs::ParamPush;
using mavros_msgs::ParamSet;
using VehicleParameter = bridges::mavlink::Parameter;

/// Of the types that are whole numbers of up to 32 bits; unknown types are not among them.
bool is_whole(ParameterType type) {
  return type >= ParameterType::kUint8 && type <= ParameterType::kInt32;
}

mavros_msgs::ParamValue value_of(const VehicleParameter& parameter) {
  mavros_msgs::ParamValue value;
  if (is_whole(parameter.type)) {
    value.integer = to_whole<std::int32_t>(parameter.value);
  } else {
    value.real = parameter.value;
  }
  return value;
}

double number_of(const mavros_msgs::ParamValue& value) {
  return value.integer != 0 ? static_cast<double>(value.integer) : value.real;
}

/// A parameter as the parameter server has it.
XmlRpc::XmlRpcValue to_xml(const VehicleParameter& parameter) {
  if (!is_whole(parameter.type)) return XmlRpc::XmlRpcValue(parameter.value);
  return XmlRpc::XmlRpcValue(to_whole<std::int32_t>(parameter.value));
}

std::optional<double> from_xml(XmlRpc::XmlRpcValue& value) {
  if (value.getType() == XmlRpc::XmlRpcValue::TypeInt) return static_cast<int&>(value);
  if (value.getType() == XmlRpc::XmlRpcValue::TypeDouble) return static_cast<double&>(value);
  return std::nullopt;
}

/// Parameters of the vehicle, and their copy on the parameter server below ~param.
class ParamPlugin : public Plugin {
 public:
  explicit ParamPlugin(Hub& hub) : hub_(hub), vehicle_(hub.vehicle) {
    values_ = hub.ros.advertise<mavros_msgs::Param>("param/param_value");
    vehicle_.on(MAVLINK_MSG_ID_PARAM_VALUE, [this](const Message& message) { on_value(message); });
    vehicle_.on_connection([this](bool is_there) {
      if (is_there) begin();
    });
    vehicle_.on_tick([this](SimTime now) {
      if (client_) client_->update(now);
      end_silent_gets(now);
    });
    serve();
  }

 private:
  using Done = std::function<void(bool)>;
  struct Get {
    std::string name;
    SimTime asked;
    WaitingServices::Reply<ParamGet> reply;
  };
  static constexpr double kGetPatience_s = 2.0;

  void serve() {
    hub_.ros.serve_waiting<ParamPull>("param/pull", [this](const auto& request, auto reply) {
      const auto answer = [this, reply](bool is_good) {
        ParamPull::Response response;
        response.success = is_good;
        response.param_received =
            client_ ? static_cast<std::uint32_t>(client_->parameters().size()) : 0U;
        reply(response);
      };
      if (is_whole_ && request.force_pull == 0U) return answer(true);
      pull(answer);
    });
    hub_.ros.serve_waiting<ParamPush>("param/push",
                                      [this](const auto&, auto reply) { push(reply); });
    hub_.ros.serve_waiting<ParamGet>(
        "param/get", [this](const auto& request, auto reply) { get(request.param_id, reply); });
    hub_.ros.serve_waiting<ParamSet>("param/set", [this](const auto& request, auto reply) {
      set(request.param_id, number_of(request.value), reply);
    });
  }

  void begin() {
    const auto encoding =
        vehicle_.is_px4() ? ParameterEncoding::kBytewise : ParameterEncoding::kCast;
    if (client_) client_->cancel("the vehicle has begun again");
    client_ = std::make_unique<ParameterClient>(
        vehicle_.self(), vehicle_.target(),
        [this](const Message& message) { vehicle_.send(message); }, encoding);
    is_whole_ = false;
    pull([](bool) {});
  }

  void pull(Done done) {
    if (!client_) return done(false);
    pulls_.push_back(std::move(done));
    if (pulls_.size() > 1) return;
    client_->fetch(vehicle_.now(), [this](bool is_good, const std::string& reason) {
      is_whole_ = is_good;
      if (is_good) copy_to_server();
      if (!is_good) refuse("parameters not read: " + reason);
      ROS_INFO_COND(is_good, "PR: %zu parameters", client_->parameters().size());
      for (const Done& waiting : std::exchange(pulls_, {})) waiting(is_good);
    });
  }

  void copy_to_server() {
    XmlRpc::XmlRpcValue all;
    for (const auto& [name, parameter] : client_->parameters()) all[name] = to_xml(parameter);
    hub_.ros.node().setParam("param", all);
  }

  void on_value(const Message& message) {
    if (!client_ || !client_->handle(message, vehicle_.now())) return;
    const auto payload = bridges::mavlink::unpack<mavlink_param_value_t>(message);
    const std::string name = text_of(payload.param_id);
    const auto found = client_->parameters().find(name);
    if (found == client_->parameters().end()) return;
    mavros_msgs::Param param;
    param.header.stamp = ros::Time::now();
    param.param_id = name;
    param.value = value_of(found->second);
    param.param_index = payload.param_index;
    param.param_count = payload.param_count;
    values_->publish(param);
    answer_gets(found->second);
  }

  void get(const std::string& name, const WaitingServices::Reply<ParamGet>& reply) {
    if (!client_) return reply(ParamGet::Response());
    const auto known = client_->parameters().find(name);
    gets_.push_back({name, vehicle_.now(), reply});
    if (known != client_->parameters().end()) return answer_gets(known->second);
    mavlink_param_request_read_t payload{};
    payload.param_index = -1;
    name.copy(payload.param_id, sizeof(payload.param_id));
    send_to_target(vehicle_, payload);
  }

  void answer_gets(const VehicleParameter& parameter) {
    for (const Get& one : std::exchange(gets_, {})) {
      if (one.name != parameter.name) {
        gets_.push_back(one);
        continue;
      }
      ParamGet::Response response;
      response.success = 1U;
      response.value = value_of(parameter);
      one.reply(response);
    }
  }

  void end_silent_gets(SimTime now) {
    while (!gets_.empty() && (now - gets_.front().asked).seconds() > kGetPatience_s) {
      refuse("parameter " + gets_.front().name + " is unknown to the vehicle");
      gets_.front().reply(ParamGet::Response());
      gets_.pop_front();
    }
  }

  void set(const std::string& name, double value, const WaitingServices::Reply<ParamSet>& reply) {
    if (!client_) return reply(ParamSet::Response());
    client_->set(name, value, vehicle_.now(),
                 [this, name, reply](bool is_good, const std::string& reason) {
                   ParamSet::Response response;
                   response.success = is_good;
                   const auto known = client_->parameters().find(name);
                   if (known != client_->parameters().end()) {
                     response.value = value_of(known->second);
                     hub_.ros.node().setParam("param/" + name, to_xml(known->second));
                   }
                   if (!is_good) refuse("parameter " + name + " not set: " + reason);
                   reply(response);
                 });
  }

  /// Of a parameter that the vehicle has, with another value.
  std::optional<double> changed_value(const std::string& name, XmlRpc::XmlRpcValue& xml) const {
    const auto known = client_->parameters().find(name);
    const auto value = from_xml(xml);
    constexpr double kSame = 1e-6;
    if (known == client_->parameters().end() || !value) return std::nullopt;
    const double change = std::abs(known->second.value - *value);
    const bool is_changed = change > kSame * std::max(1.0, std::abs(*value));
    return is_changed ? value : std::nullopt;
  }

  void push(const WaitingServices::Reply<ParamPush>& reply) {
    XmlRpc::XmlRpcValue all;
    ParamPush::Response response;
    if (!client_ || !hub_.ros.node().getParam("param", all) ||
        all.getType() != XmlRpc::XmlRpcValue::TypeStruct) {
      return reply(response);
    }
    auto changed = std::make_shared<std::deque<std::pair<std::string, double>>>();
    for (auto& [name, xml] : all) {
      if (const auto value = changed_value(name, xml)) changed->emplace_back(name, *value);
    }
    response.success = 1U;
    push_next(changed, response, reply);
  }

  void push_next(const std::shared_ptr<std::deque<std::pair<std::string, double>>>& changed,
                 ParamPush::Response response, const WaitingServices::Reply<ParamPush>& reply) {
    if (changed->empty()) return reply(response);
    const auto [name, value] = changed->front();
    changed->pop_front();
    client_->set(name, value, vehicle_.now(),
                 [this, changed, response, reply](bool is_good, const std::string& reason) mutable {
                   response.param_transfered += is_good ? 1U : 0U;
                   if (!is_good) {
                     response.success = 0U;
                     refuse(reason);
                   }
                   push_next(changed, response, reply);
                 });
  }

  void refuse(const std::string& text) { hub_.ros.refuse("parameters refused", text); }

  Hub& hub_;
  VehicleSide& vehicle_;
  std::unique_ptr<bridges::NodePublisher<mavros_msgs::Param>> values_;
  std::unique_ptr<ParameterClient> client_;
  bool is_whole_ = false;
  std::vector<Done> pulls_;
  std::deque<Get> gets_;
};

}  // namespace

std::unique_ptr<Plugin> make_param(Hub& hub) { return std::make_unique<ParamPlugin>(hub); }

}  // namespace trident::mavros
