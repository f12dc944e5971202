// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "walkers.h"

#include <algorithm>
#include <cmath>

#include "trident_base/error.h"

namespace trident::benchmarks {
namespace {

// How fast a walker comes to the velocity that it wants, and how strongly and from how far walkers
// keep apart.
constexpr double kRelaxation_s = 0.5;
constexpr double kRepulsion_m_s2 = 3.0;
constexpr double kReach_m = 0.3;
// Draws of one walker begin here, so that places and targets do not share them.
constexpr std::uint64_t kFirstTarget = 1000;

double separation(const nav::Point2& a, const nav::Point2& b) {
  return nav::distance(a.x, a.y, b.x, b.y);
}

}  // namespace

Walkers::Walkers(const WalkerParams& params, std::uint64_t seed, const nav::Point2& robot)
    : params_(params), random_(seed, "walkers") {
  if (params.max_speed < params.min_speed) {
    throw Error("walkers: max_speed is below min_speed, legal: from min_speed on");
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(params.count); ++i) {
    walkers_.emplace_back();
    const double u = random_.uniform(0, static_cast<std::uint32_t>(3 * i + 2));
    walkers_[i].speed_m_s = params.min_speed + u * (params.max_speed - params.min_speed);
    place(i, robot);
    choose_target(i);
  }
}

nav::Point2 Walkers::random_place(std::size_t walker, std::uint64_t draw) const {
  const auto channel = static_cast<std::uint32_t>(3 * walker);
  const auto along = [&](double size, std::uint32_t axis) {
    return (random_.uniform(draw, channel + axis) - 0.5) * (size - 2.0 * params_.margin);
  };
  return {along(params_.hall[0], 0), along(params_.hall[1], 1)};
}

void Walkers::place(std::size_t walker, const nav::Point2& robot) {
  for (std::uint64_t draw = 1; draw < kFirstTarget; ++draw) {
    const nav::Point2 p = random_place(walker, draw);
    const auto is_near = [&](const Walker& other) {
      return &other != &walkers_[walker] && separation(p, other.position) < 3.0 * params_.radius;
    };
    if (separation(p, robot) < params_.start_distance) continue;
    if (std::any_of(walkers_.begin(), walkers_.end(), is_near)) continue;
    walkers_[walker].position = p;
    return;
  }
  throw Error("walkers: the hall has no room for " + std::to_string(params_.count) + " of them");
}

void Walkers::choose_target(std::size_t walker) {
  Walker& own = walkers_[walker];
  // Each walk crosses a good part of the hall.
  const double least_m = 0.4 * std::min(params_.hall[0], params_.hall[1]);
  for (int tries = 0; tries < 100; ++tries) {
    own.target = random_place(walker, kFirstTarget + own.legs++);
    if (separation(own.target, own.position) >= least_m) return;
  }
}

nav::Point2 Walkers::acceleration(std::size_t walker) const {
  const Walker& own = walkers_[walker];
  const double left_m = std::max(separation(own.target, own.position), 1e-6);
  const double along = own.speed_m_s / left_m;
  nav::Point2 a{
      ((own.target.x - own.position.x) * along - own.velocity.x) / kRelaxation_s,
      ((own.target.y - own.position.y) * along - own.velocity.y) / kRelaxation_s,
  };
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    if (i == walker) continue;
    const double dx = own.position.x - walkers_[i].position.x;
    const double dy = own.position.y - walkers_[i].position.y;
    const double d = std::max(std::hypot(dx, dy), 1e-6);
    const double push = kRepulsion_m_s2 * std::exp((2.0 * params_.radius - d) / kReach_m);
    a.x += push * dx / d;
    a.y += push * dy / d;
  }
  return a;
}

void Walkers::step(double duration_s) {
  std::vector<nav::Point2> pulls;
  for (std::size_t i = 0; i < walkers_.size(); ++i) pulls.push_back(acceleration(i));
  const double edge_x = 0.5 * params_.hall[0] - params_.radius;
  const double edge_y = 0.5 * params_.hall[1] - params_.radius;
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    Walker& own = walkers_[i];
    own.velocity.x += pulls[i].x * duration_s;
    own.velocity.y += pulls[i].y * duration_s;
    const double speed = std::hypot(own.velocity.x, own.velocity.y);
    const double kept = speed > params_.max_speed ? params_.max_speed / speed : 1.0;
    const nav::Point2 to{
        std::clamp(own.position.x + kept * own.velocity.x * duration_s, -edge_x, edge_x),
        std::clamp(own.position.y + kept * own.velocity.y * duration_s, -edge_y, edge_y)};
    own.velocity = {(to.x - own.position.x) / duration_s, (to.y - own.position.y) / duration_s};
    own.position = to;
    if (separation(own.position, own.target) < params_.margin) choose_target(i);
  }
}

}  // namespace trident::benchmarks
