// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/autopilot/setpoint_stream.h"

#include <cmath>

namespace trident::bridges {
namespace {

constexpr double kLongestGap_s = 0.5;  // PX4 asks for more than 2 Hz
// What is older than this counts e times less: a circle of 2 m/s and 3 m at 20 Hz is followed
// within a few centimeters, and jitter of a few milliseconds does not show.
constexpr double kMemory_s = 0.1;

}  // namespace

void SetpointStream::push(SimTime stamp, const Eigen::Vector3d& p_m, double greatest_step_m) {
  const double gap = (stamp - stamp_).seconds();
  const Eigen::Vector3d predicted =
      estimate_.p_m + estimate_.v_m_s * gap + 0.5 * gap * gap * estimate_.a_m_s2;
  const bool is_next = count_ > 0 && gap > 0.0 && gap <= kLongestGap_s &&
                       (p_m - estimate_.p_m).norm() <= greatest_step_m;
  stamp_ = stamp;
  if (!is_next) {
    estimate_ = {p_m, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    count_ = 1;
    return;
  }
  ++count_;
  if (count_ == 2) {
    estimate_ = {p_m, (p_m - estimate_.p_m) / gap, Eigen::Vector3d::Zero()};
    return;
  }
  const Eigen::Vector3d residual = p_m - predicted;
  // Morrison's weights of the polynomial filter of degree 2.
  const double memory = std::exp(-gap / kMemory_s);
  const double left = 1.0 - memory;
  const double alpha = 1.0 - memory * memory * memory;
  const double beta = 1.5 * left * left * (1.0 + memory);
  const double gamma = left * left * left;
  estimate_.p_m = predicted + alpha * residual;
  estimate_.v_m_s += estimate_.a_m_s2 * gap + (beta / gap) * residual;
  estimate_.a_m_s2 += (gamma / (gap * gap)) * residual;
}

}  // namespace trident::bridges
