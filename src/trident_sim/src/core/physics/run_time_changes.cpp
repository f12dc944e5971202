// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "run_time_changes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "composite_inertia.h"
#include "joint_anchor.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"
#include "trident_sim/world/mass_scale.h"

namespace trident::sim {
namespace {

constexpr int kSecondAxisGroup = 0x100;  ///< of ODE's parameters: those of the second axis

const Joint* rotor_joint_of(const Model& model, const Link& link) {
  for (const auto& joint : model.joints) {
    if (joint->is_rotor && joint->child == &link) return joint.get();
  }
  return nullptr;
}

/// Numbers of the links that the body is made of; the first gives it its axes.
std::vector<std::size_t> members(const Model& model, const EngineBody& body) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (model.links[i]->body == &body) result.push_back(i);
  }
  return result;
}

std::vector<BodyPart> parts_of(const Model& model, const std::vector<std::size_t>& links) {
  std::vector<BodyPart> parts;
  for (const std::size_t i : links) {
    const Joint* rotor = rotor_joint_of(model, *model.links[i]);
    parts.push_back({&model.spec.links[i], rotor == nullptr ? nullptr : &rotor->spec.axis_model});
  }
  return parts;
}

/// Moves the origin of the body's frame, whatever is fixed to it staying where it is.
void move_origin(Model& model, EngineBody& body, const Eigen::Vector3d& shift_body) {
  const auto move = [&](SE3& T, Eigen::Vector3d& v, const Eigen::Vector3d& w) {
    const Eigen::Vector3d arm = T.R * shift_body;
    T.p += arm;
    v += w.cross(arm);
  };
  move(body.T_world_body, body.v_world, body.w_world);
  move(body.before.T_world_body, body.before.v_world, body.before.w_world);
  body.T_world_body_initial.p += body.T_world_body_initial.R * shift_body;
  body.bound_center -= shift_body;
  for (const auto& link : model.links) {
    if (link->body == &body) link->T_body_link.p -= shift_body;
  }
  for (const EngineGeom& geom : body.geoms) {
    const dReal* offset = dGeomGetOffsetPosition(geom.id);
    dGeomSetOffsetPosition(geom.id, offset[0] - shift_body.x(), offset[1] - shift_body.y(),
                           offset[2] - shift_body.z());
  }
}

void check(bool ok, const Joint& joint, const char* field, double value, const char* legal) {
  if (ok) return;
  throw Error("joint [" + joint.spec.name + "]: " + field + " is " + std::to_string(value) +
              ", must be " + legal);
}

void check(const Joint& joint, const AxisSpec& now, const AxisParams& params) {
  const auto not_negative = [&](const char* field, const std::optional<double>& value) {
    if (value) check(*value >= 0.0 && *value <= kStrongest, joint, field, *value, "in [0, 1e15]");
  };
  const auto fraction = [&](const char* field, const std::optional<double>& value) {
    if (value) check(*value >= 0.0 && *value <= 1.0, joint, field, *value, "in [0, 1]");
  };
  not_negative("damping", params.damping);
  not_negative("cfm", params.cfm);
  not_negative("stop_cfm", params.stop_cfm);
  not_negative("fmax", params.motor_effort);
  fraction("stop_erp", params.stop_erp);
  fraction("fudge_factor", params.fudge_factor);
  if (params.motor_velocity) {
    check(std::abs(*params.motor_velocity) <= kFastestMS, joint, "vel", *params.motor_velocity,
          "finite, up to 1e5");
  }
  const double lower = params.lower.value_or(now.lower);
  check(!std::isnan(lower), joint, "loStop", lower, "a number");
  check(params.upper.value_or(now.upper) >= lower, joint, "hiStop",
        params.upper.value_or(now.upper), ("at least loStop, " + std::to_string(lower)).c_str());
}

/// How ODE calls the parameters of an axis.
struct OdeAxis {
  void (*set)(dJointID, int, dReal);
  int group;
};

OdeAxis ode_axis(const Joint& joint, std::size_t axis) {
  switch (joint.spec.type) {
    case JointType::kRevolute:
      return {dJointSetHingeParam, 0};
    case JointType::kPrismatic:
      return {dJointSetSliderParam, 0};
    case JointType::kUniversal: {
      // ODE's first axis is that of its first body, ours that of the parent.
      const bool is_child_first = joint.child->body != nullptr;
      return {dJointSetUniversalParam, is_child_first == (axis == 0) ? kSecondAxisGroup : 0};
    }
    default:
      throw Error("joint [" + joint.spec.name +
                  "]: only revolute, prismatic and universal joints have limits and motors that "
                  "can be set; of others only the damping");
  }
}

void set_limits(const Joint& joint, const OdeAxis& ode, const AxisSpec& spec) {
  // Limits of more than half a turn are counted, and set again in every step.
  const double reach = joint.spec.type == JointType::kRevolute ? kPi : dInfinity;
  ode.set(joint.ode->id, dParamLoStop + ode.group, spec.lower > -reach ? spec.lower : -dInfinity);
  ode.set(joint.ode->id, dParamHiStop + ode.group, spec.upper < reach ? spec.upper : dInfinity);
}

bool needs_ode(const AxisParams& p) {
  return p.lower || p.upper || p.cfm || p.stop_erp || p.stop_cfm || p.fudge_factor ||
         p.motor_effort || p.motor_velocity;
}

void set_in_ode(Joint& joint, const OdeAxis& ode, const AxisSpec& spec, const AxisParams& params) {
  const auto set = [&](int parameter, const std::optional<double>& value) {
    if (value) ode.set(joint.ode->id, parameter + ode.group, *value);
  };
  set(dParamCFM, params.cfm);
  set(dParamStopERP, params.stop_erp);
  set(dParamStopCFM, params.stop_cfm);
  set(dParamFudgeFactor, params.fudge_factor);
  set(dParamVel, params.motor_velocity);
  set(dParamFMax, params.motor_effort);
  if (params.lower || params.upper) set_limits(joint, ode, spec);
}

}  // namespace

void recompose(Model& model, EngineBody& body) {
  const std::vector<std::size_t> links = members(model, body);
  const CompositeInertia inertia = compose_inertia(parts_of(model, links));
  const Eigen::Quaterniond& R_model_body = model.spec.links[links.front()].T_model_link.R;
  const SE3 T_model_body = model.T_world_model_initial.inverse() * body.T_world_body_initial;
  move_origin(model, body, R_model_body.conjugate() * (inertia.p_model_com - T_model_body.p));
  set_inertia(body, inertia, R_model_body);
  place_as_spawned(model);
  for (const auto& joint : model.joints) {
    if (joint->is_rotor && joint->child->body == &body) {
      const auto at = std::find_if(links.begin(), links.end(), [&](std::size_t i) {
        return model.links[i].get() == joint->child;
      });
      joint->rotor_inertia = rotor_inertia(model.spec.links[*at], joint->spec.axis_model);
    }
    if (std::find(joint->held.begin(), joint->held.end(), &body) != joint->held.end()) {
      anchor_joint(model, *joint);
    }
  }
}

namespace {

void scale_mass_of(const Model& model, EngineBody& body, double factor) {
  const std::vector<std::size_t> links = members(model, body);
  if (links.empty()) return;  // the shaft of a gearbox
  CompositeInertia inertia = compose_inertia(parts_of(model, links));
  inertia.mass_kg *= factor;
  inertia.inertia *= factor;
  inertia.weight_kg *= factor;
  set_inertia(body, inertia, model.spec.links[links.front()].T_model_link.R);
}

}  // namespace

void scale_mass(Model& model, double factor) {
  if (!(factor >= 0.01 && factor <= 100.0)) {
    throw Error("mass of model '" + model.name + "': factor is " + std::to_string(factor) +
                ", legal: 0.01 to 100");
  }
  if (model.is_static) throw Error("model '" + model.name + "' is static: it has no mass to scale");
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Inertial& made_with = model.spec.links[i].inertial;
    model.links[i]->inertial.mass_kg = factor * made_with.mass_kg;
    model.links[i]->inertial.inertia_com = factor * made_with.inertia_com;
  }
  for (const auto& body : model.bodies) scale_mass_of(model, engine_body(*body), factor);
}

namespace {

void require_axis(const Joint& joint, std::size_t axis) {
  const std::string who = "joint [" + joint.spec.name + "] ";
  if (joint.is_rotor) {
    throw Error(who + "is a rotor that a motor model drives: it has no properties to set");
  }
  if (axis >= joint.axis_count()) {
    throw Error(who + "has " + std::to_string(joint.axis_count()) + " axes, none numbered " +
                std::to_string(axis));
  }
}

}  // namespace

void set_axis_params(Joint& joint, std::size_t axis, const AxisParams& params) {
  require_axis(joint, axis);
  AxisSpec& spec = joint.axes[axis].spec;
  check(joint, spec, params);
  const bool in_ode = needs_ode(params);
  const OdeAxis ode = in_ode ? ode_axis(joint, axis) : OdeAxis{};
  spec.damping = joint.axes[axis].damping = params.damping.value_or(joint.axes[axis].damping);
  spec.lower = params.lower.value_or(spec.lower);
  spec.upper = params.upper.value_or(spec.upper);
  AxisSpec& written = axis == 0 ? static_cast<AxisSpec&>(joint.spec) : joint.spec.axis2;
  written.lower = spec.lower;
  written.upper = spec.upper;
  if (in_ode) set_in_ode(joint, ode, spec, params);
}

}  // namespace trident::sim
