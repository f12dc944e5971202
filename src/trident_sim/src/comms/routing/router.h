// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "comms/routing/hello.h"
#include "comms/routing/hello_window.h"
#include "trident_base/random_stream.h"
#include "trident_base/sim_time.h"

namespace trident::sim {

struct RouterParams {
  double hello_period_s = 0.2;     ///< the longest time from one hello to the next
  double sequence_period_s = 1.0;  ///< of the own sequence number, if nobody requests one
  double packet_bytes = 1400.0;    ///< of the packet whose transmission time is the metric
  bool is_base_station = false;
  /// What the metric of a link counts one of whose ends is a base station: below 1, so that base
  /// stations are preferred as relays.
  double base_station_factor = 0.5;
};

/// Finds routes over several hops for one robot, by what its radio has heard: a distance vector
/// protocol after Babel (RFC 8966) with the expected transmission time as its metric (Draves,
/// Padhye, Zill, "Routing in multi-radio, multi-hop wireless mesh networks", MobiCom 2004). A
/// value.
///
/// The routes of all robots together have no loop at any time, whatever is lost or late: a neighbor
/// is a next hop only while the feasibility distance that it sent is better than the own one, which
/// only becomes better, so that they do along each route. Babel compares the neighbor's metric
/// instead; that refuses more, as the metric moves with each hello that is lost. This needs that a
/// router keeps its state; one that begins again under the same name has to be silent for three
/// hello periods.
///
/// A destination raises its sequence number each second, though RFC 8966 advises against it: only a
/// newer number admits the best path again after links have become worse, and requests are lost,
/// too. It raises it at once for a robot that has only routes left that are not feasible.
class Router {
 public:
  Router(const std::string& name, const RouterParams& params);

  /// A hello that has arrived. `rate_bit_s`: that the own radio has to the sender; 0: no link.
  /// False: the bytes are no hello, or an older one than the last.
  bool hear(std::string_view hello, const std::string& sender, double rate_bit_s, SimTime now);
  /// To be broadcast now; empty: nothing is due. To be called in every step, as it drops neighbors
  /// that have been silent for three hello periods.
  std::optional<std::string> due_hello(SimTime now);
  /// The own radio has given up packets to that neighbor: it is dropped until its next hello.
  void lost(const std::string& neighbor);

  /// The neighbor to which packets for that robot go; empty: there is no route now.
  std::optional<std::string> next_hop(const std::string& destination) const;
  /// Expected transmission time over all hops, base stations counted at less [s].
  std::optional<double> metric_s(const std::string& destination) const;
  /// The same of the link to a neighbor [s]; empty: there is no link now.
  std::optional<double> link_metric_s(const std::string& neighbor) const;
  /// To which there are routes, in alphabetical order.
  std::vector<std::string> destinations() const;

 private:
  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);
  /// Another robot as the other end of a link.
  struct Neighbor {
    bool is_alive = false;
    HelloWindow window;
    SimTime heard;                 ///< last
    std::uint8_t heard_by_it = 0;  ///< share of the own hellos, of kHeardAll
    std::uint32_t cost_ns = kNoMetric;
    std::vector<RouteOffer> offers;  ///< by robot, as far as it goes
  };
  /// Another robot as a destination.
  struct Route {
    FeasibilityDistance feasibility;      ///< the best that was ever sent
    std::size_t next_hop = kNobody;       ///< robot
    std::uint32_t metric_ns = kNoMetric;  ///< with the link to the next hop
    bool is_starved = false;              ///< there are routes, and not one is feasible
    std::uint32_t requested = 0;          ///< sequence number that others wait for; 0: none
    int requests_due = 0;                 ///< hellos in which it is to be passed on
  };
  struct Robot {
    std::string name;
    Neighbor neighbor;
    Route route;
  };
  /// A next hop that may be chosen.
  struct Choice {
    std::size_t robot = kNobody;
    std::uint32_t metric_ns = kNoMetric, cost_ns = kNoMetric;
  };

  std::size_t index_of(std::string_view name);
  const Robot* find(const std::string& name) const;
  std::uint32_t link_cost_ns(const Neighbor& neighbor, double rate_bit_s,
                             bool is_base_station) const;
  void take_entry(const HelloEntry& entry, std::size_t sender);
  void trigger(int hellos);
  void take_request(const HelloEntry& entry, std::size_t destination);
  Choice choose(std::size_t destination, bool* is_starved) const;
  void update_route(std::size_t destination);
  void update_routes();
  void drop_silent(SimTime now);
  Hello make_hello();
  HelloEntry make_entry(Robot* robot);

  RouterParams params_;
  RandomStream random_;
  std::map<std::string, std::size_t, std::less<>> index_;  ///< of robots_, by name
  std::vector<Robot> robots_;                              ///< the first is this one
  std::uint32_t number_ = 0, sequence_ = 1;
  SimTime next_hello_, last_hello_, next_sequence_;
  int urgent_hellos_ = 0;  ///< that are due before their time
};

}  // namespace trident::sim
