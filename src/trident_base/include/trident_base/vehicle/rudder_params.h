// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "trident_base/angle.h"
#include "trident_base/yaml_config.h"

namespace trident {

/// A symmetric foil that turns about body z. Positive angles turn the bow to port (positive yaw) in
/// forward motion: the trailing edge goes to port.
struct RudderParams {
  std::string name;                                    ///< as its topics call it
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double area = 0.0;                                   ///< [m^2]
  double aspect_ratio = 1.5;                           ///< span^2 / area
  double drag_coefficient = 0.02;                      ///< at zero angle of attack
  double stall_angle = 0.4;                            ///< [rad]
  double max_angle = 0.6;                              ///< [rad]
  double angle_rate = 0.5;                             ///< [rad/s]

  /// Names each field with its range and meaning.
  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name, "as its topics call it");
    ar.required("position", position, "of the centre of pressure, from CO [m]");
    ar.required("area", area, Range::positive(), "[m^2]");
    ar.field("aspect_ratio", aspect_ratio, Range::positive(), "span^2 / area");
    ar.field("drag_coefficient", drag_coefficient, Range::non_negative(),
             "at zero angle of attack");
    ar.field("stall_angle", stall_angle, Range{0.0, 1.5, true}, "of attack [rad]");
    ar.field("max_angle", max_angle, Range{0.0, 1.6, true}, "to either side [rad]");
    ar.field("angle_rate", angle_rate, Range::positive(), "of the machine [rad/s]");
  }

  /// Lift coefficient per angle of attack of a wing of low aspect ratio (Helmbold):
  /// 2 pi A / (2 + sqrt(A^2 + 4)) [1/rad].
  double lift_slope() const {
    return 2.0 * kPi * aspect_ratio / (2.0 + std::sqrt(aspect_ratio * aspect_ratio + 4.0));
  }
};

}  // namespace trident
