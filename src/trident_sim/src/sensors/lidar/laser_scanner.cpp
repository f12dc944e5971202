// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "beam_caster.h"
#include "core/plugins/model_params.h"
#include "core/plugins/plugin_util.h"
#include "lidar_spec.h"
#include "rolling_sweep.h"
#include "sensors/lidar/example_lidar.h"
#include "trident_base/angle.h"
#include "trident_base/error.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

constexpr double kTurn = 2.0 * kPi;

/// A planar lidar. As a snapshot every beam of a scan is cast at once, as Gazebo does; rolling,
/// each is cast at its own time from where the sensor is then, so that what it sees is distorted by
/// its motion. Beams begin at the smallest range: what is nearer is not seen.
class LaserScanner : public MeasuringPlugin {
 public:
  LaserScanner(const PluginContext& context, const std::string& default_topic, bool is_rolling)
      : MeasuringPlugin(context.world.timing()),
        link_((required_ray_sensor(context), *context.link)),
        T_link_sensor_(context.sensor->T_link_sensor),
        spec_(read_lidar_spec(*context.sensor, context.params.owner())),
        clock_(context.sensor->update_rate_hz),
        is_rolling_(context.params.flag("rolling", is_rolling)),
        stream_(context.world.seed(), context.name),
        caster_(context, spec_.range_min_m, spec_.range_max_m),
        turn_(clock_.rate_hz(), static_cast<std::size_t>(spec_.horizontal.beams),
              is_rolling_ ? beam_period_s() : 0.0) {
    if (is_rolling_ && clock_.rate_hz() <= 0.0) {
      throw Error(context.params.owner() + ": a rolling scan needs an <update_rate> > 0");
    }
    const BeamFan& fan = spec_.horizontal;
    const double elevation = spec_.vertical.min_rad, level = std::cos(elevation);
    for (int beam = 0; beam < fan.beams; ++beam) {
      const double azimuth = fan.angle_rad(beam);
      directions_.emplace_back(level * std::cos(azimuth), level * std::sin(azimuth),
                               std::sin(elevation));
    }
    sweep_.resize(directions_.size());
    intensities_.resize(directions_.size());
    const PluginParams& params = context.params;
    scan_ = advertise<LaserScanSample>(
        context, scoped_topic(params, params.text("topicName", default_topic)), PortRank::kSensor);
    LaserScanSample& value = scan_->value;
    value.frame = resolved_frame(context, params.text("frameName", link_.name),
                                 FramePrefix::kTfPrefixOrNamespace);
    value.angle_min_rad = fan.min_rad;
    value.angle_max_rad = fan.angle_rad(fan.beams - 1);
    value.angle_increment_rad = fan.increment_rad();
    value.range_min_m = spec_.range_min_m;
    value.range_max_m = spec_.range_max_m;
    value.ranges = sweep_;
    value.intensities = intensities_;
    if (is_rolling_) {
      value.scan_time_s = 1.0 / clock_.rate_hz();
      value.time_increment_s = beam_period_s();
    }
  }

  void reset() override {
    track_.reset();
    turn_.reset();
  }
  void state(StateArchive& archive) override {
    track_.state(archive);
    turn_.state(archive);
    archive(sweep_, intensities_);
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (is_rolling_) {
      roll(info);
    } else if (clock_.is_due(info) && scan_->wanted()) {
      const SE3 T_world_sensor = link_.T_world_link() * T_link_sensor_;
      const RollingSweep::Due all{clock_.count_at(info), 0, directions_.size(), true};
      caster_.begin(directions_.size());
      aim(all, 0, directions_.size(), T_world_sensor);
      cast(all);
      publish(info.end);
    }
  }

 private:
  double beam_period_s() const {
    // The mirror makes one full turn a scan, however wide the fan of beams is.
    return spec_.horizontal.increment_rad() / kTurn / clock_.rate_hz();
  }

  /// The beams whose time lies in this step, from where the sensor was at that time.
  void roll(const StepInfo& info) {
    track_.follow(link_.T_world_link() * T_link_sensor_);
    turn_.begin_step(info, scan_->wanted());
    bool is_first = true;
    while (const auto due = turn_.next()) {
      caster_.begin(due->last - due->first);
      if (track_.is_still()) {
        aim(*due, due->first, due->last, track_.at(0.0));
      } else {
        for (std::size_t beam = due->first; beam < due->last; ++beam) {
          aim(*due, beam, beam + 1, track_.at(turn_.fraction(*due, beam, 0.0)));
        }
      }
      cast(*due);
      if (!due->is_complete) continue;
      // One that is faster than the step sends all its scans.
      is_first ? scan_->clear_buffered() : scan_->buffer_sample();
      is_first = false;
      publish(turn_.stamp(*due));
    }
  }

  /// Beams [first, last) among those that are due, from one place.
  void aim(const RollingSweep::Due& due, std::size_t first, std::size_t last,
           const SE3& T_world_sensor) {
    const Eigen::Matrix3d R = T_world_sensor.R.toRotationMatrix();
    for (std::size_t beam = first; beam < last; ++beam) {
      caster_.aim(beam - due.first, T_world_sensor.p, R * directions_[beam]);
    }
  }

  /// Casts what was aimed into the sweep.
  void cast(const RollingSweep::Due& due) {
    caster_.refresh_for_aimed((link_.T_world_link() * T_link_sensor_).p);
    caster_.cast();
    NormalRow noise(stream_, due.scan);
    for (std::size_t beam = due.first; beam < due.last; ++beam) {
      const auto channel = static_cast<std::uint32_t>(beam);
      const RayHit hit = caster_.hit(beam - due.first, due.scan, channel);
      sweep_[beam] = measured(hit.distance_m, channel, noise);
      intensities_[beam] = static_cast<float>(caster_.intensity(hit));
    }
  }

  float measured(double distance_m, std::uint32_t beam, NormalRow& noise) const {
    // REP 117: a beam without a return within the range is +infinity.
    if (!(distance_m < spec_.range_max_m)) return std::numeric_limits<float>::infinity();
    double noisy = distance_m + spec_.noise.mean;
    if (spec_.noise.stddev > 0.0) {
      noisy += spec_.noise.stddev * static_cast<double>(noise.at(beam));
    }
    // As in Gazebo, noise does not take a return out of the sensor's range.
    return static_cast<float>(std::clamp(noisy, spec_.range_min_m, spec_.range_max_m));
  }

  void publish(SimTime stamp) {
    scan_->value.stamp = stamp;
    scan_->value.ranges = sweep_;
    scan_->value.intensities = intensities_;
    scan_->publish();
  }

  Link& link_;
  SE3 T_link_sensor_;
  LidarSpec spec_;
  SampleClock clock_;
  bool is_rolling_;
  RandomStream stream_;
  BeamCaster caster_;
  OutHandle<LaserScanSample> scan_;

  std::vector<Eigen::Vector3d> directions_;  ///< of the beams, in the sensor's frame
  SensorTrack track_;
  RollingSweep turn_;
  std::vector<float> sweep_, intensities_;  ///< the scan in progress
};

PluginFactory laser_scanner(const char* default_topic, bool is_rolling) {
  return {[=](const PluginContext& context) {
            return std::make_unique<LaserScanner>(context, default_topic, is_rolling);
          },
          {}};
}

PluginExample lidar_example(const char* elements) { return {elements, {}, {}, kExampleLidar}; }

const PluginRegistrar kGazeboRosLaser("libgazebo_ros_laser.so", laser_scanner("/world", false),
                                      lidar_example("<topicName>scan</topicName>"));
const PluginRegistrar kGazeboRosGpuLaser("libgazebo_ros_gpu_laser.so",
                                         laser_scanner("/world", false),
                                         lidar_example("<topicName>scan</topicName>"));
const PluginRegistrar kTridentLidar("libtrident_lidar.so", laser_scanner("scan", true),
                                    lidar_example("<rolling>true</rolling>"));

}  // namespace

}  // namespace trident::sim
