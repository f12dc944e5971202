// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
/// Parameters of the plugin distance_sensor, under upstream's names.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "trident_ros/node_params.h"

namespace trident::mavros {

/// Where a sensor looks: MAV_SENSOR_ORIENTATION.
enum class SensorOrientation : std::uint8_t {};

inline constexpr SensorOrientation kDownward{25}, kCustomOrientation{100};
/// Names without their prefix.
constexpr auto enum_names(SensorOrientation /*tag*/) {
  return std::array{EnumName{SensorOrientation{0}, "NONE"},
                    EnumName{SensorOrientation{1}, "YAW_45"},
                    EnumName{SensorOrientation{2}, "YAW_90"},
                    EnumName{SensorOrientation{3}, "YAW_135"},
                    EnumName{SensorOrientation{4}, "YAW_180"},
                    EnumName{SensorOrientation{5}, "YAW_225"},
                    EnumName{SensorOrientation{6}, "YAW_270"},
                    EnumName{SensorOrientation{7}, "YAW_315"},
                    EnumName{SensorOrientation{8}, "ROLL_180"},
                    EnumName{SensorOrientation{9}, "ROLL_180_YAW_45"},
                    EnumName{SensorOrientation{10}, "ROLL_180_YAW_90"},
                    EnumName{SensorOrientation{11}, "ROLL_180_YAW_135"},
                    EnumName{SensorOrientation{12}, "PITCH_180"},
                    EnumName{SensorOrientation{13}, "ROLL_180_YAW_225"},
                    EnumName{SensorOrientation{14}, "ROLL_180_YAW_270"},
                    EnumName{SensorOrientation{15}, "ROLL_180_YAW_315"},
                    EnumName{SensorOrientation{16}, "ROLL_90"},
                    EnumName{SensorOrientation{17}, "ROLL_90_YAW_45"},
                    EnumName{SensorOrientation{18}, "ROLL_90_YAW_90"},
                    EnumName{SensorOrientation{19}, "ROLL_90_YAW_135"},
                    EnumName{SensorOrientation{20}, "ROLL_270"},
                    EnumName{SensorOrientation{21}, "ROLL_270_YAW_45"},
                    EnumName{SensorOrientation{22}, "ROLL_270_YAW_90"},
                    EnumName{SensorOrientation{23}, "ROLL_270_YAW_135"},
                    EnumName{SensorOrientation{24}, "PITCH_90"},
                    EnumName{SensorOrientation{25}, "PITCH_270"},
                    EnumName{SensorOrientation{26}, "PITCH_180_YAW_90"},
                    EnumName{SensorOrientation{27}, "PITCH_180_YAW_270"},
                    EnumName{SensorOrientation{28}, "ROLL_90_PITCH_90"},
                    EnumName{SensorOrientation{29}, "ROLL_180_PITCH_90"},
                    EnumName{SensorOrientation{30}, "ROLL_270_PITCH_90"},
                    EnumName{SensorOrientation{31}, "ROLL_90_PITCH_180"},
                    EnumName{SensorOrientation{32}, "ROLL_270_PITCH_180"},
                    EnumName{SensorOrientation{33}, "ROLL_90_PITCH_270"},
                    EnumName{SensorOrientation{34}, "ROLL_180_PITCH_270"},
                    EnumName{SensorOrientation{35}, "ROLL_270_PITCH_270"},
                    EnumName{SensorOrientation{36}, "ROLL_90_PITCH_180_YAW_90"},
                    EnumName{SensorOrientation{37}, "ROLL_90_YAW_270"},
                    EnumName{SensorOrientation{38}, "ROLL_90_PITCH_68_YAW_293"},
                    EnumName{SensorOrientation{39}, "PITCH_315"},
                    EnumName{SensorOrientation{40}, "ROLL_90_PITCH_315"},
                    EnumName{SensorOrientation{100}, "CUSTOM"}};
}

/// Three numbers of a section.
struct PlaceParams {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double z = 0.0;  ///< [m]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("x", x, "[m]");
    ar.field("y", y, "[m]");
    ar.field("z", z, "[m]");
  }
};

/// Of a sensor whose orientation is CUSTOM, in FRD.
struct SensorAngleParams {
  double roll = 0.0;   ///< [deg]
  double pitch = 0.0;  ///< [deg]
  double yaw = 0.0;    ///< [deg]

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("roll", roll, Range{-360, 360}, "[deg]");
    ar.field("pitch", pitch, Range{-360, 360}, "[deg]");
    ar.field("yaw", yaw, Range{-360, 360}, "[deg]");
  }
};

/// Of one sensor: a section of ~distance_sensor.
struct DistanceSensorParams {
  bool subscriber = false;                       ///< to the vehicle, else from it
  int id = 0;                                    ///< of DISTANCE_SENSOR
  std::string frame_id = "base_link";            ///< of what comes from the vehicle
  std::optional<SensorOrientation> orientation;  ///< downward where it is not set
  double field_of_view = 0.0;                    ///< of what comes from the vehicle [rad]
  int covariance = 0;                            ///< of what goes to it [cm^2]; 0: measured
  double horizontal_fov_ratio = 1.0;             ///< times the message's field of view
  double vertical_fov_ratio = 1.0;               ///< times the message's field of view
  SensorAngleParams custom_orientation;          ///< where the orientation is CUSTOM
  bool send_tf = false;                          ///< kept for files; has no effect
  PlaceParams sensor_position;                   ///< kept for files; has no effect

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("subscriber", subscriber, "ranges go to the vehicle, else they come from it");
    ar.required("id", id, Range{0, 255}, "of DISTANCE_SENSOR");
    ar.field("frame_id", frame_id, "of what comes from the vehicle");
    ar.field("orientation", orientation,
             "where it looks; what comes must have it; not set: any, downward to the vehicle");
    ar.field("field_of_view", field_of_view, Range{0, 7}, "of what comes from the vehicle [rad]");
    ar.field("covariance", covariance, Range{0, 254},
             "of what goes to the vehicle; 0: that of the newest ranges [cm^2]");
    ar.field("horizontal_fov_ratio", horizontal_fov_ratio, Range{0, 100},
             "times the message's field of view");
    ar.field("vertical_fov_ratio", vertical_fov_ratio, Range{0, 100},
             "times the message's field of view");
    ar.field("custom_orientation", custom_orientation, "where the orientation is CUSTOM, in FRD");
    ar.field("send_tf", send_tf, "kept for files; has no effect");
    ar.field("sensor_position", sensor_position, "kept for files; has no effect");
  }
};

}  // namespace trident::mavros
