// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>
#include <deque>

#include "core/plugins/plugin_util.h"
#include "trident_base/angle.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// Errors of one direction, scaled as PX4's plugin does it: white noise of a standard deviation of
/// density sqrt(period), and a bias that gains walk period^1.5 with each sample and loses a
/// sixtieth.
class PositionError {
 public:
  PositionError(double density, double walk, double period_s, std::uint32_t channel)
      : white_{density * period_s},
        period_s_(period_s),
        channel_(channel),
        bias_(bias_of(walk, period_s), period_s, channel + 1) {}
  double sample(const RandomStream& stream, std::uint64_t index) {
    return white_.sample(stream, index, channel_, period_s_) + bias_.sample(stream, index);
  }
  void reset() { bias_.reset(); }

 private:
  static GaussMarkovParams bias_of(double walk, double period_s) {
    GaussMarkovParams params;
    params.random_walk = walk * period_s;
    params.correlation_time = 60.0 * period_s;
    return params;
  }

  WhiteNoise white_;
  double period_s_;
  std::uint32_t channel_;
  GaussMarkov bias_;
};

/// PX4's satellite receiver: position on the WGS84 ellipsoid about the world's origin, velocity
/// over ground in east, north, up. Both leave <gpsDelay> after they were measured, with the stamp
/// of the measurement. Without <gpsNoise> they are exact.
class Px4Gps : public MeasuringPlugin {
 public:
  explicit Px4Gps(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(own_link(context)),
        clock_(context.params.number("updateRate", 5.0, {0.0, 1e6})),
        delay_(SimTime::from_seconds(context.params.number("gpsDelay", 0.12, {0.0, 10.0}))),
        stream_(context.world.seed(), context.name) {
    read_noise(context);
    const SphericalCoordinates& origin = context.world.spherical();
    earth_.Reset(origin.latitude_deg, origin.longitude_deg, origin.elevation_m);
    // The heading turns the world's x axis from east to north.
    R_enu_world_ = Eigen::AngleAxisd(deg_to_rad(origin.heading_deg), Eigen::Vector3d::UnitZ())
                       .toRotationMatrix();
    const std::string topic = vehicle_topic(context, context.params.text("gpsTopic", "gps"));
    fix_ = advertise<GnssFixSample>(context, topic, PortRank::kSensor);
    speed_ = advertise<TwistSample>(context, topic + "_velocity", PortRank::kSensor);
    fix_->value.frame = speed_->value.frame = link_.name;
  }

  void reset() override {
    waiting_.clear();
    for (PositionError& error : errors_) error.reset();
  }
  void state(StateArchive& archive) override { archive(waiting_, errors_); }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (clock_.is_due(info)) take(info);
    while (!waiting_.empty() && waiting_.front().stamp + delay_ <= info.end) {
      send(waiting_.front());
      waiting_.pop_front();
    }
  }

 private:
  struct Reading {
    SimTime stamp;
    Eigen::Vector3d p_enu, v_enu;
  };

  void read_noise(const PluginContext& context) {
    const PluginParams& params = context.params;
    const Limits limits{0.0, 1e6};
    const double xy_walk = params.number("gpsXYRandomWalk", 2.0, limits);
    const double z_walk = params.number("gpsZRandomWalk", 4.0, limits);
    const double xy = params.number("gpsXYNoiseDensity", 2.0e-4, limits);
    const double z = params.number("gpsZNoiseDensity", 4.0e-4, limits);
    const double v_xy = params.number("gpsVXYNoiseDensity", 0.2, limits);
    const double v_z = params.number("gpsVZNoiseDensity", 0.4, limits);
    is_noisy_ = params.flag("gpsNoise", false);
    const double period_s =
        clock_.rate_hz() > 0.0 ? 1.0 / clock_.rate_hz() : context.world.physics().max_step_size_s;
    // Two channels of the random stream for each axis: white noise and bias.
    errors_ = {{xy, xy_walk, period_s, 0}, {xy, xy_walk, period_s, 2}, {z, z_walk, period_s, 4}};
    const double root = std::sqrt(period_s);
    velocity_noise_.stddev = root * Eigen::Vector3d(v_xy, v_xy, v_z);
  }

  void take(const StepInfo& info) {
    const Eigen::Vector3d p_world = link_.T_world_link().p;
    Reading reading{info.end, R_enu_world_ * p_world, R_enu_world_ * link_velocity_world(link_)};
    if (is_noisy_) {
      const std::uint64_t index = clock_.count_at(info);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        reading.p_enu[static_cast<Eigen::Index>(axis)] += errors_[axis].sample(stream_, index);
      }
      reading.v_enu += velocity_noise_.sample(stream_, index, kVelocityChannel);
    }
    waiting_.push_back(reading);
  }

  void send(const Reading& reading) {
    GnssFixSample& fix = fix_->value;
    fix.stamp = speed_->value.stamp = reading.stamp;
    earth_.Reverse(reading.p_enu.x(), reading.p_enu.y(), reading.p_enu.z(), fix.latitude_deg,
                   fix.longitude_deg, fix.altitude_m);
    speed_->value.v = reading.v_enu;
    fix_->publish();
    speed_->publish();
  }

  static constexpr std::uint32_t kVelocityChannel = 8;

  Link& link_;
  SampleClock clock_;
  SimTime delay_;
  RandomStream stream_;
  bool is_noisy_ = false;
  std::vector<PositionError> errors_;  ///< east, north, up
  GaussianNoise3 velocity_noise_;
  GeographicLib::LocalCartesian earth_;
  Eigen::Matrix3d R_enu_world_;
  std::deque<Reading> waiting_;  ///< what was measured and has not left
  OutHandle<GnssFixSample> fix_;
  OutHandle<TwistSample> speed_;
};

const PluginRegistrar kGazeboGpsPlugin(
    "libgazebo_gps_plugin.so", factory_of<Px4Gps>(),
    PluginExample{
        "<updateRate>0</updateRate><gpsDelay>0.02</gpsDelay><gpsNoise>true</gpsNoise>",
        {},
        {"updateRate", "gpsDelay", "gpsXYRandomWalk", "gpsZRandomWalk", "gpsXYNoiseDensity",
         "gpsZNoiseDensity", "gpsVXYNoiseDensity", "gpsVZNoiseDensity"}});

/// PX4's ground truth goes to the autopilot by libgazebo_mavlink_interface.so itself.
std::unique_ptr<Plugin> ignore(const PluginContext& /*context*/) { return nullptr; }
const PluginRegistrar kGazeboGroundtruthPlugin("libgazebo_groundtruth_plugin.so", {ignore, {}});

}  // namespace
}  // namespace trident::sim
