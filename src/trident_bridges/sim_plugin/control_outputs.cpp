// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "control_outputs.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges {
namespace {

constexpr double kLargest = 1e6;  ///< of a control's value, of either sign

}  // namespace

ControlOutputs::ControlOutputs(const sim::PluginContext& context, const std::string& motor_topic)
    : world_(context.world), owner_(context.params.owner()) {
  sim::PortBoard& board = world_.ports();
  motors_ = {board, board.subscribe<sim::ActuatorCommand>(motor_topic)};
  commanded_ = {board, board.advertise<sim::ActuatorState>(motor_topic, sim::PortRank::kState)};
}

ControlOutputs::~ControlOutputs() {
  for (const Channel& channel : channels_) {
    if (channel.joint != nullptr) world_.remove_drive(*channel.joint);
  }
}

void ControlOutputs::add_motor(std::size_t number) {
  if (number >= sim::SmallVector::kCapacity) {
    throw Error(owner_ + ": motor number is " + std::to_string(number) + ", legal: 0 to 31");
  }
  speeds_.size = std::max(speeds_.size, number + 1);
  channels_.push_back({static_cast<int>(number), nullptr});
}

void ControlOutputs::add_joint(sim::Joint& joint, const sim::DriveSpec& spec) {
  try {
    world_.add_drive(joint, spec);
  } catch (const Error& error) {
    throw Error(owner_ + ": " + error.what());
  }
  channels_.push_back({-1, &joint});
}

void ControlOutputs::set(std::size_t channel, double value, const std::string& field) {
  if (!(std::abs(value) <= kLargest)) {
    world_.diagnose({sim::Severity::kError,
                     owner_,
                     field + " refused",
                     field + " is " + std::to_string(value) +
                         ", legal: finite numbers up to 1e6; the last one stays",
                     {{field, std::to_string(value)}, {"legal", "-1e6 to 1e6"}}});
    return;
  }
  const Channel& target = channels_[channel];
  if (target.motor >= 0) speeds_.data[static_cast<std::size_t>(target.motor)] = value;
  if (target.joint == nullptr) return;
  if (sim::JointDrive* drive = world_.find_drive(*target.joint)) drive->set_target(value);
}

void ControlOutputs::flush(SimTime now) {
  if (speeds_.size == 0) return;
  motors_->write({SimTime{0}, speeds_});
  if (!commanded_->wanted()) return;
  commanded_->value = {now, speeds_};
  commanded_->publish();
}

void ControlOutputs::reset() {
  speeds_.data.fill(0.0);
  motors_->clear();
}

sim::Joint* find_joint(const sim::Model& model, const std::string& name) {
  if (sim::Joint* joint = model.find_joint(name)) return joint;
  const auto at = name.rfind("::");
  return at == std::string::npos ? nullptr : model.find_joint(name.substr(at + 2));
}

std::string joint_names(const sim::Model& model, bool (*counts)(const sim::Joint*)) {
  std::vector<std::string> names;
  for (const auto& joint : model.joints) {
    if (counts(joint.get())) names.push_back(joint->spec.name);
  }
  return join(names);
}

void report_unread(sim::World& world, const sim::PluginParams& params) {
  for (const std::string& element : params.unread()) {
    world.report(sim::Severity::kWarning,
                 params.owner() + ": <" + element + "> is not known and has no effect");
  }
}

}  // namespace trident::bridges
