// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera_outputs.h"
#include "sensors/command_input.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {

/// When a camera takes pictures: at the sensor's rate, or one for each std_msgs/Empty on
/// `<triggerTopicName>` (image_trigger), at the end of the next step.
enum class Shutter { kRate, kTrigger };

/// The sensor that a camera's plugin belongs to; throws Error if there is no such sensor.
const SensorSpec& required_sensor(const PluginContext& context);

/// "<robotNamespace>/<cameraName>/<topic>"; an absolute topic stands alone.
std::string camera_topic(const PluginParams& params, const std::string& camera,
                         const std::string& topic);

/// A sensor's cameras, drawn at once. While it runs, its angle of view [rad] can be set through
/// "set_hfov", and the rate [Hz; 0: every step] through "set_update_rate", below `camera`.
class CameraSensor : public MeasuringPlugin {
 public:
  CameraSensor(const PluginContext& context, const std::string& camera,
               const std::vector<CameraSetup>& setups, Shutter shutter = Shutter::kRate);

  void reset() override;
  void state(StateArchive& archive) override;

 protected:
  void measure(const World& world, const StepInfo& info) override;

 private:
  bool is_due(const StepInfo& info);
  void follow_angle_of_view(const World& world);

  Link& link_;
  SE3 T_link_sensor_;
  double rate_hz_;
  NumberInput angle_, rate_;
  std::optional<RequestInput<TriggerCommand>> trigger_;
  std::vector<std::unique_ptr<CameraOutputs>> cameras_;
  std::optional<double> drawn_angle_;  ///< what the cameras were set to; follows from `angle_`
  std::uint64_t number_ = 0;           ///< of pictures that were due since the last reset
};

}  // namespace trident::sim
