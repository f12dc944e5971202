// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ackermann_params.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "trident_base/angle.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

/// The plugin is one of ROS 2, whose elements have underscores; people who bring it to ROS 1 write
/// them as its siblings there: odometry_frame, odometryFrame.
class Elements {
 public:
  explicit Elements(const PluginContext& context) : context_(context), params_(context.params) {}

  std::string key(const std::string& name) const {
    std::string camel;
    for (std::size_t i = 0; i < name.size(); ++i) {
      const bool joint = name[i] == '_' && i + 1 < name.size();
      camel += joint ? static_cast<char>(std::toupper(name[++i])) : name[i];
    }
    return !params_.has(name) && params_.has(camel) ? camel : name;
  }
  double number(const std::string& name, double fallback, Limits limits) const {
    return params_.number(key(name), fallback, limits);
  }
  bool flag(const std::string& name, bool fallback) const {
    return params_.flag(key(name), fallback);
  }
  std::string text(const std::string& name, const char* fallback) const {
    return params_.text(key(name), fallback);
  }
  Joint& joint(const std::string& name) const { return joint_or(context_, key(name), name); }
  Joint& motor(const std::string& name) const { return motor_joint(context_, key(name), name); }
  bool second(const std::string& name, const char* first, const char* second) const {
    return is_second_choice(params_, key(name), first, second);
  }

  /// "p i d" of <name_pid_gain>, with the limits of the integral's effort in <name_i_range>.
  std::optional<PidGains> gains(const std::string& name) const {
    const std::string element = key(name + "_pid_gain");
    if (!params_.has(element)) return std::nullopt;
    const Eigen::Vector3d pid = params_.vector3(element, Eigen::Vector3d::Zero());
    if (pid.minCoeff() < 0.0) params_.refuse(element, params_.text(element, ""), "gains >= 0");
    PidGains gains;
    gains.p = pid[0];
    gains.i = pid[1];
    gains.d = pid[2];
    gains.integral_limit = integral_limit(key(name + "_i_range"));
    return gains;
  }

  struct Remapping {
    std::string topic, space;
  };

  /// What an element of <ros> makes of the topic `name`.
  static void apply(const ParamNode& element, const std::string& name, Remapping& remapping) {
    std::istringstream words(element.text);
    std::string text;
    words >> text;
    if (element.name == "namespace") remapping.space = text;
    const bool is_rule = element.name == "remapping" || element.name == "argument";
    const std::string rule = name + ":=";
    if (is_rule && starts_with(text, rule)) remapping.topic = text.substr(rule.size());
  }

  /// Topic `name`, or what <ros><remapping>name:=other</remapping></ros> makes of it.
  std::string topic(const std::string& element, const std::string& name) const {
    Remapping remapping{params_.text(key(element), name), ""};
    if (const ParamNode* ros = params_.node("ros")) {
      for (const ParamNode& child : ros->children) apply(child, name, remapping);
    }
    const auto& [chosen, space] = remapping;
    const bool is_absolute = !chosen.empty() && chosen.front() == '/';
    if (space.empty() || is_absolute) return scoped_topic(params_, chosen);
    return scoped_topic(params_, space + "/" + chosen);
  }

 private:
  double integral_limit(const std::string& element) const {
    std::istringstream in(params_.text(element, "0 0"));
    double lowest = 0.0, highest = 0.0;
    std::string rest;
    if (!(in >> lowest >> highest) || in >> rest || lowest > 0.0 || highest < 0.0) {
      params_.refuse(element, params_.text(element, ""), "two numbers about 0, the lower first");
    }
    // PidGains has one limit for both signs: the wider one counts.
    return std::max(-lowest, highest);
  }

  const PluginContext& context_;
  const PluginParams& params_;
};

Eigen::Vector2d place(const Joint& joint) { return joint.spec.T_model_joint.p.head<2>(); }
Eigen::Vector2d middle(const std::array<Joint*, 2>& pair) {
  return 0.5 * (place(*pair[0]) + place(*pair[1]));
}

/// Of the first round collision of the link.
double radius_of(const Model& model, const std::string& link_name) {
  for (const LinkSpec& link : model.spec.links) {
    if (link.name != link_name) continue;
    for (const CollisionSpec& collision : link.collisions) {
      if (const auto* ball = std::get_if<SphereShape>(&collision.shape)) return ball->radius;
      if (const auto* disc = std::get_if<CylinderShape>(&collision.shape)) return disc->radius;
    }
  }
  return 0.0;
}

/// A steered joint turns, by a motor or, of a universal joint, by a controller with gains.
void check_steering(const Elements& elements, const PluginContext& context, const std::string& name,
                    const Joint& joint, bool has_gains) {
  const bool has_motor = joint.spec.type == JointType::kRevolute;
  const bool has_axis = has_motor || joint.spec.type == JointType::kUniversal;
  if (joint.ode == nullptr || !has_axis) {
    context.params.refuse(elements.key(name + "_joint"), joint.spec.name,
                          "a revolute or universal joint that can turn");
  }
  if (!has_motor && !has_gains) {
    context.params.refuse(elements.key(name + "_pid_gain"), "",
                          "gains, because joint '" + joint.spec.name + "' is universal");
  }
}

void read_joints(const Elements& elements, const PluginContext& context, AckermannSpec& spec) {
  spec.front = {&elements.joint("front_left_joint"), &elements.joint("front_right_joint")};
  spec.rear = {&elements.motor("rear_left_joint"), &elements.motor("rear_right_joint")};
  spec.steering = {&elements.joint("left_steering_joint"), &elements.joint("right_steering_joint")};
  const char* const names[] = {"left", "right"};
  for (const std::size_t side : {0u, 1u}) {
    const std::string name = std::string(names[side]) + "_steering";
    spec.steering_gains[side] = elements.gains(name);
    check_steering(elements, context, name, *spec.steering[side],
                   spec.steering_gains[side].has_value());
  }
  // Upstream warns of a missing one; here it is one more element that may be left out.
  if (context.params.has(elements.key("steering_wheel_joint"))) {
    spec.steering_wheel = &elements.motor("steering_wheel_joint");
  }
}

/// Reports a length in the file that is not that of the joints, which counts, as upstream.
void compare(const Elements& elements, const PluginContext& context, const std::string& name,
             double actual) {
  const double given = elements.number(name, actual, kLength);
  if (std::abs(given - actual) <= 0.01 * actual) return;
  context.world.diagnose({Severity::kWarning,
                          context.params.owner(),
                          elements.key(name) + " differs",
                          "<" + elements.key(name) + "> is " + std::to_string(given) +
                              " m, but the wheels' joints are " + std::to_string(actual) +
                              " m apart, which counts",
                          {{"value", std::to_string(given)}, {"used", std::to_string(actual)}}});
}

void read_geometry(const Elements& elements, const PluginContext& context, AckermannSpec& spec) {
  const Eigen::Vector2d ahead = middle(spec.front) - middle(spec.rear);
  const Eigen::Vector2d left = place(*spec.front[0]) - place(*spec.front[1]);
  const Eigen::Vector2d rear = place(*spec.rear[0]) - place(*spec.rear[1]);
  spec.geometry = {ahead.norm(), left.norm(), rear.norm()};
  validate(spec.geometry);
  // The z of (ahead x left) is positive if left really is on the left.
  if (ahead.x() * left.y() - ahead.y() * left.x() < 0.0) {
    context.params.refuse(elements.key("front_left_joint"), spec.front[0]->spec.name,
                          "the joint on the left when it drives ahead");
  }
  spec.T_base_axle = SE2::from_xy_yaw(middle(spec.rear).x(), middle(spec.rear).y(),
                                      std::atan2(ahead.y(), ahead.x()));
  compare(elements, context, "wheel_base", spec.geometry.wheelbase_m);
  compare(elements, context, "track_width", spec.geometry.front_track_m);
  const double found = radius_of(*context.model, spec.rear[1]->child->name);
  const double fallback = found > 0.0 ? found : 0.0;
  spec.wheel_radius_m = elements.number("wheel_radius", fallback, {0.0, 1e6});
  if (spec.wheel_radius_m <= 0.0) {
    context.params.refuse(elements.key("wheel_radius"), std::to_string(spec.wheel_radius_m),
                          "a length > 0, because the rear wheels have no round collision");
  }
}

/// Bounded so that the inner wheel reaches its angle within the limits of its joint.
void read_steering(const Elements& elements, const PluginContext& context, AckermannSpec& spec) {
  spec.max_steer_rad = elements.number("max_steer", 0.6, {1e-6, 1.5});
  // Just below a quarter turn, where the tangent is infinite.
  double inner = 1.57;
  for (const Joint* joint : spec.steering) {
    inner = std::min({inner, joint->axes[0].spec.upper, -joint->axes[0].spec.lower});
  }
  if (inner < 1e-3) {
    context.params.refuse(elements.key("left_steering_joint"), spec.steering[0]->spec.name,
                          "joints that can turn to both sides");
  }
  const double possible = spec.geometry.steering_of_inner(inner);
  if (spec.max_steer_rad > possible + 1e-6) {
    const std::string given = std::to_string(spec.max_steer_rad), used = std::to_string(possible);
    context.world.diagnose({Severity::kWarning,
                            context.params.owner(),
                            "max_steer clamped",
                            "<" + elements.key("max_steer") + "> is " + given +
                                " rad, but the limit of the inner " +
                                "wheel's steering joint allows " + used + " rad, which counts",
                            {{"value", given}, {"legal", "(0, " + used + "] rad"}}});
    spec.max_steer_rad = possible;
  }
  const double of_wheel = elements.number("max_steering_angle", 7.85, {1e-6, 1e3});
  spec.steering_wheel_ratio = spec.max_steer_rad / of_wheel;
  spec.steering_speed = elements.number("steering_speed", 0.0, kNotNegative);
  spec.steering_torque = elements.number("steering_torque", 1e3, kNotNegative);
}

void read_outputs(const Elements& elements, const PluginContext& context, AckermannSpec& spec) {
  const auto frame = [&](const char* key, const char* fallback) {
    return resolved_frame(context, elements.text(key, fallback), FramePrefix::kTfPrefix);
  };
  spec.command_topic = elements.topic("command_topic", "cmd_vel");
  spec.distance_topic = elements.topic("distance_topic", "distance");
  spec.odometry = {elements.topic("odometry_topic", "odom"), frame("odometry_frame", "odom"),
                   frame("robot_base_frame", "base_footprint")};
  spec.with_odometry = elements.flag("publish_odom", false);
  spec.with_odometry_transform = elements.flag("publish_odom_tf", false);
  spec.with_wheel_transforms = elements.flag("publish_wheel_tf", false);
  spec.with_distance = elements.flag("publish_distance", false);
  spec.with_joint_states = elements.flag("publish_joint_states", false);
  spec.from_encoders = elements.second("odometry_source", "world", "encoder");
  spec.encoders = {spec.geometry.wheelbase_m, spec.wheel_radius_m,
                   elements.number("encoder_error_per_meter", 0.0, kNotNegative),
                   elements.number("encoder_turn_error_per_meter", 0.0, kNotNegative)};
  spec.covariance_x = elements.number("covariance_x", 1e-5, kNotNegative);
  spec.covariance_y = elements.number("covariance_y", 1e-5, kNotNegative);
  spec.covariance_yaw = elements.number("covariance_yaw", 1e-3, kNotNegative);
}

}  // namespace

AckermannSpec read_ackermann(const PluginContext& context) {
  required_model(context);
  const Elements elements(context);
  AckermannSpec spec;
  read_joints(elements, context, spec);
  read_geometry(elements, context, spec);
  read_steering(elements, context, spec);
  read_outputs(elements, context, spec);
  spec.rate_hz = elements.number("update_rate", 100.0, kNotNegative);
  spec.max_speed = elements.number("max_speed", 20.0, {1e-6, 1e6});
  spec.speed_gains = elements.gains("linear_velocity");
  spec.drive_torque = elements.number("drive_torque", 1e3, kNotNegative);
  spec.acceleration = elements.number("acceleration", 0.0, kNotNegative);
  spec.turn_is_yaw_rate = elements.second("angular_command", "steering", "yaw_rate");
  return spec;
}

}  // namespace trident::sim
