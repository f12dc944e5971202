// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/plugins/plugin_util.h"
#include "trident_base/angle.h"
#include "trident_base/noise.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "trident_sim/samples/text_sample.h"
#include "trident_sim/samples/vector_sample.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

/// libtrident_anemometer.so: the air's velocity in the sensor's frame on <topicName> (wind), and
/// on <topicName>_reading its speed and where it comes from, as in NMEA 0183's MWV.
/// <reference> apparent (default): as the sensor feels it while it moves; true: over ground. The
/// noise is white, <gaussianNoise> [m/s] in each axis, and <bias> (three numbers) is added. On a
/// <sensor>, or with <linkName> and <updateRate> in a model. The air is that of the world's
/// environment or VRX' wind; without either it stands still.
class Anemometer : public MeasuringPlugin {
 public:
  explicit Anemometer(const PluginContext& context)
      : MeasuringPlugin(context.world.timing()),
        link_(context.sensor != nullptr ? *context.link : required_link(context, "linkName")),
        T_link_sensor_(context.sensor != nullptr ? context.sensor->T_link_sensor : SE3()),
        clock_(context.sensor != nullptr ? context.sensor->update_rate_hz
                                         : context.params.number("updateRate", 0.0, {0.0, 1e6})),
        stream_(context.world.seed(), context.name) {
    const PluginParams& params = context.params;
    const std::string reference = params.text("reference", "apparent");
    if (reference != "apparent" && reference != "true") {
      params.refuse("reference", reference, "apparent or true");
    }
    is_true_ = reference == "true";
    const double sigma = params.number("gaussianNoise", 0.0, {0.0, 100.0});
    noise_ = {params.vector3("bias", Eigen::Vector3d::Zero()), Eigen::Vector3d::Constant(sigma)};
    const std::string topic = scoped_topic(params, params.text("topicName", "wind"));
    velocity_ = advertise<VectorSample>(context, topic, PortRank::kSensor);
    reading_ = advertise<WindReadingSample>(context, topic + "_reading", PortRank::kSensor);
    velocity_->value.frame = reading_->value.frame = params.text("frameName", link_.name);
    reading_->value.is_true = is_true_;
  }

 protected:
  bool is_wanted() const { return velocity_->wanted() || reading_->wanted(); }

  /// Velocity of the air, relative to the sensor unless the true wind is measured; world frame.
  Eigen::Vector3d wind_at(const Eigen::Vector3d& p_world) const {
    Eigen::Vector3d wind = Eigen::Vector3d::Zero();
    if (around_.air() != nullptr) wind = around_.air()->wind(p_world);
    if (!is_true_) wind -= link_.v_world_at(p_world);
    return wind;
  }

  void measure(const World& world, const StepInfo& info) override {
    around_.look(world);
    if (!clock_.is_due(info) || !is_wanted()) return;
    const SE3 T_world_sensor = link_.T_world_link() * T_link_sensor_;
    const Eigen::Vector3d measured = T_world_sensor.R.conjugate() * wind_at(T_world_sensor.p) +
                                     noise_.sample(stream_, clock_.count_at(info), 0);
    velocity_->value.stamp = reading_->value.stamp = info.end;
    velocity_->value.value = measured;
    reading_->value.speed_m_s = std::hypot(measured.x(), measured.y());
    // Where it comes from, clockwise as seen from above.
    const double from = std::atan2(measured.y(), -measured.x());
    reading_->value.angle_rad = from < 0.0 ? from + 2.0 * kPi : from;
    if (velocity_->wanted()) velocity_->publish();
    if (reading_->wanted()) reading_->publish();
  }

 private:
  Link& link_;
  SE3 T_link_sensor_;
  SampleClock clock_;
  RandomStream stream_;
  GaussianNoise3 noise_;
  bool is_true_ = false;
  Surroundings around_;
  OutHandle<VectorSample> velocity_;
  OutHandle<WindReadingSample> reading_;
};

const PluginRegistrar kTridentAnemometer(
    "libtrident_anemometer.so", factory_of<Anemometer>(),
    PluginExample{"<linkName>base_link</linkName><gaussianNoise>0.1</gaussianNoise>",
                  {"linkName"},
                  {"gaussianNoise", "bias", "updateRate"}});

}  // namespace

}  // namespace trident::sim
