// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "../plugin_util.h"
#include "rotors_plugins.h"

namespace trident {
namespace {

Eigen::Vector3d read_direction(const PluginParams& params, const char* key,
                               const Eigen::Vector3d& fallback) {
  const Eigen::Vector3d direction = params.vector3(key, fallback);
  if (direction.norm() < 1e-9)
    params.refuse(key, params.text(key, ""), "a vector that is not zero");
  return direction.normalized();
}

/// A constant wind force, one gust of force, and a constant wind speed that the rotors of the same
/// namespace feel.
class Wind : public Plugin {
 public:
  explicit Wind(const PluginContext& context) : link_(required_link(context, "linkName")) {
    const PluginParams& params = context.params;
    if (params.flag("useCustomStaticWindField", false)) {
      params.refuse("useCustomStaticWindField", "true", "false: wind fields are not supported");
    }
    offset_ = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
    direction_ = read_direction(params, "windDirection", Eigen::Vector3d::UnitX());
    gust_direction_ = read_direction(params, "windGustDirection", Eigen::Vector3d::UnitY());
    force_mean_n_ = params.number("windForceMean", 0.0);
    gust_start_ = SimTime::from_seconds(params.number("windGustStart", 10.0, {0.0, 1e9}));
    gust_end_ =
        gust_start_ + SimTime::from_seconds(params.number("windGustDuration", 0.0, {0.0, 1e9}));
    gust_force_mean_n_ = params.number("windGustForceMean", 0.0);
    wind_world_ = params.number("windSpeedMean", 0.0) * direction_;
    const std::string speed_topic =
        scoped_topic(params, params.text("windSpeedPubTopic", "wind_speed"));
    force_ = advertise<WrenchSample>(
        context, scoped_topic(params, params.text("windForcePubTopic", "external_force")),
        PortRank::kState);
    speed_ = advertise<WindSample>(context, speed_topic, PortRank::kState);
    to_rotors_ = subscribe<WindSample>(context, speed_topic);
    force_->value.frame = speed_->value.frame = params.text("frameId", "world");
  }

  std::vector<Phase> phases() const override { return {Phase::kControl}; }

  void pre_step(Phase, World&, const StepInfo& info) override {
    Eigen::Vector3d force = force_mean_n_ * direction_;
    if (info.end >= gust_start_ && info.end < gust_end_)
      force += gust_force_mean_n_ * gust_direction_;
    if (link_.body != nullptr && !force.isZero()) {
      link_.body->add_force_at(force, link_.T_world_link() * offset_);
    }
    if (to_rotors_->count() == 0) to_rotors_->write({info.end, speed_->value.frame, wind_world_});
    if (force_->wanted()) {
      force_->value.stamp = info.end;
      force_->value.force = force;
      force_->publish();
    }
    if (speed_->wanted()) {
      speed_->value.stamp = info.end;
      speed_->value.v_world = wind_world_;
      speed_->publish();
    }
  }

  void reset() override { to_rotors_->clear(); }

 private:
  Link& link_;
  Eigen::Vector3d offset_, direction_, gust_direction_, wind_world_;
  double force_mean_n_, gust_force_mean_n_;
  SimTime gust_start_, gust_end_;
  OutHandle<WrenchSample> force_;
  OutHandle<WindSample> speed_;
  InHandle<WindSample> to_rotors_;
};

}  // namespace

PluginFactory wind_factory() {
  return {[](const PluginContext& context) { return std::make_unique<Wind>(context); }, {}};
}

}  // namespace trident
