// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/plugins/joint_states.h"
#include "core/plugins/rate_ticker.h"
#include "drive_parts.h"
#include "trident_base/vehicle/diff_drive_odometry.h"
#include "trident_sim/plugin_registry.h"
#include "velocity_command.h"

namespace trident::sim {
namespace {

/// What a drive with a left and a right side is made of.
struct DifferentialSpec {
  std::vector<Joint*> left, right;
  double separation_m = 0.0, diameter_m = 0.0;
  double torque_limit = 0.0;  ///< of one wheel [N m]
  double acceleration = 0.0;  ///< at the rim [m/s^2]; 0: at once
  double rate_hz = 0.0;
  std::string command_topic, joint_states_topic;
  double command_timeout_s = -1.0;  ///< after which it stands; negative: never
  OdometryNames odometry;
  FramePrefix frame_prefix = FramePrefix::kTfPrefix;
  bool with_odometry_topic = true, with_odometry_transform = true;
  bool with_wheel_transforms = false, with_joint_states = false;
  bool from_encoders = false;
  double encoder_variance_m = 0.0;  ///< 0: the covariance is `covariance`
  Covariance6 covariance{};
};

std::vector<Joint*> wheels_of(const DifferentialSpec& spec) {
  std::vector<Joint*> all = spec.left;
  all.insert(all.end(), spec.right.begin(), spec.right.end());
  return all;
}

/// Wheels on two sides, whose motors turn each side at a rate of its own: what the vehicle then
/// does is up to the friction between its wheels and the ground.
class DifferentialDrive : public Plugin {
 public:
  DifferentialDrive(const PluginContext& context, const DifferentialSpec& spec)
      : model_(required_model(context)),
        spec_(spec),
        ticker_(spec.rate_hz),
        command_(context, spec.command_topic, spec.command_timeout_s),
        limit_(wheel_speed_limit(context.params.owner())),
        output_(context, spec.odometry, spec.with_odometry_topic, spec.with_odometry_transform),
        odometry_({spec.separation_m, 0.5 * spec.diameter_m, spec.encoder_variance_m}) {
    for (Joint* joint : wheels_of(spec)) {
      wheels_.emplace_back(*joint, spec.diameter_m, spec.torque_limit, spec.acceleration);
    }
    output_.set_covariance(spec.covariance, {});
    if (spec.with_joint_states) {
      joint_states_.emplace(context, spec.joint_states_topic, wheels_of(spec));
    }
    if (spec.with_wheel_transforms) {
      wheel_frames_.emplace(context, wheels_of(spec), spec.frame_prefix);
    }
    read_encoders();
  }

  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    is_due_ = ticker_.tick(info);
    if (is_due_) {
      command_.poll(world);
      set_speeds(world);
    }
    for (DrivenWheel& wheel : wheels_) wheel.drive(info.dt_s);
  }

  void post_step(const World& world, const StepInfo& info) override {
    if (spec_.from_encoders) {
      const Eigen::Vector2d before = encoders_;
      read_encoders();
      odometry_.update(encoders_[0] - before[0], encoders_[1] - before[1]);
    }
    if (!is_due_) return;
    if (output_.wanted()) publish_odometry(info.end);
    if (joint_states_) joint_states_->publish(world, info.end);
    if (wheel_frames_) wheel_frames_->publish(info.end);
  }

  void reset() override {
    ticker_.reset();
    command_.reset();
    odometry_.reset();
    for (DrivenWheel& wheel : wheels_) wheel.reset();
    read_encoders();
    is_due_ = false;
  }

  void state(StateArchive& archive) override {
    ticker_.state(archive);
    command_.state(archive);
    for (DrivenWheel& wheel : wheels_) wheel.state(archive);
    archive(odometry_, encoders_, is_due_);
  }

 private:
  void set_speeds(World& world) {
    // Rim speeds v -+ w s / 2 of the left and the right side.
    const double ahead = command_.command().v_base.x();
    const double aside = 0.5 * spec_.separation_m * command_.command().w_base.z();
    const double fastest = std::max(std::abs(ahead - aside), std::abs(ahead + aside));
    // The slowest wheel limits all: one factor for both sides keeps the curvature of the path.
    double limit = wheels_.front().speed_limit();
    for (const DrivenWheel& wheel : wheels_) limit = std::min(limit, wheel.speed_limit());
    const double factor = limit_.factor(world, fastest, limit, command_.is_new());
    if (command_.is_over()) {
      for (DrivenWheel& wheel : wheels_) wheel.halt();
      return;
    }
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const bool is_left = i < spec_.left.size();
      wheels_[i].set_speed(factor * (is_left ? ahead - aside : ahead + aside));
    }
  }

  static double mean(const std::vector<Joint*>& joints, double (Joint::*of)(std::size_t) const) {
    double sum = 0.0;
    for (const Joint* joint : joints) sum += (joint->*of)(0);
    return sum / static_cast<double>(joints.size());
  }

  void read_encoders() {
    encoders_ = {mean(spec_.left, &Joint::position), mean(spec_.right, &Joint::position)};
  }

  void publish_odometry(SimTime stamp) {
    if (!spec_.from_encoders) {
      output_.publish(stamp, base_state_in_world(model_));
      return;
    }
    const double radius = 0.5 * spec_.diameter_m;
    const double left = radius * mean(spec_.left, &Joint::velocity);
    const double right = radius * mean(spec_.right, &Joint::velocity);
    BaseState state;
    state.T_odom_base = odometry_.T_odom_base().to_se3();
    // Forward kinematics of a differential drive whose wheels do not slip.
    state.v_base.x() = 0.5 * (left + right);
    state.w_base.z() = (right - left) / spec_.separation_m;
    if (spec_.encoder_variance_m > 0.0) output_.set_planar_covariance(odometry_.covariance());
    output_.publish(stamp, state);
  }

  const Model& model_;
  DifferentialSpec spec_;
  RateTicker ticker_;
  VelocityInput command_;
  CommandLimit limit_;
  OdometryOutput output_;
  DiffDriveOdometry odometry_;
  std::vector<DrivenWheel> wheels_;
  std::optional<JointStates> joint_states_;
  std::optional<WheelFrames> wheel_frames_;
  Eigen::Vector2d encoders_ = Eigen::Vector2d::Zero();  ///< left, right [rad]
  bool is_due_ = false;
};

/// What the drives read alike.
DifferentialSpec read_common(const PluginContext& context, FramePrefix from, double separation_m) {
  const PluginParams& params = context.params;
  DifferentialSpec spec;
  spec.frame_prefix = from;
  spec.separation_m = params.number("wheelSeparation", separation_m, kLength);
  spec.diameter_m = params.number("wheelDiameter", 0.15, kLength);
  spec.rate_hz = params.number("updateRate", 100.0, kNotNegative);
  spec.command_topic = read_command_topic(params);
  spec.joint_states_topic = scoped_topic(params, "joint_states");
  spec.odometry = read_odometry_names(context, from);
  return spec;
}

double side_of(const Joint& joint) { return joint.spec.T_model_joint.p.y(); }

/// In <legacyMode> leftJoint is the one on the right. Upstream takes that for granted where the
/// element is missing; here the places of the wheels decide.
bool sides_are_swapped(const PluginContext& context, const Joint& left, const Joint& right) {
  if (context.params.has("legacyMode")) return context.params.flag("legacyMode", true);
  const bool swapped = side_of(left) < side_of(right);
  context.world.report(Severity::kWarning,
                       context.params.owner() + ": <legacyMode> is missing; taken as " +
                           (swapped ? "true" : "false") + ", because joint '" + left.spec.name +
                           "' is on the " + (swapped ? "right" : "left"));
  return swapped;
}

/// libgazebo_ros_diff_drive.so. In addition to upstream's elements there are <encoderErrorPerMeter>
/// [m^2/m], the variance of a wheel's travel, from which the covariance of the encoders' odometry
/// grows (0, as upstream, reports upstream's constants), and <commandTimeout> [s], after which a
/// command is over and the wheels brake (negative, as upstream: never).
DifferentialSpec read_diff_drive(const PluginContext& context) {
  const PluginParams& params = context.params;
  DifferentialSpec spec = read_common(context, FramePrefix::kTfPrefixOrNamespace, 0.34);
  Joint& left = motor_joint(context, "leftJoint", "left_joint");
  Joint& right = motor_joint(context, "rightJoint", "right_joint");
  if (&left == &right) params.refuse("rightJoint", right.spec.name, "another joint than leftJoint");
  const bool swapped = sides_are_swapped(context, left, right);
  spec.left = {swapped ? &right : &left};
  spec.right = {swapped ? &left : &right};
  spec.torque_limit = params.number("wheelTorque", 5.0, kNotNegative);
  spec.acceleration = params.number("wheelAcceleration", 0.0, kNotNegative);
  // Upstream's <publishTf> switches the odometry topic and the transform together.
  spec.with_odometry_topic = params.flag("publishTf", true);
  spec.with_odometry_transform = spec.with_odometry_topic && params.flag("publishOdomTF", true);
  spec.with_wheel_transforms = params.flag("publishWheelTF", false);
  spec.with_joint_states = params.flag("publishWheelJointState", false);
  spec.from_encoders = is_second_choice(params, "odometrySource", "world", "encoder");
  spec.encoder_variance_m = params.number("encoderErrorPerMeter", 0.0, kNotNegative);
  spec.command_timeout_s = params.number("commandTimeout", -1.0);
  spec.covariance = planar_covariance(1e-5, 1e-5, 1e-3);
  return spec;
}

/// libgazebo_ros_skid_steer_drive.so.
DifferentialSpec read_skid_steer(const PluginContext& context) {
  const PluginParams& params = context.params;
  DifferentialSpec spec = read_common(context, FramePrefix::kTfPrefix, 0.4);
  spec.left = {&motor_joint(context, "leftFrontJoint", "left_front_joint"),
               &motor_joint(context, "leftRearJoint", "left_rear_joint")};
  spec.right = {&motor_joint(context, "rightFrontJoint", "right_front_joint"),
                &motor_joint(context, "rightRearJoint", "right_rear_joint")};
  spec.torque_limit = params.number("torque", 5.0, kNotNegative);
  spec.with_odometry_transform = params.flag("broadcastTF", false);
  spec.covariance = planar_covariance(params.number("covariance_x", 1e-4, kNotNegative),
                                      params.number("covariance_y", 1e-4, kNotNegative),
                                      params.number("covariance_yaw", 0.01, kNotNegative));
  return spec;
}

/// libgazebo_ros_kobuki.so: TurtleBot 2's base. Its sensors are not here.
DifferentialSpec read_kobuki(const PluginContext& context) {
  const PluginParams& params = context.params;
  DifferentialSpec spec;
  spec.left = {&motor_joint(context, "left_wheel_joint_name", "wheel_left_joint")};
  spec.right = {&motor_joint(context, "right_wheel_joint_name", "wheel_right_joint")};
  spec.separation_m = params.number("wheel_separation", 0.23, kLength);
  spec.diameter_m = params.number("wheel_diameter", 0.07, kLength);
  spec.torque_limit = params.number("torque", 1.0, kNotNegative);
  spec.command_timeout_s = params.number("velocity_command_timeout", 0.6, kNotNegative);
  // The rate at which a Kobuki base reports to its driver.
  spec.rate_hz = 50.0;
  spec.command_topic = scoped_topic(params, "mobile_base/commands/velocity");
  spec.joint_states_topic = scoped_topic(params, "joint_states");
  spec.with_joint_states = true;
  spec.odometry = read_odometry_names(context, FramePrefix::kTfPrefix);
  spec.with_odometry_transform = params.flag("publish_tf", false);
  spec.from_encoders = true;
  spec.covariance = planar_covariance(0.1, 0.1, 0.05);
  return spec;
}

std::unique_ptr<Plugin> make_diff_drive(const PluginContext& context) {
  return std::make_unique<DifferentialDrive>(context, read_diff_drive(context));
}

std::unique_ptr<Plugin> make_kobuki(const PluginContext& context) {
  return std::make_unique<DifferentialDrive>(context, read_kobuki(context));
}

std::unique_ptr<Plugin> make_skid_steer_drive(const PluginContext& context) {
  return std::make_unique<DifferentialDrive>(context, read_skid_steer(context));
}

const PluginRegistrar kGazeboRosDiffDrive(
    "libgazebo_ros_diff_drive.so", {make_diff_drive, {}},
    PluginExample{"<leftJoint>rotor_1_joint</leftJoint><rightJoint>rotor_3_joint</rightJoint>"
                  "<odometrySource>encoder</odometrySource>"
                  "<publishWheelJointState>true</publishWheelJointState>"
                  "<publishWheelTF>true</publishWheelTF>",
                  {},
                  {"wheelSeparation", "wheelDiameter", "wheelAcceleration", "wheelTorque",
                   "updateRate", "encoderErrorPerMeter"}});
const PluginRegistrar kGazeboRosKobuki(
    "libgazebo_ros_kobuki.so", {make_kobuki, {}},
    PluginExample{
        "<left_wheel_joint_name>rotor_1_joint</left_wheel_joint_name>"
        "<right_wheel_joint_name>rotor_3_joint</right_wheel_joint_name><publish_tf>1</publish_tf>",
        {},
        {"wheel_separation", "wheel_diameter", "torque", "velocity_command_timeout"}});
const PluginRegistrar kGazeboRosSkidSteerDrive(
    "libgazebo_ros_skid_steer_drive.so", {make_skid_steer_drive, {}},
    PluginExample{"<leftFrontJoint>rotor_0_joint</leftFrontJoint>"
                  "<leftRearJoint>rotor_1_joint</leftRearJoint>"
                  "<rightFrontJoint>rotor_2_joint</rightFrontJoint>"
                  "<rightRearJoint>rotor_3_joint</rightRearJoint>",
                  {},
                  {"wheelSeparation", "wheelDiameter", "torque", "updateRate", "covariance_x",
                   "covariance_y", "covariance_yaw"}});

}  // namespace

}  // namespace trident::sim
