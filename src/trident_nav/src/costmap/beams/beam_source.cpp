// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav/costmap/beam_source.h"

#include <algorithm>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::nav {
namespace {

void require_order(const char* least_name, double least, const char* most_name, double most) {
  if (least <= most) return;
  throw Error(std::string(least_name) + " " + number_text(least) + " m must not exceed " +
              most_name + " " + number_text(most) + " m");
}

}  // namespace

void BeamSourceParams::validate() const {
  require_order("min_obstacle_height", min_obstacle_height, "max_obstacle_height",
                max_obstacle_height);
  require_order("obstacle_min_range", obstacle_min_range, "obstacle_range", obstacle_range);
  require_order("raytrace_min_range", raytrace_min_range, "raytrace_range", raytrace_range);
}

BeamSource::BeamSource(std::string name, const BeamSourceParams& params)
    : name_(std::move(name)),
      params_(params),
      age_({params.expected_update_rate, params.max_source_age}) {}

void BeamSource::add(Observation observation) {
  const double stamp = observation.stamp_s;
  age_.note(stamp);
  const double oldest = stamp - params_.observation_persistence;
  const auto is_over = [&](const Stored& stored) {
    const double other = stored.observation.stamp_s;
    return params_.observation_persistence == 0.0 || other < oldest || other > stamp;
  };
  stored_.erase(std::remove_if(stored_.begin(), stored_.end(), is_over), stored_.end());
  stored_.push_back({std::move(observation), true});
}

bool BeamSource::has_fresh() const {
  return std::any_of(stored_.begin(), stored_.end(),
                     [](const Stored& stored) { return stored.is_fresh; });
}

void BeamSource::set_fresh(bool is_fresh) {
  for (Stored& stored : stored_) stored.is_fresh = is_fresh;
}

}  // namespace trident::nav
