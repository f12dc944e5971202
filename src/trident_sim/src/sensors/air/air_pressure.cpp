// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "air_pressure.h"

#include <cmath>

#include "core/plugins/plugin_util.h"
#include "trident_base/random_stream.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {

double standard_pressure_pa(double altitude_m) {
  constexpr double kGravity = 9.80665;             // [m/s^2]
  constexpr double kGasConstant = 8314.32;         // [N m / (kmol K)]
  constexpr double kMolarMass = 28.9644;           // [kg / kmol]
  constexpr double kSeaLevelPressure = 101325.0;   // [Pa]
  constexpr double kSeaLevelTemperature = 288.15;  // [K]
  constexpr double kLapseRate = 0.0065;            // [K/m]
  constexpr double kEarthRadius = 6356766.0;       // [m]
  const double geopotential_m = kEarthRadius * altitude_m / (kEarthRadius + altitude_m);
  const double temperature = kSeaLevelTemperature - kLapseRate * geopotential_m;
  return kSeaLevelPressure * std::pow(kSeaLevelTemperature / temperature,
                                      kGravity * kMolarMass / (kGasConstant * -kLapseRate));
}

namespace {

/// RotorS' barometer: the standard atmosphere's pressure at a link's origin, with white noise.
class AirPressure : public MeasuringPlugin {
 public:
  explicit AirPressure(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(required_link(context, "linkName")),
        reference_altitude_m_(context.params.number("referenceAltitude", 500.0, {-500.0, 10000.0})),
        variance_(context.params.number("pressureVariance", 0.0, {0.0, 1e10})),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    pressure_ = advertise<FluidPressureSample>(
        context, scoped_topic(params, params.text("pressureTopic", "air_pressure")),
        PortRank::kSensor);
    pressure_->value.frame = link_.name;
    pressure_->value.variance = variance_;
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!pressure_->wanted()) return;
    const double altitude_m = reference_altitude_m_ + link_.T_world_link().p.z();
    pressure_->value.stamp = info.end;
    pressure_->value.pressure_pa =
        standard_pressure_pa(altitude_m) + std::sqrt(variance_) * stream_.normal(info.sample, 0);
    pressure_->publish();
  }

 private:
  Link& link_;
  double reference_altitude_m_, variance_;
  RandomStream stream_;
  OutHandle<FluidPressureSample> pressure_;
};

const PluginRegistrar kRotorsGazeboPressurePlugin(
    "librotors_gazebo_pressure_plugin.so", factory_of<AirPressure>(),
    PluginExample{"<linkName>base_link</linkName><pressureVariance>4</pressureVariance>",
                  {"linkName"},
                  {"referenceAltitude", "pressureVariance"}});

}  // namespace

}  // namespace trident::sim
