// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <vector>

#include "core/plugins/plugin_util.h"
#include "marine/environment/wind_gusts.h"
#include "marine/vessel/vessel_dynamics.h"
#include "trident_base/angle.h"
#include "trident_base/string_util.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"
#include "trident_sim/samples/text_sample.h"
#include "trident_sim/sea.h"

namespace trident::sim {
namespace {

/// A wind that varies in strength only, the same everywhere.
class VaryingWind : public Air {
 public:
  VaryingWind(double direction_rad, double mean_m_s, const FirstOrderGusts& gusts)
      : along_(std::cos(direction_rad), std::sin(direction_rad), 0.0),
        mean_m_s_(mean_m_s),
        gusts(gusts) {}
  double speed_m_s() const { return mean_m_s_ + gusts.gust(); }
  Eigen::Vector3d wind(const Eigen::Vector3d&) const override { return speed_m_s() * along_; }
  std::string state_text() const override { return number_text(speed_m_s()); }

 private:
  Eigen::Vector3d along_;
  double mean_m_s_;

 public:
  FirstOrderGusts gusts;
};

/// VRX' <wind_obj>: a link that may come later.
struct WindObject {
  std::string model, link_name;
  Eigen::Vector3d coefficients;
  Link* link = nullptr;
};

WindObject read_object(const PluginParams& params) {
  WindObject object;
  object.model = params.required_text(params.has("model_name") ? "model_name" : "name");
  object.link_name = params.required_text("link_name");
  object.coefficients = params.vector3("coeff_vector", Eigen::Vector3d::Zero());
  if (object.coefficients.minCoeff() < 0.0) {
    params.refuse("coeff_vector", params.text("coeff_vector", ""), "three numbers >= 0");
  }
  return object;
}

/// libusv_gazebo_wind_plugin.so, a world's plugin: VRX' wind towards <wind_direction> [deg] with
/// <wind_mean_velocity> [m/s] and first-order gusts of the standard deviation
/// <var_wind_gain_constants> [m/s] and the time constant <var_wind_time_constants> [s] on the links
/// of each <wind_obj> (name, link_name, coeff_vector), published at <update_rate> [Hz] on
/// <topic_wind_speed> [m/s] and <topic_wind_direction> [deg]. It pushes by the apparent wind; VRX
/// takes the wind over ground, as <legacy_vrx> true does. <random_seed> 0 is the world's seed.
/// Where no environment gives the world's wind it is this one, for aircraft and anemometers too.
class UsvWind : public Plugin {
 public:
  explicit UsvWind(const PluginContext& context)
      : owner_(context.params.owner()),
        is_over_ground_(context.params.flag("legacy_vrx", false)),
        clock_(context.params.number("update_rate", 10.0, {0.0, 1e4})) {
    const PluginParams& params = context.params;
    for (std::size_t number = 1;; ++number) {
      const std::string key = "wind_obj[" + std::to_string(number) + "]";
      if (!params.has(key)) break;
      objects_.push_back(read_object(params.below(key)));
    }
    direction_deg_ = params.number("wind_direction", 0.0, {-720.0, 720.0});
    air_ = make_air(context);
    if (context.world.ports().find(kAirPort, PortDirection::kOut) == nullptr) {
      port_ = advertise<AirSample>(context, kAirPort, PortRank::kState);
      port_->value.air = air_;
    } else {
      context.world.report(Severity::kWarning,
                           owner_ +
                               ": an environment gives the world's wind already; this one "
                               "blows on its <wind_obj> alone");
    }
    speed_ = advertise_on(context, "topic_wind_speed", "/vrx/debug/wind/speed");
    direction_ = advertise_on(context, "topic_wind_direction", "/vrx/debug/wind/direction");
  }

  std::vector<Phase> phases() const override { return {Phase::kSense, Phase::kActuate}; }

  void pre_step(Phase phase, World& world, const StepInfo& info) override {
    if (phase == Phase::kActuate) return push(world);
    if (info.dt_s != dt_s_) change_step(world, info.dt_s);
    air_->gusts.step();
    if (!clock_.is_due(info)) return;
    write(speed_, info.end, air_->speed_m_s());
    write(direction_, info.end, direction_deg_);
  }

  void reset() override { air_->gusts.reset(); }
  void state(StateArchive& archive) override { air_->gusts.state(archive); }

 private:
  static OutHandle<NumberSample> advertise_on(const PluginContext& context, const char* key,
                                              const char* fallback) {
    return advertise<NumberSample>(context,
                                   scoped_topic(context.params, context.params.text(key, fallback)),
                                   PortRank::kState);
  }
  static void write(OutHandle<NumberSample>& port, SimTime stamp, double value) {
    if (!port->wanted()) return;
    port->value = {stamp, value};
    port->publish();
  }

  std::shared_ptr<VaryingWind> make_air(const PluginContext& context) {
    const PluginParams& params = context.params;
    gust_ = {params.number("var_wind_gain_constants", 0.0, {0.0, 100.0}),
             params.number("var_wind_time_constants", 1.0, {1e-6, 1e6})};
    const int seed = params.integer("random_seed", 0, {0.0, 2147483647.0});
    seed_ = seed != 0 ? static_cast<std::uint64_t>(seed) : context.world.seed();
    name_ = context.name;
    dt_s_ = context.world.dt().seconds();
    return std::make_shared<VaryingWind>(deg_to_rad(direction_deg_),
                                         params.number("wind_mean_velocity", 0.0, {0.0, 100.0}),
                                         FirstOrderGusts(gust_, dt_s_, seed_, name_));
  }

  void change_step(const World&, double dt_s) {
    dt_s_ = dt_s;
    FirstOrderGusts gusts(gust_, dt_s_, seed_, name_);
    gusts.continue_from(air_->gusts);
    air_->gusts = gusts;
  }

  void find_links(World& world) {
    // Models may be spawned, deleted and spawned again while the wind blows.
    if (world.models_version() == models_version_) return;
    models_version_ = world.models_version();
    for (WindObject& object : objects_) {
      const Model* const model = world.find_model(object.model);
      object.link = model != nullptr ? model->find_link(object.link_name) : nullptr;
      if (model == nullptr || object.link != nullptr) continue;
      world.diagnose({Severity::kError, owner_, "no such link",
                      "<wind_obj> names link '" + object.link_name + "', which model '" +
                          object.model + "' does not have; no wind blows on it"});
    }
  }

  void push(World& world) {
    find_links(world);
    for (const WindObject& object : objects_) {
      if (object.link == nullptr || object.link->body == nullptr) continue;
      Body& body = *object.link->body;
      const SE3 T_world_link = object.link->T_world_link();
      const Eigen::Vector3d p_com = object.link->p_world_com();
      Eigen::Vector3d wind = air_->wind(p_com);
      // The apparent wind at the center of mass.
      if (!is_over_ground_) wind -= body.velocity_at(p_com);
      const Vector6d wrench = wind_wrench(object.coefficients, T_world_link.R.conjugate() * wind);
      body.add_force_at(T_world_link.R * wrench.head<3>(), p_com);
      body.apply_torque(T_world_link.R * wrench.tail<3>());
    }
  }

  std::string owner_, name_;
  bool is_over_ground_;
  SampleClock clock_;
  std::vector<WindObject> objects_;
  double direction_deg_ = 0.0, dt_s_ = 0.0;
  FirstOrderGustParams gust_;
  std::uint64_t seed_ = 0;
  std::uint64_t models_version_ = ~std::uint64_t{0};
  std::shared_ptr<VaryingWind> air_;
  OutHandle<AirSample> port_;
  OutHandle<NumberSample> speed_, direction_;
};

const PluginRegistrar kUsvGazeboWindPlugin("libusv_gazebo_wind_plugin.so", factory_of<UsvWind>());

}  // namespace

}  // namespace trident::sim
