// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "sdf_joint.h"

#include <limits>
#include <map>

#include "sdf_values.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

constexpr double kTurn = 6.283185307179586;
/// In SDF this means that there is no limit.
constexpr double kNoLimit = 1e16;

void check_dynamics(const AxisSpec& spec, const std::string& what) {
  const std::pair<const char*, double> values[] = {{"damping", spec.damping},
                                                   {"friction", spec.friction},
                                                   {"spring_stiffness", spec.spring_stiffness}};
  for (const auto& [name, value] : values) {
    if (std::isfinite(value) && value >= 0.0) continue;
    throw Error(what + ": <" + name + "> is " + std::to_string(value) +
                ", must be finite and >= 0");
  }
  if (!std::isfinite(spec.spring_reference)) {
    throw Error(what + ": <spring_reference> is " + std::to_string(spec.spring_reference) +
                ", must be finite");
  }
}

AxisSpec convert_axis(const sdf::Joint& from, unsigned int index, const std::string& what) {
  const sdf::JointAxis* axis = from.Axis(index);
  if (axis == nullptr) throw Error(what + ": has no " + (index == 0 ? "<axis>" : "<axis2>"));
  ignition::math::Vector3d direction;
  const sdf::Errors errors = axis->ResolveXyz(direction, "__model__");
  if (!errors.empty()) throw Error(what + ": " + errors.front().Message());
  AxisSpec spec;
  spec.axis_model = to_eigen(direction).normalized();
  if (axis->Lower() > -kNoLimit) spec.lower = axis->Lower();
  if (axis->Upper() < kNoLimit) spec.upper = axis->Upper();
  if (spec.lower > spec.upper) {
    throw Error(what + ": lower limit " + std::to_string(spec.lower) + " is above upper limit " +
                std::to_string(spec.upper));
  }
  spec.effort = axis->Effort();
  spec.velocity = axis->MaxVelocity();
  spec.damping = axis->Damping();
  spec.friction = axis->Friction();
  spec.spring_stiffness = axis->SpringStiffness();
  spec.spring_reference = axis->SpringReference();
  check_dynamics(spec, what);
  return spec;
}

void convert_axes(const sdf::Joint& from, const std::string& what, const Eigen::Quaterniond& R,
                  JointSpec& joint) {
  static_cast<AxisSpec&>(joint) = convert_axis(from, 0, what);
  const bool has_two = joint.type == JointType::kUniversal || joint.type == JointType::kGearbox;
  if (has_two) joint.axis2 = convert_axis(from, 1, what);
  if (from.Type() == sdf::JointType::CONTINUOUS) {
    joint.lower = -std::numeric_limits<double>::infinity();
    joint.upper = std::numeric_limits<double>::infinity();
  }
  const auto limit = descend(from.Element(), {"physics", "ode", "limit"});
  for (AxisSpec* axis : {static_cast<AxisSpec*>(&joint), &joint.axis2}) {
    axis->axis_model = R * axis->axis_model;
    if (limit == nullptr) continue;
    axis->stop_erp = number_if_given(limit, "erp", what);
    axis->stop_cfm = number_if_given(limit, "cfm", what);
  }
}

/// Metres per turn. SDF 1.10's <screw_thread_pitch> is that; older files have <thread_pitch>, in
/// radians per metre and positive for a left-handed thread.
double convert_pitch(const sdf::Joint& from, const std::string& what) {
  const auto element = from.Element();
  const bool is_metric = element && element->HasElement("screw_thread_pitch");
  const char* name = is_metric ? "screw_thread_pitch" : "thread_pitch";
  const double value =
      is_metric ? value_or(element, {"screw_thread_pitch"}, 0.0) : from.ThreadPitch();
  const double pitch_m = is_metric ? value : -kTurn / value;
  if (std::abs(pitch_m) >= 1e-6 && std::abs(pitch_m) <= 1e3) return pitch_m;
  throw Error(what + ": <" + name + "> is " + std::to_string(value) +
              ", must be a travel of 1e-6 to 1e3 m per turn, of either sign");
}

void convert_gearbox(const sdf::Joint& from, const std::string& prefix, const std::string& what,
                     JointSpec& joint) {
  const auto element = from.Element();
  joint.gearbox_ratio = value_or(element, {"gearbox_ratio"}, joint.gearbox_ratio);
  const double size = std::abs(joint.gearbox_ratio);
  if (!(size >= 1e-3 && size <= 1e3)) {
    throw Error(what + ": <gearbox_ratio> is " + std::to_string(joint.gearbox_ratio) +
                ", must be 1e-3 to 1e3, of either sign");
  }
  const auto body = value_or(element, {"gearbox_reference_body"}, std::string());
  if (body.empty()) throw Error(what + ": has no <gearbox_reference_body>, legal: a link or world");
  joint.gearbox_reference_body = body == "world" ? body : prefix + body;
}

void convert_ends(const sdf::Joint& from, const std::string& prefix, const std::string& what,
                  JointSpec& joint) {
  std::string parent, child;
  if (!from.ResolveParentLink(parent).empty() || !from.ResolveChildLink(child).empty()) {
    throw Error(what + ": parent '" + from.ParentLinkName() + "' or child '" +
                from.ChildLinkName() + "' is not a link of the model");
  }
  joint.parent = parent == "world" ? parent : prefix + parent;
  joint.child = prefix + child;
}

JointType convert_type(sdf::JointType type, const std::string& what) {
  // A continuous joint is a revolute one, whose limits sdformat has set to be infinite.
  static const std::map<sdf::JointType, JointType> kKnown{
      {sdf::JointType::FIXED, JointType::kFixed},
      {sdf::JointType::REVOLUTE, JointType::kRevolute},
      {sdf::JointType::CONTINUOUS, JointType::kRevolute},
      {sdf::JointType::PRISMATIC, JointType::kPrismatic},
      {sdf::JointType::BALL, JointType::kBall},
      {sdf::JointType::UNIVERSAL, JointType::kUniversal},
      {sdf::JointType::SCREW, JointType::kScrew},
      {sdf::JointType::GEARBOX, JointType::kGearbox}};
  const auto known = kKnown.find(type);
  if (known != kKnown.end()) return known->second;
  throw Error(what +
              ": type is not supported (legal: fixed, revolute, continuous, prismatic, "
              "ball, universal, screw, gearbox)");
}

}  // namespace

JointSpec convert_joint(const sdf::Joint& from, const std::string& prefix, const SE3& T_root_model,
                        const ConvertContext& context) {
  JointSpec joint;
  joint.name = prefix + from.Name();
  const std::string what = context.label + ": joint '" + joint.name + "'";
  joint.type = convert_type(from.Type(), what);
  convert_ends(from, prefix, what, joint);
  joint.T_model_joint = T_root_model * resolve(from.SemanticPose(), "__model__", what);
  if (joint.type != JointType::kFixed && joint.type != JointType::kBall) {
    convert_axes(from, what, T_root_model.R, joint);
  }
  if (joint.type == JointType::kScrew) joint.screw_pitch_m = convert_pitch(from, what);
  if (joint.type == JointType::kGearbox) convert_gearbox(from, prefix, what, joint);
  return joint;
}

}  // namespace trident::sim
