// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/world/applied_loads.h"

#include <algorithm>
#include <cmath>

#include "drop_if.h"
#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"

namespace trident::sim {
namespace {

/// The step that contains the start has the whole force: steps are not divided.
bool active(SimTime start, const StepInfo& info) { return start < info.end; }

/// A span that ends within a step still acts in that step.
bool finished(SimTime start, SimTime duration, const StepInfo& info) {
  return duration.ns >= 0 && start + duration <= info.begin;
}

void check_drivable(const Joint& joint, std::size_t axis) {
  if (axis < joint.axis_count()) return;
  throw Error("joint '" + joint.spec.name + "' has " + std::to_string(joint.axis_count()) +
              " axes that can be driven, none numbered " + std::to_string(axis));
}

}  // namespace

void AppliedLoads::apply_wrench(const AppliedWrench& wrench) {
  if (!is_within(wrench.force_world, kStrongest) || !is_within(wrench.torque_world, kStrongest) ||
      !is_within(wrench.p_link, kFarthestBodyM)) {
    throw Error("wrench on link '" + wrench.link->name +
                "' is not finite, or beyond 1e15 N or N m, or its point 1e7 m");
  }
  if (wrench.link->body == nullptr) {
    throw Error("wrench on link '" + wrench.link->name + "': the link is static");
  }
  wrenches_.push_back(wrench);
}

void AppliedLoads::clear_wrenches(const Link& link) {
  drop_if(wrenches_, [&link](const AppliedWrench& w) { return w.link == &link; });
}

void AppliedLoads::apply_effort(const AppliedEffort& effort) {
  if (!(std::abs(effort.effort) <= kStrongest)) {
    throw Error("effort on joint '" + effort.joint->spec.name + "' is not finite, or beyond 1e15");
  }
  check_drivable(*effort.joint, effort.axis);
  efforts_.push_back(effort);
}

void AppliedLoads::clear_efforts(const Joint& joint) {
  drop_if(efforts_, [&joint](const AppliedEffort& e) { return e.joint == &joint; });
}

/// Made before the old one is removed, so that bad values leave that in place.
JointDrive& AppliedLoads::add_drive(Joint& joint, const DriveSpec& spec, std::size_t axis) {
  auto drive = std::make_unique<JointDrive>(joint, axis, spec);
  remove_drive(joint, axis);
  drives_.push_back(std::move(drive));
  return *drives_.back();
}

JointDrive* AppliedLoads::find_drive(const Joint& joint, std::size_t axis) const {
  for (const auto& drive : drives_) {
    if (&drive->joint() == &joint && drive->axis() == axis) return drive.get();
  }
  return nullptr;
}

void AppliedLoads::remove_drive(const Joint& joint, std::size_t axis) {
  drop_if(drives_,
          [&](const auto& drive) { return &drive->joint() == &joint && drive->axis() == axis; });
}

/// Drives may have come and gone since the snapshot, so that they are copied instead of exchanged.
void AppliedLoads::restore_drives(const std::vector<JointDrive>& drives) {
  std::vector<std::unique_ptr<JointDrive>> restored;
  for (const JointDrive& then : drives) {
    // A holder of a drive keeps it: it stays the same object.
    const auto same = std::find_if(drives_.begin(), drives_.end(), [&then](const auto& now) {
      return now != nullptr && &now->joint() == &then.joint() && now->axis() == then.axis();
    });
    restored.push_back(same != drives_.end() ? std::move(*same)
                                             : std::make_unique<JointDrive>(then));
    *restored.back() = then;
  }
  drives_ = std::move(restored);
}

/// In the order in which they were applied: sums of floating-point numbers depend on it.
void AppliedLoads::apply_wrenches_and_efforts(const StepInfo& info) {
  drop_if(wrenches_, [&](const auto& w) { return finished(w.start, w.duration, info); });
  drop_if(efforts_, [&](const auto& e) { return finished(e.start, e.duration, info); });
  for (const AppliedWrench& wrench : wrenches_) {
    if (!active(wrench.start, info)) continue;
    wrench.link->body->add_force_at(wrench.force_world,
                                    wrench.link->T_world_link() * wrench.p_link);
    wrench.link->body->apply_torque(wrench.torque_world);
  }
  for (const AppliedEffort& effort : efforts_) {
    if (active(effort.start, info)) effort.joint->add_effort(effort.effort, effort.axis);
  }
}

void AppliedLoads::apply_loads(const StepInfo& info) {
  if (!wrenches_.empty() || !efforts_.empty()) apply_wrenches_and_efforts(info);
  for (const auto& drive : drives_) drive->apply(info.dt_s);
}

void AppliedLoads::reset_loads() {
  wrenches_.clear();
  efforts_.clear();
  for (const auto& drive : drives_) drive->reset();
}

void AppliedLoads::drop_loads_on(const Model& model) {
  const auto of_model = [&model](const Link* link) {
    return std::any_of(model.links.begin(), model.links.end(),
                       [link](const auto& own) { return own.get() == link; });
  };
  drop_if(wrenches_, [&](const AppliedWrench& w) { return of_model(w.link); });
  drop_if(efforts_, [&](const AppliedEffort& e) { return of_model(e.joint->child); });
  drop_if(drives_, [&](const auto& drive) { return of_model(drive->joint().child); });
}

}  // namespace trident::sim
