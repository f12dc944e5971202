// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "core/plugins/model_params.h"
#include "core/plugins/plugin_util.h"
#include "ray_bundle.h"
#include "sensors/lidar/example_lidar.h"
#include "trident_base/angle.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// libgazebo_ros_range.so: the nearest range of a bundle of rays. <topicName>, <frameName>, <fov>
/// [rad], which is only published, <radiation> (ultrasound or infrared), <gaussianNoise> [m]
/// besides the sensor's own, <updateRate>. Where nothing is hit it reports the largest range,
/// without noise, as upstream.
class RangeFinder : public MeasuringPlugin {
 public:
  explicit RangeFinder(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        rays_(context, water_of(context)),
        stddev_m_(std::hypot(rays_.spec().noise.stddev,
                             context.params.number("gaussianNoise", 0.0, {0.0, 1e6}))),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    range_ = advertise<RangeSample>(context, sensor_topic(params, "/range"), PortRank::kSensor);
    RangeSample& value = range_->value;
    value.frame = resolved_frame(context, params.text("frameName", context.link->name),
                                 FramePrefix::kTfPrefix);
    value.is_infrared = is_second_choice(params, "radiation", "ultrasound", "infrared");
    value.field_of_view_rad = params.number("fov", 0.05, {0.0, 2.0 * kPi});
    value.range_min_m = rays_.spec().range_min_m;
    value.range_max_m = rays_.spec().range_max_m;
  }

 protected:
  void measure(const World&, const StepInfo& info) override {
    if (!rays_.clock().is_due(info) || !range_->wanted()) return;
    rays_.cast(rays_.clock().count_at(info));
    const LidarSpec& spec = rays_.spec();
    double nearest_m = spec.range_max_m;
    for (std::size_t beam = 0; beam < rays_.size(); ++beam) {
      nearest_m = std::min(nearest_m, rays_.range_m(beam));
    }
    if (nearest_m < spec.range_max_m) {
      const double noise_m =
          spec.noise.mean + stddev_m_ * stream_.normal(rays_.clock().count_at(info), 0);
      nearest_m = std::clamp(nearest_m + noise_m, spec.range_min_m, spec.range_max_m);
    }
    range_->value.stamp = info.end;
    range_->value.range_m = nearest_m;
    range_->publish();
  }

 private:
  /// Sound comes back from water, infrared light as a lidar's.
  static WaterReturns water_of(const PluginContext& context) {
    return context.params.text("radiation", "ultrasound") == "infrared" ? WaterReturns::kAuto
                                                                        : WaterReturns::kOn;
  }

  RayBundle rays_;
  double stddev_m_;
  RandomStream stream_;
  OutHandle<RangeSample> range_;
};

const PluginRegistrar kGazeboRosRange("libgazebo_ros_range.so", factory_of<RangeFinder>(),
                                      PluginExample{"<gaussianNoise>0.01</gaussianNoise>",
                                                    {},
                                                    {"gaussianNoise", "fov", "updateRate"},
                                                    kExampleLidar});

}  // namespace

}  // namespace trident::sim
