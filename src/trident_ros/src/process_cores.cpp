// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/process_cores.h"

#include <unistd.h>

#include <map>

#include "core_watcher_link.h"
#include "thread_affinity.h"

namespace trident::ros_utils {

struct ProcessCores::Impl {
  CoreWatcherLink watcher;
  std::map<pid_t, affinity::KeptProcess> kept;
};

ProcessCores::ProcessCores() : impl_(std::make_unique<Impl>()) {
  CPU_ZERO(&all_);
  if (sched_getaffinity(0, sizeof(all_), &all_) != 0) return;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &all_)) cores_.push_back(core);
  }
}

ProcessCores::~ProcessCores() {
  for (const auto& [process, kept] : impl_->kept) affinity::release(kept);
}

int ProcessCores::keep(pid_t process, std::size_t index) {
  if (process <= 0 || process == getpid() || cores_.size() < 2) return -1;
  if (affinity::thread_count(process) > kMaxThreads) return -1;
  const int core = cores_[index % cores_.size()];
  if (!affinity::has_thread_on(process, all_)) return -1;
  const affinity::KeptProcess kept{process, core, affinity::start_time(process), all_};
  impl_->watcher.watch(kept);  // before it is restricted: this process may end at any instruction
  if (!affinity::move_threads(process, all_, affinity::only(core))) return -1;
  impl_->kept[process] = kept;
  return core;
}

}  // namespace trident::ros_utils
