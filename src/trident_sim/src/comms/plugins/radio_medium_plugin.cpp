// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>

#include "comms/plugins/link_reporter.h"
#include "comms/plugins/radio_medium.h"
#include "comms/plugins/radio_params.h"
#include "comms/plugins/relay_ports.h"
#include "comms/relay/relay_rules.h"
#include "core/plugins/plugin_util.h"
#include "trident_base/error.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// libtrident_radio_medium.so, a world's plugin: the air between the radios (libtrident_radio.so).
/// <path> two_ray: free space, with the reflection of the sea where there is one; log_distance,
/// with <exponent>; free_space. <shadowing_sigma> [dB] over <decorrelation_distance> [m].
/// <penetration_db> for each shape in the path, or by <materials>, and diffraction around it. In
/// <outage_regions>, circles, no radio works. All links on radio/links at <status_rate> [Hz].
/// <rules>, a file of config/links, says which topics cross, and what of the above and of the
/// radios is otherwise.
class RadioMediumPlugin : public Plugin {
 public:
  explicit RadioMediumPlugin(const PluginContext& context) {
    World& world = context.world;
    if (context.model != nullptr) {
      throw Error(context.params.owner() + ": is of a model, legal: of a world");
    }
    if (world.ports().find(kRadioPort, PortDirection::kOut) != nullptr) {
      throw Error(context.params.owner() + ": the world has air for radios already, legal is one");
    }
    RadioAir air;
    read_radio_air(context.params, &air);
    const RelayFile file = read_rules(context);
    const ParamNode model = as_elements(file.model);
    const PluginParams of_file(model, rules_file_ + ": model");
    read_radio_air(of_file, &air);
    refuse_unread(of_file);
    clock_ = SampleClock(air.status_rate_hz);
    medium_ = std::make_shared<RadioMedium>(world, air.path, air.outage_regions);
    override_radios(file);
    radio_ = advertise<RadioSample>(context, kRadioPort, PortRank::kState);
    radio_->value.radio = medium_;
    links_ = advertise<LinkStatusArraySample>(context, "radio/links", PortRank::kState);
    if (file.rules.empty()) return;
    relay_ = std::make_shared<RelayPorts>(world, file, rules_file_);
    radio_->value.relay = relay_;
    radio_->value.services = relay_;
  }

  std::vector<Phase> phases() const override {
    if (relay_ != nullptr) return {Phase::kSense, Phase::kPost};
    // A world is asked again when models come or go.
    if (!medium_->has_radios()) return {};
    return {Phase::kPost};
  }
  void models_changed() override {
    if (relay_ != nullptr) relay_->set_robots(medium_->names());
  }
  void pre_step(Phase, World&, const StepInfo& info) override {
    relay_->send(info.begin, *medium_);
  }
  void post_step(const World&, const StepInfo& info) override {
    medium_->step(info);
    if (relay_ != nullptr) relay_->receive(info.end, *medium_);
    if (!links_->wanted() || !clock_.is_due(info)) return;
    reporter_.report(medium_->links(""), relay_.get(), info.end, &links_->value);
    links_->publish();
  }
  void reset() override {
    medium_->reset();
    if (relay_ != nullptr) relay_->reset();
    reporter_.clear();
  }
  void state(StateArchive& archive) override {
    medium_->state(archive);
    if (relay_ != nullptr) relay_->state(archive);
    reporter_.state(archive);
  }

 private:
  RelayFile read_rules(const PluginContext& context) {
    const std::string file = context.params.text("rules", "");
    if (file.empty()) return {};
    rules_file_ = context.world.resources().find(file);
    if (rules_file_.empty()) context.params.refuse("rules", file, "an existing file");
    return load_relay_file(rules_file_);
  }

  void override_radios(const RelayFile& file) {
    if (file.radio.empty()) return;
    const auto node = std::make_shared<ParamNode>(as_elements(file.radio));
    const std::string owner = rules_file_ + ": radio";
    const auto change = [node, owner](RadioEnd* end) {
      const PluginParams params(*node, owner);
      read_radio_end(params, end);
      refuse_unread(params);
    };
    RadioEnd probe;
    change(&probe);
    medium_->set_override(change);
  }

  std::string rules_file_;
  SampleClock clock_{0.0};
  std::shared_ptr<RadioMedium> medium_;
  std::shared_ptr<RelayPorts> relay_;  ///< nullptr: nothing crosses by rules
  OutHandle<RadioSample> radio_;
  OutHandle<LinkStatusArraySample> links_;
  LinkReporter reporter_;
};

const PluginRegistrar kRadioMedium("libtrident_radio_medium.so", factory_of<RadioMediumPlugin>());

}  // namespace
}  // namespace trident::sim
