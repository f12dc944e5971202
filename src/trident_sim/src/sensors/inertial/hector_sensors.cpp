// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Sensors under the names of hector_gazebo_plugins; their IMU is next to gazebo_ros'.
#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>

#include "axis_noise.h"
#include "core/plugins/plugin_util.h"
#include "sensors/lidar/example_lidar.h"
#include "sensors/lidar/ray_bundle.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_base/random_stream.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "trident_sim/samples/vector_sample.h"

namespace trident::sim {
namespace {

constexpr std::uint32_t kChannels = 4;  ///< of an AxisNoiseSource

/// Errors of a vector, read as read_hector_noises() does.
class VectorError {
 public:
  VectorError(const PluginParams& params, const std::string& prefix, double period_s,
              std::uint32_t channel) {
    for (const AxisNoise& noise : read_hector_noises(params, prefix)) {
      variance_[static_cast<Eigen::Index>(sources_.size())] =
          noise.stddev * noise.stddev + noise.dynamic_bias_stddev * noise.dynamic_bias_stddev;
      const auto axis = static_cast<std::uint32_t>(sources_.size());
      sources_.emplace_back(noise, period_s, channel + kChannels * axis);
    }
  }

  Eigen::Vector3d sample(const RandomStream& stream, std::uint64_t index) {
    return {sources_[0].sample(stream, index), sources_[1].sample(stream, index),
            sources_[2].sample(stream, index)};
  }
  const Eigen::Vector3d& variance() const { return variance_; }
  void reset() {
    for (AxisNoiseSource& source : sources_) source.reset();
  }
  void state(StateArchive& archive) { archive(sources_); }

 private:
  std::vector<AxisNoiseSource> sources_;
  Eigen::Vector3d variance_;
};

Link& body_of(const PluginContext& context) {
  if (context.params.has("bodyName")) return required_link(context, "bodyName");
  Link* const link = context.model != nullptr ? context.model->canonical_link() : nullptr;
  if (link == nullptr) throw Error(context.params.owner() + ": belongs in a model with a link");
  return *link;
}

/// What the sensors of a body have in common: `<bodyName>` (the model's first), `<frameId>`,
/// `<updateRate>`.
class HectorSensor : public MeasuringPlugin {
 public:
  HectorSensor(const PluginContext& context, double fallback_rate_hz)
      : MeasuringPlugin(context.world.timing()),
        link_(body_of(context)),
        frame_(context.params.text("frameId", link_.name)),
        clock_(context.params.number("updateRate", fallback_rate_hz, {0.0, 1e6})),
        period_s_(clock_.rate_hz() > 0.0 ? 1.0 / clock_.rate_hz()
                                         : context.world.physics().max_step_size_s),
        stream_(context.world.seed(), context.name) {}

 protected:
  void measure(const World&, const StepInfo& info) final {
    if (clock_.is_due(info)) measure(info.end, clock_.count_at(info));
  }
  virtual void measure(SimTime stamp, std::uint64_t index) = 0;

  template <class Sample>
  OutHandle<Sample> advertise_here(const PluginContext& context, const std::string& topic) {
    auto port = advertise<Sample>(context, scoped_topic(context.params, topic), PortRank::kSensor);
    port->value.frame = frame_;
    return port;
  }
  const Link& link() const { return link_; }
  double period_s() const { return period_s_; }
  const RandomStream& stream() const { return stream_; }

 private:
  Link& link_;
  std::string frame_;
  SampleClock clock_;
  double period_s_;
  RandomStream stream_;
};

/// The compass heading of the world's x axis [rad]: `<referenceHeading>` [degrees], or what the
/// world says, which counts from the east against the clock.
double heading_of(const PluginContext& context) {
  const double fallback = 90.0 - context.world.spherical().heading_deg;
  return deg_to_rad(context.params.number("referenceHeading", fallback, {-360.0, 360.0}));
}

/// libhector_gazebo_ros_gps.so: `<topicName>` (fix), `<velocityTopicName>` (fix_velocity: north,
/// west, up), `<referenceLatitude>`, `<referenceLongitude>`, `<referenceAltitude>`,
/// `<referenceHeading>` (the world's), errors without prefix and with "velocity". Unlike upstream's
/// an error of the velocity does not add up in the position.
class HectorGps : public HectorSensor {
 public:
  explicit HectorGps(const PluginContext& context)
      : HectorSensor(context, 4.0),
        position_(context.params, "", period_s(), 0),
        velocity_(context.params, "velocity", period_s(), 3 * kChannels),
        R_enu_world_(Eigen::AngleAxisd(0.5 * kPi - heading_of(context), Eigen::Vector3d::UnitZ())) {
    const PluginParams& params = context.params;
    const SphericalCoordinates& world = context.world.spherical();
    earth_.Reset(params.number("referenceLatitude", world.latitude_deg, {-90.0, 90.0}),
                 params.number("referenceLongitude", world.longitude_deg, {-360.0, 360.0}),
                 params.number("referenceAltitude", world.elevation_m, {-1e5, 1e7}));
    fix_ = advertise_here<GnssFixSample>(context, params.text("topicName", "fix"));
    speed_ =
        advertise_here<VectorSample>(context, params.text("velocityTopicName", "fix_velocity"));
    const Eigen::Matrix3d covariance =
        R_enu_world_ * position_.variance().asDiagonal() * R_enu_world_.transpose();
    // The errors are along the world's axes, so their covariance turns with the world's heading.
    Eigen::Map<Eigen::Matrix3d>(fix_->value.covariance_enu.data()) = covariance;
  }

  void reset() override {
    position_.reset();
    velocity_.reset();
  }
  void state(StateArchive& archive) override {
    position_.state(archive);
    velocity_.state(archive);
  }

 protected:
  void measure(SimTime stamp, std::uint64_t index) override {
    if (fix_->wanted()) {
      const Eigen::Vector3d p_world = link().T_world_link().p + position_.sample(stream(), index);
      const Eigen::Vector3d p_enu = R_enu_world_ * p_world;
      GnssFixSample& fix = fix_->value;
      fix.stamp = stamp;
      earth_.Reverse(p_enu.x(), p_enu.y(), p_enu.z(), fix.latitude_deg, fix.longitude_deg,
                     fix.altitude_m);
      fix_->publish();
    }
    if (speed_->wanted()) {
      const Eigen::Vector3d v_world =
          link_velocity_world(link()) + velocity_.sample(stream(), index);
      const Eigen::Vector3d v_enu = R_enu_world_ * v_world;
      speed_->value.stamp = stamp;
      // East, north, up to upstream's north, west, up.
      speed_->value.value = {v_enu.y(), -v_enu.x(), v_enu.z()};
      speed_->publish();
    }
  }

 private:
  VectorError position_, velocity_;
  Eigen::Matrix3d R_enu_world_;
  GeographicLib::LocalCartesian earth_;
  OutHandle<GnssFixSample> fix_;
  OutHandle<VectorSample> speed_;
};

/// libhector_gazebo_ros_magnetic.so: `<topicName>` (magnetic), `<magnitude>` (1), `<declination>`
/// (0), `<inclination>` (60) [degrees], `<referenceHeading>`; a Vector3Stamped, or a MagneticField
/// [T] with `<useMagneticFieldMsgs>`.
class HectorMagnetic : public HectorSensor {
 public:
  explicit HectorMagnetic(const PluginContext& context)
      : HectorSensor(context, 0.0), error_(context.params, "", period_s(), 0) {
    const PluginParams& params = context.params;
    const double magnitude = params.number("magnitude", 1.0, {0.0, 1e9});
    const double declination = deg_to_rad(params.number("declination", 0.0, {-180.0, 180.0}));
    const double inclination = deg_to_rad(params.number("inclination", 60.0, {-90.0, 90.0}));
    const double heading = heading_of(context) - declination;
    // Magnetic north is at this angle from the world's x axis, counterclockwise; the field dips
    // below the horizon by the inclination.
    field_world_ = magnitude * Eigen::Vector3d(std::cos(inclination) * std::cos(heading),
                                               std::cos(inclination) * std::sin(heading),
                                               -std::sin(inclination));
    const std::string topic = params.text("topicName", "magnetic");
    if (params.flag("useMagneticFieldMsgs", false)) {
      field_ = advertise_here<MagneticFieldSample>(context, topic);
    } else {
      vector_ = advertise_here<VectorSample>(context, topic);
    }
  }

  void reset() override { error_.reset(); }
  void state(StateArchive& archive) override { error_.state(archive); }

 protected:
  void measure(SimTime stamp, std::uint64_t index) override {
    if (!(field_ ? field_->wanted() : vector_->wanted())) return;
    const Eigen::Vector3d field =
        link().T_world_link().R.conjugate() * field_world_ + error_.sample(stream(), index);
    if (field_) {
      field_->value.stamp = stamp;
      field_->value.field_t = field;
      field_->publish();
    } else {
      vector_->value.stamp = stamp;
      vector_->value.value = field;
      vector_->publish();
    }
  }

 private:
  VectorError error_;
  Eigen::Vector3d field_world_;
  OutHandle<MagneticFieldSample> field_;
  OutHandle<VectorSample> vector_;
};

/// libhector_gazebo_ros_baro.so: `<topicName>` (pressure_height), the height above the world's
/// origin as z of a point. Upstream's message of its own, Altimeter, is not there.
class HectorBaro : public HectorSensor {
 public:
  explicit HectorBaro(const PluginContext& context)
      : HectorSensor(context, 0.0),
        error_(context.params, "", period_s(), 0),
        height_(advertise_here<PointSample>(context,
                                            context.params.text("topicName", "pressure_height"))) {}

  void reset() override { error_.reset(); }
  void state(StateArchive& archive) override { error_.state(archive); }

 protected:
  void measure(SimTime stamp, std::uint64_t index) override {
    if (!height_->wanted()) return;
    const double error = error_.sample(stream(), index).z();
    height_->value.stamp = stamp;
    height_->value.p_frame.z() = link().T_world_link().p.z() + error;
    height_->publish();
  }

 private:
  VectorError error_;
  OutHandle<PointSample> height_;
};

/// libhector_gazebo_ros_sonar.so, of a ray sensor: `<topicName>` (sonar), `<frameId>`
/// (/sonar_link),
/// `<updateRate>` (10); the nearest range, the largest where nothing is hit. The sensor's own
/// `<noise>` counts as well as the plugin's.
class HectorSonar : public MeasuringPlugin {
 public:
  explicit HectorSonar(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        rays_(context, WaterReturns::kOn),
        clock_(context.params.number("updateRate", 10.0, {0.0, 1e6})),
        error_(read_hector_noises(context.params, "")[0],
               clock_.rate_hz() > 0.0 ? 1.0 / clock_.rate_hz()
                                      : context.world.physics().max_step_size_s,
               0),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    range_ = advertise<RangeSample>(
        context, scoped_topic(params, params.text("topicName", "sonar")), PortRank::kSensor);
    RangeSample& value = range_->value;
    value.frame = params.text("frameId", "/sonar_link");
    const LidarSpec& spec = rays_.spec();
    value.field_of_view_rad = std::min(spec.horizontal.max_rad - spec.horizontal.min_rad,
                                       spec.vertical.max_rad - spec.vertical.min_rad);
    value.range_min_m = spec.range_min_m;
    value.range_max_m = spec.range_max_m;
  }

  void reset() override { error_.reset(); }
  void state(StateArchive& archive) override { archive(error_); }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!clock_.is_due(info) || !range_->wanted()) return;
    const std::uint64_t index = clock_.count_at(info);
    rays_.cast(index);
    const LidarSpec& spec = rays_.spec();
    double nearest_m = spec.range_max_m;
    for (std::size_t beam = 0; beam < rays_.size(); ++beam) {
      nearest_m = std::min(nearest_m, rays_.range_m(beam));
    }
    if (nearest_m < spec.range_max_m) {
      const double noise_m = spec.noise.sample(stream_, index, kChannels);
      nearest_m = std::clamp(nearest_m + noise_m + error_.sample(stream_, index), spec.range_min_m,
                             spec.range_max_m);
    }
    range_->value.stamp = info.end;
    range_->value.range_m = nearest_m;
    range_->publish();
  }

 private:
  RayBundle rays_;
  SampleClock clock_;
  AxisNoiseSource error_;
  RandomStream stream_;
  OutHandle<RangeSample> range_;
};

const PluginRegistrar kHectorGazeboRosGps("libhector_gazebo_ros_gps.so", factory_of<HectorGps>(),
                                          PluginExample{
                                              "<updateRate>50</updateRate><drift>5 5 5</drift>"
                                              "<velocityGaussianNoise>0.1</velocityGaussianNoise>",
                                              {},
                                              {"referenceLatitude", "referenceHeading",
                                               "gaussianNoise", "drift", "velocityOffset"}});
const PluginRegistrar kHectorGazeboRosMagnetic(
    "libhector_gazebo_ros_magnetic.so", factory_of<HectorMagnetic>(),
    PluginExample{"<gaussianNoise>1e-3 1e-3 1e-3</gaussianNoise>",
                  {},
                  {"magnitude", "declination", "inclination", "referenceHeading", "offset"}});
const PluginRegistrar kHectorGazeboRosBaro(
    "libhector_gazebo_ros_baro.so", factory_of<HectorBaro>(),
    PluginExample{"<drift>0.1</drift><gaussianNoise>0.5</gaussianNoise>",
                  {},
                  {"updateRate", "driftFrequency"}});
const PluginRegistrar kHectorGazeboRosSonar(
    "libhector_gazebo_ros_sonar.so", factory_of<HectorSonar>(),
    PluginExample{"<gaussianNoise>0.01</gaussianNoise><updateRate>50</updateRate>",
                  {},
                  {"gaussianNoise", "drift", "updateRate"},
                  kExampleLidar});

}  // namespace

}  // namespace trident::sim
