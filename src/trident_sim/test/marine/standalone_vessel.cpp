// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "standalone_vessel.h"

#include "core/physics/free_body.h"

namespace trident::sim {

StandaloneVessel::StandaloneVessel(const VesselParams& params, Restoring restoring,
                                   double gravity_m_s2)
    : dynamics_(params),
      hull_(params.hull, params.water_density, gravity_m_s2),
      restoring_(restoring),
      gravity_(gravity_m_s2) {
  body_.composite.mass_kg = dynamics_.rigid_body().mass_kg;
  body_.composite.inertia = dynamics_.rigid_body().inertia_cg;
  body_.composite.inertia_inverse = body_.composite.inertia.inverse();
  set_pose(SE3::identity());
}

void StandaloneVessel::set_pose(const SE3& T_world_co) {
  body_.T_world_body.p = T_world_co * dynamics_.rigid_body().center_of_gravity;
  body_.set_orientation(T_world_co.R);
}

void StandaloneVessel::set_at_rest() {
  const RigidBody& rigid = dynamics_.rigid_body();
  const StaticPose rest = hull_.rest(rigid.mass_kg, rigid.center_of_gravity);
  set_pose(SE3::from_xyz_rpy({0.0, 0.0, rest.z_m}, 0.0, rest.pitch_rad, 0.0));
}

void StandaloneVessel::set_nu(const Vector6d& nu) {
  const Eigen::Vector3d w = nu.tail<3>();
  body_.w_world = body_.R_world_body * w;
  body_.v_world =
      body_.R_world_body * (nu.head<3>() + w.cross(dynamics_.rigid_body().center_of_gravity));
}

SE3 StandaloneVessel::T_world_co() const {
  return {body_.T_world_body.R,
          body_.T_world_body * Eigen::Vector3d(-dynamics_.rigid_body().center_of_gravity)};
}

Vector6d StandaloneVessel::nu() const {
  const Eigen::Matrix3d R_body_world = body_.R_world_body.transpose();
  const Eigen::Vector3d w = R_body_world * body_.w_world;
  Vector6d nu;
  nu << R_body_world * body_.v_world - w.cross(dynamics_.rigid_body().center_of_gravity), w;
  return nu;
}

double StandaloneVessel::kinetic_energy() const {
  const Vector6d v = nu();
  return 0.5 * v.dot((dynamics_.rigid_body_mass() + dynamics_.added_mass()) * v);
}

Vector6d StandaloneVessel::spring_wrench() const {
  const Eigen::Vector3d rpy = T_world_co().rpy();
  Vector6d eta;
  eta << 0.0, 0.0, T_world_co().p.z(), rpy.x(), rpy.y(), 0.0;
  return -(springs_ * eta);
}

void StandaloneVessel::step(const Vector6d& tau, double dt_s, const Water& water,
                            const Current& current) {
  const SE3 T = T_world_co();
  const Eigen::Vector3d& r_cg = dynamics_.rigid_body().center_of_gravity;
  const Vector6d v = nu();

  Vector6d weight = Vector6d::Zero();
  HullLoad load;
  if (restoring_ == Restoring::kHull) {
    weight.head<3>() =
        T.R.conjugate() * Eigen::Vector3d(0.0, 0.0, -body_.composite.mass_kg * gravity_);
    weight.tail<3>() = r_cg.cross(weight.head<3>());
    load = hull_.load(T, water, time_s_);
  } else if (restoring_ == Restoring::kLinear) {
    load.wrench = spring_wrench();
  }
  current.add_to(T, T.R * v.head<3>(), time_s_, &load.water);
  const Vector6d wrench =
      dynamics_.engine_wrench(v, load.water, tau + load.wrench + weight, weight, dt_s);
  const Vector6d at_cg = about_center_of_gravity(wrench + weight, r_cg);
  body_.force = T.R * Eigen::Vector3d(at_cg.head<3>());
  body_.torque = T.R * Eigen::Vector3d(at_cg.tail<3>());
  integrate_free_body(body_, dt_s);
  time_s_ += dt_s;
}

VesselParams shipped_vessel(const std::string& name) {
  return load_vessel(std::string(TRIDENT_REPOSITORY) + "/config/vessels/" + name + ".yaml");
}

}  // namespace trident::sim
