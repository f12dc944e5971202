// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/process_cores.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace trident {
namespace {

namespace fs = std::filesystem;

fs::path tasks_of(pid_t process) { return "/proc/" + std::to_string(process) + "/task"; }

std::size_t thread_count(pid_t process) {
  std::size_t count = 0;
  std::error_code error;  // the process may end meanwhile
  for (fs::directory_iterator it(tasks_of(process), error), end; !error && it != end;
       it.increment(error)) {
    ++count;
  }
  return count;
}

cpu_set_t only(int core) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(core, &set);
  return set;
}

/// Moves the threads that are on exactly `from` to `to`. True: there was one.
bool move_threads(pid_t process, const cpu_set_t& from, const cpu_set_t& to) {
  bool is_moved = false;
  std::error_code error;
  for (fs::directory_iterator it(tasks_of(process), error), end; !error && it != end;
       it.increment(error)) {
    const pid_t thread = std::atoi(it->path().filename().c_str());
    cpu_set_t now;
    CPU_ZERO(&now);
    if (sched_getaffinity(thread, sizeof(now), &now) != 0 || !CPU_EQUAL(&now, &from)) continue;
    if (sched_setaffinity(thread, sizeof(to), &to) == 0) is_moved = true;
  }
  return is_moved;
}

}  // namespace

ProcessCores::ProcessCores() {
  CPU_ZERO(&all_);
  if (sched_getaffinity(0, sizeof(all_), &all_) != 0) return;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &all_)) cores_.push_back(core);
  }
}

ProcessCores::~ProcessCores() {
  for (const auto& [process, core] : kept_) move_threads(process, only(core), all_);
}

int ProcessCores::keep(pid_t process, std::size_t index) {
  if (process <= 0 || process == getpid() || cores_.size() < 2) return -1;
  if (thread_count(process) > kMostThreads) return -1;
  const int core = cores_[index % cores_.size()];
  if (!move_threads(process, all_, only(core))) return -1;
  kept_[process] = core;
  return core;
}

}  // namespace trident
