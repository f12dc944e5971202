// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trident_slam_ros/slam_node_options.h"

namespace trident::slam {

/// Private parameters of slam_gmapping beyond those of the method, with its defaults.
struct GmappingParams {
  /// gmapping's defaults.
  GmappingParams() {
    options.base_frame = "base_link";
    options.transform_publish_period = 0.05;
  }

  SlamNodeOptions options;  ///< those that slam_gmapping has, too

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    options.visit(ar);
    ar.field("tf_delay", options.tf_delay, Range::any(),
             "how far map -> odom is stamped ahead; negative: transform_timeout [s]");
  }
};

}  // namespace trident::slam
