// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "lanes.h"

#include <atomic>

namespace trident::nav {
namespace {

bool processor_has_avx2() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

std::atomic<bool> is_wide{processor_has_avx2()};

}  // namespace

bool has_wide_lanes() { return is_wide.load(std::memory_order_relaxed); }

void force_plain_lanes(bool is_forced) { is_wide = !is_forced && processor_has_avx2(); }

}  // namespace trident::nav
