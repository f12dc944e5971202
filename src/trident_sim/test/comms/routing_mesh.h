// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "comms/routing/router.h"
#include "trident_base/random_stream.h"

namespace trident::sim {

/// Random numbers one after the other.
class Dice {
 public:
  Dice(std::uint64_t seed, std::string_view name) : stream_(seed, name) {}
  double uniform() { return stream_.uniform(next_++, 0); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(uniform() * static_cast<double>(count));
  }

 private:
  RandomStream stream_;
  std::uint64_t next_ = 0;
};

/// Robots with routers, and links that lose hellos by chance.
class RoutingMesh {
 public:
  static constexpr SimTime kStep{10'000'000};
  struct Link {
    double delivery = 0.0;  ///< probability; 0: they do not hear each other
    double rate_bit_s = 0.0;
  };

  RoutingMesh(const std::vector<RouterParams>& params, std::uint64_t seed);

  std::size_t size() const { return routers_.size(); }
  static std::string name(std::size_t node);
  Router& router(std::size_t node) { return routers_[node]; }
  bool is_base_station(std::size_t node) const { return params_[node].is_base_station; }
  void set_link(std::size_t a, std::size_t b, const Link& there, const Link& back);
  void set_link(std::size_t a, std::size_t b, const Link& both) { set_link(a, b, both, both); }
  const Link& link(std::size_t from, std::size_t to) const { return links_[from * size() + to]; }
  /// A node that is off neither sends nor hears, and keeps its state.
  void set_on(std::size_t node, bool is_on) { is_on_[node] = is_on; }
  bool is_on(std::size_t node) const { return is_on_[node]; }
  /// Hellos arrive up to so many steps late, each by chance, and may overtake each other.
  void set_max_delay(std::size_t steps) { max_delay_ = steps; }
  void step();
  void run(double seconds);

  SimTime now() const { return now_; }
  std::size_t hellos() const { return hellos_; }
  std::size_t hello_bytes() const { return hello_bytes_; }
  /// By node; size(): it has no route.
  std::vector<std::size_t> next_hops(std::size_t destination) const;
  /// False: some walk along next hops visits a node twice, wherever it begins.
  bool is_loop_free() const;
  /// From `from` along next hops; empty: it does not arrive, or goes through a node that is off.
  std::optional<std::vector<std::size_t>> path(std::size_t from, std::size_t to) const;

 private:
  struct Delivery {
    std::size_t step, from, to;
    std::string bytes;
  };
  void broadcast(std::size_t from, const std::string& bytes);

  std::vector<RouterParams> params_;
  std::vector<Router> routers_;
  std::vector<Link> links_;
  std::vector<bool> is_on_;
  std::vector<Delivery> in_flight_;
  Dice dice_;
  SimTime now_;
  std::size_t step_ = 0, max_delay_ = 0, hellos_ = 0, hello_bytes_ = 0;
};

}  // namespace trident::sim
