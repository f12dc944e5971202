// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mavros_msgs/SetMavFrame.h>

#include <cstdint>
#include <string>

#include "core/plugin.h"
#include "core/setpoints.h"
#include "core/typed_messages.h"

namespace trident::mavros {

/// What the plugins of set-points share: the frame, and refusals.
class SetpointPlugin : public Plugin {
 public:
  SetpointPlugin(Hub& hub, const SetpointParams& params, const std::string& name)
      : hub_(hub), name_(name), frame_(frame_of_name(params.mav_frame)) {}

 protected:
  void serve_frame() {
    hub_.ros.serve<mavros_msgs::SetMavFrame>(name_ + "/mav_frame", [this](const auto& request) {
      mavros_msgs::SetMavFrame::Response response;
      response.success = static_cast<std::uint8_t>(is_local_frame(request.mav_frame));
      if (response.success != 0U) frame_ = request.mav_frame;
      return response;
    });
  }
  std::uint8_t frame() const { return frame_; }
  /// Sends a set-point, or refuses it naming the field that is no number.
  void send_local(const ros::Time& stamp, const LocalTarget& target) {
    const std::string problem = problem_of(target);
    if (!problem.empty()) return refuse(problem);
    send_to_target(hub_.vehicle, local_payload(target, hub_.vehicle.boot_ms(stamp)));
  }
  void refuse(const std::string& problem) {
    hub_.ros.refusals().note("set-points refused", name_ + ": " + problem);
  }

  Hub& hub_;

 private:
  std::string name_;
  std::uint8_t frame_;
};

}  // namespace trident::mavros
