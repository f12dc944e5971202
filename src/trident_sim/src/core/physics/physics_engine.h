// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/contacts/constraint_solver.h"
#include "core/contacts/contact_surface.h"
#include "trident_sim/model.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/world/contact.h"

namespace trident::sim {

/// Deeper than this nobody puts a body on purpose; wheels and feet that stand a little low are
/// less.
constexpr double kDeepContact_m = 0.01;

/// Moves bodies. ODE solves contacts and joints; a body with neither is integrated here by the same
/// semi-implicit Euler step, which costs a tenth of ODE's bookkeeping. The result does not depend
/// on the order in which models were added.
class PhysicsEngine {
 public:
  /// Receives what the user should know, a line each.
  using Report = std::function<void(const std::string&)>;
  /// `rotor_axes_lag`: the axes of rotor joints lag behind their carriers as in Gazebo.
  PhysicsEngine(const PhysicsSpec& spec, bool rotor_axes_lag, Report report);
  ~PhysicsEngine();
  PhysicsEngine(const PhysicsEngine&) = delete;
  PhysicsEngine& operator=(const PhysicsEngine&) = delete;

  void configure(const PhysicsSpec& spec);

  /// Runs what makes a collision, and decides whether an Error of it is rethrown.
  using Guard = std::function<void(const std::function<void()>& make)>;
  /// Makes the bodies, geometries and joints of `model` from its spec, at the initial pose.
  /// `rotor_joints`: names of the joints whose rotors are kept as scalars.
  void build(Model& model, const std::vector<std::string>& rotor_joints, const Guard& guard);
  void destroy(Model& model);
  /// Takes over the list of models, in the order in which they are to be stepped.
  void set_models(const std::vector<Model*>& models);

  void step(double dt_s);
  /// The next step does not depend on the contacts of the last one.
  void forget_contacts();
  /// Copies poses and velocities of the bodies of `model` into ODE, after they were set by hand.
  void push_state(Model& model);
  void push_state(Body& body);
  /// Of the last step, of the geometries that are watched.
  const std::vector<Contact>& contacts() const { return reported_contacts_; }
  /// How far a collision is inside another one. Names are those of geometries.
  struct Overlap {
    std::string own, other;
    double depth_m = 0.0;
  };
  /// The deepest one of a model that can move, with the world or another model, as they stand now.
  std::optional<Overlap> deepest_overlap(const Model& model);
  /// What the next step's result depends on besides the bodies and joints.
  void state(StateArchive& archive);

 private:
  /// A body with rotors: the joints from `first` to `last` - 1.
  struct RotorCarrier {
    EngineBody* body;
    std::size_t first, last;
  };
  /// Joints whose rotors are kept as scalars.
  struct Rotors {
    bool axes_lag = false;
    std::vector<Joint*> joints;
    std::vector<RotorCarrier> carriers;
  };
  struct StaticGeom {
    EngineGeom* geom;
    bool is_plane;
    Eigen::Vector3d lo, hi;  ///< bounds of anything but a plane
    Eigen::Vector3d normal;  ///< of a plane
    double offset;           ///< of a plane: normal . p = offset
  };

  void freeze(EngineBody& body);
  void measure_overlap(const EngineGeom& own, const EngineGeom& other,
                       std::optional<Overlap>& deepest);
  void load_rotors(double dt_s);
  void find_contacts(double dt_s);
  static StaticGeom as_static(EngineGeom& geom);
  static bool reaches(const Eigen::Vector3d& center, double radius_m, const StaticGeom& geom);
  void list_joints(const Model& model);
  void list_rotor_carriers();
  void begin_step();
  bool integrate_free_bodies(double dt_s);
  void end_step();
  double low_x(std::size_t body) const;
  void sort_bodies();
  void sweep_bodies(double dt_s);
  void release_placed();
  Correction correct(const EngineGeom& a, EngineBody* body_a, const EngineGeom& b,
                     EngineBody* body_b, double deepest_m, double dt_s);
  void collide_with_static(EngineBody& body, const Eigen::Vector3d& center, double dt_s);
  void collide_bodies(EngineBody& a, EngineBody& b, double dt_s);
  void collide_geoms(EngineGeom& a, EngineBody* body_a, EngineGeom& b, EngineBody* body_b,
                     double dt_s);
  void report_contacts();
  void advance_rotors(double dt_s);

  Report report_;
  PhysicsSpec spec_;
  Eigen::Vector3d gravity_;
  dWorldID world_;
  std::unique_ptr<ConstraintSolver> solver_;
  std::vector<EngineBody*> bodies_;
  std::vector<Eigen::Vector3d> centers_;  ///< of the bounding spheres, world frame
  std::vector<std::size_t> order_;        ///< bodies by the low end of their x interval
  std::vector<Joint*> ode_joints_;
  Rotors rotors_;
  std::vector<StaticGeom> statics_;
  std::vector<dContact> contact_buffer_;
  /// A watched contact of this step, and its place among the solver's.
  struct Watched {
    Contact contact;
    std::size_t touch;
  };
  std::vector<Watched> watched_;
  std::vector<Contact> reported_contacts_;
};

}  // namespace trident::sim
