// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/fake_gps.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>

#include <cmath>

#include "core/conversions.h"
#include "core/typed_messages.h"
#include "plugins/plugins.h"
#include "trident_bridges_ros/utc.h"

namespace trident::mavros {
namespace {

/// Poses of a motion capture or of cameras become HIL_GPS or GPS_INPUT, as if there were a
/// receiver.
class FakeGpsPlugin : public Plugin {
 public:
  explicit FakeGpsPlugin(Hub& hub)
      : hub_(hub),
        params_(hub.params.fake_gps),
        receiver_(params_),
        utc_(bridges::read_utc_start()) {
    subscribe();
  }

 private:
  void subscribe() {
    if (params_.use_mocap) return subscribe_mocap();
    if (params_.use_vision) return subscribe_pose("fake_gps/vision");
    if (params_.tf.listen) return follow();
    ROS_ERROR("fake_gps: use_mocap, use_vision and tf/listen are false: it has no poses");
  }
  void subscribe_mocap() {
    if (params_.mocap_transform) {
      return hub_.ros.subscribe<geometry_msgs::TransformStamped>(
          "fake_gps/mocap/tf",
          [this](const auto& m) { send_fix(m.header.stamp, to_eigen(m.transform.translation)); });
    }
    if (!params_.mocap_withcovariance) return subscribe_pose("fake_gps/mocap/pose");
    hub_.ros.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
        "fake_gps/mocap/pose_cov", [this](const auto& m) {
          constexpr std::size_t kEast = 0, kNorth = 7, kUp = 14;
          const auto& variance = m.pose.covariance;
          params_.horiz_accuracy = std::sqrt(0.5 * (variance[kEast] + variance[kNorth]));
          params_.vert_accuracy = std::sqrt(variance[kUp]);
          send_fix(m.header.stamp, to_eigen(m.pose.pose.position));
        });
  }
  void subscribe_pose(const std::string& topic) {
    hub_.ros.subscribe<geometry_msgs::PoseStamped>(
        topic, [this](const auto& m) { send_fix(m.header.stamp, to_eigen(m.pose.position)); });
  }
  void follow() {
    hub_.ros.follow(params_.tf,
                    [this](const FollowedPose& pose) { send_fix(pose.stamp, pose.p_m); });
  }

  void send_fix(const ros::Time& stamp, const Eigen::Vector3d& p_map_m) {
    if (!p_map_m.allFinite()) {
      return hub_.ros.refusals().note("estimates refused", "fake_gps: position is not finite");
    }
    const ros::Time time = stamp.isZero() ? ros::Time::now() : stamp;
    auto fix = receiver_.at({static_cast<std::int64_t>(time.toNSec())}, p_map_m);
    if (!fix) return;
    fix->unix_ns = bridges::unix_ns_of(utc_, time);
    const double separation_m = hub_.known.geoid_separation_m;
    params_.use_hil_gps ? send(hub_.vehicle, hil_gps_payload(*fix, params_, separation_m))
                        : send(hub_.vehicle, gps_input_payload(*fix, params_, separation_m));
  }

  Hub& hub_;
  FakeGpsParams params_;
  FakeGps receiver_;
  UtcClock utc_;
};

}  // namespace

std::unique_ptr<Plugin> make_fake_gps(Hub& hub) { return std::make_unique<FakeGpsPlugin>(hub); }

}  // namespace trident::mavros
