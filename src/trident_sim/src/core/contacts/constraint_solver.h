// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

#include "core/physics/engine_body.h"
#include "islands.h"
#include "ode_stepper.h"
#include "trident_sim/model_spec.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// What a pass of the solver yields of the bodies' next state.
enum class Pass { kPose = 0, kVelocity = 1 };

/// A contact of this step, of which each pass makes an ODE joint.
struct Touch {
  dContact ode;  ///< as dCollide found it, with the pair's surface; then as each pass needs it
  EngineBody* a = nullptr;
  EngineBody* b = nullptr;        ///< nullptr: part of the world
  std::array<double, 2> depth_m;  ///< by Pass: what it puts right of the depth that was found
  dJointFeedback feedback;        ///< forces of the last pass, world frame

  // Of the rounds of friction.
  std::array<double, 2> mu;        ///< coefficients along the two directions
  double normal_n = 0.0;           ///< normal force of the last round
  double limiting_normal_n = 0.0;  ///< from which the next one works out the limits of friction
  double change_n = 0.0;           ///< by which normal_n was off the one that limited it
  /// By Pass: normal force in the last step, then in this one; NaN: unknown.
  std::array<double, 2> known_normal_n;
  std::size_t index = 0;  ///< among the contacts of the two bodies
};

/// The normal forces of a contact, which the next step's friction is limited by at first.
struct ContactMemory {
  std::size_t a = 0, b = 0;  ///< numbers of the bodies; b: kWorld where it is part of the world
  std::size_t index = 0;     ///< among the contacts of the two
  std::array<double, 2> normal_n{};  ///< by Pass

  static constexpr std::size_t kWorld = static_cast<std::size_t>(-1);
};

/// Solves bodies that touch or are jointed with ODE, island by island, as Gazebo's ODE does: twice
/// from the same state. The first pass puts right what is too deep within the step and yields the
/// poses; the second, in which `max_vel` bounds the speed at which it is put right, the velocities.
/// Where nothing is that deep the first yields both.
///
/// Small islands are solved exactly (ODE's Dantzig solver). That one limits friction by the normal
/// forces that there would be without friction; it is asked again until they are those that there
/// are. Contacts that were there in the last step begin with its normal forces: a robot that rolls
/// or skids is solved once then.
class ConstraintSolver {
 public:
  explicit ConstraintSolver(dWorldID world);
  ~ConstraintSolver();
  ConstraintSolver(const ConstraintSolver&) = delete;
  ConstraintSolver& operator=(const ConstraintSolver&) = delete;

  void configure(const PhysicsSpec& spec);
  /// Forgets the contacts of the last step.
  void begin_step(std::size_t bodies);
  void add(const Touch& touch);
  /// Steps those of `bodies` that are in contact or on a joint. Their numbers are their places.
  void solve(const std::vector<EngineBody*>& bodies, const std::vector<Joint*>& joints,
             double dt_s);
  /// What is kept from step to step; forget() makes the next step independent of the last one.
  void state(StateArchive& archive);
  void forget() { memory_.clear(); }
  /// Has what is kept follow its bodies to other numbers; those of `before` need not exist any
  /// more.
  void renumber(const std::vector<EngineBody*>& before, const std::vector<EngineBody*>& now);
  /// Of the last step, with the forces that go with the velocities.
  const std::vector<Touch>& touches() const { return touches_; }

 private:
  /// Bodies that are constrained.
  struct Held {
    std::vector<EngineBody*> bodies;
    std::vector<std::size_t> islands;  ///< of each of them
    std::vector<SE3> poses;            ///< of each of them, from the first pass
  };
  /// How the rounds of friction of an island stand.
  struct Friction {
    double error_n, largest_n;      ///< of the last round
    double toward, squared_change;  ///< sums for the relaxation
    double relaxation;
  };

  void gather(const std::vector<EngineBody*>& bodies, const std::vector<Joint*>& joints);
  bool choose_bounded();
  void solve_pass(Pass pass, double dt_s);
  void solve_large(double dt_s);
  void solve_small(double dt_s);
  // False when the solver has failed.
  bool solve_iteratively(int iterations, double dt_s);
  bool solve_exactly(double dt_s);
  void put_back(std::size_t island);
  void give_up(std::size_t island);
  void solve_one_by_one(double dt_s);
  void refine_friction(Pass pass, double dt_s);
  bool measure_friction();
  void relax_friction(bool first);
  void recall(Touch& touch);
  void remember();
  void choose_warm(Pass pass);
  void keep_normals(Pass pass);
  void make_joints(Pass pass, bool limits_known);
  void finish(double dt_s);

  std::size_t island_of(const Touch& touch) { return islands_.first_of_island(touch.a->number); }
  bool is_large(std::size_t island);
  void put_back_active();
  void enable_active();
  void disable_all() const;

  dWorldID world_;
  OdeStepper stepper_;
  dJointGroupID joints_;
  PhysicsSpec spec_;
  Islands islands_;
  std::vector<Touch> touches_;
  Held held_;
  // By the number of an island's first body.
  std::vector<char> active_;  ///< whether the next solution is for it
  std::vector<char> is_solved_twice_;
  std::vector<Friction> friction_;
  std::vector<char> is_warm_;  ///< whether all normal forces of the last step are known

  std::vector<ContactMemory> memory_;  ///< of the last step, in the order of its contacts
  std::size_t next_in_memory_ = 0;     ///< where the next contact is looked for first
  bool has_joints_ = false;            ///< of contacts
};

}  // namespace trident::sim
