// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/plugins/joint_states.h"
#include "core/plugins/rate_ticker.h"
#include "drive_parts.h"
#include "trident_base/angle.h"
#include "trident_base/vehicle/diff_drive_odometry.h"
#include "trident_sim/plugin_registry.h"
#include "velocity_command.h"

namespace trident::sim {
namespace {

/// libgazebo_ros_tricycle_drive.so: one wheel that is steered and driven, two that only roll and
/// may measure. linear.x of the command is the speed of the driven wheel's rim [m/s], angular.z the
/// steering angle [rad], as upstream. <wheelAcceleration> counts at the rim [m/s^2].
class TricycleDrive : public Plugin {
 public:
  explicit TricycleDrive(const PluginContext& context)
      : model_(required_model(context)),
        ticker_(context.params.number("updateRate", 100.0, kNotNegative)),
        steering_(read_steering(context)),
        left_(motor_joint(context, "encoderWheelLeftJoint", "left_wheel_joint")),
        right_(motor_joint(context, "encoderWheelRightJoint", "right_wheel_joint")),
        wheel_(motor_joint(context, "actuatedWheelJoint", "front_wheel_joint"),
               context.params.number("actuatedWheelDiameter", 0.15, kLength),
               steering_.torque_limit,
               context.params.number("wheelAcceleration", 0.0, kNotNegative)),
        command_(context, read_command_topic(context.params)),
        limit_(wheel_speed_limit(context.params.owner())),
        from_encoders_(is_second_choice(context.params, "odometrySource", "world", "encoder")),
        odometry_({context.params.number("encoderWheelSeparation", 0.5, kLength),
                   0.5 * context.params.number("encoderWheelDiameter", 0.15, kLength), 0.0}),
        output_(context,
                read_odometry_names(context, FramePrefix::kTfPrefixOrNamespace, "base_link"), true,
                true) {
    output_.set_covariance(planar_covariance(1e-5, 1e-5, 1e-3), {});
    Joint& driven = motor_joint(context, "actuatedWheelJoint", "front_wheel_joint");
    const std::vector<Joint*> all{steering_.joint, &driven, &left_, &right_};
    if (context.params.flag("publishWheelJointState", false)) {
      states_.emplace(context, scoped_topic(context.params, "joint_states"), all);
    }
    if (context.params.flag("publishWheelTF", false)) {
      frames_.emplace(context, all, FramePrefix::kTfPrefixOrNamespace);
    }
    read_encoders();
  }

  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    is_due_ = ticker_.tick(info);
    if (is_due_) {
      command_.poll(world);
      const double speed = command_.command().v_base.x();
      wheel_.set_speed(speed *
                       limit_.factor(world, speed, wheel_.speed_limit(), command_.is_new()));
    }
    wheel_.drive(info.dt_s);
    const double angle = std::clamp(command_.command().w_base.z(), -0.5 * kPi, 0.5 * kPi);
    steering_.aim(angle, info.dt_s);
  }

  void post_step(const World& world, const StepInfo& info) override {
    const Eigen::Vector2d before = encoders_;
    read_encoders();
    odometry_.update(encoders_[0] - before[0], encoders_[1] - before[1]);
    if (!is_due_) return;
    if (output_.wanted()) output_.publish(info.end, measured());
    if (states_) states_->publish(world, info.end);
    if (frames_) frames_->publish(info.end);
  }

  void reset() override {
    ticker_.reset();
    command_.reset();
    wheel_.reset();
    odometry_.reset();
    read_encoders();
    is_due_ = false;
  }
  void state(StateArchive& archive) override {
    ticker_.state(archive);
    command_.state(archive);
    wheel_.state(archive);
    archive(odometry_, encoders_, is_due_);
  }

 private:
  static Steering read_steering(const PluginContext& context) {
    const PluginParams& params = context.params;
    return {&motor_joint(context, "steeringJoint", "front_steering_joint"),
            params.number("wheelTorque", 5.0, kNotNegative),
            params.number("steeringSpeed", 0.0, kNotNegative),
            params.number("steeringAngleTolerance", 0.01, kNotNegative)};
  }
  void read_encoders() { encoders_ = {left_.position(), right_.position()}; }

  BaseState measured() const {
    if (!from_encoders_) return base_state_in_world(model_);
    const DiffDriveOdometryParams& params = odometry_.params();
    const double left = params.wheel_radius_m * left_.velocity();
    const double right = params.wheel_radius_m * right_.velocity();
    BaseState state;
    state.T_odom_base = odometry_.T_odom_base().to_se3();
    state.v_base.x() = 0.5 * (left + right);
    state.w_base.z() = (right - left) / params.wheel_separation_m;
    return state;
  }

  const Model& model_;
  RateTicker ticker_;
  Steering steering_;
  Joint &left_, &right_;
  DrivenWheel wheel_;
  VelocityInput command_;
  CommandLimit limit_;
  bool from_encoders_;
  DiffDriveOdometry odometry_;
  OdometryOutput output_;
  std::optional<JointStates> states_;
  std::optional<WheelFrames> frames_;
  Eigen::Vector2d encoders_ = Eigen::Vector2d::Zero();  ///< left, right [rad]
  bool is_due_ = false;
};

const PluginRegistrar kGazeboRosTricycleDrive(
    "libgazebo_ros_tricycle_drive.so", factory_of<TricycleDrive>(),
    PluginExample{
        "<steeringJoint>rotor_0_joint</steeringJoint>"
        "<actuatedWheelJoint>rotor_2_joint</actuatedWheelJoint>"
        "<encoderWheelLeftJoint>rotor_1_joint</encoderWheelLeftJoint>"
        "<encoderWheelRightJoint>rotor_3_joint</encoderWheelRightJoint>",
        {},
        {"actuatedWheelDiameter", "encoderWheelDiameter", "encoderWheelSeparation", "wheelTorque",
         "wheelAcceleration", "steeringSpeed", "steeringAngleTolerance", "updateRate"}});

}  // namespace

}  // namespace trident::sim
