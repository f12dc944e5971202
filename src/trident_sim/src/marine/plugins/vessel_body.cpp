// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "vessel_body.h"

#include <cmath>

#include "marine/environment/current.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

constexpr double kTolerance = 0.01;

/// Upwards positive; hulls know no other direction.
double gravity_of(const World& world) { return -world.physics().gravity.z(); }

std::string text(const Eigen::Vector3d& v) {
  return "(" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) + ")";
}

[[noreturn]] void refuse(const std::string& owner, const std::string& what, const std::string& is,
                         const std::string& wanted) {
  throw Error(owner + ": the link's " + what + " is " + is + ", the vessel's is " + wanted +
              "; legal is a difference of 1 %");
}

Vector6d turned(const Eigen::Matrix3d& R, const Vector6d& v) {
  Vector6d result;
  result << R * v.head<3>(), R * v.tail<3>();
  return result;
}

}  // namespace

/// Mass, center of gravity and inertia of the body that the link is part of, about CO and in its
/// axes. The tensor is made symmetric again after the rotation, which rounding disturbs.
RigidBody rigid_body_of(const Link& link, const SE3& T_link_co) {
  const SE3 T_co_body = (link.T_body_link * T_link_co).inverse();
  const Eigen::Matrix3d R = T_co_body.R.toRotationMatrix();
  RigidBody body;
  body.mass_kg = link.body->mass();
  body.center_of_gravity = T_co_body.p;
  const Eigen::Matrix3d inertia = R * link.body->inertia_tensor() * R.transpose();
  body.inertia_cg = 0.5 * (inertia + inertia.transpose());
  return body;
}

Link& moving_link(const PluginContext& context, const std::string& key) {
  Link& link = required_link(context, key);
  if (link.body == nullptr || link.body->is_kinematic()) {
    context.params.refuse(key, link.name, "a link that forces move");
  }
  return link;
}

VesselBody::VesselBody(const PluginContext& context, Link& link, const VesselParams& vessel,
                       const Place& place)
    : owner_(context.params.owner()),
      link_(link),
      vessel_(vessel),
      place_(place),
      gravity_(gravity_of(context.world)),
      hull_(vessel.hull, vessel.water_density, gravity_),
      world_(context.world) {
  body_frames_moved();
  if (vessel.equation == VesselEquation::kLegacyVrx) {
    legacy_.emplace(Legacy{LegacyVrxForce(vessel), VrxHull(vessel.hull, vessel.water_density)});
  }
  if (const auto sea = find_sea(world_)) check_afloat(*sea);
}

/// A model file and a vessel file both state the mass. Where they differ the vessel would move by
/// one and float by the other, so that a difference is refused.
void VesselBody::check_inertial() const {
  const RigidBody is = rigid_body_of(link_, place_.T_link_co), wanted = vessel_.rigid_body();
  if (std::abs(is.mass_kg - wanted.mass_kg) > kTolerance * wanted.mass_kg) {
    refuse(owner_, "mass", number_text(is.mass_kg) + " kg", number_text(wanted.mass_kg) + " kg");
  }
  const double gyration = std::sqrt(0.5 * wanted.inertia_cg.trace() / wanted.mass_kg);
  if ((is.center_of_gravity - wanted.center_of_gravity).norm() > kTolerance * gyration) {
    refuse(owner_, "centre of gravity, from CO,", text(is.center_of_gravity) + " m",
           text(wanted.center_of_gravity) + " m");
  }
  const double largest = wanted.inertia_cg.diagonal().maxCoeff();
  const Eigen::Matrix3d difference = (is.inertia_cg - wanted.inertia_cg).cwiseAbs();
  const Eigen::Array3d moments =
      difference.diagonal().array() / wanted.inertia_cg.diagonal().array();
  if (moments.maxCoeff() > kTolerance || difference.maxCoeff() > kTolerance * largest) {
    const auto figures = [](const Eigen::Matrix3d& I) {
      return text(I.diagonal()) + ", products " + text({I(0, 1), I(0, 2), I(1, 2)}) + " kg m^2";
    };
    refuse(owner_, "inertia", figures(is.inertia_cg), figures(wanted.inertia_cg));
  }
}

/// The dynamics follow the link's present mass, which a service may have set.
void VesselBody::body_frames_moved() {
  T_body_co_ = link_.T_body_link * place_.T_link_co;
  const RigidBody body = rigid_body_of(link_, place_.T_link_co);
  const Eigen::Matrix3d& I = body.inertia_cg;
  VesselParams params = vessel_;
  params.mass = body.mass_kg;
  params.center_of_gravity = body.center_of_gravity;
  params.inertia = I.diagonal();
  params.products_of_inertia = {I(0, 1), I(0, 2), I(1, 2)};
  try {
    dynamics_ = std::make_unique<VesselDynamics>(params);
  } catch (const Error& error) {
    throw Error(owner_ + ": " + error.what());
  }
}

void VesselBody::look_around(World& world) {
  around_.look(world);
  if (around_.sea() != nullptr || is_reported_) return;
  is_reported_ = true;
  world.diagnose({Severity::kWarning, "world '" + world.name() + "'", "no sea",
                  "has no sea, so that vessels float in still water at z = 0; the world's plugin "
                  "libtrident_sea.so gives it one"});
}

/// At the place where it is spawned, each section of the hull by its own draft: a bow on the beach
/// is reported at once, not as a contact later.
void VesselBody::check_afloat(const Sea& sea) const {
  const SE3 T_world_co = link_.body->pose() * T_body_co_;
  const double time_s = world_.time().seconds();
  double worst = 0.0;
  Eigen::Vector3d where = Eigen::Vector3d::Zero();
  double depth_there = 0.0, least = 0.0;
  for (const double y : vessel_.hull.offsets) {
    for (const HullSection& section : vessel_.hull.sections) {
      const Eigen::Vector3d p = T_world_co * Eigen::Vector3d(section.x, y, 0.0);
      const double depth = sea.depth_m(p.head<2>(), time_s) + place_.level_m;
      if (depth - section.draft >= worst) continue;
      worst = depth - section.draft;
      where = p;
      depth_there = depth;
      least = section.draft;
    }
  }
  if (worst >= 0.0) return;
  throw Error(owner_ + ": vessel '" + vessel_.name +
              "' would stand on the ground at x = " + number_text(where.x()) +
              ", y = " + number_text(where.y()) + ": the water is " + number_text(depth_there) +
              " m deep there, legal is >= " + number_text(least) + " m, its draft");
}

/// By the wind relative to the hull, in its axes.
Vector6d VesselBody::wind_on_hull(const Afloat& now) const {
  const Air* const air = around_.air();
  if (air == nullptr || !air->blows() || vessel_.wind.isZero()) return Vector6d::Zero();
  const Eigen::Vector3d wind = air->wind(now.T_world_co.p);
  return wind_wrench(vessel_.wind, now.T_world_co.R.conjugate() * wind - now.nu.head<3>());
}

/// Everything at the beginning of the step, in which forces act. Gravity may be set while the world
/// runs; buoyancy then changes with it.
Afloat VesselBody::sense(World& world, const StepInfo& info) {
  look_around(world);
  if (gravity_of(world) != gravity_) {
    gravity_ = gravity_of(world);
    hull_ = Hull(vessel_.hull, vessel_.water_density, gravity_);
  }
  const Body& body = *link_.body;
  const double time_s = info.begin.seconds();
  Afloat now;
  now.T_world_co = body.pose() * T_body_co_;
  const Eigen::Matrix3d R_co_world = now.T_world_co.R.toRotationMatrix().transpose();
  const Eigen::Vector3d v_world = body.velocity_at(now.T_world_co.p);
  now.nu << R_co_world * v_world, R_co_world * body.angular_velocity();
  SE3 T_sea_co = now.T_world_co;
  T_sea_co.p.z() -= place_.level_m;
  if (around_.sea() == nullptr) {
    now.load = hull_.load(T_sea_co, StillWater(), time_s);
  } else {
    now.load = hull_.load(T_sea_co, around_.sea()->water(), time_s);
    around_.sea()->current().add_to(T_sea_co, v_world, time_s, &now.load.water);
  }
  return now;
}

/// The engine integrates a rigid body without added mass. engine_wrench() is the force that gives
/// this body the acceleration which Fossen's equation, (M_RB + M_A) nu' + ... = tau, has; what the
/// engine applies by itself (weight, forces of others) is handed in and taken out again.
void VesselBody::push(const World& world, const StepInfo& info, const Afloat& now,
                      const Vector6d& tau_actuators) {
  const Vector6d tau = tau_actuators + wind_on_hull(now);
  if (legacy_) return push_legacy(info, now, tau);
  const Body& body = *link_.body;
  const Eigen::Matrix3d R = now.T_world_co.R.toRotationMatrix();
  const Eigen::Vector3d& r_cg = dynamics_->rigid_body().center_of_gravity;
  const Eigen::Vector3d weight =
      R.transpose() * Eigen::Vector3d(body.weight_mass() * world.physics().gravity);
  const Eigen::Vector3d p_weight = r_cg + T_body_co_.R.conjugate() * body.weight_point();
  const Eigen::Vector3d force = R.transpose() * body.applied_force();
  Vector6d engine;  // what it has already, about CO
  engine << force + weight,
      R.transpose() * body.applied_torque() + r_cg.cross(force) + p_weight.cross(weight);
  add_about_cg(now, dynamics_->engine_wrench(now.nu, now.load.water, engine + now.load.wrench + tau,
                                             engine, info.dt_s));
}

/// As VRX does it: buoyancy of points, and the force of the velocity of the link's origin at the
/// centre of gravity.
void VesselBody::push_legacy(const StepInfo& info, const Afloat& now, const Vector6d& tau) {
  add_about_cg(now, tau);
  Body& body = *link_.body;
  const SE3 T_world_link = link_.T_world_link();
  SE3 T_sea_link = T_world_link;
  T_sea_link.p.z() -= place_.level_m;
  const StillWater still;
  const Water& water =
      around_.sea() == nullptr ? static_cast<const Water&>(still) : around_.sea()->water();
  const Vector6d lift =
      legacy_->hull.wrench(T_sea_link, place_.T_link_co, water, info.begin.seconds());
  const Eigen::Matrix3d R = T_world_link.R.toRotationMatrix();
  Vector6d nu;
  nu << R.transpose() * link_.v_world_at(T_world_link.p), R.transpose() * body.angular_velocity();
  const Vector6d wrench = turned(R, legacy_->force.wrench(nu, info.dt_s)) + lift;
  body.apply_force(wrench.head<3>());
  body.apply_torque(wrench.tail<3>());
}

/// The engine takes forces at the center of mass, in world axes.
void VesselBody::add_about_cg(const Afloat& now, const Vector6d& wrench) {
  const Vector6d at_cg =
      turned(now.T_world_co.R.toRotationMatrix(),
             about_center_of_gravity(wrench, dynamics_->rigid_body().center_of_gravity));
  link_.body->apply_force(at_cg.head<3>());
  link_.body->apply_torque(at_cg.tail<3>());
}

void VesselBody::reset() {
  if (legacy_) legacy_->force.reset();
}

void VesselBody::state(StateArchive& archive) {
  if (legacy_) legacy_->force.state(archive);
}

}  // namespace trident::sim
