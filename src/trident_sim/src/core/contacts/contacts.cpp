// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Broad phase, narrow phase and contact joints of PhysicsEngine.
#include <algorithm>
#include <limits>

#include "contact_margin.h"
#include "contact_surface.h"
#include "core/physics/body_sync.h"
#include "core/physics/physics_engine.h"

namespace trident::sim {
namespace {

/// At which a body that was put into something is pushed out, where its surface does not say. At
/// the world's speed limit, 100 m/s where nothing else is said, a robot spawned in a wall would be
/// shot into the sky.
constexpr double kDepenetrationSpeed = 0.5;

/// To which a mesh on the ground or on a mesh stays inside [m].
constexpr double kSunkMesh_m = 5e-4;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool boxes_overlap(const dReal* a, const dReal* b) {
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] &&
         b[4] <= a[5];
}

/// World direction of a surface's mu, or zero for any.
Eigen::Vector3d friction_direction(const EngineGeom& geom, const EngineBody* body) {
  const Eigen::Vector3d& fdir1 = geom.surface.fdir1;
  return body == nullptr ? fdir1 : Eigen::Vector3d(body->R_world_body * fdir1);
}

/// Whether a contact restores a part of the speed of the impact.
bool bounces(const Touch& touch) {
  const dSurfaceParameters& surface = touch.ode.surface;
  if (!(surface.bounce > 0.0)) return false;
  const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(touch.ode.geom.pos);
  const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3d>(touch.ode.geom.normal);
  Eigen::Vector3d velocity = touch.a->velocity_at(p);
  if (touch.b != nullptr) velocity -= touch.b->velocity_at(p);
  return -velocity.dot(normal) > surface.bounce_vel;
}

/// What each pass of the solver puts right of a contact's depth. A gap may close within the step,
/// but for what would bounce of less speed then.
void share_depth(Touch& touch, const Correction& pair, double dt_s) {
  dSurfaceParameters& surface = touch.ode.surface;
  const double depth_m = std::max(0.0, touch.ode.geom.depth - pair.min_depth_m);
  // A fraction soft_erp of the depth is put right in a step.
  const double depth_per_speed_s = surface.soft_erp > 0.0 ? dt_s / surface.soft_erp : 0.0;
  touch.depth_m[0] = std::min(depth_m, pair.most_m_s * depth_per_speed_s);
  touch.depth_m[1] = std::min(touch.depth_m[0], pair.max_vel_m_s * depth_per_speed_s);
  if (touch.ode.geom.depth >= 0.0 || bounces(touch)) return;
  surface.mode |= dContactMotionN;
  surface.motionN = touch.ode.geom.depth / dt_s;
}

/// Lays the first direction of friction along what of `direction` is in the contact's plane.
void lay_friction(dContact& contact, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d normal(contact.geom.normal[0], contact.geom.normal[1],
                               contact.geom.normal[2]);
  const Eigen::Vector3d tangent = direction - normal * normal.dot(direction);
  if (tangent.norm() <= 1e-9) return;
  contact.surface.mode |= dContactFDir1;
  for (int k = 0; k < 3; ++k) contact.fdir1[k] = tangent.normalized()[k];
}

/// Of a geometry that is part of the world the middle of its box; a plane's has no end.
Eigen::Vector3d center_of(const EngineGeom& geom, const EngineBody* body) {
  if (body != nullptr) return body->T_world_body.p;
  dReal box[6];
  dGeomGetAABB(geom.id, box);
  const Eigen::Vector3d middle =
      0.5 * Eigen::Vector3d(box[0] + box[1], box[2] + box[3], box[4] + box[5]);
  return middle.allFinite() ? middle : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

Contact contact_of(const EngineGeom& a, const EngineBody* body_a, const EngineGeom& b,
                   const EngineBody* body_b, const dContactGeom& found) {
  Contact contact;
  contact.geom1 = &a;
  contact.geom2 = &b;
  contact.depth_m = found.depth;
  contact.p_world = {found.pos[0], found.pos[1], found.pos[2]};
  contact.normal_world = {found.normal[0], found.normal[1], found.normal[2]};
  contact.p_world_center1 = center_of(a, body_a);
  contact.p_world_center2 = center_of(b, body_b);
  return contact;
}

bool may_collide(const EngineBody& a, const EngineBody& b) {
  // As in Gazebo, links of a model collide only with <self_collide>, and never across a joint.
  if (a.owner == b.owner && !a.self_collide) return false;
  if (a.frozen || b.frozen) return false;
  return dAreConnectedExcluding(a.ode, b.ode, dJointTypeContact) == 0;
}

}  // namespace

/// Whether a sphere reaches the geometry, or the box around it.
bool PhysicsEngine::reaches(const Eigen::Vector3d& center, double radius_m,
                            const StaticGeom& geom) {
  if (geom.is_plane) return !(geom.normal.dot(center) - geom.offset > radius_m);
  const Eigen::Vector3d nearest = center.cwiseMax(geom.lo).cwiseMin(geom.hi);
  return !((nearest - center).squaredNorm() > radius_m * radius_m);
}

void PhysicsEngine::find_contacts(double dt_s) {
  solver_->begin_step(bodies_.size());
  watched_.clear();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    EngineBody& body = *bodies_[i];
    centers_[i] = body.T_world_body.p + body.R_world_body * body.bound_center;
    if (body.bound_radius_m > 0.0 && !body.frozen) collide_with_static(body, centers_[i], dt_s);
  }
  sweep_bodies(dt_s);
  release_placed();
}

/// A model emerges as a whole: bodies of one follow each other.
void PhysicsEngine::release_placed() {
  for (std::size_t first = 0, end = 0; first < bodies_.size(); first = end) {
    bool any = false;
    for (; end < bodies_.size() && bodies_[end]->owner == bodies_[first]->owner; ++end) {
      any = any || bodies_[end]->depenetrating;
    }
    for (std::size_t i = first; i < end; ++i) {
      bodies_[i]->placed = bodies_[i]->placed && any;
      bodies_[i]->depenetrating = false;
    }
  }
}

double PhysicsEngine::low_x(std::size_t body) const {
  return centers_[body].x() - bodies_[body]->bound_radius_m;
}

/// Insertion sort: the order hardly changes from step to step.
void PhysicsEngine::sort_bodies() {
  for (std::size_t k = 1; k < order_.size(); ++k) {
    const std::size_t moved = order_[k];
    std::size_t at = k;
    for (; at > 0 && low_x(order_[at - 1]) > low_x(moved); --at) order_[at] = order_[at - 1];
    order_[at] = moved;
  }
}

void PhysicsEngine::sweep_bodies(double dt_s) {
  sort_bodies();
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::size_t i = order_[k];
    const double high = centers_[i].x() + bodies_[i]->bound_radius_m;
    // Sweep and prune along x: later bodies begin beyond this one's end.
    for (std::size_t m = k + 1; m < order_.size() && low_x(order_[m]) <= high; ++m) {
      const std::size_t j = order_[m];
      const double reach = bodies_[i]->bound_radius_m + bodies_[j]->bound_radius_m;
      if ((centers_[i] - centers_[j]).squaredNorm() > reach * reach) continue;
      // In order of the bodies' numbers: which one is first decides signs and sums in the solver.
      collide_bodies(*bodies_[std::min(i, j)], *bodies_[std::max(i, j)], dt_s);
    }
  }
}

void PhysicsEngine::collide_with_static(EngineBody& body, const Eigen::Vector3d& center,
                                        double dt_s) {
  bool pushed = false;
  for (const StaticGeom& other : statics_) {
    if (!reaches(center, body.bound_radius_m, other)) continue;
    // ODE's copy of a pose is brought up to date only where it is needed.
    if (!pushed) push(body);
    pushed = true;
    for (EngineGeom& geom : body.geoms) collide_geoms(geom, &body, *other.geom, nullptr, dt_s);
  }
}

void PhysicsEngine::collide_bodies(EngineBody& a, EngineBody& b, double dt_s) {
  if (!may_collide(a, b)) return;
  push(a);
  push(b);
  for (EngineGeom& geom_a : a.geoms) {
    for (EngineGeom& geom_b : b.geoms) collide_geoms(geom_a, &a, geom_b, &b, dt_s);
  }
}

void PhysicsEngine::collide_geoms(EngineGeom& a, EngineBody* body_a, EngineGeom& b,
                                  EngineBody* body_b, double dt_s) {
  if ((a.surface.collide_bitmask & b.surface.collide_bitmask) == 0) return;
  dReal box_a[6], box_b[6];
  dGeomGetAABB(a.id, box_a);
  dGeomGetAABB(b.id, box_b);
  if (!boxes_overlap(box_a, box_b)) return;
  const int found = dCollide(a.id, b.id, static_cast<int>(contact_buffer_.size()),
                             &contact_buffer_[0].geom, sizeof(dContact));
  if (found == 0) return;
  // Shapes were grown by their margins for the search; depths are those of the true shapes.
  double deepest_m = -kInfinity;
  for (int i = 0; i < found; ++i) {
    dContactGeom& contact = contact_buffer_[static_cast<std::size_t>(i)].geom;
    take_margins_off(contact, a, b);
    deepest_m = std::max(deepest_m, double{contact.depth});
  }
  const Correction correction = correct(a, body_a, b, body_b, deepest_m, dt_s);
  const Eigen::Vector3d direction =
      a.surface.fdir1.isZero() ? friction_direction(b, body_b) : friction_direction(a, body_a);
  Touch touch;
  touch.a = body_a;
  touch.b = body_b;
  const dSurfaceParameters surface = combine_surfaces(a.surface, b.surface, dt_s);
  for (int i = 0; i < found; ++i) {
    touch.ode = contact_buffer_[static_cast<std::size_t>(i)];
    touch.ode.surface = surface;
    if (!direction.isZero()) lay_friction(touch.ode, direction);
    share_depth(touch, correction, dt_s);
    if (a.watchers + b.watchers > 0) {
      watched_.push_back(
          {contact_of(a, body_a, b, body_b, touch.ode.geom), solver_->touches().size()});
    }
    solver_->add(touch);
  }
  body_a->in_contact = true;
  if (body_b != nullptr) body_b->in_contact = true;
}

/// What is to be put right of a pair's depth, more slowly while one of the two was put into the
/// other, or moves out of it since.
Correction PhysicsEngine::correct(const EngineGeom& a, EngineBody* body_a, const EngineGeom& b,
                                  EngineBody* body_b, double deepest_m, double dt_s) {
  Correction pair = combine_corrections(a.surface, body_b == nullptr ? nullptr : &b.surface, spec_);
  // Shapes without a margin are known to touch only by their being inside.
  if (!(a.margin_m + b.margin_m > 0.0)) pair.min_depth_m = std::max(pair.min_depth_m, kSunkMesh_m);
  if (!body_a->placed && (body_b == nullptr || !body_b->placed)) return pair;
  if (deepest_m - pair.min_depth_m <= kDepenetrationSpeed * dt_s) return pair;
  body_a->depenetrating = true;
  if (body_b != nullptr) body_b->depenetrating = true;
  pair.most_m_s = kDepenetrationSpeed;
  return pair;
}

void PhysicsEngine::report_contacts() {
  reported_contacts_.clear();
  for (const Watched& watched : watched_) {
    // f1 is the force on the first body, in world axes.
    const dReal* const force = solver_->touches()[watched.touch].feedback.f1;
    Contact contact = watched.contact;
    contact.force_world = {force[0], force[1], force[2]};
    if (contact.depth_m < 0.0 && contact.force_world.isZero(0.0)) continue;  // a gap is no contact
    contact.depth_m = std::max(0.0, contact.depth_m);
    reported_contacts_.push_back(contact);
  }
}

}  // namespace trident::sim
