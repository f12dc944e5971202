// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Hovering vehicles with the controllers inside the simulator: simulated time per wall time, CPU
// and memory, and with --profile where a step's time goes. See docs/reference/benchmarks.md.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "benchmark_options.h"
#include "hover_world.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// An entry of /proc/self/status, kB there, in MB (2^20 bytes).
double memory_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  }
  throw Error("/proc/self/status has no " + key);
}

struct Measured {
  double sim_s = 0.0, wall_s = 0.0, cpu_s = 0.0;
  double rss_mb = 0.0;  ///< while flying
  std::string hash;     ///< after the first window
};

Measured fly(HoverWorld& hover, const BenchmarkOptions& options) {
  Measured result;
  while (result.hash.empty() || result.wall_s < options.min_wall_s) {
    const double cpu_begin = process_cpu_s();
    const auto begin = Clock::now();
    hover.step_seconds(options.window_s);
    result.wall_s += seconds_since(begin);
    result.cpu_s += process_cpu_s() - cpu_begin;
    result.sim_s += options.window_s;
    if (result.hash.empty()) result.hash = hover.world().state_hash();
  }
  result.rss_mb = memory_mb("VmRSS");
  return result;
}

/// Microseconds per step. Reading the clock between the stages makes the steps slower, hence a
/// flight of its own, whose times are no part of the other figures.
void print_profile(HoverWorld& hover, const BenchmarkOptions& options) {
  hover.world().set_profiling(true);
  hover.world().take_stage_times();
  hover.step_seconds(options.window_s);
  const World::StageTimes times = hover.world().take_stage_times();
  const double us = 1e6 / static_cast<double>(std::max<std::uint64_t>(times.steps, 1));
  std::printf(
      ", \"profile_us_per_step\": {\"sense\": %.4f, \"control\": %.4f, \"actuate\": %.4f, "
      "\"physics\": %.4f, \"post\": %.4f}",
      times.sense_s * us, times.control_s * us, times.actuate_s * us, times.physics_s * us,
      times.post_s * us);
}

int run(const BenchmarkOptions& options) {
  const auto begin = Clock::now();
  HoverWorld hover(options);
  const double startup_s = seconds_since(begin);
  hover.take_off(options.airborne_z_m);
  const double airborne_s = hover.world().time().seconds();
  const Measured measured = fly(hover, options);
  std::printf(
      "{\"n\": %d, \"rtf\": %.6g, \"cpu_s_per_sim_s\": %.6g, \"sim_s\": %.6g, "
      "\"wall_s\": %.6g, \"startup_s\": %.6g, \"rss_mb\": %.4f, \"peak_rss_mb\": %.4f, "
      "\"airborne_s\": %.6g, \"lowest_z_m\": %.6g, \"largest_offset_m\": %.6g, "
      "\"state_hash\": \"%s\"",
      options.vehicles, measured.sim_s / measured.wall_s, measured.cpu_s / measured.sim_s,
      measured.sim_s, measured.wall_s, startup_s, measured.rss_mb, memory_mb("VmHWM"), airborne_s,
      hover.lowest_z_m(), hover.largest_offset_m(), measured.hash.c_str());
  if (options.profile) print_profile(hover, options);
  std::printf("}\n");
  return 0;
}

}  // namespace
}  // namespace trident::sim

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  for (const std::string& argument : arguments) {
    if (argument == "--help" || argument == "-h") {
      std::fputs(trident::sim::kBenchmarkUsage, stdout);
      return 0;
    }
  }
  try {
    return trident::sim::run(trident::sim::parse_benchmark_options(arguments));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sim_benchmark: %s\n", error.what());
    return 1;
  }
}
