// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Broad phase, narrow phase and contact joints of PhysicsEngine.
#include <algorithm>
#include <optional>

#include "body_sync.h"
#include "physics_engine.h"

namespace trident {
namespace {

constexpr int kRowsPerContact = 3;

/// At which a body that was put into something is pushed out, where its surface does not tell. At
/// the world's speed limit, 100 m/s where nothing else is said, a robot spawned in a wall would be
/// shot into the sky.
constexpr double kEmergingSpeed = 0.5;

/// Several contacts under one body hold it more often than it can move, which the exact solver
/// needs a little softness to tell apart: 1e10 N/m at a step of 10 ms, and 1e-8 m/s of creep per
/// newton.
constexpr double kLeastNormalCfm = 1e-8;
constexpr double kLeastSlip = 1e-8;

/// Contact parameters of a pair, combined as Gazebo combines them: springs in series, dampers in
/// parallel, the smaller friction and restitution.
dSurfaceParameters combine(const Surface& a, const Surface& b, double dt_s) {
  dSurfaceParameters surface{};
  const double kp = 1.0 / (1.0 / a.kp_n_m + 1.0 / b.kp_n_m);
  const double kd = a.kd_ns_m + b.kd_ns_m;
  surface.mode = dContactBounce | dContactMu2 | dContactSoftERP | dContactSoftCFM |
                 dContactApprox1 | dContactSlip1 | dContactSlip2;
  surface.mu = std::min(a.mu, b.mu);
  surface.mu2 = std::min(a.mu2, b.mu2);
  surface.slip1 = std::max(kLeastSlip, std::min(a.slip1, b.slip1));
  surface.slip2 = std::max(kLeastSlip, std::min(a.slip2, b.slip2));
  surface.bounce = std::min(a.restitution, b.restitution);
  surface.bounce_vel = std::min(a.bounce_threshold_m_s, b.bounce_threshold_m_s);
  surface.soft_erp = dt_s * kp / (dt_s * kp + kd);
  surface.soft_cfm = std::max(kLeastNormalCfm, 1.0 / (dt_s * kp + kd));
  return surface;
}

/// How far a pair may sink into each other, and how fast what is deeper is pushed out.
struct Correction {
  double min_depth_m, max_vel_m_s;
};

/// `b`: nullptr when it is static. As in Gazebo a static surface has no say, of two bodies the
/// smaller value counts, and the world's maximum speed bounds them all.
Correction combine_corrections(const Surface& a, const Surface* b, const PhysicsSpec& world) {
  const auto smaller = [&](std::optional<double> Surface::*field, double of_world) {
    const double of_a = (a.*field).value_or(of_world);
    return b == nullptr ? of_a : std::min(of_a, (b->*field).value_or(of_world));
  };
  return {smaller(&Surface::min_depth_m, world.contact_surface_layer),
          std::min(smaller(&Surface::max_vel_m_s, world.contact_max_correcting_vel),
                   world.contact_max_correcting_vel)};
}

/// ODE knows one depth and one speed for the whole world and pushes out at erp / dt (depth - the
/// world's layer). This is the depth to tell it so that it follows the pair's; where they are the
/// world's, the depth itself to the last bit.
double depth_to_tell(double depth_m, const Correction& pair, const PhysicsSpec& world, double erp,
                     double dt_s) {
  const double layer = world.contact_surface_layer;
  const double depth = pair.min_depth_m == layer ? depth_m : depth_m - pair.min_depth_m + layer;
  if (pair.max_vel_m_s >= world.contact_max_correcting_vel || !(erp > 0.0)) return depth;
  return std::min(depth, layer + pair.max_vel_m_s * dt_s / erp);
}

bool boxes_overlap(const dReal* a, const dReal* b) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] &&
         b[4] <= a[5];
}

/// World direction of a surface's mu, or zero for any.
Eigen::Vector3d friction_direction(const Geom& geom, const Body* body) {
  const Eigen::Vector3d& fdir1 = geom.surface.fdir1;
  return body == nullptr ? fdir1 : Eigen::Vector3d(body->R_world_body * fdir1);
}

/// Of a geometry that is part of the world the middle of its box; a plane's has no end.
Eigen::Vector3d centre_of(const Geom& geom, const Body* body) {
  if (body != nullptr) return body->T_world_body.p;
  dReal box[6];
  dGeomGetAABB(geom.id, box);
  const Eigen::Vector3d middle =
      0.5 * Eigen::Vector3d(box[0] + box[1], box[2] + box[3], box[4] + box[5]);
  return middle.allFinite() ? middle : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Contact contact_of(const Geom& a, const Body* body_a, const Geom& b, const Body* body_b,
                   double depth_m) {
  Contact contact;
  contact.geom1 = &a;
  contact.geom2 = &b;
  contact.depth_m = depth_m;
  contact.p_world_centre1 = centre_of(a, body_a);
  contact.p_world_centre2 = centre_of(b, body_b);
  return contact;
}

}  // namespace

void PhysicsEngine::find_contacts(double dt_s) {
  if (contact_count_ > 0) dJointGroupEmpty(contacts_);
  contact_count_ = 0;
  watched_count_ = 0;
  islands_.reset(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = *bodies_[i];
    centres_[i] = body.T_world_body.p + body.R_world_body * body.bound_centre;
    if (body.bound_radius_m > 0.0 && !body.frozen) collide_with_static(body, centres_[i], dt_s);
  }
  sweep_bodies(dt_s);
  release_placed();
}

/// Whether one of two bodies was put into the other, or is on its way out since, and would be
/// pushed faster than is good.
bool PhysicsEngine::is_emerging(int found, const Surface& a, const Surface& b, const Body& body_a,
                                const Body* body_b, double dt_s) const {
  if (!body_a.placed && (body_b == nullptr || !body_b->placed)) return false;
  const double of_world = spec_.contact_max_correcting_vel;
  if (combine_corrections(a, body_b == nullptr ? nullptr : &b, spec_).max_vel_m_s < of_world) {
    return false;
  }
  double depth_m = 0.0;
  for (int i = 0; i < found; ++i) {
    depth_m = std::max(depth_m, double{contact_buffer_[static_cast<std::size_t>(i)].geom.depth});
  }
  const double erp = combine(a, b, dt_s).soft_erp;
  return erp * (depth_m - spec_.contact_surface_layer) > kEmergingSpeed * dt_s;
}

/// A model emerges as a whole: bodies of one follow each other.
void PhysicsEngine::release_placed() {
  for (std::size_t first = 0, end = 0; first < bodies_.size(); first = end) {
    bool any = false;
    for (; end < bodies_.size() && bodies_[end]->owner == bodies_[first]->owner; ++end) {
      any = any || bodies_[end]->emerging;
    }
    for (std::size_t i = first; i < end; ++i) {
      bodies_[i]->placed = bodies_[i]->placed && any;
      bodies_[i]->emerging = false;
    }
  }
}

void PhysicsEngine::sweep_bodies(double dt_s) {
  const auto low = [this](std::size_t i) { return centres_[i].x() - bodies_[i]->bound_radius_m; };
  // Insertion sort: the order hardly changes from step to step.
  for (std::size_t k = 1; k < order_.size(); ++k) {
    const std::size_t moved = order_[k];
    std::size_t at = k;
    for (; at > 0 && low(order_[at - 1]) > low(moved); --at) order_[at] = order_[at - 1];
    order_[at] = moved;
  }
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t i = order_[k];
    const double high = centres_[i].x() + bodies_[i]->bound_radius_m;
    for (std::size_t m = k + 1; m < order_.size() && low(order_[m]) <= high; ++m) {
      const std::size_t j = order_[m];
      const double reach = bodies_[i]->bound_radius_m + bodies_[j]->bound_radius_m;
      if ((centres_[i] - centres_[j]).squaredNorm() > reach * reach) continue;
      collide_bodies(*bodies_[std::min(i, j)], *bodies_[std::max(i, j)], dt_s);
    }
  }
}

void PhysicsEngine::collide_with_static(Body& body, const Eigen::Vector3d& centre, double dt_s) {
  bool pushed = false;
  for (const StaticGeom& other : statics_) {
    if (other.is_plane) {
      if (other.normal.dot(centre) - other.offset > body.bound_radius_m) continue;
    } else {
      const Eigen::Vector3d nearest = centre.cwiseMax(other.lo).cwiseMin(other.hi);
      if ((nearest - centre).squaredNorm() > body.bound_radius_m * body.bound_radius_m) continue;
    }
    if (!pushed) push(body);
    pushed = true;
    for (Geom& geom : body.geoms) collide_geoms(geom, &body, *other.geom, nullptr, dt_s);
  }
}

void PhysicsEngine::collide_bodies(Body& a, Body& b, double dt_s) {
  if (a.owner == b.owner && !a.self_collide) return;
  if (a.frozen || b.frozen) return;
  if (dAreConnectedExcluding(a.ode, b.ode, dJointTypeContact)) return;
  push(a);
  push(b);
  for (Geom& geom_a : a.geoms) {
    for (Geom& geom_b : b.geoms) collide_geoms(geom_a, &a, geom_b, &b, dt_s);
  }
}

void PhysicsEngine::collide_geoms(Geom& a, Body* body_a, Geom& b, Body* body_b, double dt_s) {
  if ((a.surface.collide_bitmask & b.surface.collide_bitmask) == 0) return;
  dReal box_a[6], box_b[6];
  dGeomGetAABB(a.id, box_a);
  dGeomGetAABB(b.id, box_b);
  if (!boxes_overlap(box_a, box_b)) return;
  const int found = dCollide(a.id, b.id, static_cast<int>(contact_buffer_.size()),
                             &contact_buffer_[0].geom, sizeof(dContact));
  Correction correction =
      combine_corrections(a.surface, body_b == nullptr ? nullptr : &b.surface, spec_);
  const Eigen::Vector3d direction =
      a.surface.fdir1.isZero() ? friction_direction(b, body_b) : friction_direction(a, body_a);
  const bool is_watched = a.watchers + b.watchers > 0;
  if (is_emerging(found, a.surface, b.surface, *body_a, body_b, dt_s)) {
    correction.max_vel_m_s = std::min(correction.max_vel_m_s, kEmergingSpeed);
    body_a->emerging = true;
    if (body_b != nullptr) body_b->emerging = true;
  }
  for (int i = 0; i < found; ++i) {
    dContact& contact = contact_buffer_[static_cast<std::size_t>(i)];
    const double depth_m = contact.geom.depth;
    contact.surface = combine(a.surface, b.surface, dt_s);
    contact.geom.depth =
        depth_to_tell(contact.geom.depth, correction, spec_, contact.surface.soft_erp, dt_s);
    if (!direction.isZero()) {
      const Eigen::Vector3d normal(contact.geom.normal[0], contact.geom.normal[1],
                                   contact.geom.normal[2]);
      const Eigen::Vector3d tangent = direction - normal * normal.dot(direction);
      if (tangent.norm() > 1e-9) {
        contact.surface.mode |= dContactFDir1;
        for (int k = 0; k < 3; ++k) contact.fdir1[k] = tangent.normalized()[k];
      }
    }
    const dJointID joint = dJointCreateContact(world_, contacts_, &contact);
    dJointAttach(joint, body_a ? body_a->ode : nullptr, body_b ? body_b->ode : nullptr);
    ++contact_count_;
    if (is_watched) watch(joint, contact.geom, contact_of(a, body_a, b, body_b, depth_m));
  }
  if (found == 0) return;
  body_a->in_contact = true;
  islands_.add_rows(body_a->number, kRowsPerContact * found);
  if (body_b == nullptr) return;
  body_b->in_contact = true;
  islands_.join(body_a->number, body_b->number);
}

void PhysicsEngine::watch(dJointID joint, const dContactGeom& found, const Contact& of) {
  if (watched_count_ == watched_.size()) watched_.emplace_back();
  Watched& watched = watched_[watched_count_++];
  watched.contact = of;
  watched.contact.p_world = {found.pos[0], found.pos[1], found.pos[2]};
  watched.contact.normal_world = {found.normal[0], found.normal[1], found.normal[2]};
  watched.feedback = {};
  dJointSetFeedback(joint, &watched.feedback);
}

void PhysicsEngine::tell_contacts() {
  told_.clear();
  for (std::size_t i = 0; i < watched_count_; ++i) {
    const dReal* const force = watched_[i].feedback.f1;
    told_.push_back(watched_[i].contact);
    told_.back().force_world = {force[0], force[1], force[2]};
  }
}

}  // namespace trident
