// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "core/plugins/plugin_util.h"
#include "trident_sim/commands.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "trident_sim/samples/battery_sample.h"
#include "vehicles/battery/battery_cells.h"

namespace trident::sim {
namespace {

BatteryParams read_cells(const PluginParams& params) {
  BatteryParams cells;
  cells.capacity_ah = params.number("capacity", cells.capacity_ah, {1e-6, 1e6});
  cells.cells = params.integer("cells", cells.cells, {1, 1000});
  cells.resistance_ohm = params.number("resistance", cells.resistance_ohm, {0.0, 1e3});
  return cells;
}

std::vector<std::string> listed_thrusters(const PluginParams& params) {
  std::string list = params.text("thruster", "");
  for (char& c : list) c = c == ',' ? ' ' : c;
  std::istringstream names(list);
  std::vector<std::string> thrusters;
  for (std::string name; names >> name;) {
    thrusters.push_back(scoped_topic(params, "thrusters/" + name + "_thrust"));
  }
  return thrusters;
}

/// libtrident_battery.so: the battery of a vehicle. It gives <idlePower>, and to each joint of
/// <jointName> (rotors, wheels) <jointPower> |<speedFactor> w|^<jointExponent>, w its rate [rad/s]:
/// the cube for rotors (1 would be a wheel against friction), where <speedFactor> is the rotors'
/// rotorVelocitySlowdownSim; to each thruster of <thruster> <thrusterPower>
/// (|T| / <maxThrust>)^1.5, T its thrust [N]. Its state is on <topic> <updateRate> times a second;
/// a number on <topic>/set_charge (0 to 1) is another battery.
class Battery : public Plugin {
 public:
  explicit Battery(const PluginContext& context)
      : params_(read_cells(context.params)),
        cells_(params_),
        initial_share_(context.params.number("charge", 1.0, {0.0, 1.0})),
        idle_w_(context.params.number("idlePower", 5.0, {0.0, 1e6})),
        thrusters_(listed_thrusters(context.params)),
        clock_(context.params.number("updateRate", 5.0, {0.0, 1e4})),
        owner_(context.params.owner()) {
    read_loads(context);
    const std::string topic = scoped_topic(context.params, context.params.text("topic", "battery"));
    state_ = advertise<BatterySample>(context, topic, PortRank::kState);
    set_charge_ = subscribe<SingleNumber>(context, topic + "/set_charge");
    cells_.set_charge_share(initial_share_);
  }

  /// Loads are those at the step's begin; it asks for thrusts before a vessel's first step, so that
  /// nothing depends on who else listens.
  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    read_charge(world);
    const bool was_empty = cells_.is_empty();
    cells_.draw(power_w(world), info.dt_s);
    if (cells_.is_empty() && !was_empty) world.report(Severity::kWarning, owner_ + ": is empty");
  }

  void post_step(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info) || !state_->wanted()) return;
    BatterySample& sample = state_->value;
    sample.stamp = info.end;
    sample.voltage_v = cells_.voltage_v();
    sample.current_a = cells_.current_a();
    sample.capacity_ah = params_.capacity_ah;
    sample.charge_share = cells_.charge_share();
    sample.charge_ah = sample.charge_share * sample.capacity_ah;
    sample.cell_voltages.assign(static_cast<std::size_t>(params_.cells),
                                static_cast<float>(cells_.voltage_v() / params_.cells));
    state_->publish();
  }

  void reset() override {
    cells_ = BatteryCells(params_);
    cells_.set_charge_share(initial_share_);
    set_charge_->clear();
    charges_read_ = 0;
  }
  void state(StateArchive& archive) override {
    cells_.state(archive);
    archive(charges_read_);
  }

 private:
  void read_loads(const PluginContext& context) {
    const PluginParams& params = context.params;
    if (params.has("jointName")) joints_ = listed_joints(context);
    joint_w_ = params.number("jointPower", 0.0, {0.0, 1e9});
    joint_exponent_ = params.number("jointExponent", 3.0, {0.0, 4.0});
    speed_factor_ = params.number("speedFactor", 1.0, {1e-6, 1e6});
    thruster_w_ = params.number("thrusterPower", 0.0, {0.0, 1e9});
    max_thrust_n_ = params.number("maxThrust", 100.0, {1e-3, 1e7});
  }

  void read_charge(World& world) {
    if (set_charge_->count() == charges_read_) return;
    charges_read_ = set_charge_->count();
    const double share = set_charge_->at(charges_read_ - 1).value;
    if (share >= 0.0 && share <= 1.0) {
      cells_.set_charge_share(share);
      return;
    }
    world.report(Severity::kError,
                 owner_ + ": a charge of " + std::to_string(share) + " is refused, must be 0 to 1");
  }

  double power_w(World& world) {
    double power = idle_w_;
    for (const Joint* const joint : joints_) {
      const double rate = joint->is_rotor ? joint->rotor_velocity : joint->velocity();
      power += joint_w_ * std::pow(std::abs(speed_factor_ * rate), joint_exponent_);
    }
    asked_.resize(thrusters_.size(), nullptr);
    for (std::size_t i = 0; i < thrusters_.size(); ++i) {
      // Found by name in each step: the port is the thruster's and may be gone, or be another one.
      auto* const thrust = world.ports().find_out<ScalarSample>(thrusters_[i]);
      if (thrust == nullptr) continue;
      if (thrust != asked_[i]) thrust->add_listener();
      asked_[i] = thrust;
      // Momentum theory of an actuator disk: ideal power grows with the thrust to the power of 3/2.
      power += thruster_w_ * std::pow(std::abs(thrust->value.value) / max_thrust_n_, 1.5);
    }
    return power;
  }

  BatteryParams params_;
  BatteryCells cells_;
  double initial_share_, idle_w_;
  double joint_w_ = 0.0, joint_exponent_ = 3.0, speed_factor_ = 1.0;
  double thruster_w_ = 0.0, max_thrust_n_ = 100.0;
  std::vector<Joint*> joints_;
  std::vector<std::string> thrusters_;
  std::vector<const OutPort<ScalarSample>*> asked_;  ///< to be compared only
  SampleClock clock_;
  std::string owner_;
  OutHandle<BatterySample> state_;
  InHandle<SingleNumber> set_charge_;
  std::uint64_t charges_read_ = 0;
};

const PluginRegistrar kTridentBattery(
    "libtrident_battery.so", factory_of<Battery>(),
    PluginExample{"<jointName>rotor_1_joint</jointName><jointPower>1e-7</jointPower>"
                  "<capacity>5</capacity><updateRate>0</updateRate>",
                  {},
                  {"capacity", "cells", "resistance", "charge", "idlePower", "jointPower",
                   "jointExponent", "speedFactor", "thrusterPower", "maxThrust", "updateRate"}});

}  // namespace

}  // namespace trident::sim
