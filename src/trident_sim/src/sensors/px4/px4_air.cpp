// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "core/plugins/plugin_util.h"
#include "sensors/air/air_pressure.h"
#include "trident_base/random_stream.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

/// PX4's barometer: the standard atmosphere's pressure at a link's origin above the sea
/// (<spherical_coordinates>), with white noise of 1 Pa and a steady drift.
class Px4Barometer : public MeasuringPlugin {
 public:
  explicit Px4Barometer(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(own_link(context)),
        clock_(context.params.number("pubRate", 50.0, {0.0, 1e6})),
        drift_pa_s_(context.params.number("baroDriftPaPerSec", 0.0, {-1e3, 1e3})),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    stddev_pa_ = params.number("noiseStdDev", 1.0, {0.0, 1e5});
    pressure_ = advertise<FluidPressureSample>(
        context, vehicle_topic(context, params.text("baroTopic", "baro")), PortRank::kSensor);
    pressure_->value.frame = link_.name;
    pressure_->value.variance = stddev_pa_ * stddev_pa_;
  }

 protected:
  void measure(const World& world, const StepInfo& info) override {
    if (!clock_.is_due(info) || !pressure_->wanted()) return;
    const double altitude_m = world.spherical().elevation_m + link_.T_world_link().p.z();
    const double since_start_s = static_cast<double>(info.sample) * info.dt_s;
    pressure_->value.stamp = info.end;
    pressure_->value.pressure_pa = standard_pressure_pa(altitude_m) +
                                   stddev_pa_ * stream_.normal(clock_.count_at(info), 0) +
                                   drift_pa_s_ * since_start_s;
    pressure_->publish();
  }

 private:
  Link& link_;
  SampleClock clock_;
  double drift_pa_s_, stddev_pa_ = 0.0;
  RandomStream stream_;
  OutHandle<FluidPressureSample> pressure_;
};

/// PX4's airspeed sensor: the air's speed along the link's x axis [m/s], against the world's wind
/// where it has one, with white noise.
class Px4Airspeed : public MeasuringPlugin {
 public:
  explicit Px4Airspeed(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(own_link(context)),
        clock_(context.params.number("pubRate", 10.0, {0.0, 1e6})),
        stddev_(context.params.number("noiseStdDev", 0.1, {0.0, 100.0})),
        stream_(context.world.seed(), context.name) {
    speed_ = advertise<ScalarSample>(
        context, vehicle_topic(context, context.params.text("airspeedTopic", "airspeed")),
        PortRank::kSensor);
  }

 protected:
  void measure(const World& world, const StepInfo& info) override {
    if (!clock_.is_due(info) || !speed_->wanted()) return;
    around_.look(world);
    const SE3 T_world_link = link_.T_world_link();
    Eigen::Vector3d velocity = link_velocity_world(link_);
    if (around_.air() != nullptr) velocity -= around_.air()->wind(T_world_link.p);
    const double ahead = (T_world_link.R.conjugate() * velocity).x();
    speed_->value.stamp = info.end;
    speed_->value.value = ahead + stddev_ * stream_.normal(clock_.count_at(info), 0);
    speed_->publish();
  }

 private:
  Link& link_;
  SampleClock clock_;
  double stddev_;
  RandomStream stream_;
  Surroundings around_;
  OutHandle<ScalarSample> speed_;
};

const PluginRegistrar kGazeboBarometerPlugin(
    "libgazebo_barometer_plugin.so", factory_of<Px4Barometer>(),
    PluginExample{"<pubRate>0</pubRate>", {}, {"pubRate", "baroDriftPaPerSec", "noiseStdDev"}});
const PluginRegistrar kGazeboAirspeedPlugin(
    "libgazebo_airspeed_plugin.so", factory_of<Px4Airspeed>(),
    PluginExample{"<pubRate>0</pubRate>", {}, {"pubRate", "noiseStdDev"}});

}  // namespace
}  // namespace trident::sim
