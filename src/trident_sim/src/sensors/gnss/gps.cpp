// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "core/plugins/plugin_util.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

GaussianNoise3 horizontal_and_vertical(const PluginParams& params, const char* horizontal,
                                       double horizontal_fallback, const char* vertical,
                                       double vertical_fallback) {
  const double h = params.number(horizontal, horizontal_fallback, {0.0, 1e6});
  const double v = params.number(vertical, vertical_fallback, {0.0, 1e6});
  return {Eigen::Vector3d::Zero(), {h, h, v}};
}

/// RotorS' satellite receiver: position on the WGS84 ellipsoid about the world's origin
/// (<spherical_coordinates>, whose heading turns x from east to north), and velocity over ground in
/// east, north, up, both with white noise.
class Gps : public MeasuringPlugin {
 public:
  explicit Gps(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(context.sensor != nullptr ? *context.link : required_link(context, "linkName")),
        T_link_antenna_(context.sensor != nullptr ? context.sensor->T_link_sensor : SE3()),
        clock_(context.sensor != nullptr ? context.sensor->update_rate_hz : 0.0),
        position_noise_(
            horizontal_and_vertical(context.params, "horPosStdDev", 3.0, "verPosStdDev", 6.0)),
        velocity_noise_(
            horizontal_and_vertical(context.params, "horVelStdDev", 0.1, "verVelStdDev", 0.1)),
        stream_(context.world.seed(), context.name) {
    const SphericalCoordinates& origin = context.world.spherical();
    earth_.Reset(origin.latitude_deg, origin.longitude_deg, origin.elevation_m);
    const double heading = deg_to_rad(origin.heading_deg);
    R_enu_world_ = Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const PluginParams& params = context.params;
    if (context.sensor != nullptr) params.text("linkName", "");  // as a sensor it has its link
    fix_ = advertise<GnssFixSample>(context, scoped_topic(params, params.text("gpsTopic", "gps")),
                                    PortRank::kSensor);
    speed_ = advertise<TwistSample>(
        context, scoped_topic(params, params.text("groundSpeedTopic", "ground_speed")),
        PortRank::kSensor);
    fix_->value.frame = speed_->value.frame = link_.name;
    const Eigen::Vector3d variance = position_noise_.stddev.cwiseAbs2();
    // Row-major, in [m^2], along east, north, up, as sensor_msgs/NavSatFix has it.
    fix_->value.covariance_enu = {variance.x(), 0, 0, 0, variance.y(), 0, 0, 0, variance.z()};
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info)) return;
    const std::uint64_t index = clock_.count_at(info);
    const Eigen::Vector3d p_world = link_.T_world_link() * T_link_antenna_.p;
    if (fix_->wanted()) {
      // The world is flat and tangent to the ellipsoid at the origin: local Cartesian coordinates.
      const Eigen::Vector3d p_enu =
          R_enu_world_ * p_world + position_noise_.sample(stream_, index, 0);
      GnssFixSample& fix = fix_->value;
      fix.stamp = info.end;
      earth_.Reverse(p_enu.x(), p_enu.y(), p_enu.z(), fix.latitude_deg, fix.longitude_deg,
                     fix.altitude_m);
      fix_->publish();
    }
    if (speed_->wanted()) {
      speed_->value.stamp = info.end;
      speed_->value.v = R_enu_world_ * link_.v_world_at(p_world) +
                        velocity_noise_.sample(stream_, index, kVelocityChannel);
      speed_->publish();
    }
  }

 private:
  static constexpr std::uint32_t kVelocityChannel = 8;

  Link& link_;
  SE3 T_link_antenna_;
  SampleClock clock_;
  GaussianNoise3 position_noise_, velocity_noise_;
  RandomStream stream_;
  GeographicLib::LocalCartesian earth_;
  Eigen::Matrix3d R_enu_world_;
  OutHandle<GnssFixSample> fix_;
  OutHandle<TwistSample> speed_;
};

const PluginRegistrar kRotorsGazeboGpsPlugin(
    "librotors_gazebo_gps_plugin.so", factory_of<Gps>(),
    PluginExample{"",
                  {},
                  {"horPosStdDev", "verPosStdDev", "horVelStdDev", "verVelStdDev"},
                  R"(<sensor name="example" type="gps"><update_rate>50</update_rate></sensor>)"});

}  // namespace

}  // namespace trident::sim
