// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/schedule_fuzz.h"

#include <errno.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <thread>
#include <unordered_map>

namespace trident::ros_utils {
namespace {

// Of all hand-overs one in so many is delayed, by a time that is uniform in its logarithm.
constexpr double kShortOneIn = 200.0, kShortFrom_s = 1e-4, kShortTo_s = 2e-3;
constexpr double kLongOneIn = 8000.0, kLongFrom_s = 2e-3, kLongTo_s = 0.5;

const char* seed_text() {
  const char* text = std::getenv("TRIDENT_SCHEDULE_FUZZ");
  return text == nullptr ? "" : text;
}

std::uint64_t mixed(std::uint64_t value) {  // splitmix64
  value += 0x9e3779b97f4a7c15ull;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9ull;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebull;
  return value ^ (value >> 31);
}

std::uint64_t hash_of(const std::string& text) {  // FNV-1a
  std::uint64_t value = 0xcbf29ce484222325ull;
  for (const char c : text) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return value;
}

/// The node's namespace distinguishes copies of one program.
std::uint64_t seed_of_process() {
  const char* space = std::getenv("ROS_NAMESPACE");
  return mixed(hash_of(std::string(seed_text()) + "|" + program_invocation_short_name + "|" +
                       (space == nullptr ? "" : space)));
}

double uniform(std::uint64_t& state) {
  state = mixed(state);
  return static_cast<double>(state >> 11) * 0x1.0p-53;
}

double log_uniform(std::uint64_t& state, double from, double to) {
  return from * std::pow(to / from, uniform(state));
}

}  // namespace

namespace schedule_fuzz {
const bool is_active = *seed_text() != '\0';
}

void delay_hand_over(const char* place) {
  static const std::uint64_t seed = seed_of_process();
  thread_local std::unordered_map<const char*, std::uint64_t> visits;
  std::uint64_t state = seed ^ mixed(hash_of(place) + ++visits[place]);
  const double chance = uniform(state);
  double delay_s = 0.0;
  if (chance < 1.0 / kLongOneIn) {
    delay_s = log_uniform(state, kLongFrom_s, kLongTo_s);
  } else if (chance < 1.0 / kShortOneIn) {
    delay_s = log_uniform(state, kShortFrom_s, kShortTo_s);
  }
  if (delay_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(delay_s));
}

}  // namespace trident::ros_utils
