// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

#include "trident_base/yaml_config.h"

namespace trident {

/// How a command becomes a thrust; see thrust_at() in thruster_curve.h.
enum class ThrustMapping { kLinear, kGlf, kQuadratic, kTable };
/// Names of the mappings in YAML.
constexpr auto enum_names(ThrustMapping) {
  return std::array{
      EnumName{ThrustMapping::kLinear, "linear"}, EnumName{ThrustMapping::kGlf, "glf"},
      EnumName{ThrustMapping::kQuadratic, "quadratic"}, EnumName{ThrustMapping::kTable, "table"}};
}

/// A propeller. Fixed when `max_angle` is 0, else it turns about body z.
struct ThrusterParams {
  std::string name;                                    ///< as its topics call it
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double yaw = 0.0;                                    ///< [rad]
  ThrustMapping mapping = ThrustMapping::kLinear;      ///< from command to thrust
  double min_command = -1.0;                           ///< lower ones are cut
  double max_command = 1.0;                            ///< higher ones are cut
  double dead_band = 0.0;                              ///< smaller commands do nothing
  double time_constant = 0.0;                          ///< [s]
  double max_force_forward = 250.0;                    ///< [N]
  double max_force_reverse = 100.0;                    ///< [N]
  double coefficient_forward = 0.0;                    ///< mapping quadratic: K of K n|n|, n > 0
  double coefficient_reverse = 0.0;                    ///< mapping quadratic: K of K n|n|, n < 0
  std::vector<double> table_commands;                  ///< mapping table: rising
  std::vector<double> table_forces;                    ///< [N]
  double max_angle = 0.0;                              ///< [rad]
  double angle_rate = 1.0;                             ///< [rad/s]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name, "as its topics call it");
    ar.required("position", position, "of the propeller, from CO [m]");
    ar.field("yaw", yaw, Range{-6.3, 6.3}, "of the thrust axis about body z [rad]");
    ar.field("mapping", mapping, "from command to thrust");
    ar.field("min_command", min_command, Range::at_most(0.0), "lower ones are cut");
    ar.field("max_command", max_command, Range::positive(), "higher ones are cut");
    ar.field("dead_band", dead_band, Range::non_negative(), "smaller commands do nothing");
    ar.field("time_constant", time_constant, Range::non_negative(),
             "of the propeller following its command [s]");
    ar.field("max_force_forward", max_force_forward, Range::non_negative(), "[N]");
    ar.field("max_force_reverse", max_force_reverse, Range::non_negative(),
             "as a positive number [N]");
    ar.field("coefficient_forward", coefficient_forward, Range::non_negative(),
             "mapping quadratic: K of K n|n|, n > 0");
    ar.field("coefficient_reverse", coefficient_reverse, Range::non_negative(),
             "mapping quadratic: K of K n|n|, n < 0");
    ar.field("table_commands", table_commands, "mapping table: rising");
    ar.field("table_forces", table_forces, "mapping table: thrust at each of them [N]");
    ar.field("max_angle", max_angle, Range{0.0, 3.2}, "azimuth to either side; 0: fixed [rad]");
    ar.field("angle_rate", angle_rate, Range::positive(), "of the azimuth [rad/s]");
  }
  /// Throws Error: a table that does not rise or is not of one length, a mapping without figures.
  void validate() const;
};

}  // namespace trident
