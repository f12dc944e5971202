// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/se3.h"
#include "trident_base/yaml_config.h"

namespace trident {

/// A symmetric foil that turns about body z. Positive angles turn the bow to port (positive yaw) in
/// forward motion: the trailing edge goes to port.
struct RudderParams {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double area = 0.0;
  double aspect_ratio = 1.5;
  double drag_coefficient = 0.02;
  double stall_angle = 0.4;
  double max_angle = 0.6;
  double angle_rate = 0.5;

  template <class Archive>
  void visit(Archive& ar) {
    ar.required("name", name, "as its topics call it");
    ar.required("position", position, "of the centre of pressure, from CO [m]");
    ar.required("area", area, Range::positive(), "[m^2]");
    ar.field("aspect_ratio", aspect_ratio, Range::positive(), "span^2 / area");
    ar.field("drag_coefficient", drag_coefficient, Range::non_negative(),
             "at zero angle of attack");
    ar.field("stall_angle", stall_angle, Range{0.0, 1.5, true}, "of attack [rad]");
    ar.field("max_angle", max_angle, Range{0.0, 1.6, true}, "either way [rad]");
    ar.field("angle_rate", angle_rate, Range::positive(), "of the machine [rad/s]");
  }
};

/// Lift of a wing of low aspect ratio (Helmbold), C_L = 2 pi A / (2 + sqrt(A^2 + 4)) alpha, up to
/// the stall angle, beyond it a flat plate's normal force; drag C_D0 + C_L^2 / (0.9 pi A).
class Rudder {
 public:
  explicit Rudder(const RudderParams& params) : params_(params) {}

  const RudderParams& params() const { return params_; }
  double angle_rad() const { return angle_rad_; }
  /// Throws Error when the angle [rad] is not finite; one beyond the legal ones is cut.
  void command(double angle_rad);
  void step(double dt_s);
  void reset() { command_rad_ = angle_rad_ = 0.0; }

  /// About CO, body axes, from the velocity of CO through the water.
  Vector6d wrench(const Vector6d& nu_r, double water_density) const;

  template <class Archive>
  void state(Archive& archive) {
    archive(command_rad_, angle_rad_);
  }

 private:
  RudderParams params_;
  double command_rad_ = 0.0, angle_rad_ = 0.0;
};

}  // namespace trident
