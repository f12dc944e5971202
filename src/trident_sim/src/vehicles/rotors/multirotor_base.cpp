// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cctype>
#include <map>

#include "core/plugins/plugin_util.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// Number of a link named "...rotor_<N>", or -1.
int rotor_number(const std::string& link_name) {
  const std::string mark = "rotor_";
  const auto at = link_name.rfind(mark);
  if (at == std::string::npos) return -1;
  int number = 0;
  std::size_t digits = 0;
  for (std::size_t i = at + mark.size(); i < link_name.size() && digits < 6; ++i, ++digits) {
    if (std::isdigit(static_cast<unsigned char>(link_name[i])) == 0) return -1;
    number = 10 * number + (link_name[i] - '0');
  }
  return digits == 0 ? -1 : number;
}

/// Publishes the speeds and angles of all rotors of a multirotor.
class MultirotorBase : public MeasuringPlugin {
 public:
  explicit MultirotorBase(const PluginContext& context, TopicNaming name_of = robot_topic)
      : MeasuringPlugin(context.world.timing()) {
    const PluginParams& params = context.params;
    required_link(context, "linkName");
    slowdown_ = params.number("rotorVelocitySlowdownSim", 10.0, {1e-12, 1e12});
    std::map<int, Joint*> rotors;
    for (const auto& joint : context.model->joints) {
      const int number = joint->child ? rotor_number(joint->child->name) : -1;
      if (number >= 0 && number < static_cast<int>(SmallVector::kCapacity)) {
        rotors[number] = joint.get();
      }
    }
    motor_speed_ = advertise<ActuatorState>(
        context, name_of(context, params.text("motorPubTopic", "motor_speed")), PortRank::kState);
    joint_states_ = advertise<JointStateSample>(
        context, name_of(context, params.text("jointStatePubTopic", "joint_states")),
        PortRank::kState);
    for (const auto& [number, joint] : rotors) {
      rotors_.emplace_back(static_cast<std::size_t>(number), joint);
      joint_states_->value.names.push_back(joint->spec.name);
    }
    joint_states_->value.positions.resize(rotors_.size());
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (motor_speed_->wanted()) {
      SmallVector& speeds = motor_speed_->value.angular_velocities;
      speeds.size = rotors_.empty() ? 0 : rotors_.back().first + 1;
      for (const auto& [number, joint] : rotors_)
        // The joint turns slower than the real rotor by this factor (MotorModel).
        speeds.data[number] = joint->velocity() * slowdown_;
      motor_speed_->value.stamp = info.end;
      motor_speed_->publish();
    }
    if (joint_states_->wanted()) {
      for (std::size_t i = 0; i < rotors_.size(); ++i) {
        joint_states_->value.positions[i] = rotors_[i].second->position();
      }
      joint_states_->value.stamp = info.end;
      joint_states_->publish();
    }
  }

 private:
  double slowdown_;
  std::vector<std::pair<std::size_t, Joint*>> rotors_;
  OutHandle<ActuatorState> motor_speed_;
  OutHandle<JointStateSample> joint_states_;
};

std::unique_ptr<Plugin> make_vehicle_base(const PluginContext& context) {
  return std::make_unique<MultirotorBase>(context, vehicle_topic);
}

const PluginExample kBaseExample{
    "<linkName>base_link</linkName>", {"linkName"}, {"rotorVelocitySlowdownSim"}};

const PluginRegistrar kRotorsGazeboMultirotorBasePlugin(
    "librotors_gazebo_multirotor_base_plugin.so", factory_of<MultirotorBase>(), kBaseExample);
const PluginRegistrar kGazeboMultirotorBasePlugin("libgazebo_multirotor_base_plugin.so",
                                                  {make_vehicle_base, {}}, kBaseExample);

}  // namespace

}  // namespace trident::sim
