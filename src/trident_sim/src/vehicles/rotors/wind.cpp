// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/environment/wind_field.h"
#include "core/plugins/plugin_util.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

/// `size`: of what blows in that direction. Published vehicles give the gust that they do not have
/// no direction.
Eigen::Vector3d read_direction(const PluginParams& params, const char* key,
                               const Eigen::Vector3d& fallback, double size) {
  const Eigen::Vector3d direction = params.vector3(key, fallback);
  if (direction.norm() >= 1e-9) return direction.normalized();
  if (size != 0.0) params.refuse(key, params.text(key, ""), "a vector that is not zero");
  return Eigen::Vector3d::Zero();
}

/// The field that <customWindFieldPath> names, or nothing when the wind is the same everywhere.
std::optional<WindGrid> read_field(const PluginContext& context) {
  const PluginParams& params = context.params;
  params.node("customWindFieldPath");  // RotorS' own files name one, whether it is used or not
  if (!params.flag("useCustomStaticWindField", false)) return std::nullopt;
  const std::string path = params.required_text("customWindFieldPath");
  const Resources& resources = context.world.resources();
  const std::string file = resources.find(path);
  if (file.empty() || std::filesystem::is_directory(file)) {
    params.refuse("customWindFieldPath", path,
                  "a file; searched: as given, then " + resources.searched());
  }
  try {
    return read_wind_grid(file);
  } catch (const Error& error) {
    throw Error(params.owner() + ": <customWindFieldPath>: " + error.what());
  }
}

/// A constant wind force, one gust of force, and a constant wind speed that the rotors of the same
/// namespace feel; or the wind speed of a field at the link's origin. As in RotorS a field takes
/// the place of the forces, and outside of it the constant speed blows. Without a speed or a field
/// of its own the plugin shows the world's wind (libtrident_sea.so) at the link's origin.
class WindPlugin : public Plugin {
 public:
  explicit WindPlugin(const PluginContext& context)
      : link_(required_link(context, "linkName")), field_(read_field(context)) {
    const PluginParams& params = context.params;
    offset_ = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
    const double speed = params.number("windSpeedMean", 0.0);
    force_mean_n_ = field_ ? 0.0 : params.number("windForceMean", 0.0);
    direction_ = read_direction(params, "windDirection", Eigen::Vector3d::UnitX(),
                                std::abs(speed) + std::abs(force_mean_n_));
    if (!field_) read_gust(params);
    wind_world_ = speed * direction_;
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

  void pre_step(Phase, World& world, const StepInfo& info) override {
    around_.look(world);
    if (!field_) push(info);
    blow(info);
  }

  void reset() override { to_rotors_->clear(); }

 private:
  void read_gust(const PluginParams& params) {
    gust_start_ = SimTime::from_seconds(params.number("windGustStart", 10.0, {0.0, 1e9}));
    gust_end_ =
        gust_start_ + SimTime::from_seconds(params.number("windGustDuration", 0.0, {0.0, 1e9}));
    gust_force_mean_n_ = params.number("windGustForceMean", 0.0);
    gust_direction_ =
        read_direction(params, "windGustDirection", Eigen::Vector3d::UnitY(), gust_force_mean_n_);
  }

  void push(const StepInfo& info) {
    Eigen::Vector3d force = force_mean_n_ * direction_;
    if (info.end >= gust_start_ && info.end < gust_end_)
      force += gust_force_mean_n_ * gust_direction_;
    if (link_.body != nullptr && !force.isZero()) {
      link_.body->add_force_at(force, link_.T_world_link() * offset_);
    }
    if (!force_->wanted()) return;
    force_->value.stamp = info.end;
    force_->value.force = force;
    force_->publish();
  }

  void blow(const StepInfo& info) {
    speed_->value.stamp = info.end;
    speed_->value.v_world = wind_world_;
    const bool is_worlds = !field_ && wind_world_.isZero() && around_.air() != nullptr;
    if (field_) {
      speed_->value.v_world = wind_at(*field_, link_.T_world_link().p).value_or(wind_world_);
    } else if (is_worlds) {
      speed_->value.v_world = around_.air()->wind(link_.T_world_link().p);
    }
    // A constant wind is written once, so that a later writer to the port is heard.
    if (field_ || is_worlds || to_rotors_->count() == 0) to_rotors_->write(speed_->value);
    if (speed_->wanted()) speed_->publish();
  }

  Link& link_;
  std::optional<WindGrid> field_;
  Eigen::Vector3d offset_, direction_, wind_world_;
  Eigen::Vector3d gust_direction_ = Eigen::Vector3d::UnitY();
  double force_mean_n_ = 0.0, gust_force_mean_n_ = 0.0;
  SimTime gust_start_, gust_end_;
  Surroundings around_;
  OutHandle<WrenchSample> force_;
  OutHandle<WindSample> speed_;
  InHandle<WindSample> to_rotors_;
};

const PluginRegistrar kRotorsGazeboWindPlugin(
    "librotors_gazebo_wind_plugin.so", factory_of<WindPlugin>(),
    PluginExample{"<linkName>base_link</linkName><windForceMean>2</windForceMean>"
                  "<windGustStart>0.05</windGustStart><windGustDuration>0.05</windGustDuration>"
                  "<windGustForceMean>3</windGustForceMean>",
                  {"linkName"},
                  {"windForceMean", "windGustStart", "windGustDuration", "windGustForceMean",
                   "windSpeedMean", "xyzOffset", "windDirection"}});

}  // namespace

}  // namespace trident::sim
