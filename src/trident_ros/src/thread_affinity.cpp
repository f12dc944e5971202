// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "thread_affinity.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace trident::ros_utils::affinity {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(pid_t process) { return "/proc/" + std::to_string(process); }

std::vector<pid_t> threads_of(pid_t process) {
  std::vector<pid_t> threads;
  std::error_code error;  // the process may end meanwhile
  for (fs::directory_iterator it(folder_of(process) / "task", error), end; !error && it != end;
       it.increment(error)) {
    threads.push_back(std::atoi(it->path().filename().c_str()));
  }
  return threads;
}

std::vector<pid_t> threads_on(pid_t process, const cpu_set_t& cores) {
  std::vector<pid_t> threads;
  for (const pid_t thread : threads_of(process)) {
    cpu_set_t now;
    CPU_ZERO(&now);
    if (sched_getaffinity(thread, sizeof(now), &now) == 0 && CPU_EQUAL(&now, &cores)) {
      threads.push_back(thread);
    }
  }
  return threads;
}

}  // namespace

std::size_t thread_count(pid_t process) { return threads_of(process).size(); }

std::uint64_t start_time(pid_t process) {
  std::ifstream file(folder_of(process) / "stat");
  std::string text;
  std::getline(file, text);
  // proc(5): the second field is the name in parentheses, which may hold blanks; the 22nd is it.
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(text.substr(name_end + 1));
  std::string field;
  for (int number = 3; number <= 22; ++number) fields >> field;
  return std::strtoull(field.c_str(), nullptr, 10);
}

cpu_set_t only(int core) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(core, &set);
  return set;
}

bool has_thread_on(pid_t process, const cpu_set_t& cores) {
  return !threads_on(process, cores).empty();
}

bool move_threads(pid_t process, const cpu_set_t& from, const cpu_set_t& to) {
  bool is_moved = false;
  for (const pid_t thread : threads_on(process, from)) {
    if (sched_setaffinity(thread, sizeof(to), &to) == 0) is_moved = true;
  }
  return is_moved;
}

void release(const KeptProcess& kept) {
  if (start_time(kept.process) != kept.start_time) return;
  move_threads(kept.process, only(kept.core), kept.all);
}

}  // namespace trident::ros_utils::affinity
