// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Parameters of the controller nodes under RotorS' names.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "trident_control/lee_position_controller.h"
#include "trident_control/roll_pitch_yawrate_thrust_controller.h"
#include "trident_control/setpoint_queue.h"
#include "trident_ros/node_params.h"

namespace trident::control {

/// A diagonal gain: one number per axis of the frame that it acts in.
struct AxisGains {
  Eigen::Vector3d value;  ///< [unit of the gain]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("x", value.x(), Range::non_negative(), "along or about x");
    ar.field("y", value.y(), Range::non_negative(), "along or about y");
    ar.field("z", value.z(), Range::non_negative(), "along or about z");
  }
};

/// The upper triangle of a vehicle's inertia about its center of mass, in body axes.
struct InertiaParams {
  Eigen::Matrix3d value = VehicleParams{}.inertia;  ///< The lower triangle is not read [kg m^2].

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("xx", value(0, 0), Range::any(), "[kg m^2]");
    ar.field("xy", value(0, 1), Range::any(), "[kg m^2]");
    ar.field("xz", value(0, 2), Range::any(), "[kg m^2]");
    ar.field("yy", value(1, 1), Range::any(), "[kg m^2]");
    ar.field("yz", value(1, 2), Range::any(), "[kg m^2]");
    ar.field("zz", value(2, 2), Range::any(), "[kg m^2]");
  }
  /// The whole symmetric matrix.
  Eigen::Matrix3d matrix() const { return value.selfadjointView<Eigen::Upper>(); }
};

/// One rotor of rotor_configuration.
struct RotorParams {
  RotorConfig rotor;  ///< Its thrust axis stays body z.

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("angle", rotor.angle, Range::any(), "azimuth of the arm, 0 is forward [rad]");
    ar.required("arm_length", rotor.arm_length, Range::any(), "from the center of mass [m]");
    ar.required("rotor_force_constant", rotor.force_constant, Range::any(),
                "thrust per squared speed [N s^2/rad^2]");
    ar.required("rotor_moment_constant", rotor.moment_constant, Range::any(),
                "drag torque per thrust [m]");
    ar.required("direction", rotor.direction, Range{-1, 1}, "1 (ccw) or -1 (cw), from above");
  }
};

/// What both multirotor controllers read.
struct MultirotorParams {
  AxisGains attitude_gain{AttitudeGains{}.attitude};          ///< [N m/rad]
  AxisGains angular_rate_gain{AttitudeGains{}.angular_rate};  ///< [N m s/rad]
  double mass = VehicleParams{}.mass;                         ///< [kg]
  double gravity = VehicleParams{}.gravity;                   ///< [m/s^2]
  InertiaParams inertia;  ///< about the center of mass, in body axes
  std::map<std::string, RotorParams> rotors = firefly_rotors();  ///< By number: 0, 1, 2 ...
  AttitudeQuirks quirks;  ///< where the law keeps RotorS' departures from the paper

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("attitude_gain", attitude_gain, "torque per attitude error [N m/rad]");
    ar.field("angular_rate_gain", angular_rate_gain, "torque per error of rates [N m s/rad]");
    ar.field("mass", mass, Range::positive(), "of the vehicle [kg]");
    ar.field("gravity", gravity, Range::non_negative(), "along -z of the world [m/s^2]");
    ar.field("inertia", inertia, "about the center of mass, in body axes");
    ar.field("rotor_configuration", rotors, "rotors named 0, 1, 2 ... without a gap, 4 to 16");
    ar.field("rotate_yaw_rate_with_RdT_R", quirks.rotate_yaw_rate_with_RdT_R,
             "RotorS' rotation of the desired body rate; false: the paper's");
    ar.field("omit_gyroscopic_term", quirks.omit_gyroscopic_term,
             "leave out w x J w, as RotorS does");
    ar.field("unlimited_rotor_speed", quirks.unlimited_rotor_speed,
             "false: rotor speeds are limited to max_rotor_speed");
    ar.field("max_rotor_speed", quirks.max_rotor_speed, Range::any(),
             "used when unlimited_rotor_speed is false [rad/s]");
  }
  /// Throws Error when the rotors or the inertia cannot be those of a vehicle.
  void validate() const;

  /// The gains of the inner loop.
  AttitudeGains attitude_gains() const { return {attitude_gain.value, angular_rate_gain.value}; }
  /// The vehicle. Throws Error when the rotors are not named 0, 1, 2 ...
  VehicleParams vehicle() const;
  /// RotorS' defaults.
  static std::map<std::string, RotorParams> firefly_rotors();
};

/// Private parameters of lee_position_controller_node.
struct LeeNodeParams {
  AxisGains position_gain{LeeGains{}.position};  ///< [N/m]
  AxisGains velocity_gain{LeeGains{}.velocity};  ///< [N s/m]
  MultirotorParams multirotor;
  SetpointQueueParams setpoints;  ///< how stamped set-points are anchored in time

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("position_gain", position_gain, "force per position error [N/m]");
    ar.field("velocity_gain", velocity_gain, "force per velocity error [N s/m]");
    multirotor.visit(ar);
    ar.field("first_point_at_start", setpoints.first_point_at_start,
             "a trajectory's first point acts at its start, whatever its time_from_start");
    ar.field("keep_setpoint_over_reset", setpoints.keep_setpoint_over_reset,
             "the active set-point outlives a reset of the world, as in RotorS");
    ar.field("max_setpoint_lead", setpoints.max_lead_s, Range::any(),
             "stamps further ahead are of another clock: the message starts at once [s]");
    ar.field("max_setpoint_age", setpoints.max_age_s, Range::any(),
             "older stamps do not anchor a trajectory: the message starts at once [s]");
  }
  /// Throws Error as MultirotorParams::validate() does.
  void validate() const { multirotor.validate(); }
  /// What the controller itself takes.
  LeeParams controller() const;
};

/// Private parameters of roll_pitch_yawrate_thrust_controller_node.
struct RollPitchYawrateThrustNodeParams : MultirotorParams {
  /// What the controller itself takes.
  RollPitchYawrateThrustParams controller() const { return {attitude_gains(), vehicle(), quirks}; }
};

/// Private parameters of vessel_controller_node.
struct VesselNodeParams {
  std::string vessel, controller;  ///< Paths of YAML files.

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("vessel", vessel, "path of a vessel's file, see config/vessels");
    ar.required("controller", controller, "path of a controller's file, see config/controllers");
  }
};

/// One sentence per absent parameter that RotorS' files have, in the order of the struct.
std::vector<std::string> absent_notes(const ros_utils::NodeParams& params);

}  // namespace trident::control
