// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/transform_follower.h"

#include <tf2/exceptions.h>

#include <utility>

#include "core/conversions.h"

namespace trident::mavros {

bool FollowedRate::is_due(const ros::Time& stamp) {
  constexpr double kEarly = 0.99;  // of a period: stamps jitter
  // The difference of two times may be no ros::Duration.
  const bool is_early =
      newest_ && stamp >= *newest_ &&
      (stamp == *newest_ || stamp.toSec() - newest_->toSec() < kEarly * period_s_);
  if (is_early) return false;
  newest_ = stamp;
  return true;
}

void Transforms::on_change(ros_utils::Refusals& refusals, std::function<void()> handler) {
  if (refusals_ == nullptr) refusals_ = &refusals;
  handlers_.push_back(std::move(handler));
  if (!changing_) subscribe();
}

void Transforms::subscribe() {
  constexpr std::uint32_t kQueue = 100;
  ros::NodeHandle node;
  changing_ = loop_.subscribe<tf2_msgs::TFMessage>(
      node, "/tf", kQueue, [this](const auto& message) { receive(message, false); });
  static_ = loop_.subscribe<tf2_msgs::TFMessage>(
      node, "/tf_static", kQueue, [this](const auto& message) { receive(message, true); });
}

void Transforms::receive(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_) gate_.clear();
  last_ = now;
  for (const auto& transform : message.transforms) {
    const std::string problem = gate_.add(transform, "/tf", is_static, now);
    if (!problem.empty()) refusals_->note("transforms refused", problem);
  }
  for (const auto& handler : handlers_) handler();
}

std::optional<FollowedPose> Transforms::find(const TfParams& params) const {
  try {
    const auto found =
        buffer_.lookupTransform(params.frame_id, params.child_frame_id, ros::Time(0));
    return FollowedPose{found.header.stamp, to_eigen(found.transform.translation),
                        to_rotation(found.transform.rotation)};
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

}  // namespace trident::mavros
