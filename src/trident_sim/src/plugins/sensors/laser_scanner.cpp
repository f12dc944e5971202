// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "../gazebo_ros/drive_parts.h"
#include "../plugin_util.h"
#include "lidar_spec.h"
#include "sample_clock.h"
#include "sensor_plugins.h"
#include "trident_base/error.h"
#include "trident_sim/ray_scene.h"

namespace trident {
namespace {

constexpr double kTurn = 2.0 * 3.14159265358979323846;

const SensorSpec& required_sensor(const PluginContext& context) {
  if (context.sensor == nullptr) {
    throw Error(context.params.owner() + ": belongs in a <sensor> of type ray or gpu_ray");
  }
  return *context.sensor;
}

SE3 between(const SE3& from, const SE3& to, double fraction) {
  return {from.R.slerp(fraction, to.R), from.p + fraction * (to.p - from.p)};
}

/// A planar lidar. As a snapshot every beam of a scan is cast at once, as Gazebo does; rolling,
/// each is cast at its own time from where the sensor is then, so that what it sees is distorted by
/// its motion. Beams begin at the smallest range: what is nearer is not seen.
class LaserScanner : public MeasuringPlugin {
 public:
  LaserScanner(const PluginContext& context, const std::string& default_topic, bool is_rolling)
      : MeasuringPlugin(context.world.timing()),
        world_(context.world),
        link_(*context.link),
        T_link_sensor_(required_sensor(context).T_link_sensor),
        spec_(read_lidar_spec(*context.sensor, context.params.owner())),
        clock_(context.sensor->update_rate_hz),
        is_rolling_(context.params.flag("rolling", is_rolling)),
        geometry_(context.sensor->type.rfind("gpu", 0) == 0 ? RayGeometry::kVisual
                                                            : RayGeometry::kCollision),
        stream_(context.world.seed(), context.name) {
    if (is_rolling_ && clock_.rate_hz() <= 0.0) {
      throw Error(context.params.owner() + ": a rolling scan needs an <update_rate> > 0");
    }
    const PluginParams& params = context.params;
    scan_ = advertise<LaserScanSample>(
        context, scoped_topic(params, params.text("topicName", default_topic)), PortRank::kSensor);
    LaserScanSample& value = scan_->value;
    value.frame = resolved_frame(context, params.text("frameName", link_.name),
                                 FramePrefix::kTfPrefixOrNamespace);
    const BeamFan& fan = spec_.horizontal;
    value.angle_min_rad = fan.min_rad;
    value.angle_max_rad = fan.angle_rad(fan.beams - 1);
    value.angle_increment_rad = fan.increment_rad();
    value.range_min_m = spec_.range_min_m;
    value.range_max_m = spec_.range_max_m;
    value.ranges.resize(static_cast<std::size_t>(fan.beams));
    value.intensities.resize(value.ranges.size());
    if (is_rolling_) {
      value.scan_time_s = 1.0 / clock_.rate_hz();
      value.time_increment_s = beam_period_s();
    }
    sweep_ = value.ranges;
  }

  void reset() override {
    is_sweeping_ = false;
    has_before_ = false;
  }
  void state(StateArchive& archive) override {
    archive(sweep_, scan_number_, next_beam_, is_sweeping_, T_world_before_, has_before_);
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (is_rolling_) {
      sweep(info);
    } else if (clock_.is_due(info) && scan_->wanted()) {
      const SE3 T_world_sensor = link_.T_world_link() * T_link_sensor_;
      for (int beam = 0; beam < spec_.horizontal.beams; ++beam) aim(beam, T_world_sensor);
      cast(clock_.count_at(info), 0);
      publish(info.end);
    }
  }

 private:
  double beam_period_s() const {
    return spec_.horizontal.increment_rad() / kTurn / clock_.rate_hz();
  }

  /// The beams whose time lies in this step, from where the sensor was at that time.
  void sweep(const StepInfo& info) {
    const SE3 T_world_sensor = link_.T_world_link() * T_link_sensor_;
    const SE3 T_world_before = has_before_ ? T_world_before_ : T_world_sensor;
    T_world_before_ = T_world_sensor;
    has_before_ = true;
    const double begin_s = static_cast<double>(info.dt.ns * (info.sample - 1)) / 1e9;
    const double end_s = static_cast<double>(info.dt.ns * info.sample) / 1e9;
    if (!scan_->wanted()) {
      is_sweeping_ = false;
      return;
    }
    if (!is_sweeping_) begin_sweep(std::ceil(begin_s * clock_.rate_hz() - kSame));
    while (is_sweeping_) {
      const int first = next_beam_;
      for (; next_beam_ < spec_.horizontal.beams; ++next_beam_) {
        const double time_s = beam_time_s(next_beam_);
        if (time_s > end_s + kSame) break;
        const double fraction = std::clamp((time_s - begin_s) / (end_s - begin_s), 0.0, 1.0);
        aim(next_beam_, between(T_world_before, T_world_sensor, fraction));
      }
      cast(scan_number_, first);
      if (next_beam_ < spec_.horizontal.beams) return;
      const std::int64_t zero_ns =
          info.end.ns - info.dt.ns * static_cast<std::int64_t>(info.sample);
      publish(SimTime{zero_ns} + SimTime::from_seconds(beam_time_s(0)));
      begin_sweep(static_cast<double>(scan_number_ + 1));
      if (beam_time_s(0) > end_s) return;
    }
  }

  void begin_sweep(double number) {
    scan_number_ = static_cast<std::uint64_t>(std::max(number, 0.0));
    next_beam_ = 0;
    is_sweeping_ = true;
  }
  /// Since the last reset.
  double beam_time_s(int beam) const {
    return static_cast<double>(scan_number_) / clock_.rate_hz() + beam * beam_period_s();
  }

  void aim(int beam, const SE3& T_world_sensor) {
    const double azimuth = spec_.horizontal.angle_rad(beam);
    const double elevation = spec_.vertical.min_rad;
    const Eigen::Vector3d direction_sensor(std::cos(elevation) * std::cos(azimuth),
                                           std::cos(elevation) * std::sin(azimuth),
                                           std::sin(elevation));
    Ray ray;
    ray.p_world_origin = T_world_sensor.p;
    ray.direction_world = T_world_sensor.R * direction_sensor;
    ray.t_min_m = spec_.range_min_m;
    ray.t_max_m = spec_.range_max_m;
    rays_.push_back(ray);
  }

  /// Casts what was aimed, the beams from `first` on, into the sweep.
  void cast(std::uint64_t number, int first) {
    if (rays_.empty()) return;
    hits_.resize(rays_.size());
    RayScene& scene = world_.rays(geometry_);
    scene.refresh();
    scene.cast({rays_.data(), rays_.size()}, {hits_.data(), hits_.size()});
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const std::size_t beam = static_cast<std::size_t>(first) + i;
      sweep_[beam] = measured(hits_[i].distance_m, number, static_cast<std::uint32_t>(beam));
    }
    rays_.clear();
  }

  float measured(double distance_m, std::uint64_t number, std::uint32_t beam) const {
    if (!(distance_m < spec_.range_max_m)) return std::numeric_limits<float>::infinity();
    const double noisy = distance_m + spec_.noise.sample(stream_, number, beam);
    return static_cast<float>(std::clamp(noisy, spec_.range_min_m, spec_.range_max_m));
  }

  void publish(SimTime stamp) {
    scan_->value.stamp = stamp;
    scan_->value.ranges = sweep_;
    scan_->publish();
  }

  static constexpr double kSame = 1e-9;

  World& world_;
  Link& link_;
  SE3 T_link_sensor_;
  LidarSpec spec_;
  SampleClock clock_;
  bool is_rolling_;
  RayGeometry geometry_;
  RandomStream stream_;
  OutHandle<LaserScanSample> scan_;

  std::vector<Ray> rays_;
  std::vector<RayHit> hits_;
  std::vector<float> sweep_;  ///< the scan in progress [m]
  std::uint64_t scan_number_ = 0;
  int next_beam_ = 0;
  bool is_sweeping_ = false;
  SE3 T_world_before_;  ///< of the sensor, one step ago
  bool has_before_ = false;
};

}  // namespace

PluginFactory gazebo_laser_factory() {
  return {[](const PluginContext& context) {
            required_sensor(context);
            return std::make_unique<LaserScanner>(context, "/world", false);
          },
          {}};
}

PluginFactory lidar_factory() {
  return {[](const PluginContext& context) {
            required_sensor(context);
            return std::make_unique<LaserScanner>(context, "scan", true);
          },
          {}};
}

}  // namespace trident
