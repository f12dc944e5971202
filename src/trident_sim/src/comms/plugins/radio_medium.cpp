// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/plugins/radio_medium.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "comms/phy/packet_error.h"
#include "comms/phy/vht.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_sim/comms/relay.h"

namespace trident::sim {
namespace {

constexpr int kMaxRadioPort = 65535;

void add_counts(const LinkCounts& counts, RadioLink* link) {
  link->sent = counts.sent;
  link->delivered = counts.delivered;
  link->lost = counts.lost;
  link->expired = counts.expired;
  link->refused = counts.refused;
  link->bytes = counts.bytes;
  link->delay_s = counts.delay_s;
  link->squared_delay_s2 = counts.squared_delay_s2;
  link->airtime_s = 1e-9 * static_cast<double>(counts.airtime_ns);
}

}  // namespace

std::shared_ptr<Radio> find_radio(const World& world) {
  const auto* port = world.ports().find_out<RadioSample>(kRadioPort);
  return port == nullptr ? nullptr : port->value.radio;
}

std::shared_ptr<const RelayReport> find_relay(const World& world) {
  const auto* port = world.ports().find_out<RadioSample>(kRadioPort);
  return port == nullptr ? nullptr : port->value.relay;
}

std::shared_ptr<RelayServices> find_relay_services(const World& world) {
  const auto* port = world.ports().find_out<RadioSample>(kRadioPort);
  return port == nullptr ? nullptr : port->value.services;
}

RadioMedium::RadioMedium(World& world, const PathLossParams& params,
                         std::vector<OutageRegion> regions)
    : world_(world),
      links_(world, params),
      outage_regions_(std::move(regions)),
      channel_(world.seed()) {}

bool RadioMedium::is_in_outage_region(int station) {
  if (outage_regions_.empty()) return false;
  const Eigen::Vector2d place = links_.position(station).head<2>();
  return std::any_of(outage_regions_.begin(), outage_regions_.end(),
                     [&place](const OutageRegion& region) {
                       return (place - region.center).norm() <= region.radius_m;
                     });
}

// Radios are found by their ports, so that robots may come and go without registering here.
std::map<std::string, std::shared_ptr<const RadioEnd>> RadioMedium::present_ends() const {
  std::map<std::string, std::shared_ptr<const RadioEnd>> present;
  world_.ports().for_each([&present](const PortBase& port) {
    const auto* end = dynamic_cast<const OutPort<RadioEndSample>*>(&port);
    if (end != nullptr) present[end->value.end->name] = end->value.end;
  });
  return present;
}

// Those that have come between two looks are numbered by their names: in which order robots are
// spawned before time zero is left to chance.
void RadioMedium::look() {
  if (world_.ports().version() == ports_version_) return;
  ports_version_ = world_.ports().version();
  auto present = present_ends();
  for (auto known = numbers_.begin(); known != numbers_.end();) {
    const auto found = present.find(known->first);
    // A model that was deleted and spawned under its old name is a new radio.
    const bool is_same = found != present.end() && found->second == own_[known->second];
    if (is_same) {
      present.erase(found);
      ++known;
      continue;
    }
    channel_.remove(known->second);
    own_.erase(known->second);
    inboxes_.erase(inboxes_.lower_bound({known->first, 0}),
                   inboxes_.upper_bound({known->first, kMaxRadioPort}));
    drop_outages_of(known->first);
    known = numbers_.erase(known);
  }
  for (const auto& [name, end] : present) add(end);
}

void RadioMedium::add(const std::shared_ptr<const RadioEnd>& end) {
  auto changed = std::make_shared<RadioEnd>(*end);
  if (override_) override_(changed.get());
  const int number = channel_.add(changed->name, changed->params);
  own_[number] = end;
  numbers_[changed->name] = number;
  links_.set_end(number, std::move(changed));
}

int RadioMedium::number(const std::string& name) {
  look();
  const auto known = numbers_.find(name);
  if (known != numbers_.end()) return known->second;
  throw Error("radio " + unknown_name_text(name, names()));
}

std::vector<std::string> RadioMedium::names() {
  std::vector<std::string> result;
  for (const auto& [name, end] : present_ends()) result.push_back(name);
  return result;
}

void RadioMedium::follow_outages(SimTime now) {
  now_ = now;
  const double time_s = now.seconds();
  for (const auto& [name, number] : numbers_) {
    const auto& planned = links_.end(number).outages;
    const bool is_planned =
        std::any_of(planned.begin(), planned.end(), [time_s](const RadioOutage& outage) {
          return time_s >= outage.begin_s && time_s < outage.end_s;
        });
    const auto commanded = out_until_.find(name);
    const bool is_commanded = commanded != out_until_.end() && now < commanded->second;
    // Outages by the plan of a file, by command and by place add up.
    channel_.set_out(number, is_planned || is_commanded || is_in_outage_region(number));
  }
}

// A link fails in both directions, so that a pair is kept under its names in order.
RadioMedium::Pair RadioMedium::pair_of(const std::string& a, const std::string& b) {
  return {std::min(a, b), std::max(a, b)};
}

bool RadioMedium::is_cut(int a, int b) const {
  if (cut_until_.empty()) return false;
  const auto cut = cut_until_.find(pair_of(links_.end(a).name, links_.end(b).name));
  return cut != cut_until_.end() && now_ < cut->second;
}

double RadioMedium::loss_db(int a, int b) { return is_cut(a, b) ? INFINITY : links_.loss_db(a, b); }

void RadioMedium::drop_outages_of(const std::string& name) {
  out_until_.erase(name);
  for (auto cut = cut_until_.begin(); cut != cut_until_.end();) {
    const bool is_its = cut->first.first == name || cut->first.second == name;
    cut = is_its ? cut_until_.erase(cut) : std::next(cut);
  }
}

void RadioMedium::step(const StepInfo& info) {
  look();
  // Losses are not worked out while nobody sends.
  if (channel_.is_idle()) return;
  links_.follow();
  follow_outages(info.begin);
  channel_.advance(info.end.ns, *this);
  take_deliveries();
}

void RadioMedium::take_deliveries() {
  for (RadioDelivery& delivery : channel_.take_deliveries()) {
    const RadioPacket& packet = delivery.packet;
    const std::string& receiver = channel_.station(delivery.receiver).name;
    dropped_ += inboxes_[{receiver, packet.port}].add({channel_.station(packet.source).name,
                                                       *packet.data, SimTime{packet.created_ns},
                                                       SimTime{delivery.time_ns}, delivery.snr_db});
  }
}

bool RadioMedium::send(const std::string& source, const std::string& destination, std::string data,
                       const RadioQos& qos) {
  RadioPacket packet;
  packet.source = number(source);
  packet.destination = destination == kAll ? kEverybody : number(destination);
  if (packet.source == packet.destination) {
    throw Error("radio '" + source + "': sends to itself, legal: another radio, or " + kAll);
  }
  if (data.size() > kMaxBytes) {
    throw Error("radio '" + source + "': a message has " + std::to_string(data.size()) +
                " bytes, legal: at most " + std::to_string(kMaxBytes));
  }
  if (qos.priority < 0 || qos.priority >= kRadioPriorities) {
    throw Error("radio '" + source + "': priority is " + std::to_string(qos.priority) +
                ", legal: 0 to " + std::to_string(kRadioPriorities - 1));
  }
  constexpr double kLongest_s = 1e6;
  if (!(qos.deadline_s >= 0.0 && qos.deadline_s <= kLongest_s)) {
    throw Error("radio '" + source + "': deadline is " + number_text(qos.deadline_s) +
                " s, legal: 0 (none) to " + number_text(kLongest_s));
  }
  if (qos.port < 0 || qos.port > kMaxRadioPort) {
    throw Error("radio '" + source + "': port is " + std::to_string(qos.port) + ", legal: 0 to " +
                std::to_string(kMaxRadioPort));
  }
  packet.port = qos.port;
  packet.history = qos.history;
  packet.priority = qos.priority;
  packet.created_ns = world_.time().ns;
  if (qos.deadline_s > 0.0) {
    packet.deadline_ns = packet.created_ns + SimTime::from_seconds(qos.deadline_s).ns;
  }
  packet.data = std::make_shared<const std::string>(std::move(data));
  return channel_.send(packet);
}

std::vector<RadioMessage> RadioMedium::receive(const std::string& name, int port) {
  number(name);
  const auto inbox = inboxes_.find({name, port});
  if (inbox == inboxes_.end()) return {};
  return inbox->second.take(world_.time());
}

RadioLimits RadioMedium::limits(const std::string& name) {
  const RadioParams& params = links_.end(number(name)).params;
  return {params.queue_bytes, 1e6 * params.broadcast_mbit_s, params.is_base_station};
}

double RadioMedium::rate_bit_s(const std::string& source, const std::string& destination) {
  const int from = number(source);
  const RadioParams& params = links_.end(from).params;
  return vht::data_rate(channel_.mcs(from, number(destination)), params.width_mhz,
                        params.has_short_guard);
}

RadioLink RadioMedium::link(int source, int destination) {
  const RadioEnd &from = links_.end(source), &to = links_.end(destination);
  const RadioStation& sender = channel_.station(source);
  const bool is_possible = from.params.channel == to.params.channel && !sender.is_out &&
                           !channel_.station(destination).is_out && !is_cut(source, destination);
  const LinkLoss loss = links_.present_loss(source, destination);
  RadioLink result;
  result.source = from.name;
  result.destination = to.name;
  result.distance_m = links_.distance_m(source, destination);
  result.loss_db = is_possible ? loss.whole_db : INFINITY;
  result.rssi_dbm = from.params.tx_power_dbm - result.loss_db;
  result.snr_db = result.rssi_dbm - noise_power_dbm(to.params.width_mhz, to.params.noise_figure_db);
  result.mcs = channel_.mcs(source, destination);
  result.rate_bit_s = rate_bit_s(from.name, to.name);
  // An Ethernet frame's payload for the error rate; whether a link is up goes by a short frame in
  // the slowest mode, as that of a hello.
  constexpr std::size_t kLongBytes = 1500, kShortBytes = 100;
  result.packet_error_rate = packet_error_rate(result.mcs, result.snr_db, kLongBytes);
  result.is_up = packet_error_rate(0, result.snr_db, kShortBytes) < 0.5;
  result.has_line_of_sight = loss.obstacles_db == 0.0;
  for (const std::size_t bytes : sender.queued_bytes) {
    result.queue_bytes += static_cast<double>(bytes);
  }
  add_counts(channel_.counts(source, destination), &result);
  return result;
}

std::vector<RadioLink> RadioMedium::links(const std::string& source) {
  if (!source.empty()) number(source);
  look();
  links_.follow();
  follow_outages(world_.time());
  std::vector<RadioLink> result;
  for (const auto& [name, from] : numbers_) {
    if (!source.empty() && name != source) continue;
    for (const auto& [other, to] : numbers_) {
      if (from != to) result.push_back(link(from, to));
    }
  }
  return result;
}

void RadioMedium::set_outage(const std::string& source, const std::string& destination,
                             SimTime until) {
  number(source);
  if (destination.empty()) {
    out_until_[source] = until;
    return;
  }
  number(destination);
  if (source == destination) throw Error("radio '" + source + "': has no link to itself");
  cut_until_[pair_of(source, destination)] = until;
}

void RadioMedium::reset() {
  channel_ = RadioChannel(world_.seed());
  links_.clear();
  numbers_.clear();
  own_.clear();
  inboxes_.clear();
  out_until_.clear();
  cut_until_.clear();
  dropped_ = 0;
  // No version that a board has, so that the next step looks for radios again.
  ports_version_ = ~std::uint64_t{0};
}

void RadioMedium::state(StateArchive& archive) {
  archive(channel_, numbers_, own_, inboxes_, out_until_, cut_until_, dropped_);
  links_.state(archive);
}

std::string RadioMedium::state_text() const { return std::to_string(channel_.digest()); }

}  // namespace trident::sim
