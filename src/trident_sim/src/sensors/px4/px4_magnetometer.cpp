// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/plugins/plugin_util.h"
#include "geomagnetic_dipole.h"
#include "trident_base/angle.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {

Eigen::Vector3d geomagnetic_dipole_enu(double latitude_deg, double longitude_deg,
                                       double altitude_m) {
  constexpr double kRadius = 6371.2e3;                                          // [m]
  const Eigen::Vector3d g = Eigen::Vector3d(-1450.9, 4652.5, -29404.8) * 1e-9;  // g11, h11, g10 [T]
  const double lat = deg_to_rad(latitude_deg), lon = deg_to_rad(longitude_deg);
  const Eigen::Vector3d up(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon),
                           std::sin(lat));
  const Eigen::Vector3d east(-std::sin(lon), std::cos(lon), 0.0);
  const Eigen::Vector3d north = up.cross(east);
  const double scale = std::pow(kRadius / (kRadius + altitude_m), 3);
  const Eigen::Vector3d field = scale * (3.0 * g.dot(up) * up - g);
  return {field.dot(east), field.dot(north), field.dot(up)};
}

namespace {

constexpr double kTeslaPerGauss = 1e-4;

/// PX4's magnetometer: the field at the world's place on the Earth in the frame of the model's
/// first link, with white noise and a bias that wanders.
class Px4Magnetometer : public MeasuringPlugin {
 public:
  explicit Px4Magnetometer(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(own_link(context)),
        clock_(context.params.number("pubRate", 100.0, {0.0, 1e6})),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    read_field(context);
    const Limits not_negative{0.0, 1e12}, positive{1e-9, 1e12};
    period_s_ =
        clock_.rate_hz() > 0.0 ? 1.0 / clock_.rate_hz() : context.world.physics().max_step_size_s;
    white_.density = kTeslaPerGauss * params.number("noiseDensity", 0.4e-3, not_negative);
    GaussMarkovParams bias;
    bias.random_walk = kTeslaPerGauss * params.number("randomWalk", 6.4e-6, not_negative);
    bias.correlation_time = params.number("biasCorrelationTime", 600.0, positive);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      biases_.emplace_back(bias, period_s_, kBiasChannel + axis);
    }
    magnetic_ = advertise<MagneticFieldSample>(
        context, vehicle_topic(context, params.text("magTopic", "mag")), PortRank::kSensor);
    magnetic_->value.frame = link_.name;
    const double variance = white_.density * white_.density / period_s_;
    magnetic_->value.covariance = {variance, 0, 0, 0, variance, 0, 0, 0, variance};
  }

  void reset() override {
    for (GaussMarkov& bias : biases_) bias.reset();
  }
  void state(StateArchive& archive) override { archive(biases_); }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info) || !magnetic_->wanted()) return;
    const std::uint64_t index = clock_.count_at(info);
    Eigen::Vector3d field = link_.T_world_link().R.conjugate() * field_world_;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      field[axis] +=
          white_.sample(stream_, index, axis, period_s_) + biases_[axis].sample(stream_, index);
    }
    magnetic_->value.stamp = info.end;
    magnetic_->value.field_t = field;
    magnetic_->publish();
  }

 private:
  static constexpr std::uint32_t kBiasChannel = 16;

  /// The dipole's, where the file gives no other.
  void read_field(const PluginContext& context) {
    const SphericalCoordinates& origin = context.world.spherical();
    const Eigen::Vector3d dipole =
        geomagnetic_dipole_enu(origin.latitude_deg, origin.longitude_deg, origin.elevation_m);
    const Limits field{-1e-3, 1e-3};  // twenty times the strongest on earth
    const Eigen::Vector3d enu(context.params.number("refMagEast", dipole.x(), field),
                              context.params.number("refMagNorth", dipole.y(), field),
                              -context.params.number("refMagDown", -dipole.z(), field));
    const Eigen::AngleAxisd R_enu_world(deg_to_rad(origin.heading_deg), Eigen::Vector3d::UnitZ());
    field_world_ = R_enu_world.inverse() * enu;
  }

  Link& link_;
  SampleClock clock_;
  RandomStream stream_;
  double period_s_ = 0.0;
  WhiteNoise white_;
  std::vector<GaussMarkov> biases_;  ///< by axis
  Eigen::Vector3d field_world_ = Eigen::Vector3d::Zero();
  OutHandle<MagneticFieldSample> magnetic_;
};

const PluginRegistrar kGazeboMagnetometerPlugin(
    "libgazebo_magnetometer_plugin.so", factory_of<Px4Magnetometer>(),
    PluginExample{"<pubRate>0</pubRate>",
                  {},
                  {"pubRate", "noiseDensity", "randomWalk", "biasCorrelationTime"}});

}  // namespace
}  // namespace trident::sim
