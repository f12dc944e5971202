// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// holding_cores_check PROCESS...: keeps processes on one core each until its standard input ends,
// as the simulator's server keeps controllers. Prints the cores in one line.
#include <cstdio>
#include <cstdlib>

#include "trident_ros/process_cores.h"

int main(int argc, char** argv) {
  trident::ros_utils::ProcessCores cores;
  for (int i = 1; i < argc; ++i) {
    std::printf("%d ", cores.keep(std::atoi(argv[i]), static_cast<std::size_t>(i)));
  }
  std::printf("\n");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
  }
  return 0;
}
