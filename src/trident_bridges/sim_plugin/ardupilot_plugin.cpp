// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ardupilot_plugin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/is_one_of.h"
#include "trident_sim/sample_clock.h"
#include "trident_sim/topic_names.h"

namespace trident::bridges {
namespace {

constexpr const char* kTargetTypes[] = {"VELOCITY", "POSITION", "EFFORT", "COMMAND"};

bool is_in_degrees(const sim::ParamNode& node) {
  return std::any_of(node.attributes.begin(), node.attributes.end(), [](const auto& pair) {
    return pair.first == "degrees" && pair.second == "true";
  });
}

/// Of ArduPilot's servo outputs.
bool is_channel(const std::string& number) {
  return !number.empty() && number.size() < 3 &&
         number.find_first_not_of("0123456789") == std::string::npos && std::stoul(number) <= 31;
}

bool is_target(const sim::Joint* joint) { return is_rotor(joint) || can_move(joint); }

/// The rotation of a pose "x y z roll pitch yaw", in degrees where the element says so.
std::optional<Eigen::Quaterniond> read_rotation(const sim::PluginParams& params, const char* key) {
  const sim::ParamNode* const node = params.node(key);
  if (node == nullptr) return std::nullopt;
  std::istringstream in(node->text);
  std::array<double, 6> numbers{};
  for (double& number : numbers) in >> number;
  std::string rest;
  if (in.fail() || in >> rest) {
    params.refuse(key, node->text, "six numbers: x y z roll pitch yaw");
  }
  const double unit = is_in_degrees(*node) ? kPi / 180.0 : 1.0;
  return SE3::from_xyz_rpy(Eigen::Vector3d::Zero(), unit * numbers[3], unit * numbers[4],
                           unit * numbers[5])
      .R;
}

sim::DriveSpec read_servo_drive(const sim::PluginParams& params, const std::string& type) {
  const sim::Limits any{-1e12, 1e12}, not_negative{0.0, 1e12};
  sim::DriveSpec spec;
  spec.mode = type == "VELOCITY" ? sim::DriveMode::kVelocity
              : type == "EFFORT" ? sim::DriveMode::kEffort
                                 : sim::DriveMode::kPosition;
  spec.gains.p = params.number("p_gain", 1.0, any);
  spec.gains.i = params.number("i_gain", 0.0, any);
  spec.gains.d = params.number("d_gain", 0.0, any);
  spec.gains.integral_limit = params.number("i_max", 0.0, not_negative);
  spec.gains.output_limit = params.number("cmd_max", 1e12, not_negative);
  return spec;
}

}  // namespace

ArduPilotPlugin::ArduPilotPlugin(const sim::PluginContext& context)
    : SitlPeer(context, "ArduPilot"),
      world_(context.world),
      body_(context.world, body_link(context)),
      outputs_(context,
               sim::vehicle_topic(context, context.params.text("motorSpeedCommandPubTopic",
                                                               "/gazebo/command/motor_speed"))),
      airspeed_(world_,
                sim::vehicle_topic(context, context.params.text("airspeedSubTopic", "/airspeed"))),
      link_(context.params.flag("lock_step", true),
            [this](Span<const std::uint8_t> block) { send(block); }) {
  const sim::PluginParams& params = context.params;
  read_frames(params);
  for (const char* unused : {"fdm_port_out", "connectionTimeoutMaxCount", "imuName",
                             "have_32_channels", "listen_addr"}) {
    params.node(unused);  // of datagrams to a fixed port, of a count of lost ones, of a sensor
  }
  for (int i = 1;; ++i) {
    const sim::ParamNode* const node = params.node("control[" + std::to_string(i) + "]");
    if (node == nullptr) break;
    read_control(context, *node);
  }
  if (channels_.empty()) params.refuse("control", "", "at least one");
  const int port = params.integer("fdm_port_in", 9002, {1.0, 65535.0});
  open(params, "fdm_port_in",
       "udp://" + read_address(params, "fdm_addr") + ":" + std::to_string(port) + "@");
}

void ArduPilotPlugin::read_frames(const sim::PluginParams& params) {
  if (const auto R_ned_world = read_rotation(params, "gazeboXYZToNED")) {
    body_.set_R_ned_world(*R_ned_world);
  }
  if (const auto R_frd_link = read_rotation(params, "modelXYZToAirplaneXForwardZDown")) {
    body_.set_R_link_frd(R_frd_link->conjugate());
  }
}

void ArduPilotPlugin::read_control(const sim::PluginContext& context, const sim::ParamNode& node) {
  Channel channel;
  std::string number = std::to_string(channels_.size());
  for (const auto& [key, value] : node.attributes) {
    if (key == "channel") number = value;
  }
  channel.name = "control channel '" + number + "'";
  const sim::PluginParams params(node, context.params.owner() + " " + channel.name);
  if (!is_channel(number)) {
    context.params.refuse("control channel", number, "an integer in [0, 31]");
  }
  channel.servo = std::stoul(number);
  const sim::Limits any{-1e6, 1e6}, microseconds{0.0, 65535.0};
  channel.multiplier = params.number("multiplier", 1.0, any);
  channel.offset = params.number("offset", 0.0, any);
  channel.servo_min = params.number("servo_min", 1000.0, microseconds);
  channel.servo_max = params.number("servo_max", 2000.0, microseconds);
  if (channel.servo_max <= channel.servo_min) {
    params.refuse("servo_max", params.text("servo_max", "2000"), "more than <servo_min>");
  }
  for (const char* unused : {"turningDirection", "useForce", "frequencyCutoff", "samplingRate",
                             "rotorVelocitySlowdownSim", "controlVelocitySlowdownSim", "i_min",
                             "cmd_min", "cmd_topic"}) {
    params.node(unused);
  }
  add_target(context, params, &channel);
  channels_.push_back(channel);
  report_unread(world_, params);
}

/// A rotor of a motor model takes the size of a speed: its own plugin has the direction of turning.
void ArduPilotPlugin::add_target(const sim::PluginContext& context, const sim::PluginParams& params,
                                 Channel* channel) {
  const std::string type = params.text("type", "VELOCITY");
  if (!is_one_of(type, kTargetTypes)) {
    params.refuse("type", type, "VELOCITY, POSITION, EFFORT or COMMAND");
  }
  const sim::DriveSpec drive = read_servo_drive(params, type);
  const std::string name = params.required_text("jointName");
  sim::Joint* const joint = find_joint(*context.model, name);
  if (is_rotor(joint)) {
    channel->multiplier = std::abs(channel->multiplier);
    outputs_.add_motor(static_cast<std::size_t>(
        params.integer("motorNumber", static_cast<int>(channel->servo), {0.0, 31.0})));
    return;
  }
  if (can_move(joint)) return outputs_.add_joint(*joint, drive);
  params.refuse("jointName", name,
                "a joint of the model that can move: " + joint_names(*context.model, is_target));
}

void ArduPilotPlugin::received(Span<const std::uint8_t> bytes) {
  try {
    link_.received(bytes);
  } catch (const Error& error) {
    world_.diagnose({sim::Severity::kError, who(), "servo packet refused", error.what(), {}});
  }
}

void ArduPilotPlugin::pre_step(sim::Phase, sim::World&, const sim::StepInfo& info) {
  wait_in_step();
  is_frame_begun_ = false;
  if (link_.packets() != applied_) apply_servos(info);
}

/// An output of 0 us says nothing: the channel keeps its last value.
void ArduPilotPlugin::apply_servos(const sim::StepInfo& info) {
  applied_ = link_.packets();
  const sitl::ServoPacket& packet = link_.servos();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    if (channel.servo >= packet.channels || packet.pwm[channel.servo] == 0) continue;
    const double part =
        (packet.pwm[channel.servo] - channel.servo_min) / (channel.servo_max - channel.servo_min);
    outputs_.set(i, channel.multiplier * (std::clamp(part, 0.0, 1.0) + channel.offset),
                 channel.name);
  }
  outputs_.flush(info.end);
}

void ArduPilotPlugin::post_step(const sim::World&, const sim::StepInfo& info) { step_ = info; }

/// ArduPilot asks for frames of 1/frame_rate: several steps where these are shorter.
void ArduPilotPlugin::send_sensors() {
  if (step_.step == 0) return;
  const double rate_hz = link_.servos().frame_rate_hz;
  if (!sim::SampleClock(rate_hz).is_due(step_)) return;
  if (rate_hz * step_.dt_s > 1.0 + 1e-9) {
    char text[120];
    std::snprintf(text, sizeof(text),
                  "frame_rate is %.0f Hz, legal: up to %.0f Hz with steps of %g s; each packet is "
                  "one step",
                  rate_hz, 1.0 / step_.dt_s, step_.dt_s);
    world_.diagnose({sim::Severity::kWarning, who(), "frame rate", text, {}});
  }
  link_.send_state(measure());
  is_frame_begun_ = true;
}

sitl::JsonState ArduPilotPlugin::measure() {
  sitl::JsonState state;
  state.stamp = step_.end;
  state.w_frd = body_.w_frd();
  state.a_frd = body_.a_frd(step_.dt_s);
  state.p_ned = body_.p_ned();
  state.v_ned = body_.v_ned();
  state.R_ned_frd = body_.R_ned_frd();
  if (const auto* speed = airspeed_.newest()) state.airspeed_m_s = speed->value;
  return state;
}

std::string ArduPilotPlugin::awaited() const {
  if (!link_.has_joined()) return "has not sent a servo packet";
  char text[80];
  std::snprintf(text, sizeof(text), "has not answered the state of t = %.4f s",
                link_.answered().seconds());
  return text;
}

void ArduPilotPlugin::reset() {
  outputs_.reset();
  step_ = {};
  is_frame_begun_ = true;
}

void ArduPilotPlugin::state(sim::StateArchive& archive) {
  outputs_.state(archive);
  archive(step_, is_frame_begun_);
}

}  // namespace trident::bridges
