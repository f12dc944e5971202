// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plugins/plugin_util.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// RotorS' magnetometer: the reference field turned into a link's frame, with white noise and a
/// bias drawn once per run, both along the world's axes. RotorS takes north, east and down for x, y
/// and z of the world, which is right where x points north and z down; `<worldIsEnu>` 1 turns the
/// field into a world whose x points east and z up.
class Magnetometer : public MeasuringPlugin {
 public:
  explicit Magnetometer(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(required_link(context, "linkName")),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    const Limits field{-1e-3, 1e-3};  // twenty times the strongest on earth
    const double north = params.number("refMagNorth", 2.1493e-5, field);
    const double east = params.number("refMagEast", 8.15e-7, field);
    const double down = params.number("refMagDown", 4.2795e-5, field);
    field_world_ = params.flag("worldIsEnu", false) ? Eigen::Vector3d(east, north, -down)
                                                    : Eigen::Vector3d(north, east, down);
    noise_.stddev = non_negative(params, "noiseNormal");
    const Eigen::Vector3d spread = non_negative(params, "noiseUniformInitialBias");
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      field_world_[axis] += spread[axis] * (2.0 * stream_.uniform(0, kBiasChannel + axis) - 1.0);
    }
    magnetic_ = advertise<MagneticFieldSample>(
        context, scoped_topic(params, params.text("magnetometerTopic", "magnetic_field")),
        PortRank::kSensor);
    magnetic_->value.frame = link_.name;
    const Eigen::Vector3d variance = noise_.stddev.cwiseAbs2();
    magnetic_->value.covariance = {variance.x(), 0, 0, 0, variance.y(), 0, 0, 0, variance.z()};
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!magnetic_->wanted()) return;
    magnetic_->value.stamp = info.end;
    const Eigen::Vector3d noisy = field_world_ + noise_.sample(stream_, info.sample, 0);
    magnetic_->value.field_t = link_.T_world_link().R.conjugate() * noisy;
    magnetic_->publish();
  }

 private:
  static constexpr std::uint32_t kBiasChannel = 16;

  static Eigen::Vector3d non_negative(const PluginParams& params, const char* key) {
    Eigen::Vector3d value = params.vector3(key, Eigen::Vector3d::Zero());
    if (value.minCoeff() < 0.0) params.refuse(key, params.text(key, ""), "three numbers >= 0");
    return value;
  }

  Link& link_;
  RandomStream stream_;
  Eigen::Vector3d field_world_;
  GaussianNoise3 noise_;
  OutHandle<MagneticFieldSample> magnetic_;
};

const PluginRegistrar kRotorsGazeboMagnetometerPlugin(
    "librotors_gazebo_magnetometer_plugin.so", factory_of<Magnetometer>(),
    PluginExample{
        "<linkName>base_link</linkName><noiseNormal>1e-7 1e-7 1e-7</noiseNormal>",
        {"linkName"},
        {"refMagNorth", "refMagEast", "refMagDown", "noiseNormal", "noiseUniformInitialBias"}});

}  // namespace

}  // namespace trident::sim
