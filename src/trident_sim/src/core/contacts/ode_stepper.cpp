// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "ode_stepper.h"

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <utility>

namespace trident::sim {
namespace {

/// ODE aborts the process at an assertion; here it unwinds to
/// the job that it was in, and the step is reported as failed.
struct BrokenOff {};

/// ODE's callbacks have no context: each thread knows whose step it is in.
thread_local OdeStepper* stepping = nullptr;
thread_local bool is_in_job = false;

/// Of an assertion. Elsewhere than in a step it is a fault of ours.
[[noreturn]] void on_assertion(int number, const char* format, va_list arguments) {
  if (is_in_job) throw BrokenOff{};
  std::fprintf(stderr, "ODE INTERNAL ERROR %d: ", number);
  std::vfprintf(stderr, format, arguments);
  std::fputc('\n', stderr);
  std::abort();
}

/// ODE's own, in which the thread that steps does all jobs itself.
const dThreadingFunctionsInfo* plain_functions = nullptr;

}  // namespace

const dThreadingFunctionsInfo& OdeStepper::functions() {
  static dThreadingFunctionsInfo guarded;
  static std::once_flag once;
  std::call_once(once, [] {
    dSetDebugHandler(on_assertion);
    const dThreadingImplementationID any = dThreadingAllocateSelfThreadedImplementation();
    plain_functions = dThreadingImplementationGetFunctions(any);
    dThreadingFreeImplementation(any);
    guarded = *plain_functions;
    // All functions but this are ODE's own; it wraps each job in a try block.
    guarded.post_call = post;
  });
  return guarded;
}

OdeStepper::OdeStepper(dWorldID world)
    : world_(world), threading_(dThreadingAllocateSelfThreadedImplementation()) {
  dWorldSetStepThreadingImplementation(world_, &functions(), threading_);
}

OdeStepper::~OdeStepper() {
  dWorldSetStepThreadingImplementation(world_, nullptr, nullptr);
  dThreadingFreeImplementation(threading_);
}

void OdeStepper::post(dThreadingImplementationID implementation, int* fault,
                      dCallReleaseeID* posted, ddependencycount_t dependencies,
                      dCallReleaseeID dependent, dCallWaitID wait, dThreadedCallFunction* call,
                      void* context, dcallindex_t index, const char* name) {
  OdeStepper& self = *stepping;
  if (self.posted_ == self.jobs_.size()) self.jobs_.emplace_back();
  Job& job = self.jobs_[self.posted_++];
  job = {&self, call, context};
  plain_functions->post_call(implementation, fault, posted, dependencies, dependent, wait, do_job,
                             &job, index, name);
}

int OdeStepper::do_job(void* context, dcallindex_t index, dCallReleaseeID releasee) {
  const Job& job = *static_cast<const Job*>(context);
  int result = 1;
  const bool is_nested = std::exchange(is_in_job, true);
  try {
    result = job.call(job.context, index, releasee);
  } catch (const BrokenOff&) {
    job.owner->has_failed_ = true;
  }
  is_in_job = is_nested;
  return result;
}

bool OdeStepper::run(int (*step)(dWorldID, dReal), double dt_s) {
  stepping = this;
  posted_ = 0;
  has_failed_ = false;
  step(world_, dt_s);
  return !has_failed_;
}

}  // namespace trident::sim
