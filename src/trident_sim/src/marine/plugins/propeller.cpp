// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string>

#include "core/plugins/joint_states.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// libtrident_propeller.so: what is seen of a thruster of libtrident_vessel.so. It turns the joint
/// <jointName>, whose child is a picture without a body of its own, by the thrust T of <thruster>:
/// at <maxRate> sqrt(T / <maxThrust>), and publishes its angle on <robotNamespace>/joint_states.
class Propeller : public Plugin {
 public:
  explicit Propeller(const PluginContext& context)
      : joint_(required_joint(context, "jointName")),
        topic_(scoped_topic(context.params,
                            "thrusters/" + context.params.required_text("thruster") + "_thrust")),
        rate_(context.params.number("maxRate", 100.0, {0.0, 1e4})),
        thrust_n_(context.params.number("maxThrust", 100.0, {1e-3, 1e7})),
        clock_(context.params.number("updateRate", 50.0, {0.0, 1e4})),
        states_(context, scoped_topic(context.params, "joint_states"), {&joint_}) {}

  /// It asks for the thrust before the vessel's first step, so that nothing depends on who else
  /// listens.
  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo&) override {
    auto* const thrust = world.ports().find_out<ScalarSample>(topic_);
    if (thrust == nullptr) return;
    if (thrust != asked_) thrust->add_listener();
    asked_ = thrust;
    const double part = thrust->value.value / thrust_n_;
    joint_.set_velocity(std::copysign(rate_ * std::sqrt(std::abs(part)), part));
  }

  void post_step(const World& world, const StepInfo& info) override {
    if (clock_.is_due(info)) states_.publish(world, info.end);
  }

 private:
  Joint& joint_;
  std::string topic_;
  double rate_, thrust_n_;
  SampleClock clock_;
  JointStates states_;
  const OutPort<ScalarSample>* asked_ = nullptr;  ///< to be compared only
};

std::string propeller_joint(const PluginParams& params) { return params.text("jointName", ""); }

const PluginRegistrar kTridentPropeller(
    "libtrident_propeller.so", factory_of<Propeller>(propeller_joint),
    PluginExample{"<jointName>rotor_1_joint</jointName><thruster>left</thruster>",
                  {"jointName", "thruster"},
                  {"maxRate", "maxThrust", "updateRate"}});

}  // namespace

}  // namespace trident::sim
