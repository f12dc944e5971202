// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/amcl_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <utility>

#include "trident_base/string_util.h"
#include "trident_ros/message_checks.h"

namespace trident::estimation {
namespace {

using Status = diagnostic_msgs::DiagnosticStatus;

constexpr double kPeriod_s = 1.0;  // wall time

}  // namespace

AmclDiagnostics::AmclDiagnostics(ros::NodeHandle& node, const AmclNodeParams& params,
                                 const AmclLocalizer& localizer, const ScanInput& scans,
                                 ros_utils::DiagnosticCounter& problems)
    : params_(params),
      localizer_(localizer),
      scans_(scans),
      problems_(problems),
      name_(ros::this_node::getName()),
      publisher_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)),
      timer_(node.createWallTimer(ros::WallDuration(kPeriod_s),
                                  [this](const ros::WallTimerEvent&) { publish(); })) {}

void AmclDiagnostics::publish() {
  if (publisher_.getNumSubscribers() == 0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.push_back(status());
  problems_.add_to(array, name_);
  publisher_.publish(array);
}

Status AmclDiagnostics::status() const {
  Status status;
  status.name = name_ + ": Standard deviation";
  status.message = localizer_.has_map() ? "OK" : "no map yet";
  status.level = localizer_.has_map() ? Status::OK : Status::WARN;
  if (localizer_.has_map()) add_estimate(status);
  return status;
}

void AmclDiagnostics::add_estimate(Status& status) const {
  const PoseEstimate& estimate = localizer_.filter().estimate();
  // Rounding can make a variance of a single particle negative.
  const Eigen::Vector3d sigma = estimate.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Vector3d limit(params_.std_warn_level_x, params_.std_warn_level_y,
                              params_.std_warn_level_yaw);
  if ((sigma.array() > limit.array()).any()) {
    status.level = Status::WARN;
    status.message = "Too large";
  }
  const std::pair<const char*, double> values[] = {
      {"std_x", sigma.x()},
      {"std_y", sigma.y()},
      {"std_yaw", sigma.z()},
      {"agreement", estimate.agreement},
      {"cluster_weight", estimate.cluster_weight},
      {"particles", static_cast<double>(estimate.particles)},
      {"updates", static_cast<double>(localizer_.updates())},
      {"searches of the whole map", static_cast<double>(localizer_.searches())},
      {"scans", static_cast<double>(scans_.received())}};
  for (const auto& [key, value] : values) {
    status.values.push_back(ros_utils::key_value(key, number_text(value)));
  }
}

}  // namespace trident::estimation
