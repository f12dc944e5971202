// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/sea.h"

#include <algorithm>

#include "core/plugins/report_throttle.h"
#include "environment_reader.h"
#include "live_surroundings.h"
#include "terrain_depth.h"
#include "trident_base/config_writer.h"
#include "trident_base/string_util.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/samples/text_sample.h"
#include "vessel_body.h"

namespace trident::sim {
namespace {

constexpr Range kLevels{-1000.0, 9000.0};

/// freefloating_gazebo's <surface>, a point on still water. What it reads of a robot's description,
/// the <buoyancy> of links, is for libtrident_vessel.so to say.
EnvironmentParams read_freefloating(const PluginContext& context) {
  EnvironmentParams environment;
  environment.water_level = context.params.vector3("surface", Eigen::Vector3d::Zero()).z();
  for (const char* key : {"descriptionParam", "fluidTopic"}) context.params.node(key);
  context.world.report(Severity::kWarning,
                       context.params.owner() +
                           ": <buoyancy> of links has no effect; boats float by "
                           "libtrident_vessel.so, and the current is that of libtrident_sea.so");
  return environment;
}

/// libtrident_sea.so, libtrident_environment.so, a world's plugin: the sea, the wind and the ground
/// of the file <environment>, or of <tide>, <waves>, <current>, <wind>, <bathymetry> with the
/// file's keys as elements; <water_level> [m] comes before that of the file. Without any of them
/// the sea is flat and at rest, and the air still.
/// libWavefieldModelPlugin.so: VRX' waves, <wave>. As VRX' physics takes them: linear.
///
/// While the world runs it takes changes on the topics environment/tide, waves, current and wind,
/// each the keys to change as YAML, and environment/water_level [m]. A change acts in the step
/// that begins next; one that is not legal is refused whole. environment/state publishes what is.
class SeaPlugin : public Plugin {
 public:
  enum class HasAir { kYes, kNo };
  SeaPlugin(const PluginContext& context, const EnvironmentParams& params, HasAir has_air)
      : world_(context.world), owner_(context.params.owner()), file_(params), now_(params) {
    if (world_.ports().find(kSeaPort, PortDirection::kOut) != nullptr) {
      throw Error(owner_ + ": the world has a sea already, legal is one");
    }
    try {
      seabed_ = make_seabed(params.bathymetry, world_);
      dt_s_ = world_.dt().seconds();
      live_ = std::make_shared<LiveSurroundings>(make_environment(now_), make_wind(now_.wind));
    } catch (const Error& error) {
      throw Error(owner_ + ": " + error.what());
    }
    check_vessels();
    sea_ = advertise<SeaSample>(context, kSeaPort, PortRank::kState);
    sea_->value.sea = live_;
    for (const char* section : {"tide", "waves", "current"}) listen(context, section);
    if (has_air == HasAir::kYes) advertise_air(context);
    level_ = subscribe<ScalarSample>(context, "environment/water_level");
    state_ = advertise<EnvironmentSample>(context, "environment/state", PortRank::kState);
    publish_state();
  }

  /// First of all in a step, so that everybody reads the same sea.
  std::vector<Phase> phases() const override { return {Phase::kSense}; }

  void pre_step(Phase, World&, const StepInfo& info) override {
    take_commands();
    // The gusts' filters are discretized for a step; they continue from their present state.
    if (info.dt_s != dt_s_) {
      dt_s_ = info.dt_s;
      set_wind(now_.wind);
    }
    live_->blowing.step();
    if (!wind_speed_ || !wind_speed_->wanted()) return;
    wind_speed_->value.stamp = info.end;
    wind_speed_->value.v_world = live_->wind(Eigen::Vector3d::Zero());
    wind_speed_->publish();
  }

  void reset() override {
    for (Input& input : inputs_) {
      input.port->clear();
      input.seen = 0;
      input.refused.newest.clear();
    }
    level_->clear();
    level_seen_ = 0;
    level_refused_.newest.clear();
    // What commands have changed in the last run is undone.
    if (live_->text != to_yaml(file_)) {
      now_ = file_;
      live_->environment = make_environment(now_);
      live_->blowing = make_wind(now_.wind);
      publish_state();
    }
    live_->blowing.reset();
  }

  void state(StateArchive& archive) override {
    archive(now_, live_->environment, live_->blowing, live_->text, dt_s_, level_seen_);
    for (Input& input : inputs_) archive(input.seen);
  }

 private:
  struct Refused {
    std::string newest;  ///< is reported once, however often it comes
    ReportThrottle throttle;
  };
  struct Input {
    std::string section;
    InHandle<TextCommand> port;
    std::uint64_t seen = 0;
    Refused refused;
  };

  std::shared_ptr<const Environment> make_environment(const EnvironmentParams& params) const {
    return std::make_shared<const Environment>(params, world_.seed(), seabed_);
  }
  Wind make_wind(const WindParams& params) const {
    return {params, dt_s_, world_.seed(), "environment::wind"};
  }
  void set_wind(const WindParams& params) {
    Wind wind = make_wind(params);
    wind.continue_from(live_->blowing);
    live_->blowing = wind;
  }

  void listen(const PluginContext& context, const std::string& section) {
    inputs_.push_back({section, subscribe<TextCommand>(context, "environment/" + section), 0, {}});
  }

  /// One air: where another plugin gives it, this one's must not blow.
  void advertise_air(const PluginContext& context) {
    if (world_.ports().find(kAirPort, PortDirection::kOut) != nullptr) {
      if (!now_.wind.blows()) return;
      throw Error(owner_ + ": <wind>: another plugin gives the world's wind already, legal is one");
    }
    air_ = advertise<AirSample>(context, kAirPort, PortRank::kState);
    air_->value.air = live_;
    listen(context, "wind");
    wind_speed_ = advertise<WindSample>(context, "environment/wind_speed", PortRank::kState);
    wind_speed_->value.frame = "world";
  }

  /// Vessels of the world's file, which were made before the sea.
  void check_vessels() const {
    for (const auto& [name, model] : world_.models()) {
      for (const auto& plugin : model->plugins) {
        if (const auto* const vessel = dynamic_cast<const Floating*>(plugin.get())) {
          vessel->check_afloat(*live_);
        }
      }
    }
  }

  /// Both return whether the environment has changed.
  bool take_section_commands() {
    bool has_changed = false;
    for (Input& input : inputs_) {
      for (input.seen = std::max(input.seen, input.port->oldest());
           input.seen < input.port->count(); ++input.seen) {
        const std::string& text = input.port->at(input.seen).text;
        has_changed = attempt(input.port->name(), &input.refused, text,
                              [&] {
                                EnvironmentParams wanted = now_;
                                overlay(input.section, input.port->name(), text, &wanted);
                                put(wanted);
                              }) ||
                      has_changed;
      }
    }
    return has_changed;
  }

  bool take_level_commands() {
    bool has_changed = false;
    for (level_seen_ = std::max(level_seen_, level_->oldest()); level_seen_ < level_->count();
         ++level_seen_) {
      const double level = level_->at(level_seen_).value;
      has_changed = attempt(level_->name(), &level_refused_, number_text(level),
                            [&] {
                              if (!kLevels.contains(level)) {
                                throw Error(level_->name() + " is " + number_text(level) +
                                            ", legal is " + kLevels.text() + " m");
                              }
                              EnvironmentParams wanted = now_;
                              wanted.water_level = level;
                              put(wanted);
                            }) ||
                    has_changed;
    }
    return has_changed;
  }

  void take_commands() {
    const bool has_new_section = take_section_commands();
    const bool has_new_level = take_level_commands();
    if (has_new_section || has_new_level) publish_state();
  }

  static void overlay(const std::string& section, const std::string& topic, const std::string& text,
                      EnvironmentParams* wanted) {
    if (section == "tide") wanted->tide = overlay_yaml_string(text, topic, wanted->tide);
    if (section == "waves") wanted->waves = overlay_yaml_string(text, topic, wanted->waves);
    if (section == "current") wanted->current = overlay_yaml_string(text, topic, wanted->current);
    if (section == "wind") wanted->wind = overlay_yaml_string(text, topic, wanted->wind);
  }

  /// All of it or, when something throws Error, nothing.
  void put(EnvironmentParams wanted) {
    find_files(world_.resources(), "", &wanted);
    auto environment = make_environment(wanted);
    set_wind(wanted.wind);
    live_->environment = std::move(environment);
    now_ = std::move(wanted);
  }

  template <class Action>
  bool attempt(const std::string& topic, Refused* refused, const std::string& given,
               Action&& action) {
    try {
      action();
      refused->newest.clear();
      return true;
    } catch (const Error& error) {
      const std::string label = starts_with(error.what(), topic) ? "" : topic + ": ";
      const std::string what = label + error.what() + "; the sea stays as it was";
      world_.note({Severity::kError, owner_, topic + " refused", what, {{"value", given}}});
      if (what != refused->newest && refused->throttle.is_due()) {
        world_.report(Severity::kError, owner_ + ": " + what);
      }
      refused->newest = what;
      return false;
    }
  }

  void publish_state() {
    live_->text = to_yaml(now_);
    state_->value = {world_.time(), live_->text};
    state_->publish();
  }

  World& world_;
  std::string owner_;
  EnvironmentParams file_, now_;
  std::shared_ptr<const Seabed> seabed_;
  double dt_s_ = 0.0;
  std::shared_ptr<LiveSurroundings> live_;
  OutHandle<SeaSample> sea_;
  OutHandle<AirSample> air_;
  std::vector<Input> inputs_;
  InHandle<ScalarSample> level_;
  std::uint64_t level_seen_ = 0;
  Refused level_refused_;
  OutHandle<EnvironmentSample> state_;
  OutHandle<WindSample> wind_speed_;
};

std::unique_ptr<Plugin> make_sea(const PluginContext& context) {
  return std::make_unique<SeaPlugin>(context, read_environment(context), SeaPlugin::HasAir::kYes);
}

std::unique_ptr<Plugin> make_vrx_wave_field(const PluginContext& context) {
  return std::make_unique<SeaPlugin>(context, read_vrx_waves(context), SeaPlugin::HasAir::kNo);
}

std::unique_ptr<Plugin> make_freefloating_fluid(const PluginContext& context) {
  return std::make_unique<SeaPlugin>(context, read_freefloating(context), SeaPlugin::HasAir::kNo);
}

const PluginRegistrar kTridentSea("libtrident_sea.so", {make_sea, {}});
const PluginRegistrar kTridentEnvironment("libtrident_environment.so", {make_sea, {}});
const PluginRegistrar kWavefieldModelPlugin("libWavefieldModelPlugin.so",
                                            {make_vrx_wave_field, {}});
const PluginRegistrar kOldWavefieldModelPlugin("libwavefield_model_plugin.so",
                                               {make_vrx_wave_field, {}});
const PluginRegistrar kFreefloatingGazeboFluid("libfreefloating_gazebo_fluid.so",
                                               {make_freefloating_fluid, {}});

}  // namespace

std::shared_ptr<const Sea> find_sea(const World& world) {
  const auto* const port = world.ports().find_out<SeaSample>(kSeaPort);
  return port != nullptr ? port->value.sea : nullptr;
}

std::shared_ptr<const Air> find_air(const World& world) {
  const auto* const port = world.ports().find_out<AirSample>(kAirPort);
  return port != nullptr ? port->value.air : nullptr;
}

void Surroundings::look(const World& world) {
  if (world.ports().version() == ports_version_) return;
  ports_version_ = world.ports().version();
  sea_ = find_sea(world);
  air_ = find_air(world);
}

}  // namespace trident::sim
