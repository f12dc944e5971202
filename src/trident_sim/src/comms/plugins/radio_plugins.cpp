// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "comms/phy/vht.h"
#include "comms/plugins/link_reporter.h"
#include "comms/plugins/radio_medium.h"
#include "comms/plugins/radio_packet_code.h"
#include "comms/plugins/relay_ports.h"
#include "comms/relay/relay_rules.h"
#include "core/plugins/plugin_util.h"
#include "core/plugins/report_throttle.h"
#include "core/plugins/sample_clock.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_sim/plugin_registry.h"

namespace trident::sim {
namespace {

/// One of a few words. Throws Error.
template <class Choice>
Choice choice(const PluginParams& params, const std::string& key, Choice fallback,
              const std::vector<std::pair<std::string, Choice>>& known) {
  const auto usual = std::find_if(known.begin(), known.end(),
                                  [fallback](const auto& k) { return k.second == fallback; });
  const std::string text = params.text(key, usual->first);
  std::vector<std::string> names;
  for (const auto& [name, value] : known) {
    if (name == text) return value;
    names.push_back(name);
  }
  params.refuse(key, text, join(names, " or "));
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

/// Adaptive, or a number that is a mode at this width.
int read_rate(const PluginParams& params, int fallback, int width_mhz) {
  const std::string text =
      params.text("rate", fallback < 0 ? "adaptive" : std::to_string(fallback));
  if (text == "adaptive") return -1;
  const auto mcs = number_from_text(text);
  const bool is_whole = mcs && *mcs == static_cast<int>(*mcs);
  if (!is_whole || !vht::is_mode(static_cast<int>(*mcs), width_mhz)) {
    params.refuse("rate", text,
                  width_mhz == 20 ? "adaptive or an MCS, 0 to 8" : "adaptive or an MCS, 0 to 9");
  }
  return static_cast<int>(*mcs);
}

/// What is not among the elements stays.
void read_radio(const PluginParams& params, RadioParams* radio) {
  params.text("standard", "802.11ac");
  radio->channel = params.integer("channel", radio->channel, {36, 177});
  radio->width_mhz =
      choice(params, "width", radio->width_mhz, {{"20", 20}, {"40", 40}, {"80", 80}});
  radio->tx_power_dbm = params.number("tx_power", radio->tx_power_dbm, {-30, 40});
  radio->noise_figure_db = params.number("noise_figure", radio->noise_figure_db, {0, 30});
  radio->carrier_sense_dbm = params.number("carrier_sense", radio->carrier_sense_dbm, {-100, -30});
  radio->mcs = read_rate(params, radio->mcs, radio->width_mhz);
  radio->has_short_guard =
      choice(params, "guard", radio->has_short_guard, {{"long", false}, {"short", true}});
  radio->max_ampdu_bytes = static_cast<std::size_t>(
      params.integer("max_ampdu", static_cast<int>(radio->max_ampdu_bytes), {0, 1048575}));
  radio->broadcast_mbit_s =
      choice(params, "broadcast_rate", radio->broadcast_mbit_s, {{"6", 6}, {"12", 12}, {"24", 24}});
  radio->tries = params.integer("tries", radio->tries, {1, 255});
  radio->queue_bytes = static_cast<std::size_t>(
      params.integer("queue_bytes", static_cast<int>(radio->queue_bytes), {2000, 1e9}));
  radio->is_base_station = params.flag("base_station", radio->is_base_station);
  const double processing_s = 1e-9 * static_cast<double>(radio->processing_ns);
  radio->processing_ns =
      SimTime::from_seconds(params.number("processing", processing_s, {0.0, 1.0})).ns;
}

/// What is not among the elements stays.
void read_end(const PluginParams& params, RadioEnd* end) {
  read_radio(params, &end->params);
  end->pattern =
      choice(params, "antenna", end->pattern,
             {{"isotropic", AntennaPattern::kIsotropic}, {"dipole", AntennaPattern::kDipole}});
  end->gain_dbi = params.number("gain", end->gain_dbi, {-30, 40});
  const double before_m = end->height_m;
  end->height_m = params.number("height", before_m, {-10, 100});
  end->T_link_antenna.p.z() += end->height_m - before_m;
}

/// The robot's namespace without outer slashes; of one without a namespace the model's name.
std::string name_of(const PluginParams& params, const std::string& model) {
  const std::string text = params.text("robotNamespace", model);
  const std::size_t first = text.find_first_not_of('/');
  if (first == std::string::npos) return model;
  return text.substr(first, text.find_last_not_of('/') - first + 1);
}

std::vector<RadioOutage> read_outages(const PluginParams& params) {
  const std::string text = params.text("outages", "");
  const std::vector<std::string> parts = words(text);
  std::vector<RadioOutage> outages;
  const char* const kExpected = "pairs of times [s], each begin before its end";
  if (parts.size() % 2 != 0) params.refuse("outages", text, kExpected);
  for (std::size_t i = 0; i < parts.size(); i += 2) {
    const auto begin = number_from_text(parts[i]), end = number_from_text(parts[i + 1]);
    if (!begin || !end || !(*begin <= *end)) params.refuse("outages", text, kExpected);
    outages.push_back({*begin, *end});
  }
  return outages;
}

double read_status_rate(const PluginContext& context) {
  return context.params.number("status_rate", 2.0, {0.01, 1000.0});
}

/// libtrident_radio.so: an IEEE 802.11ac radio of a robot, or of a static model such as a mast. It
/// has the name of the robot, <robotNamespace>. Its antenna sits <height> above the origin of
/// <linkName> (the model's first link) along its z, at <xyzOffset>. Radios of one <channel> hear
/// each other as far as the world's libtrident_radio_medium.so lets them. <name>/radio/send and
/// <name>/radio/receive carry packets, <name>/link_status its links at <status_rate> [Hz].
class RadioPlugin : public Plugin {
 public:
  explicit RadioPlugin(const PluginContext& context)
      : world_(context.world), owner_(context.params.owner()), clock_(read_status_rate(context)) {
    const PluginParams& params = context.params;
    auto end = std::make_shared<RadioEnd>();
    end->name = name_of(params, context.model->name);
    end->model = context.model;
    end->link = &find_link(context);
    end->T_link_antenna.p = params.vector3("xyzOffset", Eigen::Vector3d::Zero());
    end->T_link_antenna.p.z() += end->height_m;
    read_end(params, end.get());
    end->outages = read_outages(params);
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
    const std::uint64_t kept = std::max(to_send_->oldest(), seen_);
    if (kept > seen_) report(std::to_string(kept - seen_) + " packets came in one step too many");
    for (seen_ = kept; seen_ < to_send_->count(); ++seen_) send(*radio, to_send_->at(seen_));
  }

  void post_step(const World&, const StepInfo& info) override {
    const auto radio = find_radio(world_);
    if (radio == nullptr) return;
    if (received_->wanted()) publish_received(*radio);
    if (!clock_.is_due(info) || !status_->wanted()) return;
    reporter_.report(radio->links(name()), find_relay(world_).get(), info.end, &status_->value);
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

void read_obstacles(const PluginParams& params, ObstacleParams* obstacles) {
  obstacles->penetration_db = params.number("penetration_db", obstacles->penetration_db, {0, 200});
  const std::string text = params.text("materials", "");
  if (!params.has("materials")) return;
  const std::vector<std::string> parts = words(text);
  const char* const kExpected = "pairs of a part of a collision's name and a loss, 0 to 200 [dB]";
  if (parts.size() % 2 != 0) params.refuse("materials", text, kExpected);
  obstacles->materials.clear();
  for (std::size_t i = 0; i < parts.size(); i += 2) {
    const auto loss_db = number_from_text(parts[i + 1]);
    if (!loss_db || !(*loss_db >= 0.0 && *loss_db <= 200.0)) {
      params.refuse("materials", text, kExpected);
    }
    obstacles->materials.emplace_back(parts[i], *loss_db);
  }
}

/// What is not among the elements stays.
void read_path_loss(const PluginParams& params, PathLossParams* path) {
  path->model = choice(params, "path", path->model,
                       {{"two_ray", PathModel::kTwoRay},
                        {"log_distance", PathModel::kLogDistance},
                        {"free_space", PathModel::kFreeSpace}});
  path->exponent = params.number("exponent", path->exponent, {1, 6});
  path->shadowing.stddev_db = params.number("shadowing_sigma", path->shadowing.stddev_db, {0, 20});
  path->shadowing.decorrelation_m =
      params.number("decorrelation_distance", path->shadowing.decorrelation_m, {1, 1000});
  read_obstacles(params, &path->obstacles);
  path->polarization =
      choice(params, "polarization", path->polarization,
             {{"vertical", Polarization::kVertical}, {"horizontal", Polarization::kHorizontal}});
  path->water.relative_permittivity =
      params.number("permittivity", path->water.relative_permittivity, {1, 100});
  path->water.conductivity_s_m =
      params.number("conductivity", path->water.conductivity_s_m, {0, 10});
}

void read_outage_regions(const PluginParams& params, std::vector<OutageRegion>* regions) {
  const std::string text = params.text("outage_regions", "");
  if (!params.has("outage_regions")) return;
  const std::vector<std::string> parts = words(text);
  const char* const kExpected = "x, y and radius of each [m], the radius not negative";
  if (parts.size() % 3 != 0) params.refuse("outage_regions", text, kExpected);
  regions->clear();
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    const auto x = number_from_text(parts[i]), y = number_from_text(parts[i + 1]);
    const auto radius = number_from_text(parts[i + 2]);
    const bool is_legal = x && y && radius && std::isfinite(*x + *y + *radius) && *radius >= 0.0;
    if (!is_legal) params.refuse("outage_regions", text, kExpected);
    regions->push_back({{*x, *y}, *radius});
  }
}

/// What the elements of a medium say.
struct Air {
  PathLossParams path;
  std::vector<OutageRegion> outage_regions;
  double status_rate_hz = 2.0;
};

/// What is not among the elements stays.
void read_air(const PluginParams& params, Air* air) {
  read_path_loss(params, &air->path);
  read_outage_regions(params, &air->outage_regions);
  air->status_rate_hz = params.number("status_rate", air->status_rate_hz, {0.01, 1000.0});
}

ParamNode elements(const std::map<std::string, std::string>& texts) {
  ParamNode node;
  for (const auto& [name, text] : texts) node.children.push_back({name, text, {}, {}});
  return node;
}

/// Throws Error for a key of a file that no element has.
void refuse_unread(const PluginParams& params) {
  const std::vector<std::string> unread = params.unread();
  if (unread.empty()) return;
  std::vector<std::string> known;
  for (const auto& [name, query] : params.queries()) known.push_back(name);
  throw Error(params.owner() + ": " + unknown_name_text(unread.front(), known));
}

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
    Air air;
    read_air(context.params, &air);
    const RelayFile file = read_rules(context);
    const ParamNode model = elements(file.model);
    const PluginParams of_file(model, rules_file_ + ": model");
    read_air(of_file, &air);
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
  }

  std::vector<Phase> phases() const override { return {Phase::kSense, Phase::kPost}; }
  void models_changed() override {
    if (relay_ != nullptr) relay_->set_robots(medium_->names());
  }
  void pre_step(Phase, World&, const StepInfo& info) override {
    if (relay_ != nullptr) relay_->send(info.begin, *medium_);
  }
  void post_step(const World&, const StepInfo& info) override {
    medium_->step(info);
    if (relay_ != nullptr) relay_->receive(info.end, *medium_);
    if (!clock_.is_due(info) || !links_->wanted()) return;
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
    const auto node = std::make_shared<ParamNode>(elements(file.radio));
    const std::string owner = rules_file_ + ": radio";
    const auto change = [node, owner](RadioEnd* end) {
      const PluginParams params(*node, owner);
      read_end(params, end);
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

const PluginRegistrar kRadio("libtrident_radio.so", factory_of<RadioPlugin>());
const PluginRegistrar kRadioMedium("libtrident_radio_medium.so", factory_of<RadioMediumPlugin>());

}  // namespace
}  // namespace trident::sim
