// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vehicle_state.h"

#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_sim/world/link_motion.h"

namespace trident::bridges {

sim::Link& body_link(const sim::PluginContext& context) {
  if (context.model == nullptr || context.model->canonical_link() == nullptr) {
    throw Error(context.params.owner() + ": belongs in a model with a link");
  }
  return *context.model->canonical_link();
}

VehicleState::VehicleState(const sim::World& world, const sim::Link& link)
    : world_(world), link_(link) {
  const sim::SphericalCoordinates& origin = world.spherical();
  const Eigen::AngleAxisd heading(deg_to_rad(origin.heading_deg), Eigen::Vector3d::UnitZ());
  R_enu_world_ = heading.toRotationMatrix();
  Eigen::Matrix3d R_ned_enu;
  R_ned_enu << 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, -1.0;
  R_ned_world_ = Eigen::Quaterniond(Eigen::Matrix3d(R_ned_enu * R_enu_world_));
  earth_.Reset(origin.latitude_deg, origin.longitude_deg, origin.elevation_m);
}

Eigen::Vector3d VehicleState::p_ned() const { return R_ned_world_ * link_.T_world_link().p; }

Eigen::Vector3d VehicleState::v_ned() const {
  return R_ned_world_ * sim::link_velocity_world(link_);
}

Eigen::Quaterniond VehicleState::R_ned_frd() const {
  return (R_ned_world_ * link_.T_world_link().R * R_link_frd_).normalized();
}

Eigen::Vector3d VehicleState::w_frd() const {
  return (link_.T_world_link().R * R_link_frd_).conjugate() * link_.w_world();
}

Eigen::Vector3d VehicleState::a_frd(double dt_s) const {
  const Eigen::Vector3d specific =
      sim::link_acceleration_world(link_, dt_s) - world_.physics().gravity;
  return (link_.T_world_link().R * R_link_frd_).conjugate() * specific;
}

Eigen::Vector3d VehicleState::place() const {
  const Eigen::Vector3d p_enu = R_enu_world_ * link_.T_world_link().p;
  Eigen::Vector3d place;
  earth_.Reverse(p_enu.x(), p_enu.y(), p_enu.z(), place.x(), place.y(), place.z());
  return place;
}

}  // namespace trident::bridges
