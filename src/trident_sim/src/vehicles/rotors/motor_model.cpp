// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/plugins/plugin_util.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

constexpr double kFastestCommand = 1e6;  ///< [rad/s], of either sign

/// One rotor with its motor: thrust, drag torque, H-force and rolling moment from the present speed
/// (Martin and Salaun 2010), then a first-order lag of the speed towards the command.
/// Speeds in rad/s of the real rotor; its joint turns `slowdown` times slower.
class MotorModel : public Plugin {
 public:
  explicit MotorModel(const PluginContext& context, TopicNaming name_of = robot_topic)
      : joint_(required_joint(context, "jointName")), link_(required_link(context, "linkName")) {
    const PluginParams& params = context.params;
    const Limits positive{1e-12, 1e12}, not_negative{0.0, 1e12};
    motor_number_ = static_cast<std::size_t>(
        params.required_integer("motorNumber", {0, SmallVector::kCapacity - 1}));
    const std::string turning = params.required_text("turningDirection");
    if (turning != "cw" && turning != "ccw")
      params.refuse("turningDirection", turning, "cw or ccw");
    constants_.direction = turning == "ccw" ? 1.0 : -1.0;
    const std::string type = params.text("motorType", "velocity");
    if (type != "velocity") params.refuse("motorType", type, "velocity");
    constants_.rotor_drag = params.number("rotorDragCoefficient", 1.0e-4, not_negative);
    constants_.rolling_moment = params.number("rollingMomentCoefficient", 1.0e-6, not_negative);
    constants_.max_speed = params.number("maxRotVelocity", 838.0, not_negative);
    constants_.motor = params.number("motorConstant", 8.54858e-06, not_negative);
    constants_.moment = params.number("momentConstant", 0.016, not_negative);
    decay_.time_constant_up_s = params.number("timeConstantUp", 1.0 / 80.0, positive);
    decay_.time_constant_down_s = params.number("timeConstantDown", 1.0 / 40.0, positive);
    constants_.slowdown = params.number("rotorVelocitySlowdownSim", 10.0, positive);
    command_ = subscribe<ActuatorCommand>(
        context, name_of(context, params.text("commandSubTopic", "command/motor_speed")));
    wind_ = subscribe<WindSample>(context,
                                  name_of(context, params.text("windSpeedSubTopic", "wind_speed")));
    speed_ = advertise<ScalarSample>(
        context, name_of(context, params.text("motorSpeedPubTopic", "motor_speed")),
        PortRank::kState);
    name_ = params.owner();
    MotorModel::body_frames_moved();
    tilt_.along_body = link_.T_body_link.R * Eigen::Vector3d::UnitZ() - joint_.axis_body;
    tilt_.is_none = tilt_.along_body.isZero(0.0);
  }

  std::vector<Phase> phases() const override { return {Phase::kActuate}; }

  void pre_step(Phase, World& world, const StepInfo& info) override {
    if (link_.body == nullptr) return;
    around_.look(world);
    read_command(world);
    apply_forces();
    advance_speed(info.dt_s);
    if (speed_->wanted()) {
      speed_->value = {info.end, joint_.velocity()};
      speed_->publish();
    }
  }

  void body_frames_moved() override { arm_body_ = link_.T_body_link * link_.inertial.T_link_com.p; }

  void reset() override {
    speed_now_.reference = 0.0;
    speed_now_.filtered = 0.0;
    command_seen_ = 0;
    refused_ = false;
    command_->clear();
  }
  void state(StateArchive& archive) override {
    archive(speed_now_.reference, speed_now_.filtered, command_seen_, refused_);
  }

 private:
  /// As RotorS names them in its parameters, which give their units.
  struct Constants {
    double direction = 1.0;  ///< 1: counter-clockwise
    double rotor_drag, rolling_moment, max_speed, motor, moment, slowdown;
  };
  /// Factors of the first-order lag for the step size that they were worked out for.
  struct Decay {
    double dt_s = -1.0, up = 0.0, down = 0.0;
    double time_constant_up_s, time_constant_down_s;
  };
  /// As commanded, and behind the lag [rad/s].
  struct Speed {
    double reference = 0.0, filtered = 0.0;
  };
  /// From the rotor's axis to the direction of thrust.
  struct ThrustTilt {
    bool is_none = true;         ///< the joint turns about the link's z
    Eigen::Vector3d along_body;  ///< zero then
  };

  void read_command(World& world) {
    if (command_->count() == command_seen_) return;
    command_seen_ = command_->count();
    const SmallVector& speeds = command_->at(command_seen_ - 1).angular_velocities;
    if (motor_number_ >= speeds.size) {
      report_once(world, "is not in a command of " + std::to_string(speeds.size) + " speeds");
    } else if (!(std::abs(speeds.data[motor_number_]) <= kFastestCommand)) {
      report_once(world, "is commanded " + std::to_string(speeds.data[motor_number_]) +
                             " rad/s, must be finite, up to 1e6");
    } else {
      speed_now_.reference = std::min(speeds.data[motor_number_], constants_.max_speed);
      refused_ = false;
    }
  }

  void report_once(World& world, const std::string& what) {
    if (!refused_) {
      world.report(Severity::kError, name_ + ": motor " + std::to_string(motor_number_) + " " +
                                         what + "; it keeps its last one");
    }
    refused_ = true;
  }

  void apply_forces() {
    Body& body = *link_.body;
    const Eigen::Matrix3d& R = body.rotation();
    const double speed =
        (joint_.is_rotor ? joint_.rotor_velocity : joint_.velocity()) * constants_.slowdown;
    // T = k_m w |w|: its sign is that of the speed, so a rotor that turns backwards pushes down.
    const double thrust = constants_.direction * std::abs(speed) * speed * constants_.motor;
    const Eigen::Vector3d axis = R * joint_.rotor_axis_body;
    // Thrust acts along the rotor link's z, which leans with the rotor's axis.
    Eigen::Vector3d thrust_axis = axis;
    if (!tilt_.is_none) thrust_axis += R * tilt_.along_body;
    // From the body's center of mass, to which apply_force() applies a force, to the rotor's.
    const Eigen::Vector3d arm = R * arm_body_;
    const Eigen::Vector3d velocity =
        body.velocity() + body.angular_velocity().cross(arm) - wind_velocity(arm);
    // H-force and rolling moment oppose the part of the airspeed in the plane of the rotor disk.
    const Eigen::Vector3d across = velocity - velocity.dot(axis) * axis;
    const Eigen::Vector3d force =
        thrust * thrust_axis - std::abs(speed) * constants_.rotor_drag * across;
    body.apply_force(force);
    // The drag torque on the airframe is opposite to the rotor's turning direction.
    body.apply_torque(arm.cross(force) -
                      constants_.direction * thrust * constants_.moment * thrust_axis -
                      std::abs(speed) * constants_.rolling_moment * across);
  }

  /// What came on the topic, else the world's wind.
  Eigen::Vector3d wind_velocity(const Eigen::Vector3d& arm) const {
    if (wind_->count() > 0) return wind_->at(wind_->count() - 1).v_world;
    if (around_.air() == nullptr) return Eigen::Vector3d::Zero();
    return around_.air()->wind(link_.body->pose().p + arm);
  }

  void advance_speed(double dt_s) {
    if (dt_s != decay_.dt_s) {
      decay_.dt_s = dt_s;
      // The lag's exact solution over a step, stable for time constants below the step size.
      decay_.up = std::exp(-dt_s / decay_.time_constant_up_s);
      decay_.down = std::exp(-dt_s / decay_.time_constant_down_s);
    }
    const double decay = speed_now_.reference > speed_now_.filtered ? decay_.up : decay_.down;
    speed_now_.filtered = decay * speed_now_.filtered + (1.0 - decay) * speed_now_.reference;
    const double rate = constants_.direction * speed_now_.filtered / constants_.slowdown;
    if (joint_.is_rotor) {
      joint_.rotor_velocity = rate;
    } else {
      joint_.set_velocity(rate);
    }
  }

  // What a step needs lies together, ahead of what it does not: six a vehicle are read in each.
  Joint& joint_;
  Link& link_;
  InHandle<ActuatorCommand> command_;
  InHandle<WindSample> wind_;
  OutHandle<ScalarSample> speed_;
  Surroundings around_;
  Eigen::Vector3d arm_body_;  ///< rotor's centre of mass
  Constants constants_;
  Decay decay_;
  Speed speed_now_;
  std::uint64_t command_seen_ = 0;
  std::size_t motor_number_ = 0;
  bool refused_ = false;
  ThrustTilt tilt_;
  std::string name_;
};

std::string velocity_controlled_joint(const PluginParams& params) {
  return params.text("motorType", "velocity") == "velocity" ? params.text("jointName", "")
                                                            : std::string();
}

std::unique_ptr<Plugin> make_vehicle_motor(const PluginContext& context) {
  for (const char* of_gazebo : {"reversible", "gazebo_joint_control_pid"}) {
    context.params.node(of_gazebo);  // PX4's, of parts that this motor does not have
  }
  return std::make_unique<MotorModel>(context, vehicle_topic);
}

const PluginExample kMotorExample{
    "<jointName>rotor_1_joint</jointName><linkName>rotor_1</linkName>"
    "<turningDirection>ccw</turningDirection><motorNumber>1</motorNumber>"
    "<commandSubTopic>gazebo/command/motor_speed</commandSubTopic>"
    "<motorSpeedPubTopic>motor_speed/1</motorSpeedPubTopic>"
    "<timeConstantUp>0.02</timeConstantUp><timeConstantDown>0.05</timeConstantDown>"
    "<maxRotVelocity>900</maxRotVelocity><motorConstant>1.2e-5</motorConstant>"
    "<momentConstant>0.02</momentConstant><rotorDragCoefficient>0</rotorDragCoefficient>"
    "<rollingMomentCoefficient>0</rollingMomentCoefficient>"
    "<rotorVelocitySlowdownSim>10</rotorVelocitySlowdownSim>",
    {"jointName", "linkName", "motorNumber", "turningDirection"},
    {"motorNumber", "timeConstantUp", "timeConstantDown", "maxRotVelocity", "motorConstant",
     "momentConstant", "rotorDragCoefficient", "rollingMomentCoefficient",
     "rotorVelocitySlowdownSim"}};

const PluginRegistrar kRotorsGazeboMotorModel("librotors_gazebo_motor_model.so",
                                              factory_of<MotorModel>(velocity_controlled_joint),
                                              kMotorExample);
const PluginRegistrar kGazeboMotorModel("libgazebo_motor_model.so",
                                        {make_vehicle_motor, velocity_controlled_joint},
                                        kMotorExample);

}  // namespace

}  // namespace trident::sim
