// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "drop_if.h"
#include "trident_base/error.h"
#include "trident_base/sha256.h"
#include "trident_sim/world.h"

namespace trident {
namespace {

bool active(SimTime start, const StepInfo& info) { return start < info.end; }

bool finished(SimTime start, SimTime duration, const StepInfo& info) {
  return duration.ns >= 0 && start + duration <= info.begin;
}

}  // namespace

void World::apply_wrench(const AppliedWrench& wrench) {
  if (!wrench.force_world.allFinite() || !wrench.torque_world.allFinite() ||
      !wrench.p_link.allFinite()) {
    throw Error("wrench on link '" + wrench.link->name + "' is not finite");
  }
  if (wrench.link->body == nullptr) {
    throw Error("wrench on link '" + wrench.link->name + "': the link is static");
  }
  wrenches_.push_back(wrench);
}

void World::clear_wrenches(const Link& link) {
  drop_if(wrenches_, [&link](const AppliedWrench& w) { return w.link == &link; });
}

void World::apply_effort(const AppliedEffort& effort) {
  if (!std::isfinite(effort.effort)) {
    throw Error("effort on joint '" + effort.joint->spec.name + "' is not finite");
  }
  efforts_.push_back(effort);
}

void World::clear_efforts(const Joint& joint) {
  drop_if(efforts_, [&joint](const AppliedEffort& e) { return e.joint == &joint; });
}

void World::apply_external(const StepInfo& info) {
  drop_if(wrenches_, [&](const auto& w) { return finished(w.start, w.duration, info); });
  drop_if(efforts_, [&](const auto& e) { return finished(e.start, e.duration, info); });
  for (const AppliedWrench& wrench : wrenches_) {
    if (!active(wrench.start, info)) continue;
    wrench.link->body->add_force_at(wrench.force_world,
                                    wrench.link->T_world_link() * wrench.p_link);
    wrench.link->body->torque += wrench.torque_world;
  }
  for (const AppliedEffort& effort : efforts_) {
    if (active(effort.start, info)) effort.joint->force += effort.effort;
  }
}

std::string World::state_hash() const {
  Sha256 hash;
  hash.update_double(static_cast<double>(step_count_));
  for (const auto& [name, model] : models_) {
    hash.update_string(name);
    for (const auto& body : model->bodies) {
      const SE3& T = body->T_world_body;
      for (int i = 0; i < 3; ++i) hash.update_double(T.p[i]);
      for (int i = 0; i < 4; ++i) hash.update_double(T.R.coeffs()[i]);
      for (int i = 0; i < 3; ++i) hash.update_double(body->v_world[i]);
      for (int i = 0; i < 3; ++i) hash.update_double(body->w_world[i]);
    }
    for (const auto& joint : model->joints) {
      if (joint->spun) hash.update_double(joint->spun_velocity);
    }
  }
  return hash.hex_digest();
}

}  // namespace trident
