// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <GeographicLib/LocalCartesian.hpp>

#include "trident_sim/world.h"

namespace trident::bridges {

/// From forward, left, up to forward, right, down, and back: a half turn about x.
inline Eigen::Vector3d flu_to_frd(const Eigen::Vector3d& v) { return {v.x(), -v.y(), -v.z()}; }
/// From east, north, up to north, east, down, and back.
inline Eigen::Vector3d enu_to_ned(const Eigen::Vector3d& v) { return {v.y(), v.x(), -v.z()}; }

/// The first link of a plugin's model, which its body moves with. Throws Error when it has no link.
sim::Link& body_link(const sim::PluginContext& context);

/// A link in the frames of aviation, and on the Earth.
class VehicleState {
 public:
  /// `link` moves with the vehicle's body: x forward, z up.
  VehicleState(const sim::World& world, const sim::Link& link);
  /// Another frame than the world's on the Earth.
  void set_R_ned_world(const Eigen::Quaterniond& R_ned_world) { R_ned_world_ = R_ned_world; }
  /// Another one than the link's x forward, z up.
  void set_R_link_frd(const Eigen::Quaterniond& R_link_frd) { R_link_frd_ = R_link_frd; }

  Eigen::Vector3d p_ned() const;         ///< from the world's origin [m]
  Eigen::Vector3d v_ned() const;         ///< [m/s]
  Eigen::Quaterniond R_ned_frd() const;  ///< of the body
  Eigen::Vector3d w_frd() const;         ///< [rad/s]
  /// Specific force over the last step of `dt_s` [m/s^2].
  Eigen::Vector3d a_frd(double dt_s) const;
  /// Latitude, longitude [deg] and altitude above the ellipsoid [m].
  Eigen::Vector3d place() const;

 private:
  const sim::World& world_;
  const sim::Link& link_;
  Eigen::Matrix3d R_enu_world_;
  Eigen::Quaterniond R_ned_world_, R_link_frd_{0.0, 1.0, 0.0, 0.0};
  GeographicLib::LocalCartesian earth_;
};

}  // namespace trident::bridges
