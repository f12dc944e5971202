// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "physics_check.h"

#include <sstream>

#include "trident_base/error.h"
#include "trident_sim/motion_limits.h"

namespace trident::sim {
namespace {

/// Checks the values of `<physics>`: throws Error at the first that is illegal, or, where `odd` is
/// given, puts Gazebo's default in its place and notes it.
class PhysicsCheck {
 public:
  PhysicsCheck(PhysicsSpec& physics, std::vector<std::string>* odd)
      : physics_(physics), odd_(odd) {}

  template <class T>
  void check(bool ok, const char* field, T PhysicsSpec::*member, const char* legal) {
    if (ok) return;
    std::ostringstream text;
    text << "physics: " << field << " is '" << print(physics_.*member) << "', must be " << legal;
    if (odd_ == nullptr) throw Error(text.str());
    physics_.*member = PhysicsSpec{}.*member;
    odd_->push_back(text.str() + "; the default is taken");
  }

 private:
  template <class T>
  static T print(const T& value) {
    return value;
  }
  static double print(const Eigen::Vector3d& value) { return value.norm(); }

  PhysicsSpec& physics_;
  std::vector<std::string>* odd_;
};

}  // namespace

void validate(PhysicsSpec& p, std::vector<std::string>* odd) {
  PhysicsCheck is(p, odd);
  const double dt = p.max_step_size_s;
  is.check(dt >= 1e-6 && dt <= 1.0, "max_step_size", &PhysicsSpec::max_step_size_s,
           "in [1e-6, 1] s");
  is.check(p.solver == "quick" || p.solver == "world", "solver type", &PhysicsSpec::solver,
           "quick or world");
  is.check(p.exact_solver_rows >= 0, "exact_solver_rows", &PhysicsSpec::exact_solver_rows, ">= 0");
  is.check(p.precon_iterations >= 0, "precon_iters", &PhysicsSpec::precon_iterations, ">= 0");
  is.check(is_within(p.gravity, 1e6), "gravity", &PhysicsSpec::gravity, "finite, up to 1e6 m/s^2");
  is.check(p.iterations >= 1 && p.iterations <= 100000, "iterations", &PhysicsSpec::iterations,
           "in [1, 100000]");
  is.check(p.sor > 0.0 && p.sor < 2.0, "sor", &PhysicsSpec::sor, "in (0, 2)");
  is.check(p.cfm >= 0.0 && p.cfm <= 1e12, "cfm", &PhysicsSpec::cfm, "in [0, 1e12]");
  is.check(p.erp >= 0.0 && p.erp <= 1.0, "erp", &PhysicsSpec::erp, "in [0, 1]");
  is.check(p.contact_surface_layer >= 0.0, "contact_surface_layer",
           &PhysicsSpec::contact_surface_layer, ">= 0 m");
  is.check(p.contact_max_correcting_vel >= 0.0, "contact_max_correcting_vel",
           &PhysicsSpec::contact_max_correcting_vel, ">= 0 m/s");
  is.check(p.max_contacts >= 1 && p.max_contacts <= 100000, "max_contacts",
           &PhysicsSpec::max_contacts, "in [1, 100000]");
  is.check(p.real_time_update_rate_hz >= 0.0, "real_time_update_rate",
           &PhysicsSpec::real_time_update_rate_hz, ">= 0 Hz");
}

}  // namespace trident::sim
