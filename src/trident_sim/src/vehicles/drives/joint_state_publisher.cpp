// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plugins/joint_states.h"
#include "core/plugins/rate_ticker.h"
#include "drive_parts.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// libgazebo_ros_joint_state_publisher.so: <jointName> a, b, ...; <updateRate>.
class JointStatePublisher : public Plugin {
 public:
  explicit JointStatePublisher(const PluginContext& context)
      : ticker_(context.params.number("updateRate", 100.0, {0.0, 1e9})),
        states_(context, scoped_topic(context.params, "joint_states"), listed_joints(context)) {}

  std::vector<Phase> phases() const override { return {Phase::kPost}; }
  void post_step(const World& world, const StepInfo& info) override {
    if (ticker_.tick(info)) states_.publish(world, info.end);
  }
  void reset() override { ticker_.reset(); }
  void state(StateArchive& archive) override { ticker_.state(archive); }

 private:
  RateTicker ticker_;
  JointStates states_;
};

const PluginRegistrar kGazeboRosJointStatePublisher(
    "libgazebo_ros_joint_state_publisher.so", factory_of<JointStatePublisher>(),
    PluginExample{
        "<jointName>rotor_0_joint, rotor_1_joint</jointName>", {"jointName"}, {"updateRate"}});

}  // namespace

}  // namespace trident::sim
