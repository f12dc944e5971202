// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "ackermann_params.h"
#include "core/plugins/joint_states.h"
#include "core/plugins/rate_ticker.h"
#include "drive_parts.h"
#include "trident_base/angle.h"
#include "trident_sim/plugin_registry.h"
#include "velocity_command.h"

namespace trident::sim {
namespace {

/// Gains with which an explicit step does not feed on itself: they may bring the wheel to its
/// target within a step, but not beyond.
PidGains bounded(PidGains gains, double inertia, double dt_s, DriveMode mode) {
  if (mode == DriveMode::kVelocity) {
    // An effort p e changes the rate by p e dt / I in a step; more than e would overshoot.
    gains.p = std::min(gains.p, inertia / dt_s);
    gains.d = std::min(gains.d, 0.5 * inertia);
  } else {
    // The same effort moves the joint by p e dt^2 / I in a step (semi-implicit Euler).
    gains.p = std::min(gains.p, inertia / (dt_s * dt_s));
    gains.d = std::min(gains.d, inertia / dt_s);
  }
  return gains;
}

/// A drive by efforts that lives as long as its plugin.
class EffortDrive {
 public:
  EffortDrive(World& world, Joint& joint, const PidGains& gains, DriveMode mode)
      : world_(world), joint_(joint) {
    const double dt_s = world.physics().max_step_size_s;
    world.add_drive(joint, {mode, bounded(gains, joint.axes[0].inertia, dt_s, mode), 0.0});
  }
  ~EffortDrive() { world_.remove_drive(joint_); }
  EffortDrive(const EffortDrive&) = delete;
  EffortDrive& operator=(const EffortDrive&) = delete;
  void set_target(double target) {
    // Looked up each time, because others may replace it or take it away.
    if (JointDrive* drive = world_.find_drive(joint_)) drive->set_target(target);
  }

 private:
  World& world_;
  Joint& joint_;
};

/// One steered wheel.
class SteeredWheel {
 public:
  SteeredWheel(World& world, Joint& joint, const AckermannSpec& spec,
               const std::optional<PidGains>& gains)
      : motor_{&joint, spec.steering_torque, spec.steering_speed, 0.0} {
    if (gains) effort_ = std::make_unique<EffortDrive>(world, joint, *gains, DriveMode::kPosition);
  }
  void aim(double target_rad, double dt_s) {
    if (effort_) {
      effort_->set_target(target_rad);
    } else {
      motor_.aim(target_rad, dt_s);
    }
  }
  double angle() const { return motor_.joint->position(0); }

 private:
  Steering motor_;
  std::unique_ptr<EffortDrive> effort_;
};

/// One driven wheel.
class RearWheel {
 public:
  RearWheel(World& world, Joint& joint, const AckermannSpec& spec)
      : wheel_(joint, 2.0 * spec.wheel_radius_m, spec.speed_gains ? 0.0 : spec.drive_torque,
               spec.acceleration) {
    if (!spec.speed_gains) return;
    // The effort replaces the motor that DrivenWheel gave the joint.
    joint.motor.reset();
    effort_ = std::make_unique<EffortDrive>(world, joint, *spec.speed_gains, DriveMode::kVelocity);
  }
  double speed_limit() const { return wheel_.speed_limit(); }
  double angle() const { return wheel_.joint().position(); }
  double rate() const { return wheel_.joint().velocity(); }
  void drive(double rim_speed, double dt_s) {
    if (effort_) {
      effort_->set_target(rim_speed / wheel_.radius_m());
    } else {
      wheel_.set_speed(rim_speed);
      wheel_.drive(dt_s);
    }
  }
  void reset() {
    if (!effort_) wheel_.reset();
  }
  void state(StateArchive& archive) { wheel_.state(archive); }

 private:
  DrivenWheel wheel_;
  std::unique_ptr<EffortDrive> effort_;
};

CommandLimit speed_limit(const std::string& owner) {
  return {owner, {"velocity command clamped", "m/s", "speed", "the speed is cut to <max_speed>"}};
}
CommandLimit steering_limit(const std::string& owner) {
  return {owner, {"steering command clamped", "rad", "steering angle", "it is cut to <max_steer>"}};
}

/// libgazebo_ros_ackermann_drive.so: two steered front wheels, each at its own angle, and two
/// driven rear ones, each at its own speed, so that none of them scrubs. linear.x of the command is
/// the speed of the middle of the rear axle [m/s]; angular.z, as upstream, the steering angle [rad]
/// for a turn to the left, ahead or back, or with <angular_command> yaw_rate a yaw rate [rad/s].
class AckermannDrive : public Plugin {
 public:
  AckermannDrive(const PluginContext& context, const AckermannSpec& spec)
      : model_(*context.model),
        spec_(spec),
        ticker_(spec.rate_hz),
        command_(context, spec.command_topic),
        limits_{speed_limit(context.params.owner()), wheel_speed_limit(context.params.owner()),
                steering_limit(context.params.owner())},
        front_{{context.world, *spec.steering[0], spec, spec.steering_gains[0]},
               {context.world, *spec.steering[1], spec, spec.steering_gains[1]}},
        rear_{{context.world, *spec.rear[0], spec}, {context.world, *spec.rear[1], spec}},
        output_(context, spec.odometry, spec.with_odometry, spec.with_odometry_transform),
        odometry_(spec.encoders) {
    const Covariance6 covariance =
        planar_covariance(spec.covariance_x, spec.covariance_y, spec.covariance_yaw);
    output_.set_covariance(covariance, covariance);
    if (spec.with_distance) {
      distance_ = advertise<ScalarSample>(context, spec.distance_topic, PortRank::kState);
    }
    if (spec.with_joint_states) {
      states_.emplace(context, scoped_topic(context.params, "joint_states"), joints());
    }
    if (spec.with_wheel_transforms) frames_.emplace(context, joints(), FramePrefix::kTfPrefix);
    remember();
  }

  std::vector<Phase> phases() const override { return {Phase::kControl, Phase::kPost}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    is_due_ = ticker_.tick(info);
    if (is_due_) {
      command_.poll(world);
      take_command(world);
    }
    const Eigen::Vector2d angles = spec_.geometry.wheel_angles(wanted_.steering);
    front_.left.aim(angles[0], info.dt_s);
    front_.right.aim(angles[1], info.dt_s);
    // For the measured angle, not the wanted one: the rear wheels must not scrub while the front
    // wheels are still turning to their angles.
    const Eigen::Vector2d speeds = spec_.geometry.rear_speeds(wanted_.speed, steering());
    rear_.left.drive(speeds[0], info.dt_s);
    rear_.right.drive(speeds[1], info.dt_s);
    if (spec_.steering_wheel != nullptr) {
      const double turn =
          0.5 * (front_.left.angle() + front_.right.angle()) / spec_.steering_wheel_ratio;
      Steering{spec_.steering_wheel, spec_.steering_torque, 0.0, 0.0}.aim(turn, info.dt_s);
    }
  }

  void post_step(const World& world, const StepInfo& info) override {
    const double before = travel_.wheels_rad;
    const Eigen::Vector2d p_before = travel_.p_world;
    remember();
    odometry_.update(travel_.wheels_rad - before, steering());
    travel_.distance_m += (travel_.p_world - p_before).norm();
    if (!is_due_) return;
    if (output_.wanted()) publish_odometry(info.end);
    if (states_) states_->publish(world, info.end);
    if (frames_) frames_->publish(info.end);
    if (distance_ && distance_->wanted()) {
      distance_->value = {info.end, travel_.distance_m};
      distance_->publish();
    }
  }

  void reset() override {
    ticker_.reset();
    command_.reset();
    odometry_.reset();
    rear_.left.reset();
    rear_.right.reset();
    wanted_.speed = wanted_.steering = travel_.distance_m = 0.0;
    is_due_ = false;
    remember();
  }

  void state(StateArchive& archive) override {
    ticker_.state(archive);
    command_.state(archive);
    rear_.left.state(archive);
    rear_.right.state(archive);
    archive(odometry_, wanted_.speed, wanted_.steering, travel_.distance_m, travel_.wheels_rad,
            travel_.p_world, is_due_);
  }

 private:
  std::vector<Joint*> joints() const {
    std::vector<Joint*> all;
    for (const auto& pair : {spec_.steering, spec_.front, spec_.rear}) {
      for (Joint* joint : pair) {
        if (std::find(all.begin(), all.end(), joint) == all.end()) all.push_back(joint);
      }
    }
    if (spec_.steering_wheel != nullptr) all.push_back(spec_.steering_wheel);
    return all;
  }

  /// As the front wheels stand.
  double steering() const {
    return spec_.geometry.steering_of(front_.left.angle(), front_.right.angle());
  }

  void remember() {
    travel_.wheels_rad = 0.5 * (rear_.left.angle() + rear_.right.angle());
    travel_.p_world = model_.T_world_model().p.head<2>();
  }

  void take_command(World& world) {
    const bool is_new = command_.is_new();
    const double speed = command_.command().v_base.x();
    // In reverse a turn to the left needs the wheels to the right.
    const double turn = std::copysign(1.0, speed) * command_.command().w_base.z();
    double steering = turn;
    if (spec_.turn_is_yaw_rate) {
      // Bicycle model: tan(steering) = wheelbase * yaw rate / speed. At rest it is a quarter turn,
      // which the limit below cuts.
      steering = std::atan2(spec_.geometry.wheelbase_m * turn, std::abs(speed));
    }
    // The steering angle comes first, because the speeds at the rims depend on it.
    wanted_.steering =
        steering * limits_.steering.factor(world, steering, spec_.max_steer_rad, is_new);
    wanted_.speed = speed * limits_.speed.factor(world, speed, spec_.max_speed, is_new);
    // The faster of the rear wheels, the outer one in a turn, limits the speed of the axle.
    const double rim =
        spec_.geometry.rear_speeds(wanted_.speed, wanted_.steering).cwiseAbs().maxCoeff();
    const double limit = std::min(rear_.left.speed_limit(), rear_.right.speed_limit());
    wanted_.speed *= limits_.wheel.factor(world, rim, limit, is_new);
  }

  void publish_odometry(SimTime stamp) {
    if (!spec_.from_encoders) {
      output_.publish(stamp, base_state_in_world(model_));
      return;
    }
    const SE2& T_base_axle = spec_.T_base_axle;
    BaseState state;
    // The odometry of the axle starts at the axle; that of the base must start at the base.
    state.T_odom_base = (T_base_axle * odometry_.T_odom_axle() * T_base_axle.inverse()).to_se3();
    const double speed = 0.5 * spec_.wheel_radius_m * (rear_.left.rate() + rear_.right.rate());
    // Bicycle model about the middle of the rear axle, which moves along its own x only.
    const double yaw_rate = speed * std::tan(steering()) / spec_.geometry.wheelbase_m;
    const Eigen::Vector3d twist = T_base_axle.adjoint() * Eigen::Vector3d(speed, 0.0, yaw_rate);
    state.v_base = {twist.x(), twist.y(), 0.0};
    state.w_base.z() = yaw_rate;
    if (odometry_.covariance().trace() > 0.0) {
      output_.set_planar_covariance(covariance_of_base());
    }
    output_.publish(stamp, state);
  }

  /// The base is carried by the axle: errors of its heading move the base, and both are seen from
  /// where the base began.
  Eigen::Matrix3d covariance_of_base() const {
    const SE2 T_start_axle = spec_.T_base_axle * odometry_.T_odom_axle();
    const Eigen::Vector2d arm = T_start_axle.rotation() * spec_.T_base_axle.inverse().p;
    Eigen::Matrix3d by_axle = Eigen::Matrix3d::Identity();
    by_axle.topLeftCorner<2, 2>() = spec_.T_base_axle.rotation();
    by_axle(0, 2) = -arm.y();
    by_axle(1, 2) = arm.x();
    return by_axle * odometry_.covariance() * by_axle.transpose();
  }

  struct FrontWheels {
    SteeredWheel left, right;
  };
  struct RearWheels {
    RearWheel left, right;
  };
  struct Limits {
    CommandLimit speed, wheel, steering;
  };
  /// Of the last command.
  struct Wanted {
    double speed = 0.0;     ///< [m/s]
    double steering = 0.0;  ///< [rad]
  };
  struct Travel {
    double wheels_rad = 0.0;  ///< turned by the rear wheels, their mean
    double distance_m = 0.0;
    Eigen::Vector2d p_world = Eigen::Vector2d::Zero();
  };

  const Model& model_;
  AckermannSpec spec_;
  RateTicker ticker_;
  VelocityInput command_;
  Limits limits_;
  FrontWheels front_;
  RearWheels rear_;
  OdometryOutput output_;
  OutHandle<ScalarSample> distance_;
  BicycleOdometry odometry_;
  std::optional<JointStates> states_;
  std::optional<WheelFrames> frames_;
  Wanted wanted_;
  Travel travel_;
  bool is_due_ = false;
};

std::unique_ptr<Plugin> make_ackermann_drive(const PluginContext& context) {
  return std::make_unique<AckermannDrive>(context, read_ackermann(context));
}

const PluginRegistrar kGazeboRosAckermannDrive(
    "libgazebo_ros_ackermann_drive.so", {make_ackermann_drive, {}},
    PluginExample{
        "<front_left_joint>rotor_1_joint</front_left_joint>"
        "<front_right_joint>rotor_0_joint</front_right_joint>"
        "<left_steering_joint>rotor_1_joint</left_steering_joint>"
        "<right_steering_joint>rotor_0_joint</right_steering_joint>"
        "<rear_left_joint>rotor_2_joint</rear_left_joint>"
        "<rear_right_joint>rotor_3_joint</rear_right_joint><wheel_radius>0.1</wheel_radius>"
        "<linear_velocity_pid_gain>1e-3 1e-3 0</linear_velocity_pid_gain>"
        "<odometry_source>encoder</odometry_source><publish_odom>true</publish_odom>"
        "<publish_odom_tf>true</publish_odom_tf><publish_distance>true</publish_distance>",
        {},
        {"wheel_radius", "wheel_base", "track_width", "max_steer", "max_speed",
         "max_steering_angle", "update_rate", "covariance_x", "covariance_yaw", "drive_torque",
         "acceleration", "steering_speed", "encoder_error_per_meter"}});

}  // namespace

}  // namespace trident::sim
