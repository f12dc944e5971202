// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "process_cost.h"

#include <sys/resource.h>

#include <fstream>
#include <string>

namespace trident::slam {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// VmHWM of proc(5) [kB], or 0 where there is no such file.
double high_water_kb() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double value = 0.0;
    if (word == "VmHWM:" && status >> value) return value;
  }
  return 0.0;
}

}  // namespace

double process_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

ProcessCost process_cost() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), high_water_kb() / 1024.0};
}

}  // namespace trident::slam
