// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_sensor.h"

#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr double kFastest = 1e6;  ///< [Hz]

/// The slower of the sensor's rate and the plugin's, as in gazebo_plugins; 0: every step.
double rate_of(const PluginContext& context) {
  const double sensor = required_sensor(context).update_rate_hz;
  const double plugin = context.params.number("updateRate", 0.0, {0.0, kFastest});
  return plugin > 0.0 && (sensor <= 0.0 || plugin < sensor) ? plugin : sensor;
}

}  // namespace

const SensorSpec& required_sensor(const PluginContext& context) {
  if (context.sensor == nullptr) {
    throw Error(context.params.owner() +
                ": belongs in a <sensor> of type camera, depth or multicamera");
  }
  return *context.sensor;
}

std::string camera_topic(const PluginParams& params, const std::string& camera,
                         const std::string& topic) {
  const bool stands_alone = camera.empty() || (!topic.empty() && topic.front() == '/');
  return scoped_topic(params, stands_alone ? topic : camera + "/" + topic);
}

CameraSensor::CameraSensor(const PluginContext& context, const std::string& camera,
                           const std::vector<CameraSetup>& setups, Shutter shutter)
    : MeasuringPlugin(context.world.timing()),
      link_(*context.link),
      T_link_sensor_(required_sensor(context).T_link_sensor),
      rate_hz_(rate_of(context)),
      angle_(context, camera_topic(context.params, camera, "set_hfov"), "rad",
             {kMinAngleOfView, kMaxAngleOfView}),
      rate_(context, camera_topic(context.params, camera, "set_update_rate"), "Hz",
            {0.0, kFastest}) {
  if (shutter == Shutter::kTrigger) {
    const std::string topic = context.params.text("triggerTopicName", "image_trigger");
    trigger_.emplace(context, camera_topic(context.params, camera, topic));
  }
  for (const CameraSetup& setup : setups) {
    cameras_.push_back(std::make_unique<CameraOutputs>(context, setup));
  }
}

bool CameraSensor::is_due(const StepInfo& info) {
  if (trigger_) return trigger_->take();
  return SampleClock(rate_.value().value_or(rate_hz_)).is_due(info);
}

void CameraSensor::follow_angle_of_view(const World& world) {
  if (angle_.value() == drawn_angle_) return;
  try {
    for (const auto& camera : cameras_) camera->set_angle_of_view(angle_.value());
    drawn_angle_ = angle_.value();
  } catch (const Error& error) {
    world.report(Severity::kWarning, std::string(error.what()) + "; the last good one stays");
    angle_.put(drawn_angle_);
    for (const auto& camera : cameras_) camera->set_angle_of_view(drawn_angle_);
  }
}

void CameraSensor::measure(const World& world, const StepInfo& info) {
  angle_.poll(world);
  rate_.poll(world);
  follow_angle_of_view(world);
  if (!is_due(info)) return;
  ++number_;
  const SE3 T_world_sensor = link_.T_world_link() * T_link_sensor_;
  for (const auto& camera : cameras_) camera->measure(T_world_sensor, info.end, number_);
}

void CameraSensor::reset() {
  angle_.reset();
  rate_.reset();
  if (trigger_) trigger_->reset();
  number_ = 0;
}

void CameraSensor::state(StateArchive& archive) {
  angle_.state(archive);
  rate_.state(archive);
  if (trigger_) trigger_->state(archive);
  archive(number_);
}

}  // namespace trident::sim
