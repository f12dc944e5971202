// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "beam_caster.h"
#include "core/plugins/model_params.h"
#include "core/plugins/plugin_util.h"
#include "lidar_pattern.h"
#include "lidar_spec.h"
#include "rolling_sweep.h"
#include "sensors/lidar/example_lidar.h"
#include "trident_base/error.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// What a returning beam must keep to: the sensor's `<range>` and the plugin's <min_range>,
/// <max_range> and <min_intensity>.
struct ReturnLimits {
  double range_min_m, range_max_m, intensity_min;
};

ReturnLimits read_limits(const LidarSpec& spec, const PluginParams& params) {
  constexpr double kAny = std::numeric_limits<double>::lowest();
  ReturnLimits limits{};
  limits.range_min_m = std::max(spec.range_min_m, params.number("min_range", 0.0, {0.0, 1e9}));
  limits.range_max_m = std::min(spec.range_max_m, params.number("max_range", 1e9, {0.0, 1e9}));
  limits.intensity_min = params.number("min_intensity", kAny);
  if (!(limits.range_min_m < limits.range_max_m)) {
    throw Error(params.owner() + ": ranges from " + std::to_string(limits.range_min_m) + " m to " +
                std::to_string(limits.range_max_m) +
                " m are left by <range>, <min_range> and <max_range>; the smallest must be less "
                "than the largest");
  }
  return limits;
}

/// A lidar with many rings, whose returns are points in its frame. As a snapshot all beams of a
/// scan are cast at once, as Gazebo does, and stamped with that time; rolling, each is cast from
/// where the sensor is as its column is cast, and the stamp is that of the first. What is cast in a
/// step is deferred to the end of the phase, when threads share it with other sensors'.
class PointLidar : public MeasuringPlugin, public RayJob {
 public:
  PointLidar(const PluginContext& context, const std::string& default_topic, bool is_rolling)
      : PointLidar(context, read_lidar_spec(required_ray_sensor(context), context.params.owner()),
                   default_topic, context.params.flag("rolling", is_rolling)) {}

  void reset() override {
    track_.reset();
    sweep_.reset();
    points_.clear();
  }
  void state(StateArchive& archive) override {
    track_.state(archive);
    sweep_.state(archive);
    archive(points_);
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    step_.casts.clear();
    if (is_rolling_) {
      roll(info);
    } else if (clock_.is_due(info) && cloud_->wanted()) {
      T_world_sensor_ = link_.T_world_link() * T_link_sensor_;
      step_.casts.push_back({{clock_.count_at(info), 0, pattern_->columns(), true}, info.end});
    }
    if (!step_.casts.empty()) caster_.scene().deferred().add(*this);
  }

  Eigen::Vector2d viewer() const override { return T_world_sensor_.p.head<2>(); }

  std::size_t begin() override {
    // On the stepping thread, because the parts on the other threads only read the surface.
    caster_.refresh_water(T_world_sensor_.p);
    step_.blocks.clear();
    for (const Cast& cast : step_.casts) divide(cast);
    if (step_.returns.size() < step_.blocks.size()) step_.returns.resize(step_.blocks.size());
    return step_.blocks.size();
  }

  void run_part(std::size_t part) override {
    // One buffer a thread, whose memory serves all the parts that the thread casts.
    thread_local Beams beams;
    const Block& block = step_.blocks[part];
    cast_block(block, beams);
    step_.returns[part].clear();
    collect(block, beams, step_.returns[part]);
  }

  void finish() override {
    // In the order of the blocks, whichever thread cast
    // them: the cloud is the same for any number of threads.
    std::size_t part = 0;
    for (const Cast& cast : step_.casts) {
      for (; part < step_.blocks.size() && step_.blocks[part].cast == &cast; ++part) {
        points_.insert(points_.end(), step_.returns[part].begin(), step_.returns[part].end());
      }
      if (cast.due.is_complete) publish(cast.stamp);
    }
  }

 private:
  PointLidar(const PluginContext& context, const LidarSpec& spec, const std::string& default_topic,
             bool is_rolling)
      : MeasuringPlugin(context.world.timing()),
        link_(*context.link),
        T_link_sensor_(context.sensor->T_link_sensor),
        clock_(context.sensor->update_rate_hz),
        is_rolling_(is_rolling),
        limits_(read_limits(spec, context.params)),
        noise_{
            std::hypot(spec.noise.stddev, context.params.number("gaussianNoise", 0.0, {0.0, 1e6})),
            spec.noise.mean},
        stream_(context.world.seed(), context.name),
        caster_(context, limits_.range_min_m, limits_.range_max_m),
        pattern_(checked_pattern(context, spec, is_rolling)),
        sweep_(clock_.rate_hz(), pattern_->columns(), pattern_->column_period_s()) {
    const PluginParams& params = context.params;
    cloud_ = advertise<LidarCloudSample>(
        context, scoped_topic(params, params.text("topicName", default_topic)), PortRank::kSensor);
    cloud_->value.frame = resolved_frame(context, params.text("frameName", link_.name),
                                         FramePrefix::kTfPrefixOrNamespace);
    const std::size_t most = pattern_->columns() * pattern_->beams().size();
    cloud_->value.points.reserve(most);
    points_.reserve(most);
  }

  static std::unique_ptr<LidarPattern> checked_pattern(const PluginContext& context,
                                                       const LidarSpec& spec, bool is_rolling) {
    const double rate_hz = context.sensor->update_rate_hz;
    if (is_rolling && !(rate_hz > 0.0)) {
      throw Error(context.params.owner() + ": a rolling scan needs an <update_rate> > 0");
    }
    return make_pattern({spec, rate_hz, is_rolling}, context.params);
  }

  /// The columns whose time lies in this step, from where the sensor was at that time.
  void roll(const StepInfo& info) {
    T_world_sensor_ = link_.T_world_link() * T_link_sensor_;
    track_.follow(T_world_sensor_);
    sweep_.begin_step(info, cloud_->wanted());
    if (!cloud_->wanted()) points_.clear();
    while (const auto due = sweep_.next()) step_.casts.push_back({*due, sweep_.stamp(*due)});
  }

  /// Columns of a scan that are due in this step.
  struct Cast {
    RollingSweep::Due due;
    SimTime stamp;
  };
  /// Columns that are cast at a time.
  struct Block {
    const Cast* cast;
    std::size_t first, columns;
  };
  /// What a thread casts them with.
  struct Beams {
    std::vector<Eigen::Vector3d> directions;  ///< in the sensor's frame
    BeamBatch batch;
  };

  /// Into blocks that fit into the cache, the last of which is not a small one. Which rays go
  /// together, and so the result, does not depend on who casts them.
  void divide(const Cast& cast) {
    constexpr std::size_t kColumns = 32;
    for (std::size_t begin = cast.due.first, columns = 0; begin < cast.due.last; begin += columns) {
      const std::size_t left = cast.due.last - begin;
      columns = left <= kColumns * 3 / 2 ? left : kColumns;
      step_.blocks.push_back({&cast, begin, columns});
    }
  }

  void cast_block(const Block& block, Beams& own) const {
    const std::size_t beams = pattern_->beams().size();
    own.directions.resize(block.columns * beams);
    caster_.begin(block.columns * beams, own.batch);
    for (std::size_t i = 0; i < block.columns; ++i) {
      Eigen::Vector3d* const directions = &own.directions[i * beams];
      pattern_->aim(block.cast->due.scan, block.first + i, directions);
      const SE3 T = T_world_column(block.cast->due, block.first + i);
      const Eigen::Matrix3d R = T.R.toRotationMatrix();
      for (std::size_t beam = 0; beam < beams; ++beam) {
        caster_.aim(place(block, beam, i), T.p, R * directions[beam], own.batch);
      }
    }
    caster_.cast(own.batch);
  }

  /// Where the sensor is in the middle of a column.
  SE3 T_world_column(const RollingSweep::Due& due, std::size_t column) const {
    if (!is_rolling_) return T_world_sensor_;
    const double middle_s = 0.5 * pattern_->beams()[pattern_->firing_order().back()].time_s;
    return track_.at(sweep_.fraction(due, column, middle_s));
  }

  /// Of a beam of the i-th column of a block: neighbours go in one packet.
  std::size_t place(const Block& block, std::size_t beam, std::size_t i) const {
    return pattern_->neighbors() == LidarPattern::Neighbors::kAcrossColumns
               ? beam * block.columns + i
               : i * pattern_->beams().size() + beam;
  }

  void collect(const Block& block, const Beams& own, std::vector<LidarPoint>& points) const {
    NormalRow noise(stream_, block.cast->due.scan);
    for (std::size_t i = 0; i < block.columns; ++i) collect_column(block, own, i, noise, points);
  }

  /// The returns of the i-th column of a block.
  void collect_column(const Block& block, const Beams& own, std::size_t i, NormalRow& noise,
                      std::vector<LidarPoint>& points) const {
    const std::uint64_t scan = block.cast->due.scan;
    const std::size_t beams = pattern_->beams().size(), column = block.first + i;
    const double begin_s = static_cast<double>(column) * pattern_->column_period_s();
    // In the firing order the points of a cloud are sorted by their time.
    for (const std::size_t beam : pattern_->firing_order()) {
      // Noise is a function of scan and beam alone, so that it does not depend on the thread.
      const auto channel = static_cast<std::uint32_t>(column * beams + beam);
      const RayHit hit = caster_.hit(own.batch, place(block, beam, i), scan, channel);
      if (!(hit.distance_m < limits_.range_max_m)) continue;
      const double intensity = caster_.intensity(hit);
      const double range_m =
          hit.distance_m + noise_.bias_m +
          (noise_.stddev_m > 0.0 ? noise_.stddev_m * static_cast<double>(noise.at(channel)) : 0.0);
      const bool counts = range_m >= limits_.range_min_m && range_m <= limits_.range_max_m &&
                          intensity >= limits_.intensity_min;
      if (!counts) continue;
      const LidarPattern::Beam& timing = pattern_->beams()[beam];
      const Eigen::Vector3f p = (range_m * own.directions[i * beams + beam]).cast<float>();
      points.push_back({p.x(), p.y(), p.z(), static_cast<float>(intensity), timing.ring,
                        static_cast<float>(begin_s + timing.time_s)});
    }
  }

  void publish(SimTime stamp) {
    cloud_->value.stamp = stamp;
    // Swapped and not copied: both buffers keep the memory of a full cloud.
    cloud_->value.points.swap(points_);
    points_.clear();
    cloud_->publish();
  }

  /// Of each range, Gaussian.
  struct RangeNoise {
    double stddev_m, bias_m;
  };
  /// What is cast in a step, kept to save its memory.
  struct Step {
    std::vector<Cast> casts;
    std::vector<Block> blocks;
    std::vector<std::vector<LidarPoint>> returns;  ///< by block
  };

  Link& link_;
  SE3 T_link_sensor_;
  SampleClock clock_;
  bool is_rolling_;
  ReturnLimits limits_;
  RangeNoise noise_;
  RandomStream stream_;
  BeamCaster caster_;
  std::unique_ptr<LidarPattern> pattern_;
  SensorTrack track_;
  RollingSweep sweep_;
  OutHandle<LidarCloudSample> cloud_;
  SE3 T_world_sensor_;  ///< now
  Step step_;
  std::vector<LidarPoint> points_;  ///< of the scan in progress
};

PluginFactory point_lidar(const char* default_topic, bool is_rolling) {
  return {[=](const PluginContext& context) {
            return std::make_unique<PointLidar>(context, default_topic, is_rolling);
          },
          {}};
}

PluginExample velodyne_example() {
  return {"<topicName>points</topicName>",
          {},
          {"min_range", "max_range", "min_intensity", "gaussianNoise"},
          kExampleLidar};
}

const PluginRegistrar kGazeboRosVelodyneLaser("libgazebo_ros_velodyne_laser.so",
                                              point_lidar("/world", false), velodyne_example());
const PluginRegistrar kGazeboRosVelodyneGpuLaser("libgazebo_ros_velodyne_gpu_laser.so",
                                                 point_lidar("/world", false), velodyne_example());
const PluginRegistrar kTridentLidar3d("libtrident_lidar3d.so", point_lidar("points", true),
                                      PluginExample{"<gaussianNoise>0.01</gaussianNoise>",
                                                    {},
                                                    {"min_range", "max_range", "min_intensity",
                                                     "gaussianNoise", "beamPeriod"},
                                                    kExampleLidar});

}  // namespace

}  // namespace trident::sim
