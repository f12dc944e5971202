// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_motion.h"

#include <algorithm>
#include <cmath>

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/vehicle/thruster_curve.h"
#include "trident_control/vessel_model.h"

namespace trident::nav {
namespace {

// A thruster gives forces in the directions that its azimuth reaches: the extremes along one axis
// are those of its ends or of the axis itself.
double greatest_share(double yaw, double max_angle, double axis) {
  const double off = wrap_angle(axis - yaw);
  return std::cos(std::max(std::fabs(off) - max_angle, 0.0));
}

struct Interval {
  double least = 0.0, greatest = 0.0;

  void add(double a, double b) {
    least += std::min(a, b);
    greatest += std::max(a, b);
  }
};

// The force range of one thruster along a direction of the body [N].
void add_along(const ThrusterParams& thruster, double axis, Interval* range) {
  const double ahead = thrust_at(thruster, thruster.max_command);
  const double astern = thrust_at(thruster, thruster.min_command);
  const double share = greatest_share(thruster.yaw, thruster.max_angle, axis);
  const double opposite = greatest_share(thruster.yaw, thruster.max_angle, axis + kPi);
  const double most = std::max({0.0, ahead * share, -astern * opposite});
  const double least = std::min({0.0, astern * share, -ahead * opposite});
  range->add(least, most);
}

// Of a moment: the direction square to the lever is the one that turns.
void add_moment(const ThrusterParams& thruster, Interval* range) {
  const double lever = std::hypot(thruster.position.x(), thruster.position.y());
  const double axis = std::atan2(thruster.position.y(), thruster.position.x()) + 0.5 * kPi;
  Interval force;
  add_along(thruster, axis, &force);
  range->add(lever * force.least, lever * force.greatest);
}

// The greatest side force of a rudder over the square of the speed: at the angle that it reaches
// before it stalls.
double rudder_force(const RudderParams& rudder, double water_density) {
  const double angle = std::min(rudder.max_angle, rudder.stall_angle);
  return 0.5 * water_density * rudder.area * rudder.lift_slope() * angle;
}

}  // namespace

VesselMotion load_vessel_motion(const VesselConstraintsParams& params) {
  if (params.vessel_file.empty()) {
    throw Error(
        "VesselConstraints.vessel_file is '', legal, with motion_model Vessel, is the path of a "
        "vessel's file");
  }
  const control::VesselModel model = control::load_vessel_model(params.vessel_file);
  VesselMotion motion;
  Interval surge, sway, yaw;
  for (const ThrusterParams& thruster : model.thrusters) {
    add_along(thruster, 0.0, &surge);
    add_along(thruster, 0.5 * kPi, &sway);
    add_moment(thruster, &yaw);
  }
  motion.force_min = {surge.least, sway.least, yaw.least};
  motion.force_max = {surge.greatest, sway.greatest, yaw.greatest};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    motion.mass[i] = model.mass[axis];
    motion.linear_damping[i] = model.linear_damping[axis];
    motion.quadratic_damping[i] = model.quadratic_damping[axis];
  }
  for (const RudderParams& rudder : model.rudders) {
    const double force = rudder_force(rudder, model.water_density);
    motion.rudder_force += force;
    motion.rudder_moment += force * std::fabs(rudder.position.x());
  }
  motion.munk_mass = model.munk_mass;
  motion.current = {params.current[0], params.current[1]};
  return motion;
}

}  // namespace trident::nav
