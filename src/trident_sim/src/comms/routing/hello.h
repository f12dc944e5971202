// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trident::sim {

/// As a metric: there is no route.
constexpr std::uint32_t kNoMetric = std::numeric_limits<std::uint32_t>::max();
/// Share of hellos that stands for all of them.
constexpr std::uint8_t kHeardAll = 63;

/// Where a robot is in the order that keeps routes free of loops (RFC 8966, 2.4).
struct FeasibilityDistance {
  std::uint32_t sequence = 0;  ///< of the destination; 0: there never was a route
  std::uint32_t distance_ns = kNoMetric;

  /// Nearer to the destination: a newer sequence number, or a shorter distance at the same one.
  bool is_better_than(const FeasibilityDistance& other) const {
    return sequence > other.sequence ||
           (sequence == other.sequence && distance_ns < other.distance_ns);
  }
};

/// What a robot offers to its neighbors for one destination.
struct RouteOffer {
  FeasibilityDistance feasibility;      ///< its distance is not above the metric
  std::uint32_t metric_ns = kNoMetric;  ///< expected transmission time of a packet, all hops

  bool is_route() const { return metric_ns != kNoMetric; }
};

/// What a hello has on one other robot.
struct HelloEntry {
  std::string_view robot;
  std::uint8_t heard = 0;  ///< share of its hellos that arrive, of kHeardAll
  RouteOffer offer;        ///< to that robot
  /// Request for a route to that robot with this sequence number or a newer one; 0: none.
  std::uint32_t wanted_sequence = 0;
};

/// The broadcast by which routers find each other. It has the whole table each time, so that one
/// that is lost costs time only, and a route that is not in it has been withdrawn. Its sender is
/// known by the radio. Robots are named in full: numbers would have to be agreed on before, and
/// again with each robot that comes. Names are short: among 20
/// robots with names of 8 characters a hello has 310 bytes.
struct Hello {
  std::uint32_t number = 0;           ///< counts the sender's hellos, from 1
  std::uint32_t sequence = 0;         ///< the sender's own as a destination, from 1
  bool is_base_station = false;       ///< the sender is one
  std::vector<HelloEntry> entries{};  ///< by name, ascending, each name once
};

/// Names have 1 to 255 bytes; an offer's feasibility distance must not be above its metric.
std::string encode(const Hello& hello);
/// Empty: encode() does not make such bytes. Names point into `bytes`.
std::optional<Hello> decode_hello(std::string_view bytes);

}  // namespace trident::sim
