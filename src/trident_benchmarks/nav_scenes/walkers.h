// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "trident_base/config_types.h"
#include "trident_base/random_stream.h"
#include "trident_nav/core/geometry.h"

namespace trident::benchmarks {

/// People in a hall, and how they walk.
struct WalkerParams {
  int count = 10;
  double min_speed = 0.5, max_speed = 1.2;
  double radius = 0.25;
  double height = 1.7;
  std::array<double, 2> hall{12.0, 8.0};
  double margin = 0.6;
  double start_distance = 2.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("count", count, Range{0, 1000}, "of walkers");
    ar.field("min_speed", min_speed, Range::positive(), "that a walker wants [m/s]");
    ar.field("max_speed", max_speed, Range::positive(), "that a walker wants [m/s]");
    ar.field("radius", radius, Range::positive(), "of a walker [m]");
    ar.field("height", height, Range::positive(), "of a walker [m]");
    ar.field("hall", hall, Range{1.0, 1e3}, "inner width and height, the origin in the middle [m]");
    ar.field("margin", margin, Range::non_negative(), "of their aims from the walls [m]");
    ar.field("start_distance", start_distance, Range::non_negative(),
             "of walkers from the robot at the start, at least [m]");
  }
};

/// One of them, in the hall's frame.
struct Walker {
  nav::Point2 position;
  nav::Point2 velocity;    ///< [m/s]
  nav::Point2 target;      ///< Where it walks to.
  double speed_m_s = 0.0;  ///< That it wants.
  std::uint64_t legs = 0;  ///< Targets it has had.
};

/// Walkers that go from one random place of the hall to the next at speeds of their own. They avoid
/// each other by the repulsion of the social force model (Helbing and Molnar, "Social
/// force model for pedestrian dynamics", Phys. Rev. E 51, 1995, equations 2, 3 and 8), and see no
/// robot.
class Walkers {
 public:
  /// Places them at random, none near `robot`. Throws Error if the hall has no room for them.
  Walkers(const WalkerParams& params, std::uint64_t seed, const nav::Point2& robot);

  /// Lets them walk for a while from where they are.
  void step(double duration_s);
  /// Puts one where it really is.
  void set_position(std::size_t walker, const nav::Point2& position) {
    walkers_[walker].position = position;
  }
  const std::vector<Walker>& all() const { return walkers_; }

 private:
  nav::Point2 random_place(std::size_t walker, std::uint64_t draw) const;
  void place(std::size_t walker, const nav::Point2& robot);
  void choose_target(std::size_t walker);
  nav::Point2 acceleration(std::size_t walker) const;

  WalkerParams params_;
  RandomStream random_;
  std::vector<Walker> walkers_;
};

}  // namespace trident::benchmarks
