// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <deque>
#include <string>

#include "trident_base/config_types.h"
#include "trident_nav/costmap/observation.h"
#include "trident_nav/costmap/source_age.h"

namespace trident::nav {

enum class BeamDataType { kPointCloud, kPointCloud2, kLaserScan };
constexpr auto enum_names(BeamDataType /*type*/) {
  return std::array{EnumName<BeamDataType>{BeamDataType::kPointCloud, "PointCloud"},
                    EnumName<BeamDataType>{BeamDataType::kPointCloud2, "PointCloud2"},
                    EnumName<BeamDataType>{BeamDataType::kLaserScan, "LaserScan"}};
}

/// One of a layer's `observation_sources`.
struct BeamSourceParams {
  std::string topic;
  std::string sensor_frame;
  double observation_persistence = 0.0;
  double expected_update_rate = 0.0;
  BeamDataType data_type = BeamDataType::kPointCloud;
  double min_obstacle_height = 0.0;
  double max_obstacle_height = 2.0;
  bool inf_is_valid = false;
  bool clearing = false;
  bool marking = true;
  double obstacle_range = 2.5;
  double obstacle_min_range = 0.0;
  double raytrace_range = 3.0;
  double raytrace_min_range = 0.0;
  double max_source_age = -1.0;

  template <class Archive>
  void visit(Archive& ar) {
    ar.field("topic", topic, "topic of the data; empty: the source's name");
    ar.field("sensor_frame", sensor_frame, "frame of the sensor; empty: that of the data");
    ar.field("observation_persistence", observation_persistence, Range::non_negative(),
             "how long data stay in use; 0: until the next [s]");
    ar.field("expected_update_rate", expected_update_rate, Range::non_negative(),
             "longest legal time between data; 0: three periods, and at least 0.3 s [s]");
    ar.field("data_type", data_type, "type of the messages");
    ar.field("min_obstacle_height", min_obstacle_height, "of what is marked [m]");
    ar.field("max_obstacle_height", max_obstacle_height, "of what is marked [m]");
    ar.field("inf_is_valid", inf_is_valid, "beams that hit nothing clear up to range_max");
    ar.field("clearing", clearing, "beams clear what they pass");
    ar.field("marking", marking, "ends of beams are marked");
    ar.field("obstacle_range", obstacle_range, Range::non_negative(),
             "how far from the sensor ends are marked [m]");
    ar.field("obstacle_min_range", obstacle_min_range, Range::non_negative(),
             "how near to the sensor ends are marked [m]");
    ar.field("raytrace_range", raytrace_range, Range::non_negative(),
             "how far from the sensor beams clear [m]");
    ar.field("raytrace_min_range", raytrace_min_range, Range::non_negative(),
             "where beams begin to clear [m]");
    ar.field("max_source_age", max_source_age,
             "how old the newest data may be; 0: what expected_update_rate says, or no limit; "
             "negative: see expected_update_rate [s]");
  }
  /// Throws Error when a least height or range exceeds the greatest.
  void validate() const;
};

/// Data of one source that are in use, and their age.
class BeamSource {
 public:
  BeamSource(std::string name, const BeamSourceParams& params);

  const std::string& name() const { return name_; }
  const BeamSourceParams& params() const { return params_; }
  /// The topic, or the source's name where none is given.
  const std::string& topic() const { return params_.topic.empty() ? name_ : params_.topic; }
  const SourceAge& age() const { return age_; }

  void add(Observation observation);

  /// An observation, and whether no update has used it.
  struct Stored {
    Observation observation;
    bool is_fresh = true;
  };
  const std::deque<Stored>& stored() const { return stored_; }
  bool has_fresh() const;
  void set_fresh(bool is_fresh);

 private:
  std::string name_;
  BeamSourceParams params_;
  SourceAge age_;
  std::deque<Stored> stored_;
};

}  // namespace trident::nav
