// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "scan_check.h"

#include <algorithm>
#include <cmath>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

/// By how much patterns of one scanner differ: part of a step (motors that turn freely), and steps
/// at either end. Where readings were lost, more is missing.
constexpr double kLikeSteps = 0.05;
constexpr double kLikeEnds = 2.0;
constexpr std::size_t kMaxNewcomers = 16;

struct ReturnCounts {
  std::size_t usable = 0, not_a_number = 0, infinite = 0, zero = 0;
};

ReturnCounts count_returns(const LaserScan& scan) {
  ReturnCounts counts;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float range = scan.ranges[i];
    if (std::isnan(range)) {
      ++counts.not_a_number;
    } else if (std::isinf(range)) {
      ++counts.infinite;
    } else if (range <= 0.0F) {
      ++counts.zero;
    } else if (scan.is_return(i)) {
      ++counts.usable;
    }
  }
  return counts;
}

std::string too_few(const LaserScan& scan, const ReturnCounts& counts) {
  return std::to_string(counts.usable) + " of " + std::to_string(scan.size()) +
         " beams have a return within [" + number_text(scan.range_min) + ", " +
         number_text(scan.range_max) + "] m, needed: " + std::to_string(ScanCheck::kMinReturns) +
         " (" + std::to_string(counts.not_a_number) + " NaN, " + std::to_string(counts.infinite) +
         " infinite, " + std::to_string(counts.zero) + " zero)";
}

}  // namespace

bool ScanCheck::Pattern::is_like(const Pattern& other) const {
  const double step = std::abs(other.angle_increment);
  return std::abs(angle_increment - other.angle_increment) <= kLikeSteps * step &&
         std::abs(angle_min - other.angle_min) <= kLikeEnds * step &&
         std::abs(angle_max() - other.angle_max()) <= kLikeEnds * step;
}

std::string ScanCheck::Pattern::text() const {
  return std::to_string(beams) + " beams from " + number_text(angle_min) + " by " +
         number_text(angle_increment) + " rad";
}

/// What is known of a pattern that is not believed yet; after a long time it begins again.
std::vector<ScanCheck::Newcomer>::iterator ScanCheck::newcomer_of(const Pattern& pattern) {
  auto it = std::find_if(newcomers_.begin(), newcomers_.end(), [&pattern](const Newcomer& known) {
    return pattern.is_like(known.pattern);
  });
  if (it == newcomers_.end()) {
    if (newcomers_.size() == kMaxNewcomers) newcomers_.erase(newcomers_.begin());
    it = newcomers_.insert(newcomers_.end(), Newcomer{pattern, scans_, 0});
  } else if (scans_ - it->first_scan >= kPatienceScans) {
    *it = {pattern, scans_, 0};
  }
  return it;
}

bool ScanCheck::is_believed(const Pattern& pattern) {
  const auto is_like = [&pattern](const Pattern& known) { return pattern.is_like(known); };
  if (std::any_of(patterns_.begin(), patterns_.end(), is_like)) return true;
  const auto it = newcomer_of(pattern);
  if (++it->count < kPatience && !patterns_.empty()) return false;
  newcomers_.erase(it);
  patterns_.push_back(pattern);
  return true;
}

namespace {

bool is_placed(const LaserScan& scan) {
  return std::isfinite(scan.angle_min) && std::isfinite(scan.angle_increment) &&
         scan.angle_increment != 0.0 && std::isfinite(scan.T_base_laser.angle) &&
         scan.T_base_laser.p.allFinite();
}

}  // namespace

std::string ScanCheck::problem(const LaserScan& scan) {
  if (!is_placed(scan)) {
    return "angle_min " + number_text(scan.angle_min) + ", angle_increment " +
           number_text(scan.angle_increment) + " or the laser's place is not a usable number";
  }
  ++scans_;
  const Pattern pattern{scan.size(), scan.angle_min, scan.angle_increment};
  if (scan.size() > 0 && !is_believed(pattern)) {
    return pattern.text() + ", so far: " + patterns_.front().text() +
           (patterns_.size() == 1
                ? std::string()
                : " and " + std::to_string(patterns_.size() - 1) + " other patterns");
  }
  const ReturnCounts counts = count_returns(scan);
  return counts.usable < kMinReturns ? too_few(scan, counts) : std::string();
}

}  // namespace trident::slam
