// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/scan_stamps.h"

#include <algorithm>
#include <cmath>

#include "trident_base/string_util.h"

namespace trident::slam {
namespace {

/// Two scans in a row that are no farther apart agree on what time it is [s].
constexpr double kAgreement = 10.0;

double between(const ros::Time& earlier, const ros::Time& later) {
  return (later - earlier).toSec();
}

}  // namespace

ScanStamps::Step ScanStamps::add(const sensor_msgs::LaserScanConstPtr& message) {
  const ros::Time& stamp = message->header.stamp;
  const double ahead = newest_.isZero() ? 0.0 : between(newest_, stamp);
  if (-ahead > threshold_) return add_older(message);
  Step step;
  if (suspect_) {
    step.problem = "scan is left out: its stamp is " +
                   number_text(between(suspect_->header.stamp, newest_)) +
                   " s before those about it";
    suspect_.reset();
  }
  before_jump_ = ahead > kAgreement ? newest_ : ros::Time();
  newest_ = std::max(newest_, stamp);
  step.scans.push_back(message);
  return step;
}

ScanStamps::Step ScanStamps::add_older(const sensor_msgs::LaserScanConstPtr& message) {
  Step step;
  const ros::Time& stamp = message->header.stamp;
  if (!before_jump_.isZero() && std::abs(between(before_jump_, stamp)) <= kAgreement) {
    step.problem = "scan is left out: its stamp is " + number_text(between(stamp, newest_)) +
                   " s after those about it";
    step.was_ahead = true;
  } else if (suspect_ && std::abs(between(suspect_->header.stamp, stamp)) <= kAgreement) {
    step.went_back = newest_ - suspect_->header.stamp;
    step.back_from = newest_;
    step.scans.push_back(suspect_);
  } else {
    suspect_ = message;
    return step;
  }
  suspect_.reset();
  before_jump_ = ros::Time();
  newest_ = stamp;
  step.scans.push_back(message);
  return step;
}

}  // namespace trident::slam
