// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <deque>

namespace trident::sim {

/// Steps a world of ODE. Where a solution is no number, ODE ends the process by an assertion amid
/// the step; here that step fails instead, and leaves the bodies anywhere.
class OdeStepper {
 public:
  explicit OdeStepper(dWorldID world);
  ~OdeStepper();
  OdeStepper(const OdeStepper&) = delete;
  OdeStepper& operator=(const OdeStepper&) = delete;

  /// Runs dWorldStep or dWorldQuickStep; false when it failed.
  bool run(int (*step)(dWorldID, dReal), double dt_s);

 private:
  /// A part of a step. ODE goes through a list of them, which stays whole when one is broken off.
  struct Job {
    OdeStepper* owner;
    dThreadedCallFunction* call;
    void* context;
  };
  static const dThreadingFunctionsInfo& functions();
  static void post(dThreadingImplementationID implementation, int* fault, dCallReleaseeID* posted,
                   ddependencycount_t dependencies, dCallReleaseeID dependent, dCallWaitID wait,
                   dThreadedCallFunction* call, void* context, dcallindex_t index,
                   const char* name);
  static int do_job(void* job, dcallindex_t index, dCallReleaseeID releasee);

  dWorldID world_;
  dThreadingImplementationID threading_;
  std::deque<Job> jobs_;  ///< kept from step to step
  std::size_t posted_ = 0;
  bool has_failed_ = false;
};

}  // namespace trident::sim
