// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "teb_band.h"

#include <algorithm>
#include <cmath>

namespace trident::nav {
namespace {

double step_m(const TebNode& a, const TebNode& b) {
  return distance(a.pose.x, a.pose.y, b.pose.x, b.pose.y);
}

double turn_between(const TebNode& a, const TebNode& b) {
  return wrap_angle(b.pose.yaw - a.pose.yaw);
}

TebNode middle(const TebNode& a, const TebNode& b) {
  return {{0.5 * (a.pose.x + b.pose.x), 0.5 * (a.pose.y + b.pose.y),
           wrap_angle(a.pose.yaw + 0.5 * turn_between(a, b))},
          0.5 * a.dt_s};
}

bool is_too_long(const TebSpacing& spacing, const TebNode& a, const TebNode& b) {
  return a.dt_s > spacing.dt_ref_s + spacing.dt_hysteresis_s || step_m(a, b) > spacing.max_step_m ||
         std::fabs(turn_between(a, b)) > spacing.max_turn;
}

// Whether a segment is short, and one with what follows it would not be too long.
bool can_join(const TebSpacing& spacing, const TebNode& a, const TebNode& b, const TebNode& c) {
  constexpr double kMargin = 0.9;  // so that the result is not split again at once
  return a.dt_s < spacing.dt_ref_s - spacing.dt_hysteresis_s &&
         a.dt_s + b.dt_s < kMargin * (spacing.dt_ref_s + spacing.dt_hysteresis_s) &&
         step_m(a, b) + step_m(b, c) < kMargin * spacing.max_step_m &&
         std::fabs(turn_between(a, b)) + std::fabs(turn_between(b, c)) < kMargin * spacing.max_turn;
}

void split_long(const TebSpacing& spacing, TebBand* band) {
  for (std::size_t i = 0; i + 1 < band->size();) {
    if (band->size() < spacing.max_nodes && is_too_long(spacing, (*band)[i], (*band)[i + 1])) {
      const TebNode node = middle((*band)[i], (*band)[i + 1]);
      (*band)[i].dt_s = node.dt_s;
      band->insert(band->begin() + static_cast<std::ptrdiff_t>(i) + 1, node);
    } else {
      ++i;
    }
  }
}

void join_short(const TebSpacing& spacing, TebBand* band) {
  for (std::size_t i = 0; i + 2 < band->size() && band->size() > spacing.min_nodes;) {
    TebBand& nodes = *band;
    if (can_join(spacing, nodes[i], nodes[i + 1], nodes[i + 2])) {
      nodes[i].dt_s += nodes[i + 1].dt_s;
      nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    } else {
      ++i;
    }
  }
}

}  // namespace

double duration_s(const TebBand& band) {
  double sum = 0.0;
  for (const TebNode& node : band) sum += node.dt_s;
  return sum;
}

void slow_down(const TebPace& pace, TebBand* band) {
  for (std::size_t i = 0; i + 1 < band->size(); ++i) {
    TebNode& node = (*band)[i];
    const double drive_s = step_m(node, (*band)[i + 1]) / pace.v;
    const double turn_s = std::fabs(turn_between(node, (*band)[i + 1])) / pace.wz;
    node.dt_s = std::max({node.dt_s, drive_s, turn_s, kMinTebDuration_s});
  }
}

TebBand band_through(const Path& poses, const TebPace& pace) {
  TebBand band;
  for (const Pose2& pose : poses) band.push_back({pose, 0.0});
  slow_down(pace, &band);
  return band;
}

void resize_band(const TebSpacing& spacing, TebBand* band) {
  join_short(spacing, band);
  split_long(spacing, band);
  // A band of too few poses has none that obstacles could move.
  while (band->size() < spacing.min_nodes) {
    TebSpacing halved = spacing;
    halved.dt_ref_s = 0.0;
    halved.dt_hysteresis_s = 0.6 * duration_s(*band) / static_cast<double>(band->size() - 1);
    halved.max_nodes = spacing.min_nodes;
    split_long(halved, band);
  }
}

void move_ends(const Pose2& start, const Pose2& goal, double reach_m, TebBand* band) {
  // The robot is somewhere near the beginning, even where the band comes back to this place.
  constexpr std::size_t kSearched = 10;
  const std::size_t end = std::min(kSearched, band->size() - 1);
  std::size_t first = 0;
  double nearest_m = distance(start.x, start.y, (*band)[0].pose.x, (*band)[0].pose.y);
  for (std::size_t i = 1; i < end; ++i) {
    const double d = distance(start.x, start.y, (*band)[i].pose.x, (*band)[i].pose.y);
    if (d > nearest_m && d > reach_m) break;
    nearest_m = std::min(nearest_m, d);
    first = i;
  }
  band->erase(band->begin(), band->begin() + static_cast<std::ptrdiff_t>(first));
  band->front().pose = start;
  band->back().pose = goal;
}

}  // namespace trident::nav
