// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/plugins/model_params.h"
#include "core/plugins/plugin_util.h"
#include "ray_bundle.h"
#include "sensors/lidar/example_lidar.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// libgazebo_ros_block_laser.so: a point per beam, ring by ring. <topicName>, <frameName>,
/// <updateRate>, and <gaussianNoise> [m], which upstream adds to x, y and z, each its own; the
/// sensor's noise is that of the range. A beam that hits nothing has its point at the largest
/// range, without noise, as upstream. <hokuyoMinIntensity> is read and does nothing, as upstream.
class BlockLaser : public MeasuringPlugin {
 public:
  explicit BlockLaser(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        rays_(context),
        point_stddev_m_(context.params.number("gaussianNoise", 0.0, {0.0, 1e6})),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    params.number("hokuyoMinIntensity", 101.0);
    points_ =
        advertise<PointListSample>(context, sensor_topic(params, "/world"), PortRank::kSensor);
    PointListSample& value = points_->value;
    value.frame = resolved_frame(context, params.text("frameName", context.link->name),
                                 FramePrefix::kTfPrefix);
    value.points.resize(rays_.size());
    value.intensities.resize(rays_.size());
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!rays_.clock().is_due(info) || !points_->wanted()) return;
    const std::uint64_t scan = rays_.clock().count_at(info);
    rays_.cast(scan);
    NormalRow noise(stream_, scan);
    for (std::size_t beam = 0; beam < rays_.size(); ++beam) {
      points_->value.points[beam] = point(beam, noise).cast<float>();
      points_->value.intensities[beam] = static_cast<float>(rays_.intensity(beam));
    }
    points_->value.stamp = info.end;
    points_->publish();
  }

 private:
  Eigen::Vector3d point(std::size_t beam, NormalRow& noise) const {
    const LidarSpec& spec = rays_.spec();
    const double range_m = rays_.range_m(beam);
    if (!(range_m < spec.range_max_m)) return spec.range_max_m * rays_.direction(beam);
    const auto normal = [&](std::uint32_t axis) {
      return static_cast<double>(noise.at(static_cast<std::uint32_t>(4 * beam) + axis));
    };
    const double along_m = spec.noise.mean + spec.noise.stddev * normal(3);
    return (range_m + along_m) * rays_.direction(beam) +
           point_stddev_m_ * Eigen::Vector3d(normal(0), normal(1), normal(2));
  }

  RayBundle rays_;
  double point_stddev_m_;
  RandomStream stream_;
  OutHandle<PointListSample> points_;
};

const PluginRegistrar kGazeboRosBlockLaser("libgazebo_ros_block_laser.so", factory_of<BlockLaser>(),
                                           PluginExample{"<gaussianNoise>0.01</gaussianNoise>",
                                                         {},
                                                         {"gaussianNoise", "updateRate"},
                                                         kExampleLidar});

}  // namespace

}  // namespace trident::sim
