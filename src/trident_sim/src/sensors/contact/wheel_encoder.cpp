// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "core/plugins/plugin_util.h"
#include "trident_base/vehicle/wheel_encoder.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// libtrident_wheel_encoder.so: what incremental encoders on joints count, as joint states whose
/// positions are whole ticks [rad] and whose rates are the ticks since the last sample over the
/// time. A wheel that slips counts as it turns. <jointName> a, b, ...; <ticksPerTurn> (1024);
/// <updateRate> [Hz] (50); <topicName> (wheel_encoders).
class WheelEncoders : public MeasuringPlugin {
 public:
  explicit WheelEncoders(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        joints_(listed_joints(context, 1)),
        encoder_(context.params.integer("ticksPerTurn", 1024, {1.0, 1e9})),
        clock_(context.params.number("updateRate", 50.0, {0.0, 1e6})),
        last_ticks_(joints_.size(), 0) {
    const PluginParams& params = context.params;
    states_ = advertise<JointStateSample>(
        context, scoped_topic(params, params.text("topicName", "wheel_encoders")),
        PortRank::kState);
    JointStateSample& value = states_->value;
    for (const Joint* joint : joints_) value.names.push_back(joint->spec.name);
    value.positions.resize(joints_.size());
    value.velocities.resize(joints_.size());
  }

  void reset() override {
    last_ticks_.assign(joints_.size(), 0);
    last_sample_ = 0;
  }
  void state(StateArchive& archive) override { archive(last_ticks_, last_sample_); }

 protected:
  /// Counts whether somebody listens or not, so that rates are the same for all.
  void measure(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info)) return;
    const double since_s = static_cast<double>(info.sample - last_sample_) * info.dt_s;
    JointStateSample& value = states_->value;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      const std::int64_t ticks = encoder_.ticks(joints_[i]->position());
      value.positions[i] = encoder_.angle(ticks);
      value.velocities[i] = encoder_.angle(ticks - last_ticks_[i]) / since_s;
      last_ticks_[i] = ticks;
    }
    last_sample_ = info.sample;
    if (!states_->wanted()) return;
    value.stamp = info.end;
    states_->publish();
  }

 private:
  std::vector<Joint*> joints_;
  WheelEncoder encoder_;
  SampleClock clock_;
  std::vector<std::int64_t> last_ticks_;
  std::uint64_t last_sample_ = 0;  ///< number of the step, since the last reset
  OutHandle<JointStateSample> states_;
};

const PluginRegistrar kTridentWheelEncoder(
    "libtrident_wheel_encoder.so", factory_of<WheelEncoders>(),
    PluginExample{"<jointName>rotor_0_joint, rotor_1_joint</jointName>",
                  {"jointName"},
                  {"ticksPerTurn", "updateRate"}});

}  // namespace

}  // namespace trident::sim
