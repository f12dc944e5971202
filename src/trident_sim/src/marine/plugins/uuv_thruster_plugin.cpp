// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include "actuator_input.h"
#include "marine/vessel/uuv_thruster.h"
#include "trident_base/string_util.h"
#include "trident_sim/commands.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/samples/text_sample.h"
#include "trident_sim/thruster_setup.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

const Limits kAny{-1e12, 1e12}, kPositive{1e-12, 1e12}, kNotNegative{0.0, 1e12};

template <class Enum>
Enum read_type(const PluginParams& params) {
  const std::string text = params.required_text("type");
  std::string legal;
  for (const auto& item : enum_names(Enum{})) {
    if (text == item.name) return item.value;
    legal += (legal.empty() ? "" : ", ") + std::string(item.name);
  }
  params.refuse("type", text, legal);
}

double required_number(const PluginParams& params, const char* key, const Limits& limits) {
  params.required_text(key);
  return params.number(key, 0.0, limits);
}

std::vector<double> required_numbers(const PluginParams& params, const char* key) {
  const std::string text = params.required_text(key);
  std::istringstream words(text);
  std::vector<double> numbers;
  double number = 0.0;
  while (words >> number) numbers.push_back(number);
  if (!words.eof() || numbers.size() < 2) params.refuse(key, text, "at least two numbers");
  return numbers;
}

void read_dynamics(const PluginParams& params, UuvThrusterParams* thruster) {
  // Yoerger, Cooke and Slotine 1990, and Bessa, Dutra and Kreuzer 2006, as uuv_simulator has them.
  thruster->dynamics = read_type<UuvDynamics>(params);
  switch (thruster->dynamics) {
    case UuvDynamics::kZeroOrder:
      break;
    case UuvDynamics::kFirstOrder:
      thruster->time_constant_s = required_number(params, "timeConstant", kPositive);
      break;
    case UuvDynamics::kYoerger:
      thruster->alpha = required_number(params, "alpha", kNotNegative);
      thruster->beta = required_number(params, "beta", kAny);
      break;
    case UuvDynamics::kBessa:
      thruster->Jmsp = required_number(params, "Jmsp", kPositive);
      thruster->Kv1 = required_number(params, "Kv1", kNotNegative);
      thruster->Kv2 = required_number(params, "Kv2", kNotNegative);
      thruster->Kt = required_number(params, "Kt", kAny);
      thruster->Rm = required_number(params, "Rm", kPositive);
      break;
  }
}

void check_conversion_table(const PluginParams& params, const UuvThrusterParams& thruster) {
  if (thruster.inputs.size() != thruster.outputs.size()) {
    params.refuse("outputValues", std::to_string(thruster.outputs.size()) + " numbers",
                  std::to_string(thruster.inputs.size()) + ", as <inputValues> has");
  }
  for (std::size_t i = 1; i < thruster.inputs.size(); ++i) {
    if (thruster.inputs[i] <= thruster.inputs[i - 1]) {
      params.refuse("inputValues", number_text(thruster.inputs[i]), "numbers that rise");
    }
  }
}

void read_conversion(const PluginParams& params, UuvThrusterParams* thruster) {
  thruster->conversion = read_type<UuvConversion>(params);
  switch (thruster->conversion) {
    case UuvConversion::kBasic:
      thruster->rotor_constant = required_number(params, "rotorConstant", kAny);
      break;
    case UuvConversion::kBessa:
      thruster->rotor_constant_left = required_number(params, "rotorConstantL", kAny);
      thruster->rotor_constant_right = required_number(params, "rotorConstantR", kAny);
      thruster->delta_left = required_number(params, "deltaL", {-1e12, 0.0});
      thruster->delta_right = required_number(params, "deltaR", kNotNegative);
      break;
    case UuvConversion::kLinearInterp:
      thruster->inputs = required_numbers(params, "inputValues");
      thruster->outputs = required_numbers(params, "outputValues");
      check_conversion_table(params, *thruster);
      break;
  }
}

UuvThruster read_thruster(const PluginParams& params) {
  UuvThrusterParams thruster;
  read_dynamics(params.below("dynamics"), &thruster);
  read_conversion(params.below("conversion"), &thruster);
  return UuvThruster(thruster);
}

/// As services return it.
ThrusterSetup read_setup(const PluginParams& params) {
  ThrusterSetup setup;
  setup.thrust_efficiency = params.number("thrust_efficiency", 1.0, {0.0, 1.0});
  setup.dynamic_state_efficiency = params.number("propeller_efficiency", 1.0, {0.0, 1.0});
  UuvThrusterParams thruster;
  read_conversion(params.below("conversion"), &thruster);
  for (const auto& item : enum_names(thruster.conversion)) {
    if (item.value == thruster.conversion) setup.conversion = item.name;
  }
  if (thruster.conversion == UuvConversion::kBasic) {
    setup.tags = {"rotor_constant"};
    setup.data = {thruster.rotor_constant};
  } else if (thruster.conversion == UuvConversion::kBessa) {
    setup.tags = {"rotor_constant_l", "rotor_constant_r", "delta_l", "delta_r"};
    setup.data = {thruster.rotor_constant_left, thruster.rotor_constant_right, thruster.delta_left,
                  thruster.delta_right};
  }
  setup.inputs = thruster.inputs;
  setup.outputs = thruster.outputs;
  return setup;
}

/// Below the namespace, or, as upstream, below the model's name where none is given.
std::string thruster_topic(const PluginContext& context, const std::string& topic) {
  const PluginParams& params = context.params;
  const bool has_namespace = !params.text("robotNamespace", "").empty();
  return scoped_topic(params, has_namespace ? topic : context.model->name + "/" + topic);
}

std::string own_name(const PluginContext& context, const char* end) {
  const int id = context.params.required_integer("thrusterID", {0, 1000});
  return "thrusters/" + std::to_string(id) + "/" + end;
}
std::string own_topic(const PluginContext& context, const char* end) {
  return thruster_topic(context, own_name(context, end));
}
/// The same, unless <key> has another name for it.
std::string named_topic(const PluginContext& context, const char* key, const char* end) {
  return thruster_topic(context, context.params.text(key, own_name(context, end)));
}

/// libuuv_thruster_ros_plugin.so: a thruster of uuv_simulator under its elements. It pushes
/// <linkName> along the link's x axis by what its conversion makes of the state of its dynamics,
/// and turns <jointName>, which is a picture, at that state [rad/s]. Topics
/// <robotNamespace>/thrusters/<thrusterID>/input, thrust and thrust_wrench, or those that
/// <inputTopic> and <thrustTopic> name; is_on, thrust_efficiency, dynamic_state_efficiency, and
/// upstream's services (ros/thruster_services.h) through the port setup.
class UuvThrusterPlugin : public Plugin {
 public:
  explicit UuvThrusterPlugin(const PluginContext& context)
      : link_(moving_link(context, "linkName")),
        thruster_(read_thruster(context.params)),
        gain_(context.params.number("gain", 1.0, kAny)),
        setup_{read_setup(context.params), {}},
        input_(context, named_topic(context, "inputTopic", "input"), "input of the thruster", "",
               clamp(context.params), ActuatorInput::Source::kStampedTopic),
        thrust_(advertise<StampedNumber>(context, named_topic(context, "thrustTopic", "thrust"),
                                         PortRank::kState)),
        wrench_(advertise<WrenchSample>(
            context, named_topic(context, "thrustWrenchTopic", "thrust_wrench"), PortRank::kState)),
        changes_(subscribe<ThrusterChange>(context, own_topic(context, "setup"))),
        setup_port_(
            advertise<ThrusterSetup>(context, own_topic(context, "setup"), PortRank::kState)),
        is_on_(advertise<FlagSample>(context, own_topic(context, "is_on"), PortRank::kState)),
        efficiencies_{
            advertise<NumberSample>(context, own_topic(context, "thrust_efficiency"),
                                    PortRank::kState),
            advertise<NumberSample>(context, own_topic(context, "dynamic_state_efficiency"),
                                    PortRank::kState)} {
    const PluginParams& params = context.params;
    setup_port_->value = setup_.now = setup_.initial;
    limits_.lo = params.number("thrustMin", kAny.lo, kAny);
    limits_.hi = params.number("thrustMax", kAny.hi, {limits_.lo, kAny.hi});
    if (params.has("jointName")) joint_ = &required_joint(context, "jointName");
    wrench_->value.frame = link_.name;
  }

  /// Before libuuv_underwater_object_ros_plugin.so looks.
  std::vector<Phase> phases() const override { return {Phase::kControl}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    take_changes();
    if (const auto newest = input_.take(world)) command_ = *newest;
    // Switched off the propeller runs down by its own dynamics.
    thruster_.step(setup_.now.is_on ? gain_ * command_ : 0.0, info.dt_s);
    const double state = setup_.now.dynamic_state_efficiency * thruster_.state_value();
    const double thrust = std::clamp(setup_.now.thrust_efficiency * thruster_.thrust_at(state),
                                     limits_.lo, limits_.hi);
    const SE3 T_world_link = link_.T_world_link();
    const Eigen::Vector3d force = T_world_link.R * Eigen::Vector3d(thrust, 0.0, 0.0);
    link_.body->add_force_at(force, T_world_link * link_.inertial.T_link_com.p);
    if (joint_ != nullptr && joint_->is_rotor) joint_->set_velocity(state);
    publish(info.end, thrust);
  }

  void reset() override {
    thruster_.reset();
    input_.reset();
    command_ = 0.0;
    changes_->clear();
    changes_seen_ = 0;
    setup_.now = setup_.initial;
    publish_setup();
  }
  void state(StateArchive& archive) override {
    thruster_.state(archive);
    input_.state(archive);
    archive(command_, setup_.now, changes_seen_);
  }

 private:
  static Limits clamp(const PluginParams& params) {
    Limits limits;
    limits.lo = params.number("clampMin", kAny.lo, kAny);
    limits.hi = params.number("clampMax", kAny.hi, {limits.lo, kAny.hi});
    return limits;
  }

  void take_changes() {
    for (changes_seen_ = std::max(changes_seen_, changes_->oldest());
         changes_seen_ < changes_->count(); ++changes_seen_) {
      apply(changes_->at(changes_seen_), &setup_.now);
      publish_setup();
    }
  }
  void publish_setup() {
    setup_port_->value = setup_.now;
    setup_port_->publish();
  }

  template <class Handle, class Value>
  static void write(const Handle& port, SimTime stamp, Value value) {
    if (!port->wanted()) return;
    port->value = {stamp, value};
    port->publish();
  }

  void publish(SimTime stamp, double thrust) {
    write(is_on_, stamp, setup_.now.is_on);
    write(efficiencies_.thrust, stamp, setup_.now.thrust_efficiency);
    write(efficiencies_.state, stamp, setup_.now.dynamic_state_efficiency);
    write(thrust_, stamp, thrust);
    if (wrench_->wanted()) {
      wrench_->value.stamp = stamp;
      wrench_->value.force = {thrust, 0.0, 0.0};
      wrench_->publish();
    }
  }

  struct Setup {
    ThrusterSetup initial, now;  ///< as the file says, and as services have changed it
  };
  struct Efficiencies {
    OutHandle<NumberSample> thrust, state;
  };

  Link& link_;
  Joint* joint_ = nullptr;
  UuvThruster thruster_;
  double gain_;
  Setup setup_;
  Limits limits_;
  ActuatorInput input_;
  double command_ = 0.0;
  OutHandle<StampedNumber> thrust_;
  OutHandle<WrenchSample> wrench_;
  InHandle<ThrusterChange> changes_;
  OutHandle<ThrusterSetup> setup_port_;
  OutHandle<FlagSample> is_on_;
  Efficiencies efficiencies_;
  std::uint64_t changes_seen_ = 0;
};

std::string thruster_joint(const PluginParams& params) { return params.text("jointName", ""); }

const PluginRegistrar kUuvThrusterRosPlugin("libuuv_thruster_ros_plugin.so",
                                            factory_of<UuvThrusterPlugin>(thruster_joint));

}  // namespace

}  // namespace trident::sim
