// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "../plugin_util.h"
#include "axis_noise.h"
#include "sample_clock.h"
#include "sensor_plugins.h"
#include "trident_base/error.h"

namespace trident {
namespace {

struct ImuSite {
  Link* link;
  SE3 T_link_imu;
  std::string topic, frame;
  double rate_hz;
  bool is_against_start;  ///< orientation against that at the start, else against the world
};

SE3 offset_of(const PluginParams& params) {
  const Eigen::Vector3d rpy = params.vector3("rpyOffset", Eigen::Vector3d::Zero());
  const Eigen::Vector3d xyz = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
  return SE3::from_xyz_rpy(xyz, rpy.x(), rpy.y(), rpy.z());
}

/// Orientation, angular velocity and specific force, gravity included, of gazebo_ros' two IMUs.
/// `<gaussianNoise>` is the standard deviation on every axis of the rates and of the force.
class GazeboImu : public MeasuringPlugin {
 public:
  GazeboImu(const PluginContext& context, ImuSite site, const ParamNode* element)
      : MeasuringPlugin(context.world.timing()),
        site_(std::move(site)),
        clock_(site_.rate_hz),
        gaussian_(context.params.number("gaussianNoise", 0.0, {0.0, 1e9})),
        stream_(context.world.seed(), context.name),
        R_start_(site_.link->T_world_link().R * site_.T_link_imu.R) {
    imu_ =
        advertise<ImuSample>(context, scoped_topic(context.params, site_.topic), PortRank::kSensor);
    ImuSample& value = imu_->value;
    value.frame = site_.frame;  // as upstream, without tf_prefix
    const std::string& owner = context.params.owner();
    const auto gyro = read_axis_noises(child(element, "angular_velocity"), owner);
    const auto accel = read_axis_noises(child(element, "linear_acceleration"), owner);
    const double period_s =
        site_.rate_hz > 0.0 ? 1.0 / site_.rate_hz : context.world.physics().max_step_size_s;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double common = gaussian_ * gaussian_;
      value.orientation_covariance[4 * axis] = common;
      value.gyro_covariance[4 * axis] = common + square(gyro[axis].stddev);
      value.accel_covariance[4 * axis] = common + square(accel[axis].stddev);
    }
    for (const auto& triad : {gyro, accel}) {
      for (const AxisNoise& noise : triad) {
        const auto channel = static_cast<std::uint32_t>(kChannels * noises_.size());
        noises_.emplace_back(noise, period_s, channel);
      }
    }
  }

  void reset() override {
    for (AxisNoiseSource& noise : noises_) noise.reset();
  }
  void state(StateArchive& archive) override { archive(noises_); }

 protected:
  void measure(const World& world, const StepInfo& info) override {
    if (!clock_.is_due(info) || !imu_->wanted()) return;
    const std::uint64_t index = clock_.count_at(info);
    ImuSample& out = imu_->value;
    out.stamp = info.end;
    const Eigen::Quaterniond R_world_imu = site_.link->T_world_link().R * site_.T_link_imu.R;
    const Eigen::Quaterniond R_imu_world = R_world_imu.conjugate();
    out.R_world_imu = site_.is_against_start ? R_start_.conjugate() * R_world_imu : R_world_imu;
    out.w_imu = R_imu_world * site_.link->w_world();
    out.a_imu = R_imu_world * (acceleration_world(info.dt_s) - world.physics().gravity);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      out.w_imu[axis] += noise(axis, index);
      out.a_imu[axis] += noise(axis + 3, index);
    }
    imu_->publish();
  }

 private:
  static constexpr std::uint32_t kChannels = 5;  ///< per axis: its source's, and gaussianNoise

  static double square(double x) { return x * x; }
  static const ParamNode* child(const ParamNode* element, const char* name) {
    return element != nullptr ? element->find(name) : nullptr;
  }

  /// Of axis x, y, z of the rate, then of the force.
  double noise(std::uint32_t axis, std::uint64_t index) {
    const double common = gaussian_ * stream_.normal(index, kChannels * axis + kChannels - 1);
    return noises_[axis].sample(stream_, index) + common;
  }

  /// Of the IMU's own place, which may be off the link's origin.
  Eigen::Vector3d acceleration_world(double dt_s) const {
    const Link& link = *site_.link;
    Eigen::Vector3d acceleration = link_acceleration_world(link, dt_s);
    if (link.body == nullptr) return acceleration;
    const Eigen::Vector3d r = link.T_world_link().R * site_.T_link_imu.p;
    const Eigen::Vector3d w = link.w_world();
    const Eigen::Vector3d dw = (w - link.body->w_before) / dt_s;
    return acceleration + dw.cross(r) + w.cross(w.cross(r));
  }

  ImuSite site_;
  SampleClock clock_;
  double gaussian_;
  RandomStream stream_;
  std::vector<AxisNoiseSource> noises_;
  Eigen::Quaterniond R_start_;
  OutHandle<ImuSample> imu_;
};

std::unique_ptr<Plugin> make_model_imu(const PluginContext& context) {
  const PluginParams& params = context.params;
  Link& link = required_link(context, "bodyName");
  return std::make_unique<GazeboImu>(
      context,
      ImuSite{&link, offset_of(params), params.text("topicName", "/default_imu"),
              params.text("frameName", link.name), params.number("updateRate", 0.0, {0.0, 1e6}),
              false},
      nullptr);
}

std::unique_ptr<Plugin> make_sensor_imu(const PluginContext& context) {
  const PluginParams& params = context.params;
  if (context.sensor == nullptr) {
    throw Error(params.owner() + ": belongs in a <sensor> of type imu");
  }
  const double fallback =
      context.sensor->update_rate_hz > 0.0 ? context.sensor->update_rate_hz : 1.0;
  return std::make_unique<GazeboImu>(
      context,
      ImuSite{context.link, context.sensor->T_link_sensor * offset_of(params),
              params.text("topicName", "imu_data"), params.required_text("frameName"),
              params.number("updateRateHZ", fallback, {0.0, 1e6}),
              params.flag("initialOrientationAsReference", false)},
      context.sensor->params.find("imu"));
}

}  // namespace

PluginFactory gazebo_imu_factory() { return {make_model_imu, {}}; }
PluginFactory gazebo_imu_sensor_factory() { return {make_sensor_imu, {}}; }

}  // namespace trident
