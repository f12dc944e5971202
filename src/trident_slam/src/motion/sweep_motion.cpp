// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/sweep_motion.h"

#include <algorithm>
#include <cmath>

namespace trident::slam {
namespace {

constexpr double kLongestMotion = 1.0;  // [s]
/// What moves faster, by odometry and stamps, has stamps that lie.
constexpr double kFastest = 100.0;                   // [m/s], [rad/s]
constexpr std::int64_t kKept = 10'000'000'000;       // [ns]
constexpr std::int64_t kLongestGap = 100'000'000;    // [ns]
constexpr std::int64_t kRestartGap = 1'000'000'000;  // [ns]

}  // namespace

double sweep_duration(const LaserScan& scan) {
  return scan.size() < 2 ? 0.0 : scan.time_increment * static_cast<double>(scan.size() - 1);
}

Eigen::Vector3d sweep_twist(const LaserScan& scan, const SE2& T_before_now, double seconds) {
  if (scan.time_increment == 0.0) return Eigen::Vector3d::Zero();
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  if (seconds > 0.0 && seconds <= kLongestMotion) twist = T_before_now.log() / seconds;
  if (!(twist.cwiseAbs().maxCoeff() <= kFastest)) twist.setZero();
  if (scan.yaw_rate) twist.z() = *scan.yaw_rate;
  return twist;
}

bool YawRates::add(std::int64_t stamp_ns, double yaw_rate) {
  if (!(std::abs(yaw_rate) <= kFastest)) return false;
  if (!samples_.empty() && stamp_ns < samples_.back().stamp_ns - kRestartGap) samples_.clear();
  if (!samples_.empty() && stamp_ns <= samples_.back().stamp_ns) return false;
  samples_.push_back({stamp_ns, yaw_rate});
  while (samples_.front().stamp_ns < stamp_ns - kKept) samples_.pop_front();
  return true;
}

std::optional<std::int64_t> YawRates::newest_ns() const {
  if (samples_.empty()) return std::nullopt;
  return samples_.back().stamp_ns;
}

double YawRates::rate_at(std::size_t after, std::int64_t stamp_ns) const {
  const Sample& b = samples_[after];
  if (after == 0 || b.stamp_ns == stamp_ns) return b.rate;
  const Sample& a = samples_[after - 1];
  const double part =
      static_cast<double>(stamp_ns - a.stamp_ns) / static_cast<double>(b.stamp_ns - a.stamp_ns);
  return a.rate + part * (b.rate - a.rate);
}

bool YawRates::covers(std::int64_t from_ns, std::int64_t to_ns) const {
  return !samples_.empty() && from_ns <= to_ns && from_ns >= samples_.front().stamp_ns &&
         to_ns <= samples_.back().stamp_ns;
}

/// The first sample that is not before a time.
std::size_t YawRates::not_before(std::int64_t stamp_ns) const {
  const auto it = std::lower_bound(
      samples_.begin(), samples_.end(), stamp_ns,
      [](const Sample& sample, std::int64_t stamp) { return sample.stamp_ns < stamp; });
  return static_cast<std::size_t>(it - samples_.begin());
}

bool YawRates::has_gap(std::int64_t from_ns, std::int64_t to_ns) const {
  const std::size_t next = not_before(from_ns), last = not_before(to_ns);
  // The first interval counts where the time begins within it.
  const std::size_t first = samples_[next].stamp_ns > from_ns ? next : next + 1;
  for (std::size_t i = first; i <= last; ++i) {
    if (samples_[i].stamp_ns - samples_[i - 1].stamp_ns > kLongestGap) return true;
  }
  return false;
}

std::optional<double> YawRates::mean(std::int64_t from_ns, std::int64_t to_ns) const {
  if (!covers(from_ns, to_ns) || has_gap(from_ns, to_ns)) return std::nullopt;
  std::size_t next = not_before(from_ns);
  double rate = rate_at(next, from_ns);
  if (from_ns == to_ns) return rate;
  double integral = 0.0;  // by trapezia [rad/s ns]
  for (std::int64_t at = from_ns; at < to_ns;) {
    while (samples_[next].stamp_ns <= at) ++next;
    const std::int64_t end = std::min(samples_[next].stamp_ns, to_ns);
    const double rate_at_end = rate_at(next, end);
    integral += 0.5 * (rate + rate_at_end) * static_cast<double>(end - at);
    rate = rate_at_end;
    at = end;
  }
  return integral / static_cast<double>(to_ns - from_ns);
}

}  // namespace trident::slam
