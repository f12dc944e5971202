// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// A sensor and the message that it sends, by public headers alone.
#include <radiation_survey/Radiation.h>
#include <trident_sim/plugin_registry.h>
#include <trident_sim/port.h>
#include <trident_sim/world.h>
#include <trident_sim_ros/output_topic.h>

#include <memory>
#include <vector>

namespace radiation_survey {

struct RadiationSample {
  trident::SimTime stamp;
  double rate = 0.0;  ///< [1/s]
};

void convert(const RadiationSample& sample, Radiation& message) {
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(sample.stamp.ns));
  message.counts_per_second = sample.rate;
}

namespace {

const trident::sim::OutputTopicRegistrar<RadiationSample, Radiation> kRadiationTopic;

/// A point source at the origin: the rate falls with the square of the distance.
class RadiationCounter : public trident::sim::Plugin {
 public:
  explicit RadiationCounter(const trident::sim::PluginContext& context)
      : link_(*context.model->find_link(context.params.required_text("linkName"))),
        rate_at_1m_(context.params.number("rateAt1m", 100.0, {0.0, 1e9})),
        output_({context.world.ports(), context.world.ports().advertise<RadiationSample>(
                                            "radiation", trident::sim::PortRank::kSensor)}) {}

  std::vector<trident::sim::Phase> phases() const override { return {trident::sim::Phase::kPost}; }
  void post_step(const trident::sim::World&, const trident::sim::StepInfo& info) override {
    output_->value = {info.end, rate_at_1m_ / link_.p_world_com().squaredNorm()};
    output_->publish();
  }

 private:
  trident::sim::Link& link_;
  double rate_at_1m_;
  trident::sim::OutHandle<RadiationSample> output_;
};

}  // namespace
}  // namespace radiation_survey

extern "C" void trident_register_plugins(trident::sim::PluginRegistry& registry) {
  registry.add("libradiation_counter.so",
               {[](const trident::sim::PluginContext& context) {
                  return std::make_unique<radiation_survey::RadiationCounter>(context);
                },
                {}});
}
