// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/plugins/plugin_util.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

ImuNoiseParams read_noise(const PluginParams& params) {
  const Limits not_negative{0.0, 1e12}, positive{1e-9, 1e12};
  ImuNoiseParams noise;
  InertialNoiseParams& gyro = noise.gyroscope;
  InertialNoiseParams& accel = noise.accelerometer;
  gyro.noise_density = params.number("gyroscopeNoiseDensity", gyro.noise_density, not_negative);
  // RotorS' xacros write gyroscopeRandomWalk and its plugin reads gyroscopeBiasRandomWalk; both
  // count.
  gyro.bias.random_walk = params.number("gyroscopeRandomWalk", gyro.bias.random_walk, not_negative);
  gyro.bias.random_walk =
      params.number("gyroscopeBiasRandomWalk", gyro.bias.random_walk, not_negative);
  gyro.bias.correlation_time =
      params.number("gyroscopeBiasCorrelationTime", gyro.bias.correlation_time, positive);
  gyro.bias.turn_on_stddev =
      params.number("gyroscopeTurnOnBiasSigma", gyro.bias.turn_on_stddev, not_negative);
  accel.noise_density =
      params.number("accelerometerNoiseDensity", accel.noise_density, not_negative);
  accel.bias.random_walk =
      params.number("accelerometerRandomWalk", accel.bias.random_walk, not_negative);
  accel.bias.correlation_time =
      params.number("accelerometerBiasCorrelationTime", accel.bias.correlation_time, positive);
  accel.bias.turn_on_stddev =
      params.number("accelerometerTurnOnBiasSigma", accel.bias.turn_on_stddev, not_negative);
  return noise;
}

/// Angular velocity and specific force of a link in its own frame, with Gauss-Markov biases and
/// white noise. Unlike RotorS every IMU has its own random stream.
class Imu : public MeasuringPlugin {
 public:
  explicit Imu(const PluginContext& context, TopicNaming name_of = robot_topic)
      : MeasuringPlugin(context.world.timing()),
        link_(required_link(context, "linkName")),
        noise_params_(read_noise(context.params)),
        stream_(context.world.seed(), context.name),
        noise_(noise_params_, context.world.physics().max_step_size_s, stream_),
        noise_dt_s_(context.world.physics().max_step_size_s) {
    const PluginParams& params = context.params;
    imu_ = advertise<ImuSample>(context, name_of(context, params.text("imuTopic", "imu")),
                                PortRank::kSensor);
    ImuSample& value = imu_->value;
    value.frame = link_.name;
    // sensor_msgs/Imu: -1 in the first element says that the orientation is not an estimate.
    value.orientation_covariance[0] = -1.0;
    // As in RotorS, squares of the continuous densities, not of the discrete noise.
    for (std::size_t i : {0, 4, 8}) {
      value.gyro_covariance[i] = square(noise_params_.gyroscope.noise_density);
      value.accel_covariance[i] = square(noise_params_.accelerometer.noise_density);
    }
  }

  void reset() override { noise_.reset(); }
  void state(StateArchive& archive) override { archive(noise_, noise_dt_s_); }

 protected:
  void measure(const World& world, const StepInfo& info) override {
    if (!imu_->wanted()) return;
    // White noise and bias are discretized for one step size, so a new one needs a new model.
    if (info.dt_s != noise_dt_s_) {
      noise_ = ImuNoise(noise_params_, info.dt_s, stream_);
      noise_dt_s_ = info.dt_s;
    }
    ImuSample& out = imu_->value;
    out.stamp = info.end;
    out.R_world_imu = link_.T_world_link().R;
    const Eigen::Quaterniond R_imu_world = out.R_world_imu.conjugate();
    out.w_imu = R_imu_world * link_.w_world();
    // Specific force a - g: an IMU at rest measures +9.81 m/s^2 on the axis that points up.
    out.a_imu = R_imu_world * (link_acceleration_world(link_, info.dt_s) - world.physics().gravity);
    noise_.add(info.sample, &out.w_imu, &out.a_imu);
    imu_->publish();
  }

 private:
  static double square(double x) { return x * x; }

  Link& link_;
  ImuNoiseParams noise_params_;
  RandomStream stream_;
  ImuNoise noise_;
  double noise_dt_s_;
  OutHandle<ImuSample> imu_;
};

std::unique_ptr<Plugin> make_vehicle_imu(const PluginContext& context) {
  return std::make_unique<Imu>(context, vehicle_topic);
}

const PluginExample kImuExample{
    "<linkName>base_link</linkName>",
    {"linkName"},
    {"gyroscopeNoiseDensity", "gyroscopeRandomWalk", "gyroscopeBiasCorrelationTime",
     "gyroscopeTurnOnBiasSigma", "accelerometerNoiseDensity", "accelerometerRandomWalk",
     "accelerometerBiasCorrelationTime", "accelerometerTurnOnBiasSigma"}};

const PluginRegistrar kRotorsGazeboImuPlugin("librotors_gazebo_imu_plugin.so", factory_of<Imu>(),
                                             kImuExample);
const PluginRegistrar kGazeboImuPlugin("libgazebo_imu_plugin.so", {make_vehicle_imu, {}},
                                       kImuExample);

}  // namespace

}  // namespace trident::sim
