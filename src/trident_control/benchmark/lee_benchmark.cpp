// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Time of one LeePositionController::compute() [ns], the median of 21 batches.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <vector>

#include "trident_control/lee_position_controller.h"

int main() {
  using Clock = std::chrono::steady_clock;
  constexpr int kCalls = 200000;
  const trident::control::LeePositionController controller{trident::control::LeeParams{}};
  trident::control::OdometryState state;
  trident::control::TrajectoryPoint reference;
  reference.p_world = Eigen::Vector3d(1.0, 0.5, 2.0);
  std::array<double, 6> speeds;
  double sum = 0.0;
  std::vector<double> ns;
  for (int batch = 0; batch < 21; ++batch) {
    const auto begin = Clock::now();
    for (int i = 0; i < kCalls; ++i) {
      state.p_world_body.x() = 1e-6 * i;
      state.w_body.y() = 1e-7 * i;
      reference.yaw = 1e-6 * i;
      if (controller.compute(state, reference, speeds) == trident::control::ControlStatus::ok)
        sum += speeds[3];
    }
    ns.push_back(std::chrono::duration<double, std::nano>(Clock::now() - begin).count() / kCalls);
  }
  std::nth_element(ns.begin(), ns.begin() + 10, ns.end());
  std::printf(
      "LeePositionController::compute  %.1f ns per call (median of 21 x %d, checksum %.6g)\n",
      ns[10], kCalls, sum);
}
