// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "axis_noise.h"
#include "core/plugins/plugin_util.h"
#include "sensors/command_input.h"
#include "trident_base/error.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

struct ImuSite {
  Link* link;
  SE3 T_link_imu;
  std::string topic, frame;
  double rate_hz;
  bool is_against_start;  ///< orientation against that at the start, else against the world
  std::vector<std::string> services;  ///< std_srvs/Empty, each of which calibrates the gyroscope
};

using Triad = std::array<AxisNoise, 3>;
struct ImuNoises {
  Triad gyro, accel;
  AxisNoise heading;    ///< of the orientation, about the IMU's z [rad]
  double common = 0.0;  ///< standard deviation on every axis of the rates and of the force
};

SE3 offset_of(const PluginParams& params) {
  const Eigen::Vector3d rpy = params.vector3("rpyOffset", Eigen::Vector3d::Zero());
  const Eigen::Vector3d xyz = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
  return SE3::from_xyz_rpy(xyz, rpy.x(), rpy.y(), rpy.z());
}

/// Orientation, angular velocity and specific force, gravity included, of gazebo_ros' two IMUs and
/// hector_gazebo_plugins'. A calibration takes the gyroscope's bias of that moment out of what
/// follows, until a reset.
class GazeboImu : public MeasuringPlugin {
 public:
  GazeboImu(const PluginContext& context, ImuSite site, const ImuNoises& noises)
      : MeasuringPlugin(context.world.timing()),
        site_(std::move(site)),
        clock_(site_.rate_hz),
        gaussian_(noises.common),
        heading_(noises.heading, period_s(context), kChannels * 6),
        stream_(context.world.seed(), context.name),
        R_start_(site_.link->T_world_link().R * site_.T_link_imu.R) {
    imu_ =
        advertise<ImuSample>(context, scoped_topic(context.params, site_.topic), PortRank::kSensor);
    ImuSample& value = imu_->value;
    value.frame = site_.frame;  // as upstream, without tf_prefix
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double common = gaussian_ * gaussian_;
      value.orientation_covariance[4 * axis] = common;
      value.gyro_covariance[4 * axis] = common + square(noises.gyro[axis].stddev);
      value.accel_covariance[4 * axis] = common + square(noises.accel[axis].stddev);
    }
    value.orientation_covariance[8] += square(noises.heading.stddev);
    for (const Triad& triad : {noises.gyro, noises.accel}) {
      for (const AxisNoise& noise : triad) {
        const auto channel = static_cast<std::uint32_t>(kChannels * noises_.size());
        noises_.emplace_back(noise, period_s(context), channel);
      }
    }
    for (const std::string& service : site_.services) {
      calibrations_.emplace_back(context, scoped_topic(context.params, service));
    }
  }

  void reset() override {
    for (AxisNoiseSource& noise : noises_) noise.reset();
    heading_.reset();
    for (auto& calibration : calibrations_) calibration.reset();
    taken_out_.setZero();
  }
  void state(StateArchive& archive) override {
    archive(noises_, heading_, taken_out_);
    for (auto& calibration : calibrations_) calibration.state(archive);
  }

 protected:
  void measure(const World& world, const StepInfo& info) override {
    const std::uint64_t index = clock_.count_at(info);
    for (auto& calibration : calibrations_) {
      if (calibration.take()) calibrate(index);
    }
    if (!clock_.is_due(info) || !imu_->wanted()) return;
    ImuSample& out = imu_->value;
    out.stamp = info.end;
    const Eigen::Quaterniond R_world_imu = site_.link->T_world_link().R * site_.T_link_imu.R;
    const Eigen::Quaterniond R_imu_world = R_world_imu.conjugate();
    out.R_world_imu = site_.is_against_start ? R_start_.conjugate() * R_world_imu : R_world_imu;
    const double heading = heading_.sample(stream_, index);
    if (heading != 0.0) {
      out.R_world_imu = out.R_world_imu * Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ());
    }
    out.w_imu = R_imu_world * site_.link->w_world() - taken_out_;
    // Specific force a - g, as an accelerometer measures it.
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
  double period_s(const PluginContext& context) const {
    return site_.rate_hz > 0.0 ? 1.0 / site_.rate_hz : context.world.physics().max_step_size_s;
  }
  void calibrate(std::uint64_t index) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      taken_out_[static_cast<Eigen::Index>(axis)] = noises_[axis].bias(stream_, index);
    }
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
    const Eigen::Vector3d dw = (w - link.body->previous_angular_velocity()) / dt_s;
    // Acceleration of a point of a rigid body: that of the origin, tangential and centripetal part.
    return acceleration + dw.cross(r) + w.cross(w.cross(r));
  }

  ImuSite site_;
  SampleClock clock_;
  double gaussian_;
  AxisNoiseSource heading_;
  RandomStream stream_;
  std::vector<AxisNoiseSource> noises_;  ///< of the rates, then of the force
  std::vector<RequestInput<ServiceCommand>> calibrations_;
  Eigen::Vector3d taken_out_ = Eigen::Vector3d::Zero();  ///< of the rates, since a calibration
  Eigen::Quaterniond R_start_;
  OutHandle<ImuSample> imu_;
};

/// "<topic>/calibrate", and what `<serviceName>` names in addition.
std::vector<std::string> services_of(const PluginParams& params, const std::string& topic) {
  std::vector<std::string> services{topic + "/calibrate"};
  const std::string named = params.text("serviceName", "");
  if (!named.empty() && named != services.front()) services.push_back(named);
  return services;
}

double read_common_noise(const PluginParams& params) {
  return params.number("gaussianNoise", 0.0, {0.0, 1e9});
}

std::unique_ptr<Plugin> make_model_imu(const PluginContext& context) {
  const PluginParams& params = context.params;
  Link& link = required_link(context, "bodyName");
  const std::string topic = params.text("topicName", "/default_imu");
  ImuNoises noises;
  noises.common = read_common_noise(params);
  return std::make_unique<GazeboImu>(
      context,
      ImuSite{&link, offset_of(params), topic, params.text("frameName", link.name),
              params.number("updateRate", 0.0, {0.0, 1e6}), false, services_of(params, topic)},
      noises);
}

std::unique_ptr<Plugin> make_sensor_imu(const PluginContext& context) {
  const PluginParams& params = context.params;
  if (context.sensor == nullptr) {
    throw Error(params.owner() + ": belongs in a <sensor> of type imu");
  }
  const double fallback =
      context.sensor->update_rate_hz > 0.0 ? context.sensor->update_rate_hz : 1.0;
  const ParamNode* const element = context.sensor->params.find("imu");
  const auto read = [&](const char* name) {
    return read_axis_noises(element != nullptr ? element->find(name) : nullptr, params.owner());
  };
  ImuNoises noises;
  noises.gyro = read("angular_velocity");
  noises.accel = read("linear_acceleration");
  noises.common = read_common_noise(params);
  const std::string topic = params.text("topicName", "imu_data");
  return std::make_unique<GazeboImu>(
      context,
      ImuSite{context.link, context.sensor->T_link_sensor * offset_of(params), topic,
              params.required_text("frameName"),
              params.number("updateRateHZ", fallback, {0.0, 1e6}),
              params.flag("initialOrientationAsReference", false), services_of(params, topic)},
      noises);
}

void set_stddev(double stddev, ImuNoises& noises) {
  for (Triad* const triad : {&noises.gyro, &noises.accel}) {
    for (AxisNoise& noise : *triad) noise.stddev = stddev;
  }
}

/// What a mounting that is off by `rpy` does to the means that are not given, as upstream.
void add_mounting(const Eigen::Vector3d& rpy, ImuNoises& noises) {
  constexpr double kGravity = 9.8065;  // upstream's
  // Small angles: a roll error shows gravity's reaction on y, a pitch error on x.
  if (noises.accel[1].mean == 0.0) noises.accel[1].mean = -rpy.x() * kGravity;
  if (noises.accel[0].mean == 0.0) noises.accel[0].mean = rpy.y() * kGravity;
  if (noises.heading.mean == 0.0) noises.heading.mean = rpy.z();
}

/// hector_gazebo_plugins': `<rpyOffset>` is what its mounting does to the force and the heading, as
/// upstream. Unlike upstream's, the spread of a drift does not depend on the step, and an error of
/// the force does not tilt the orientation.
std::unique_ptr<Plugin> make_hector_imu(const PluginContext& context) {
  const PluginParams& params = context.params;
  if (context.model == nullptr) throw Error(params.owner() + ": belongs in a model");
  Link* const link = params.has("bodyName") ? &required_link(context, "bodyName")
                                            : context.model->canonical_link();
  if (link == nullptr) throw Error(params.owner() + ": the model has no link");
  ImuNoises noises;
  noises.gyro = read_hector_noises(params, "rate");
  noises.accel = read_hector_noises(params, "accel");
  noises.heading = read_hector_noises(params, "heading")[0];
  const double common = read_common_noise(params);
  if (common != 0.0) set_stddev(common, noises);
  add_mounting(params.vector3("rpyOffset", Eigen::Vector3d::Zero()), noises);
  const std::string topic = params.text("topicName", "imu");
  return std::make_unique<GazeboImu>(
      context,
      ImuSite{link, SE3(), topic, params.text("frameId", link->name),
              params.number("updateRate", 0.0, {0.0, 1e6}), false, services_of(params, topic)},
      noises);
}

const PluginRegistrar kGazeboRosImu(
    "libgazebo_ros_imu.so", {make_model_imu, {}},
    PluginExample{"<bodyName>base_link</bodyName><gaussianNoise>0.1</gaussianNoise>",
                  {"bodyName"},
                  {"gaussianNoise", "updateRate", "xyzOffset", "rpyOffset"}});
const PluginRegistrar kGazeboRosImuSensor(
    "libgazebo_ros_imu_sensor.so", {make_sensor_imu, {}},
    PluginExample{"<frameName>imu</frameName><gaussianNoise>0.1</gaussianNoise>",
                  {"frameName"},
                  {"gaussianNoise", "updateRateHZ", "xyzOffset", "rpyOffset"},
                  R"(<sensor name="example" type="imu"><update_rate>50</update_rate></sensor>)"});
const PluginRegistrar kHectorGazeboRosImu(
    "libhector_gazebo_ros_imu.so", {make_hector_imu, {}},
    PluginExample{"<bodyName>base_link</bodyName><rateDrift>0.01 0.02 0.03</rateDrift>"
                  "<accelGaussianNoise>0.1</accelGaussianNoise>",
                  {},
                  {"gaussianNoise", "updateRate", "rpyOffset", "rateDrift", "accelOffset",
                   "headingGaussianNoise", "rateDriftFrequency"}});

}  // namespace

}  // namespace trident::sim
