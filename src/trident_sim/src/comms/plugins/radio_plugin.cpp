// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>

#include "comms/plugins/link_reporter.h"
#include "comms/plugins/radio_packet_code.h"
#include "comms/plugins/radio_params.h"
#include "core/plugins/plugin_util.h"
#include "core/plugins/report_throttle.h"
#include "trident_base/error.h"
#include "trident_sim/comms/relay.h"
#include "trident_sim/plugin_registry.h"
#include "trident_sim/sample_clock.h"

namespace trident::sim {
namespace {

/// libtrident_radio.so: an IEEE 802.11ac radio of a robot, or of a static model such as a mast. It
/// has the name of the robot, <robotNamespace>. Its antenna sits <height> above the origin of
/// <linkName> (the model's first link) along its z, at <xyzOffset>. Radios of one <channel> hear
/// each other as far as the world's libtrident_radio_medium.so lets them. <name>/radio/send and
/// <name>/radio/receive carry packets, <name>/link_status its links at <status_rate> [Hz].
class RadioPlugin : public Plugin {
 public:
  explicit RadioPlugin(const PluginContext& context)
      : world_(context.world),
        owner_(context.params.owner()),
        clock_(read_status_rate_hz(context.params)) {
    const PluginParams& params = context.params;
    auto end = std::make_shared<RadioEnd>();
    end->name = radio_name(params, context.model->name);
    end->model = context.model;
    end->link = &find_link(context);
    end->T_link_antenna.p = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
    end->T_link_antenna.p.z() += end->height_m;
    read_radio_end(params, end.get());
    end->outages = read_outages(params);
    // That name is the destination of broadcasts.
    if (end->name == Radio::kAll) params.refuse("robotNamespace", end->name, "another name");
    end_ = advertise<RadioEndSample>(context, end->name + "/radio", PortRank::kState);
    const std::string name = end->name;
    end_->value.end = std::move(end);
    to_send_ = subscribe<RadioPacketSample>(context, name + "/radio/send");
    received_ = advertise<RadioPacketSample>(context, name + "/radio/receive", PortRank::kSensor);
    status_ = advertise<LinkStatusArraySample>(context, name + "/link_status", PortRank::kState);
  }

  std::vector<Phase> phases() const override { return {Phase::kSense, Phase::kPost}; }

  void pre_step(Phase, World&, const StepInfo&) override {
    const auto radio = find_radio(world_);
    if (radio == nullptr) return report_no_air();
    if (to_send_->count() == seen_) return;
    // A port keeps its newest values only; packets that it has dropped are reported.
    const std::uint64_t kept = std::max(to_send_->oldest(), seen_);
    if (kept > seen_) report(std::to_string(kept - seen_) + " packets came in one step too many");
    for (seen_ = kept; seen_ < to_send_->count(); ++seen_) send(*radio, to_send_->at(seen_));
  }

  void post_step(const World&, const StepInfo& info) override {
    const auto radio = find_radio(world_);
    if (radio == nullptr) return;
    if (received_->wanted()) publish_received(*radio);
    if (!clock_.is_due(info) || !status_->wanted()) return;
    const auto relay = find_relay(world_);
    reporter_.report(radio->links(name()), relay.get(), info.end, &status_->value);
    report_heard(relay.get());
    status_->publish();
  }

  void reset() override {
    to_send_->clear();
    seen_ = 0;
    reporter_.clear();
    refused_ = ReportThrottle();
  }
  void state(StateArchive& archive) override {
    archive(seen_);
    reporter_.state(archive);
  }

 private:
  static Link& find_link(const PluginContext& context) {
    if (context.params.has("linkName")) return required_link(context, "linkName");
    if (context.link != nullptr) return *context.link;
    Link* const first = context.model->canonical_link();
    if (first == nullptr) context.params.refuse("linkName", "", "a link of the model");
    return *first;
  }

  const std::string& name() const { return end_->value.end->name; }

  void report_no_air() {
    if (has_reported_) return;
    has_reported_ = true;
    world_.report(Severity::kWarning, owner_ + ": the world has no air for radios, nobody hears '" +
                                          name() +
                                          "'; libtrident_radio_medium.so in the world makes it");
  }

  void report(const std::string& what) {
    if (!refused_.is_due()) return;
    world_.report(Severity::kWarning, owner_ + ": " + name() + "/radio/send: " + what);
  }

  void send(Radio& radio, const RadioPacketSample& packet) {
    try {
      const std::string to = packet.destination.empty() ? Radio::kAll : packet.destination;
      radio.send(name(), to, encode_packet(packet), {packet.priority, packet.deadline_s});
    } catch (const Error& error) {
      report(error.what());
    }
  }

  void report_heard(const RelayReport* relay) {
    status_->value.heard.clear();
    if (relay == nullptr) return;
    for (const auto& [topic, messages] : relay->heard(name())) {
      status_->value.heard.push_back({topic, messages});
    }
  }

  void publish_received(Radio& radio) {
    bool is_first = true;
    for (const RadioMessage& message : radio.receive(name())) {
      if (is_first) {
        received_->clear_buffered();
      } else {
        received_->buffer_sample();
      }
      is_first = false;
      RadioPacketSample& packet = received_->value;
      packet.stamp = message.received;
      packet.source = message.source;
      packet.destination = name();
      decode_packet(message.data, &packet);
    }
    if (!is_first) received_->publish();
  }

  World& world_;
  std::string owner_;
  bool has_reported_ = false;
  SampleClock clock_;
  OutHandle<RadioEndSample> end_;
  InHandle<RadioPacketSample> to_send_;
  OutHandle<RadioPacketSample> received_;
  OutHandle<LinkStatusArraySample> status_;
  std::uint64_t seen_ = 0;
  LinkReporter reporter_;
  ReportThrottle refused_;
};

const PluginRegistrar kRadio("libtrident_radio.so", factory_of<RadioPlugin>());

}  // namespace
}  // namespace trident::sim
