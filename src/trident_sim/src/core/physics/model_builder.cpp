// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "composite_inertia.h"
#include "joint_anchor.h"
#include "ode_joint.h"
#include "physics_engine.h"
#include "shapes.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

/// Which links move as one: disjoint sets joined by rigid and rotor joints. The last element stands
/// for the world.
class LinkGroups {
 public:
  explicit LinkGroups(std::size_t links) : parent_(links + 1) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t world() const { return parent_.size() - 1; }
  std::size_t find(std::size_t i) const { return parent_[i] == i ? i : find(parent_[i]); }
  void join(std::size_t a, std::size_t b) {
    // The lower index leads, so that a body has the frame of its first link; the world always does.
    const std::size_t lo = std::min(find(a), find(b));
    const std::size_t hi = std::max(find(a), find(b));
    if (lo == hi) return;
    if (hi == world()) {
      parent_[lo] = hi;
    } else {
      parent_[hi] = lo;
    }
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Makes a model's bodies, shapes and joints from its spec. The order of run() matters: which links
/// share a body follows from the joints, so joints are read before bodies and made after them.
class Builder {
 public:
  Builder(Model& model, const std::vector<std::string>& rotor_joints, dWorldID world,
          const PhysicsEngine::Guard& guard)
      : model_(model),
        spec_(model.spec),
        guard_(guard),
        rotor_names_(rotor_joints.begin(), rotor_joints.end()),
        world_(world),
        groups_(spec_.links.size()) {}

  void run() {
    index_links();
    group_links();
    make_links();
    make_bodies();
    make_geoms();
    make_joints();
  }

 private:
  // The world is one more group behind the links, so that a link fixed to it becomes static.
  std::size_t link_index(const std::string& name, const std::string& joint) const {
    if (name == "world") return groups_.world();
    const auto it = index_.find(name);
    if (it == index_.end()) {
      throw Error("model '" + model_.name + "': joint '" + joint + "' names link '" + name +
                  "', which is not there");
    }
    return it->second;
  }

  void index_links() {
    for (std::size_t i = 0; i < spec_.links.size(); ++i) {
      if (!index_.emplace(spec_.links[i].name, i).second) {
        throw Error("model '" + model_.name + "': two links are named '" + spec_.links[i].name +
                    "'");
      }
    }
  }

  // A rotor joint joins its links, too: the rotor is kept as a scalar rate on its carrier's body
  // (docs/explanation/physics.md), whose mass then includes the rotor's.
  void group_links() {
    for (const JointSpec& joint : spec_.joints) {
      const std::size_t parent = link_index(joint.parent, joint.name);
      const std::size_t child = link_index(joint.child, joint.name);
      if (joint.rigid() || is_rotor(joint.name)) groups_.join(parent, child);
    }
    if (model_.is_static) {
      for (std::size_t i = 0; i < spec_.links.size(); ++i) groups_.join(i, groups_.world());
    }
  }

  // Until attach_link() puts a link on a body, T_body_link is T_world_link: that of a static link.
  void make_links() {
    for (const LinkSpec& spec : spec_.links) {
      auto link = std::make_unique<Link>();
      link->name = spec.name;
      link->inertial = spec.inertial;
      link->gravity = spec.gravity;
      link->T_body_link = model_.T_world_model_initial * spec.T_model_link;
      model_.links.push_back(std::move(link));
    }
  }

  bool is_rotor(const std::string& joint) const { return rotor_names_.count(joint) != 0; }

  const JointSpec* rotor_joint_of(const std::string& child) const {
    for (const JointSpec& joint : spec_.joints) {
      if (joint.child == child && is_rotor(joint.name)) return &joint;
    }
    return nullptr;
  }

  BodyPart part(std::size_t i) const {
    const JointSpec* rotor = rotor_joint_of(spec_.links[i].name);
    return {&spec_.links[i], rotor == nullptr ? nullptr : &rotor->axis_model};
  }

  // std::map: bodies come in the order of their first links, which the solver's results depend on.
  void make_bodies() {
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t i = 0; i < spec_.links.size(); ++i) members[groups_.find(i)].push_back(i);
    for (const auto& [leader, links] : members) {
      if (leader == groups_.world()) continue;
      model_.bodies.push_back(make_body(leader, links));
      for (const std::size_t i : links) attach_link(engine_body(*model_.bodies.back()), i);
    }
  }

  // The origin is the composite center of mass, as ODE requires, the axes are those of the first
  // link.
  std::unique_ptr<EngineBody> make_body(std::size_t leader, const std::vector<std::size_t>& links) {
    auto body = std::make_unique<EngineBody>();
    const LinkSpec& first = spec_.links[leader];
    body->name = model_.name + "::" + first.name;
    std::vector<BodyPart> parts;
    parts.reserve(links.size());
    for (const std::size_t i : links) parts.push_back(part(i));
    const CompositeInertia inertia = compose_inertia(parts);
    body->T_world_body =
        model_.T_world_model_initial * SE3{first.T_model_link.R, inertia.p_model_com};
    body->set_orientation(body->T_world_body.R);
    body->T_world_body_initial = body->T_world_body;
    // Of links that are fixed to each other only the first one's switches count.
    body->kinematic = first.kinematic;
    body->damping.linear = first.linear_damping;
    body->damping.angular = first.angular_damping;
    body->self_collide = spec_.self_collide;
    body->owner = &model_;
    make_ode_body(*body);
    set_inertia(*body, inertia, first.T_model_link.R);
    return body;
  }

  // ODE's copy of a body sleeps until the constraint solver enables it with its island: free bodies
  // are moved by the engine itself, which also applies gravity.
  void make_ode_body(EngineBody& body) {
    body.ode = dBodyCreate(world_);
    dBodySetGyroscopicMode(body.ode, 0);  // the engine adds that torque, rotors included
    dBodySetGravityMode(body.ode, 0);
    dBodySetAutoDisableFlag(body.ode, 0);
    dBodySetData(body.ode, &body);
    if (body.kinematic) dBodySetKinematic(body.ode);
    dBodyDisable(body.ode);
  }

  void attach_link(EngineBody& body, std::size_t i) {
    Link& link = *model_.links[i];
    link.body = &body;
    link.T_body_link = body.T_world_body.inverse() * link.T_body_link;
  }

  void make_geoms() {
    for (std::size_t i = 0; i < spec_.links.size(); ++i) {
      Link& link = *model_.links[i];
      for (const CollisionSpec& spec : spec_.links[i].collisions) {
        // One odd collision is left out, or refused, as the world's policy says.
        guard_([&] { add_collision(link, spec); });
      }
    }
    for (const auto& body : model_.bodies) bound(engine_body(*body));
  }

  void add_collision(Link& link, const CollisionSpec& spec) {
    EngineGeom geom =
        make_geom(spec, model_.name + "::" + link.name + "::" + spec.name, link.body != nullptr);
    const SE3 T_base_shape = link.T_body_link * spec.T_link_shape;
    geom.surface.fdir1 = T_base_shape.R * geom.surface.fdir1;
    if (link.body == nullptr) {
      place_static_geom(geom, T_base_shape);
      if (model_.static_geoms == nullptr) model_.static_geoms = std::make_shared<StaticGeoms>();
      model_.static_geoms->geoms.push_back(std::move(geom));
    } else {
      place_on_body(engine_body(*link.body), std::move(geom), T_base_shape);
    }
  }

  void place_on_body(EngineBody& body, EngineGeom geom, const SE3& T_body_shape) {
    if (must_be_static(geom)) {
      const std::string name = geom.name;
      const char* kind = geom.heightfield != nullptr ? "heightmap" : "plane";
      destroy_geom(geom);
      throw Error("collision '" + name + "' is a " + kind + " on a link that moves; a " + kind +
                  " must be static");
    }
    // ODE moves the geometry with its body; the offset is from the center of mass.
    dGeomSetBody(geom.id, body.ode);
    dGeomSetOffsetPosition(geom.id, T_body_shape.p.x(), T_body_shape.p.y(), T_body_shape.p.z());
    const dQuaternion q = {T_body_shape.R.w(), T_body_shape.R.x(), T_body_shape.R.y(),
                           T_body_shape.R.z()};
    dGeomSetOffsetQuaternion(geom.id, q);
    body.geoms.push_back(std::move(geom));
  }

  /// Bounding sphere of all shapes, from their boxes while the ODE body is at the origin.
  static void bound(EngineBody& body) {
    if (body.geoms.empty()) return;
    Eigen::AlignedBox3d all;
    std::vector<Eigen::AlignedBox3d> boxes;
    for (const EngineGeom& geom : body.geoms) {
      dReal aabb[6];
      dGeomGetAABB(geom.id, aabb);
      boxes.emplace_back(Eigen::Vector3d(aabb[0], aabb[2], aabb[4]),
                         Eigen::Vector3d(aabb[1], aabb[3], aabb[5]));
      all.extend(boxes.back());
    }
    body.bound_center = all.center();
    for (const auto& box : boxes) {
      const Eigen::Vector3d reach = (box.max() - body.bound_center)
                                        .cwiseAbs()
                                        .cwiseMax((box.min() - body.bound_center).cwiseAbs());
      body.bound_radius_m = std::max(body.bound_radius_m, reach.norm());
    }
  }

  /// Joints between links of one body are not made: a rigid joint holds them together already.
  /// Those of ODE wait until all bodies stand where they belong.
  void make_joint(const JointSpec& spec) {
    auto joint = std::make_unique<Joint>();
    joint->spec = spec;
    joint->parent = model_.find_link(spec.parent);
    joint->child = model_.find_link(spec.child);
    if (is_rotor(spec.name)) {
      make_rotor(*joint);
    } else if (!spec.rigid() && joint->child->body != body_of(joint->parent)) {
      pending_.push_back(joint.get());
    }
    model_.joints.push_back(std::move(joint));
  }

  void make_joints() {
    for (const JointSpec& spec : spec_.joints) make_joint(spec);
    // Joints take the present poses as their zero.
    place_as_spawned(model_);
    for (Joint* joint : pending_) {
      if (joint->spec.type == JointType::kGearbox) add_shaft(*joint);
      make_ode_joint(model_, *joint, world_);
    }
  }

  void add_shaft(Joint& joint) {
    const std::string& reference = joint.spec.gearbox_reference_body;
    if (link_index(reference, joint.spec.name) != groups_.world()) {
      joint.reference = model_.find_link(reference)->body;
    }
    const EngineBody *parent = body_of(joint.parent), *child = engine_body(joint.child->body);
    if (parent == nullptr || child == nullptr || parent == joint.reference ||
        child == joint.reference) {
      throw Error("model '" + model_.name + "': gearbox '" + joint.spec.name +
                  "': parent and child must move against the reference body '" + reference + "'");
    }
    model_.bodies.push_back(make_shaft(model_, joint, world_));
    joint.shaft = model_.bodies.back().get();
  }

  static EngineBody* body_of(const Link* link) {
    return link == nullptr ? nullptr : engine_body(link->body);
  }

  void make_rotor(Joint& joint) const {
    joint.is_rotor = true;
    const LinkSpec& spec = spec_.links[index_.at(joint.spec.child)];
    joint.rotor_inertia = rotor_inertia(spec, joint.spec.axis_model);
    if (joint.child->body == nullptr) return;
    const Eigen::Quaterniond R_world_model = model_.T_world_model_initial.R;
    joint.axis_body =
        joint.child->body->pose().R.conjugate() * (R_world_model * joint.spec.axis_model);
    joint.rotor_axis_body = joint.axis_body;
  }

  Model& model_;
  const ModelSpec& spec_;
  const PhysicsEngine::Guard& guard_;
  std::set<std::string> rotor_names_;
  dWorldID world_;
  LinkGroups groups_;
  std::map<std::string, std::size_t> index_;
  std::vector<Joint*> pending_;
};

void destroy_geoms(std::vector<EngineGeom>& geoms) {
  for (EngineGeom& geom : geoms) destroy_geom(geom);
  geoms.clear();
}

}  // namespace

void PhysicsEngine::build(Model& model, const std::vector<std::string>& rotor_joints,
                          const Guard& guard) {
  try {
    Builder(model, rotor_joints, world_, guard).run();
  } catch (...) {
    // What was made so far is in ODE's world and must go.
    destroy(model);
    throw;
  }
}

void PhysicsEngine::destroy(Model& model) {
  for (const auto& joint : model.joints) destroy_ode_joint(*joint);
  for (const auto& body : model.bodies) {
    EngineBody& own = engine_body(*body);
    destroy_geoms(own.geoms);
    if (own.ode != nullptr) dBodyDestroy(own.ode);
    own.ode = nullptr;
  }
  if (model.static_geoms == nullptr) return;
  destroy_geoms(model.static_geoms->geoms);
  model.static_geoms.reset();
}

}  // namespace trident::sim
