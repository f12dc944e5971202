// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_actuators.h"

namespace trident::sim {
namespace {

std::string thruster_topic(const PluginContext& context, const ThrusterParams& params,
                           const char* end) {
  return scoped_topic(context.params, "thrusters/" + params.name + end);
}

using Source = ActuatorInput::Source;

/// An input on its own topic, or of what comes on `command_topic`.
ActuatorInput make_input(const PluginContext& context, Source own, const std::string& own_topic,
                         const std::string& command_topic, const std::string& what,
                         const std::string& unit, const Limits& limits) {
  if (command_topic.empty()) return {context, own_topic, what, unit, limits, own};
  return {context, command_topic, what, unit, limits, Source::kCaller};
}

}  // namespace

ThrusterOnTopics::ThrusterOnTopics(const PluginContext& context, const ThrusterParams& params,
                                   double timeout_s, const std::string& command_topic)
    : thruster_(params),
      timeout_s_(timeout_s),
      command_(make_input(context, Source::kSingleTopic,
                          thruster_topic(context, params, "_thrust_cmd"), command_topic,
                          "command of thruster '" + params.name + "'", "",
                          {params.min_command, params.max_command})),
      thrust_(advertise<ScalarSample>(context, thruster_topic(context, params, "_thrust"),
                                      PortRank::kState)) {
  if (params.max_angle > 0.0) {
    angle_.emplace(make_input(context, Source::kSingleTopic,
                              thruster_topic(context, params, "_thrust_angle"), command_topic,
                              "angle of thruster '" + params.name + "'", " rad",
                              {-params.max_angle, params.max_angle}));
  }
}

void ThrusterOnTopics::command(World& world, const StepInfo& info, double value) {
  if (const auto legal = command_.check(world, value)) {
    thruster_.command(*legal);
    commanded_ = info.begin;
  }
}

void ThrusterOnTopics::command_angle(World& world, double angle_rad) {
  if (const auto legal = angle_->check(world, angle_rad)) thruster_.command_angle(*legal);
}

void ThrusterOnTopics::step(World& world, const StepInfo& info) {
  if (const auto command = command_.take(world)) {
    thruster_.command(*command);
    commanded_ = info.begin;
  } else if (timeout_s_ > 0.0 && (info.begin - commanded_).seconds() > timeout_s_) {
    thruster_.command(0.0);
  }
  if (angle_) {
    if (const auto angle = angle_->take(world)) thruster_.command_angle(*angle);
  }
  thruster_.step(info.dt_s);
}

void ThrusterOnTopics::command_part(double part, const StepInfo& info) {
  const ThrusterParams& params = thruster_.params();
  // Parts of the full command in either direction.
  thruster_.command(part * (part >= 0.0 ? params.max_command : -params.min_command));
  commanded_ = info.begin;
}

void ThrusterOnTopics::publish(SimTime stamp) {
  if (!thrust_->wanted()) return;
  thrust_->value = {stamp, thruster_.thrust_n()};
  thrust_->publish();
}

void ThrusterOnTopics::reset() {
  thruster_.reset();
  command_.reset();
  if (angle_) angle_->reset();
  commanded_ = {};
}

void ThrusterOnTopics::state(StateArchive& archive) {
  thruster_.state(archive);
  command_.state(archive);
  if (angle_) angle_->state(archive);
  archive(commanded_);
}

RudderOnTopic::RudderOnTopic(const PluginContext& context, const RudderParams& params,
                             const std::string& command_topic)
    : rudder_(params),
      angle_(make_input(context, Source::kTopic,
                        scoped_topic(context.params, "rudders/" + params.name + "_angle"),
                        command_topic, "angle of rudder '" + params.name + "'", " rad",
                        {-params.max_angle, params.max_angle})) {}

void RudderOnTopic::command(World& world, double angle_rad) {
  if (const auto legal = angle_.check(world, angle_rad)) rudder_.command(*legal);
}

void RudderOnTopic::step(World& world, const StepInfo& info) {
  if (const auto angle = angle_.take(world)) rudder_.command(*angle);
  rudder_.step(info.dt_s);
}

void RudderOnTopic::reset() {
  rudder_.reset();
  angle_.reset();
}

void RudderOnTopic::state(StateArchive& archive) {
  rudder_.state(archive);
  angle_.state(archive);
}

}  // namespace trident::sim
