// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>

namespace trident::ros_utils::affinity {

/// A process that is restricted to one core. It is sent to core_watcher in this form.
struct KeptProcess {
  pid_t process = 0;
  std::int32_t core = 0;
  std::uint64_t start_time = 0;  ///< Of the process: its number may be given to another one later.
  cpu_set_t all{};               ///< The cores that it had before.
};

/// Number of threads of a process; 0 when it has ended.
std::size_t thread_count(pid_t process);

/// When a process was started [clock ticks since the machine was]; 0 when it has ended.
std::uint64_t start_time(pid_t process);

/// The set of one core.
cpu_set_t only(int core);

/// Whether a thread of a process may use exactly these cores.
bool has_thread_on(pid_t process, const cpu_set_t& cores);

/// Moves the threads of a process that are on exactly `from` to `to`. Returns whether there was
/// one.
bool move_threads(pid_t process, const cpu_set_t& from, const cpu_set_t& to);

/// Gives a process back the cores that it had, unless it has ended. Threads that somebody else has
/// restricted meanwhile are left alone.
void release(const KeptProcess& kept);

}  // namespace trident::ros_utils::affinity
