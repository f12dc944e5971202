// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_motion.h"

#include <algorithm>
#include <cmath>

namespace trident::slam {
namespace {

/// Part of a mean that the newest value makes up.
constexpr double kNewest = 0.1;
constexpr double kNewestPeriod = 0.05;
/// A motion continues for so many usual times between scans at most, ...
constexpr double kLongest = 3.0;
/// ... and two scans that came at once are taken to be this part of it apart.
constexpr double kShortest = 0.5;
/// No step is longer [m, m, rad].
const SE2::Tangent kMaxMotion(2.0, 2.0, 1.5);
/// What a robot loses of its velocity with each scan that does not show it.
constexpr double kDamping = 0.7;

/// Standard deviations: of the errors of late, and of the motion, whose part they are.
constexpr double kErrors = 1.5;
constexpr double kPartOfMotion = 0.1;
constexpr double kMinSigma = 0.03;  // [m], [rad]
constexpr double kMaxSigma = 0.3;

SE2::Tangent bounded(const SE2::Tangent& motion) {
  return motion.cwiseMin(kMaxMotion).cwiseMax(-kMaxMotion);
}

double sigma(double squared_error, double motion) {
  return std::clamp(kErrors * std::sqrt(squared_error) + kPartOfMotion * motion, kMinSigma,
                    kMaxSigma);
}

}  // namespace

double ScanMotion::seconds_since_last(std::int64_t stamp_ns) const {
  return last_stamp_ns_
             ? 1e-9 * (static_cast<double>(stamp_ns) - static_cast<double>(*last_stamp_ns_))
             : 0.0;
}

SE2::Tangent ScanMotion::predicted(Kind kind, std::int64_t stamp_ns) const {
  if (kind == kByScans || usual_seconds_ <= 0.0) return last_;
  const double seconds = std::clamp(seconds_since_last(stamp_ns), 0.0, kLongest * usual_seconds_);
  return bounded(last_ * (seconds / std::max(last_seconds_, kShortest * usual_seconds_)));
}

ExpectedMotion ScanMotion::expected(std::int64_t stamp_ns) const {
  const SE2::Tangent motion = predicted(better(), stamp_ns);
  ExpectedMotion expected;
  expected.T_before_now = SE2::exp(motion);
  expected.spread.s_p = sigma(error_p_, motion.head<2>().norm());
  expected.spread.s_yaw = sigma(error_yaw_, std::abs(motion.z()));
  return expected;
}

void ScanMotion::learn_errors(std::int64_t stamp_ns, const SE2::Tangent& seen) {
  const SE2::Tangent off = predicted(better(), stamp_ns) - seen;
  for (const Kind kind : {kByScans, kByStamps}) {
    error_[kind] += kNewest * ((predicted(kind, stamp_ns) - seen).squaredNorm() - error_[kind]);
  }
  error_p_ += kNewest * (off.head<2>().squaredNorm() - error_p_);
  error_yaw_ += kNewest * (off.z() * off.z() - error_yaw_);
}

void ScanMotion::add(std::int64_t stamp_ns, const SE2& T_before_now, bool is_sure) {
  if (last_stamp_ns_) {
    const SE2::Tangent seen = bounded(T_before_now.log());
    if (is_sure) {
      learn_errors(stamp_ns, seen);
      last_ = seen;
    } else {
      last_ *= kDamping;
    }
    last_seconds_ = seconds_since_last(stamp_ns);
    if (usual_seconds_ <= 0.0) usual_seconds_ = std::max(last_seconds_, 0.0);
    const double change =
        std::clamp(last_seconds_ - usual_seconds_, -usual_seconds_, usual_seconds_);
    usual_seconds_ += kNewestPeriod * change;
  }
  last_stamp_ns_ = stamp_ns;
}

}  // namespace trident::slam
