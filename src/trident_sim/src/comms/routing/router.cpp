// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "comms/routing/router.h"

#include <algorithm>
#include <cmath>

namespace trident::sim {
namespace {

/// After so many periods without a hello a neighbor is gone.
constexpr int kSilentPeriods = 3;
/// Hellos before their time come this much after the last one, in periods: what happens at once
/// shares a hello, and the air is not flooded.
constexpr double kMinGap = 0.1;
/// What neighbors have to know at once is in so many hellos of that kind: where 30 % are lost, all
/// of three are in 1 of 37 cases, and the period would be waited for in 1 of 3 after one alone.
constexpr int kUrgentHellos = 3;
/// The time between hellos is drawn from this part of the period up to the whole, so that those of
/// robots do not stay on top of each other.
constexpr double kMinPeriod = 0.8;
/// By this part of its first link's metric a route must be better than the present one. As it goes
/// by the link, the metric of a whole path is within the same part of the best path's.
constexpr double kHysteresis = 0.05;

}  // namespace

Router::Router(const std::string& name, const RouterParams& params)
    : params_(params), random_(0, name) {
  index_of(name);
  next_hello_ = SimTime::from_seconds(params_.hello_period_s * random_.uniform(0, 0));
  last_hello_ = SimTime{} - SimTime::from_seconds(params_.hello_period_s);
}

std::size_t Router::index_of(std::string_view name) {
  const auto known = index_.find(name);
  if (known != index_.end()) return known->second;
  index_.emplace(name, robots_.size());
  robots_.emplace_back().name = name;
  return robots_.size() - 1;
}

const Router::Robot* Router::find(const std::string& name) const {
  const auto known = index_.find(name);
  return known == index_.end() ? nullptr : &robots_[known->second];
}

/// ETT = ETX S / B with ETX = 1 / (share there * share back).
std::uint32_t Router::link_cost_ns(const Neighbor& neighbor, double rate_bit_s,
                                   bool is_base_station) const {
  const double shares =
      static_cast<double>(neighbor.heard_by_it * neighbor.window.share()) / (kHeardAll * kHeardAll);
  if (shares <= 0.0 || !(rate_bit_s > 0.0)) return kNoMetric;
  double cost_ns = 8e9 * params_.packet_bytes / (rate_bit_s * shares);
  if (is_base_station || params_.is_base_station) cost_ns *= params_.base_station_factor;
  // A link that costs nothing would let feasibility distances stay equal along a route.
  return cost_ns < kNoMetric ? static_cast<std::uint32_t>(std::max(cost_ns, 1.0)) : kNoMetric;
}

bool Router::hear(std::string_view hello_bytes, const std::string& sender, double rate_bit_s,
                  SimTime now) {
  const std::optional<Hello> hello = decode_hello(hello_bytes);
  const std::size_t from = index_of(sender);
  Neighbor& neighbor = robots_[from].neighbor;
  if (!hello || from == 0) return false;
  if (neighbor.is_alive && hello->number <= neighbor.window.last()) return false;
  neighbor.is_alive = true;
  neighbor.heard = now;
  neighbor.heard_by_it = 0;
  neighbor.window.add(hello->number);
  // A hello has all offers of its sender: what is not in it is withdrawn.
  neighbor.offers.assign(robots_.size(), RouteOffer{});
  // A robot is its own destination at no cost.
  neighbor.offers[from] = {{hello->sequence, 0}, 0};
  for (const HelloEntry& entry : hello->entries) take_entry(entry, from);
  // Entries may have brought robots that move the others in memory.
  Neighbor& same = robots_[from].neighbor;
  same.cost_ns = link_cost_ns(same, rate_bit_s, hello->is_base_station);
  update_routes();
  return true;
}

void Router::take_entry(const HelloEntry& entry, std::size_t sender) {
  const std::size_t destination = index_of(entry.robot);
  Neighbor& neighbor = robots_[sender].neighbor;
  if (destination == 0) neighbor.heard_by_it = entry.heard;
  if (destination != 0 && destination != sender) {
    if (destination >= neighbor.offers.size()) neighbor.offers.resize(robots_.size());
    neighbor.offers[destination] = entry.offer;
  }
  if (entry.wanted_sequence > 0) take_request(entry, destination);
}

/// At most so many hellos go before their time.
void Router::trigger(int hellos) { urgent_hellos_ = std::max(urgent_hellos_, hellos); }

/// Requests go where feasibility distances improve, as packets do, so that they reach the
/// destination without an echo. Who has such a route already answers. A request that comes again is
/// answered or passed on once more: the answer may have been lost.
void Router::take_request(const HelloEntry& entry, std::size_t destination) {
  if (destination == 0) {
    trigger(sequence_ < entry.wanted_sequence ? kUrgentHellos : 1);
    sequence_ = std::max(sequence_, entry.wanted_sequence);
    return;
  }
  Route& route = robots_[destination].route;
  if (route.next_hop == kNobody) return;
  if (route.feasibility.sequence >= entry.wanted_sequence) return trigger(1);
  if (entry.offer.is_route() && !route.feasibility.is_better_than(entry.offer.feasibility)) return;
  const int hellos = route.requested < entry.wanted_sequence ? kUrgentHellos : 1;
  route.requested = std::max(route.requested, entry.wanted_sequence);
  route.requests_due = std::max(route.requests_due, hellos);
  trigger(hellos);
}

Router::Choice Router::choose(std::size_t destination, bool* is_starved) const {
  const Route& route = robots_[destination].route;
  Choice best, present;
  bool has_forbidden = false;
  for (std::size_t i = 1; i < robots_.size(); ++i) {
    const Neighbor& neighbor = robots_[i].neighbor;
    if (!neighbor.is_alive || neighbor.cost_ns == kNoMetric) continue;
    if (destination >= neighbor.offers.size()) continue;
    const RouteOffer& offer = neighbor.offers[destination];
    if (!offer.is_route() || offer.metric_ns >= kNoMetric - neighbor.cost_ns) continue;
    // The feasibility condition (RFC 8966, 3.5.1) keeps routes free of loops.
    if (!offer.feasibility.is_better_than(route.feasibility)) {
      has_forbidden = true;
      continue;
    }
    const Choice choice{i, offer.metric_ns + neighbor.cost_ns, neighbor.cost_ns};
    if (i == route.next_hop) present = choice;
    if (choice.metric_ns < best.metric_ns) best = choice;
  }
  *is_starved = has_forbidden && best.robot == kNobody;
  if (present.robot == kNobody) return best;
  const bool is_better = best.metric_ns + kHysteresis * best.cost_ns < present.metric_ns;
  return is_better ? best : present;
}

/// Neighbors hear at once of a route that is lost, one that is back, and one that they wait for.
void Router::update_route(std::size_t destination) {
  Route& route = robots_[destination].route;
  bool is_starved = false;
  const Choice choice = choose(destination, &is_starved);
  const bool had_route = route.next_hop != kNobody, has_route = choice.robot != kNobody;
  const bool is_back = has_route && !had_route && route.feasibility.sequence > 0;
  if (is_back || (had_route && !has_route) || (is_starved && !route.is_starved)) {
    trigger(kUrgentHellos);
  }
  route.next_hop = choice.robot;
  route.metric_ns = choice.metric_ns;
  route.is_starved = is_starved;
  if (route.requested == 0 || !has_route) return;
  const RouteOffer& offer = robots_[choice.robot].neighbor.offers[destination];
  if (offer.feasibility.sequence < route.requested) return;
  route.requested = 0;
  route.requests_due = 0;
  trigger(kUrgentHellos);
}

void Router::update_routes() {
  for (std::size_t i = 1; i < robots_.size(); ++i) update_route(i);
}

void Router::drop_silent(SimTime now) {
  const SimTime limit = SimTime::from_seconds(params_.hello_period_s) * kSilentPeriods;
  bool is_any = false;
  for (Robot& robot : robots_) {
    Neighbor& neighbor = robot.neighbor;
    if (!neighbor.is_alive || now - neighbor.heard < limit) continue;
    neighbor.is_alive = false;
    is_any = true;
  }
  if (is_any) update_routes();
}

void Router::lost(const std::string& name) {
  const auto known = index_.find(name);
  if (known == index_.end() || !robots_[known->second].neighbor.is_alive) return;
  robots_[known->second].neighbor = Neighbor{};
  update_routes();
}

/// The feasibility distance becomes that of what is sent if it is better, and never worse.
HelloEntry Router::make_entry(Robot* robot) {
  Route& route = robot->route;
  HelloEntry entry;
  entry.robot = robot->name;
  if (robot->neighbor.is_alive) entry.heard = robot->neighbor.window.share();
  if (route.next_hop != kNobody) {
    const auto destination = static_cast<std::size_t>(robot - robots_.data());
    const FeasibilityDistance& below =
        robots_[route.next_hop].neighbor.offers[destination].feasibility;
    const FeasibilityDistance feasibility{below.sequence, route.metric_ns};
    if (feasibility.is_better_than(route.feasibility)) route.feasibility = feasibility;
    entry.offer = {route.feasibility, route.metric_ns};
  }
  if (route.is_starved) {
    entry.wanted_sequence = route.feasibility.sequence + 1;
  } else if (route.requests_due > 0) {
    --route.requests_due;
    entry.wanted_sequence = route.requested;
  }
  return entry;
}

Hello Router::make_hello() {
  Hello hello;
  hello.number = ++number_;
  hello.sequence = sequence_;
  hello.is_base_station = params_.is_base_station;
  for (const auto& [name, index] : index_) {
    if (index == 0) continue;
    HelloEntry entry = make_entry(&robots_[index]);
    const bool is_worth = entry.heard > 0 || entry.offer.is_route() || entry.wanted_sequence > 0;
    if (is_worth) hello.entries.push_back(entry);
  }
  return hello;
}

std::optional<std::string> Router::due_hello(SimTime now) {
  drop_silent(now);
  const SimTime min_gap = SimTime::from_seconds(kMinGap * params_.hello_period_s);
  const bool is_early = urgent_hellos_ > 0 && now - last_hello_ >= min_gap;
  if (now < next_hello_ && !is_early) return std::nullopt;
  if (now >= next_sequence_) {
    ++sequence_;
    next_sequence_ = now + SimTime::from_seconds(params_.sequence_period_s);
  }
  urgent_hellos_ = std::max(urgent_hellos_ - 1, 0);
  last_hello_ = now;
  std::string bytes = encode(make_hello());
  const double part = kMinPeriod + (1.0 - kMinPeriod) * random_.uniform(number_, 0);
  next_hello_ = now + SimTime::from_seconds(part * params_.hello_period_s);
  return bytes;
}

std::optional<std::string> Router::next_hop(const std::string& destination) const {
  const Robot* const robot = find(destination);
  if (robot == nullptr || robot->route.next_hop == kNobody) return std::nullopt;
  return robots_[robot->route.next_hop].name;
}

std::optional<double> Router::metric_s(const std::string& destination) const {
  const Robot* const robot = find(destination);
  if (robot == nullptr || robot->route.next_hop == kNobody) return std::nullopt;
  return 1e-9 * robot->route.metric_ns;
}

std::optional<double> Router::link_metric_s(const std::string& name) const {
  const Robot* const robot = find(name);
  if (robot == nullptr || !robot->neighbor.is_alive) return std::nullopt;
  const std::uint32_t cost_ns = robot->neighbor.cost_ns;
  if (cost_ns == kNoMetric) return std::nullopt;
  return 1e-9 * cost_ns;
}

std::vector<std::string> Router::destinations() const {
  std::vector<std::string> result;
  for (const auto& [name, index] : index_) {
    if (robots_[index].route.next_hop != kNobody) result.push_back(name);
  }
  return result;
}

}  // namespace trident::sim
