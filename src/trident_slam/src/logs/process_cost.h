// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::slam {

/// What this process has taken so far. Memory is that of this program alone: getrusage's figure is
/// never below that of the process that started it.
struct ProcessCost {
  double cpu_s = 0.0;
  double peak_rss_mb = 0.0;  ///< in 2^20 bytes
};
ProcessCost process_cost();
/// Its CPU time alone, to a microsecond.
double process_cpu_s();

}  // namespace trident::slam
