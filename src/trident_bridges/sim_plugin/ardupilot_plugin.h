// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "control_outputs.h"
#include "port_reader.h"
#include "sitl_peer.h"
#include "trident_bridges/sitl/ardupilot_link.h"
#include "vehicle_state.h"

namespace trident::bridges {

/// libArduPilotPlugin.so: ArduPilot flies the model by its JSON interface on UDP <fdm_port_in>.
/// Each <control channel="N"> turns a servo output into a rotor's speed or a joint's target.
class ArduPilotPlugin : public sim::Plugin, public SitlPeer {
 public:
  /// Throws Error for a parameter out of range, an unknown joint, or a port that is in use.
  explicit ArduPilotPlugin(const sim::PluginContext& context);

  std::vector<sim::Phase> phases() const override {
    return {sim::Phase::kControl, sim::Phase::kPost};
  }
  void pre_step(sim::Phase phase, sim::World& world, const sim::StepInfo& info) override;
  void post_step(const sim::World& world, const sim::StepInfo& info) override;
  void reset() override;
  void state(sim::StateArchive& archive) override;

  void send_sensors() override;
  bool is_awaited() const override { return is_frame_begun_ && link_.is_awaited(); }
  std::string awaited() const override;
  bool is_gone() const override { return link_.is_gone(); }
  bool runs_free() const override { return link_.runs_free(); }
  void give_up() override { link_.give_up(); }

 protected:
  void left() override { link_.disconnected(); }
  void received(Span<const std::uint8_t> bytes) override;

 private:
  /// How a servo output becomes a target.
  struct Channel {
    std::string name;       ///< of the element, for reports
    std::size_t servo = 0;  ///< index of the output
    double multiplier = 1.0, offset = 0.0;
    double servo_min = 1000.0, servo_max = 2000.0;  ///< [us]
  };

  void read_control(const sim::PluginContext& context, const sim::ParamNode& node);
  void add_target(const sim::PluginContext& context, const sim::PluginParams& params,
                  Channel* channel);
  void read_frames(const sim::PluginParams& params);
  void apply_servos(const sim::StepInfo& info);
  sitl::JsonState measure();

  sim::World& world_;
  VehicleState body_;
  ControlOutputs outputs_;
  std::vector<Channel> channels_;
  PortReader<sim::ScalarSample> airspeed_;
  sitl::ArduPilotLink link_;
  sim::StepInfo step_;          ///< the one that has just been made
  bool is_frame_begun_ = true;  ///< the next step begins with a packet of ArduPilot
  std::uint64_t applied_ = 0;   ///< ArduPilotLink::packets() of what the outputs have
};

}  // namespace trident::bridges
