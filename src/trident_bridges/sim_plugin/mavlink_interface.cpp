// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "mavlink_interface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "trident_base/error.h"
#include "trident_base/is_one_of.h"
#include "trident_sim/topic_names.h"

namespace trident::bridges {
namespace {

constexpr const char* kControlTypes[] = {"velocity", "position", "position_gztopic",
                                         "position_kinematic"};
constexpr double kGaussPerTesla = 1e4;
constexpr double kAirDensity = 1.225;  ///< [kg/m^3] at the sea, standard atmosphere

/// Geopotential altitude [m] of a static pressure in the standard atmosphere's troposphere (U.S.
/// Standard Atmosphere 1976, equation 33a, solved for the altitude).
double pressure_altitude_m(double pressure_pa) {
  return 288.15 / 0.0065 * (1.0 - std::pow(pressure_pa / 101325.0, 1.0 / 5.255876));
}

sim::DriveSpec read_drive(const sim::PluginParams& params, const std::string& type) {
  const sim::Limits any{-1e12, 1e12}, not_negative{0.0, 1e12};
  const sim::PluginParams pid = params.below("joint_control_pid");
  sim::DriveSpec spec;
  spec.mode = type == "velocity" ? sim::DriveMode::kVelocity : sim::DriveMode::kPosition;
  spec.gains.p = pid.number("p", 0.0, any);
  spec.gains.i = pid.number("i", 0.0, any);
  spec.gains.d = pid.number("d", 0.0, any);
  spec.gains.integral_limit = pid.number("iMax", 0.0, not_negative);
  spec.gains.output_limit = pid.number("cmdMax", 1e12, not_negative);
  for (const char* mirrored : {"iMin", "cmdMin"}) pid.number(mirrored, 0.0, any);
  return spec;
}

}  // namespace

std::string MavlinkInterface::topic_of(const sim::PluginContext& context, const char* element,
                                       const char* fallback) {
  return sim::vehicle_topic(context, context.params.text(element, fallback));
}

MavlinkInterface::MavlinkInterface(const sim::PluginContext& context)
    : SitlPeer(context, "PX4"),
      world_(context.world),
      body_(context.world, body_link(context)),
      outputs_(context,
               topic_of(context, "motorSpeedCommandPubTopic", "/gazebo/command/motor_speed")),
      imu_(world_, topic_of(context, "imuSubTopic", "/imu")),
      magnetometer_(world_, topic_of(context, "magSubTopic", "/mag")),
      barometer_(world_, topic_of(context, "baroSubTopic", "/baro")),
      gps_(world_, topic_of(context, "gpsSubTopic", "/gps")),
      gps_velocity_(world_, topic_of(context, "gpsSubTopic", "/gps") + "_velocity"),
      airspeed_(world_, topic_of(context, "airspeedSubTopic", "/airspeed")),
      sensor_clock_(context.params.number("imu_rate", 250.0, {1.0, 1e5})),
      state_clock_(context.params.number("state_rate", 50.0, {0.1, 1e5})),
      link_(context.params.flag("enable_lockstep", true), 1.0 / sensor_clock_.rate_hz(),
            [this](mavlink::Bytes bytes) { send(bytes); }) {
  const sim::PluginParams& params = context.params;
  refuse_other_modes(params);
  read_channels(context);
  const int port = params.integer("mavlink_tcp_port", 4560, {1.0, 65535.0});
  open(params, "mavlink_tcp_port",
       "tcp-l://" + read_address(params, "mavlink_addr") + ":" + std::to_string(port));
}

/// What PX4's plugin can do besides, and what it reads for other programs.
void MavlinkInterface::refuse_other_modes(const sim::PluginParams& params) const {
  for (const char* off : {"hil_mode", "serialEnabled"}) {
    if (params.flag(off, false)) params.refuse(off, "true", "false: PX4 runs as a program");
  }
  if (!params.flag("use_tcp", true)) params.refuse("use_tcp", "false", "true: TCP alone");
  for (const char* unused :
       {"mavlink_udp_port", "qgc_addr", "qgc_udp_port", "sdk_addr", "sdk_udp_port", "serialDevice",
        "baudRate", "hil_state_level", "send_vision_estimation", "send_odometry",
        "opticalFlowTopic", "lidarSubTopic", "visionSubTopic", "vehicle_is_tailsitter",
        "enable_gimbal", "protocol_version", "gst_udp_port", "video_uri", "use_left_elevon_pid"}) {
    params.node(unused);
  }
}

void MavlinkInterface::read_channels(const sim::PluginContext& context) {
  const sim::ParamNode* const list = context.params.node("control_channels");
  if (list == nullptr) {
    context.params.refuse("control_channels", "", "an element with <channel> elements");
  }
  for (const sim::ParamNode& node : list->children) {
    if (node.name == "channel") read_channel(context, node, channels_.size());
  }
}

void MavlinkInterface::read_channel(const sim::PluginContext& context, const sim::ParamNode& node,
                                    std::size_t number) {
  Channel channel;
  channel.name = "channel " + std::to_string(number);
  for (const auto& [key, value] : node.attributes) {
    if (key == "name") channel.name = "channel '" + value + "'";
  }
  const sim::PluginParams params(node, context.params.owner() + " " + channel.name);
  const sim::Limits any{-1e6, 1e6};
  channel.input_index = static_cast<std::size_t>(
      params.integer("input_index", static_cast<int>(number), {0.0, 15.0}));
  channel.offset = params.number("input_offset", 0.0, any);
  channel.scaling = params.number("input_scaling", 1.0, any);
  channel.zero_disarmed = params.number("zero_position_disarmed", 0.0, any);
  channel.zero_armed = params.number("zero_position_armed", 0.0, any);
  params.text("gztopic", "");
  add_target(context, params, number);
  channels_.push_back(channel);
  report_unread(world_, params);
}

/// PX4's own models name joints of other vehicles: those have no effect.
void MavlinkInterface::add_target(const sim::PluginContext& context,
                                  const sim::PluginParams& params, std::size_t number) {
  const std::string type = params.text("joint_control_type", "velocity");
  if (!is_one_of(type, kControlTypes)) {
    params.refuse("joint_control_type", type,
                  "velocity, position, position_gztopic or position_kinematic");
  }
  const sim::DriveSpec drive = read_drive(params, type);
  const std::string name = params.text("joint_name", "");
  sim::Joint* const joint = name.empty() ? nullptr : find_joint(*context.model, name);
  if (name.empty() || is_rotor(joint)) return outputs_.add_motor(number);
  if (can_move(joint)) return outputs_.add_joint(*joint, drive);
  world_.report(sim::Severity::kWarning, params.owner() + ": <joint_name> is '" + name +
                                             "', expected a joint of the model that can move: " +
                                             joint_names(*context.model, can_move) +
                                             "; the channel has no effect");
  outputs_.add_nothing();
}

void MavlinkInterface::pre_step(sim::Phase, sim::World&, const sim::StepInfo& info) {
  listen();
  wait_in_step();
  apply_controls(info);
}

/// Before the sensors of this step measure: one that nobody listens to does not.
void MavlinkInterface::listen() {
  imu_.is_there();
  magnetometer_.is_there();
  barometer_.is_there();
  gps_.is_there();
  gps_velocity_.is_there();
  airspeed_.is_there();
}

void MavlinkInterface::apply_controls(const sim::StepInfo& info) {
  const sitl::HilControls& controls = link_.controls();
  if (controls.count == applied_) return;
  applied_ = controls.count;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    const double input = static_cast<double>(controls.values[channel.input_index]);
    const double target = controls.is_armed
                              ? (input + channel.offset) * channel.scaling + channel.zero_armed
                              : channel.zero_disarmed;
    outputs_.set(i, target, channel.name);
  }
  outputs_.flush(info.end);
}

void MavlinkInterface::post_step(const sim::World&, const sim::StepInfo& info) { step_ = info; }

void MavlinkInterface::send_sensors() {
  if (step_.step == 0) return;
  if (!sensor_clock_.is_due(step_)) return;
  if (state_clock_.is_due(step_)) send_state();
  send_gps();
  const sim::ImuSample* const imu = imu_.newest();
  if (imu == nullptr) {
    world_.diagnose({sim::Severity::kError,
                     who(),
                     "no IMU",
                     "<imuSubTopic> is '" + imu_.name() +
                         "', expected the topic of an IMU of the model; PX4 gets no sensors",
                     {}});
    return;
  }
  sensor_.a_frd = flu_to_frd(imu->a_imu);
  sensor_.w_frd = flu_to_frd(imu->w_imu);
  sensor_.fields = sitl::HilSensor::kAccelerometer | sitl::HilSensor::kGyroscope;
  add_slow_sensors(&sensor_);
  link_.send_sensor(step_.end, sensor_, wall_s());
}

void MavlinkInterface::add_slow_sensors(sitl::HilSensor* sensor) {
  if (const auto* field = magnetometer_.take()) {
    sensor->magnetic_frd_gauss = flu_to_frd(field->field_t) * kGaussPerTesla;
    sensor->fields |= sitl::HilSensor::kMagnetometer;
  }
  if (const auto* pressure = barometer_.take()) {
    sensor->pressure_hpa = pressure->pressure_pa / 100.0;
    sensor->pressure_altitude_m = pressure_altitude_m(pressure->pressure_pa);
    sensor->temperature_c = 15.0 - 0.0065 * sensor->pressure_altitude_m;
    sensor->fields |= sitl::HilSensor::kBarometer;
  }
  if (const auto* speed = airspeed_.take()) {
    const double v = speed->value;
    sensor->differential_pressure_hpa = 0.5 * kAirDensity * v * std::abs(v) / 100.0;
    sensor->fields |= sitl::HilSensor::kDifferentialPressure;
  }
}

void MavlinkInterface::send_gps() {
  const sim::GnssFixSample* const fix = gps_.take();
  if (fix == nullptr) return;
  sitl::HilGps gps;
  gps.latitude_deg = fix->latitude_deg;
  gps.longitude_deg = fix->longitude_deg;
  gps.altitude_m = fix->altitude_m;
  if (const auto* velocity = gps_velocity_.newest()) gps.v_ned = enu_to_ned(velocity->v);
  if (fix->covariance_enu[0] > 0.0) gps.horizontal_error_m = std::sqrt(fix->covariance_enu[0]);
  if (fix->covariance_enu[8] > 0.0) gps.vertical_error_m = std::sqrt(fix->covariance_enu[8]);
  link_.send_gps(fix->stamp, gps);
}

void MavlinkInterface::send_state() {
  sitl::HilState state;
  const Eigen::Vector3d place = body_.place();
  state.R_ned_frd = body_.R_ned_frd();
  state.w_frd = body_.w_frd();
  state.latitude_deg = place.x();
  state.longitude_deg = place.y();
  state.altitude_m = place.z();
  state.v_ned = body_.v_ned();
  if (const auto* speed = airspeed_.newest()) state.airspeed_m_s = std::max(0.0, speed->value);
  state.a_frd = body_.a_frd(step_.dt_s);
  link_.send_state(step_.end, state);
}

std::string MavlinkInterface::awaited() const {
  if (!link_.is_connected()) {
    return link_.was_connected() ? "has not connected again" : "has not connected";
  }
  char text[80];
  std::snprintf(text, sizeof(text), "has not answered HIL_SENSOR of t = %.4f s",
                link_.asked().seconds());
  return text;
}

void MavlinkInterface::reset() {
  outputs_.reset();
  applied_ = link_.controls().count;
  sensor_ = {};
  step_ = {};
  magnetometer_.reset();
  barometer_.reset();
  gps_.reset();
  airspeed_.reset();
}

void MavlinkInterface::state(sim::StateArchive& archive) {
  outputs_.state(archive);
  magnetometer_.state(archive);
  barometer_.state(archive);
  gps_.state(archive);
  airspeed_.state(archive);
  archive(sensor_, step_);
}

}  // namespace trident::bridges
