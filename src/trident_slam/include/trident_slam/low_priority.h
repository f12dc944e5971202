// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>

namespace trident::slam {

/// From here on this thread lets others go first: what runs in the background must not hold up
/// scans where there are fewer processor cores than threads. Changes no result.
inline void lower_priority_of_this_thread() {
  constexpr int kNice = 5;
  setpriority(PRIO_PROCESS, 0, kNice);  // Linux: of the calling thread alone
}

}  // namespace trident::slam
