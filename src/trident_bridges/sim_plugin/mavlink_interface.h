// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "control_outputs.h"
#include "port_reader.h"
#include "sitl_peer.h"
#include "trident_bridges/sitl/px4_link.h"
#include "trident_sim/sample_clock.h"
#include "vehicle_state.h"

namespace trident::bridges {

/// libgazebo_mavlink_interface.so: PX4 flies the model by its simulator API. It listens on TCP
/// <mavlink_tcp_port>; sensors are those of the topics <imuSubTopic>, <magSubTopic>,
/// <baroSubTopic>, <gpsSubTopic> and <airspeedSubTopic> below the vehicle; <control_channels> act
/// on motors and joints.
class MavlinkInterface : public sim::Plugin, public SitlPeer {
 public:
  /// Throws Error for a parameter out of range, or a port that is in use.
  explicit MavlinkInterface(const sim::PluginContext& context);

  std::vector<sim::Phase> phases() const override {
    return {sim::Phase::kControl, sim::Phase::kPost};
  }
  void pre_step(sim::Phase phase, sim::World& world, const sim::StepInfo& info) override;
  void post_step(const sim::World& world, const sim::StepInfo& info) override;
  void reset() override;
  void state(sim::StateArchive& archive) override;

  void send_sensors() override;
  bool is_awaited() const override { return link_.is_awaited(wall_s()); }
  std::string awaited() const override;
  bool is_gone() const override { return link_.was_connected() && !link_.is_connected(); }
  bool runs_free() const override { return link_.runs_free(); }
  void give_up() override { link_.give_up(); }

 protected:
  void joined() override { link_.connected(); }
  void left() override { link_.disconnected(); }
  void received(Span<const std::uint8_t> bytes) override { link_.received(bytes); }

 private:
  /// How a value of a channel becomes a target.
  struct Channel {
    std::string name;             ///< of the element, for reports
    std::size_t input_index = 0;  ///< in HIL_ACTUATOR_CONTROLS.controls
    double offset = 0.0, scaling = 0.0;
    double zero_disarmed = 0.0, zero_armed = 0.0;
  };

  static std::string topic_of(const sim::PluginContext& context, const char* element,
                              const char* fallback);
  void read_channels(const sim::PluginContext& context);
  void read_channel(const sim::PluginContext& context, const sim::ParamNode& node,
                    std::size_t number);
  void add_target(const sim::PluginContext& context, const sim::PluginParams& params,
                  std::size_t number);
  void refuse_other_modes(const sim::PluginParams& params) const;
  void listen();
  void apply_controls(const sim::StepInfo& info);
  void add_slow_sensors(sitl::HilSensor* sensor);
  void send_gps();
  void send_state();

  sim::World& world_;
  VehicleState body_;
  ControlOutputs outputs_;
  std::vector<Channel> channels_;
  PortReader<sim::ImuSample> imu_;
  PortReader<sim::MagneticFieldSample> magnetometer_;
  PortReader<sim::FluidPressureSample> barometer_;
  PortReader<sim::GnssFixSample> gps_;
  PortReader<sim::TwistSample> gps_velocity_;
  PortReader<sim::ScalarSample> airspeed_;
  sim::SampleClock sensor_clock_, state_clock_;
  sitl::Px4Link link_;
  sitl::HilSensor sensor_;     ///< with the newest of the slow sensors
  sim::StepInfo step_;         ///< the one that has just been made
  std::uint64_t applied_ = 0;  ///< HilControls::count of what the outputs have
};

}  // namespace trident::bridges
