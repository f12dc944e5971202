// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>

#include <functional>

#include "trident_base/mutex.h"
#include "trident_ros/reconfigure_table.h"
#include "trident_ros/refusals.h"

namespace trident::ros_utils {

/// dynamic_reconfigure's server for parameters that a struct with visit() describes: the service
/// `set_parameters` and the latched topics `parameter_descriptions` and `parameter_updates`, for
/// rqt_reconfigure, dynparam and dynamic_reconfigure.client. What clients change is written to the
/// parameter server, too. Thread-safe.
class ReconfigureServer {
 public:
  /// Takes over the values, a map; called from the thread that serves the call, one call at a time.
  /// Throws Error when they cannot be used: then nothing changes.
  using Apply = std::function<void(const ConfigNode& values)>;

  /// Serves below the namespace of `node`. `refusals` outlives it: what is refused or changed is
  /// one message of the kind "reconfigure NAMESPACE".
  ReconfigureServer(const ros::NodeHandle& node, ReconfigureTable table, Refusals& refusals,
                    Apply apply);

 private:
  bool serve(const dynamic_reconfigure::ReconfigureRequest& request,
             dynamic_reconfigure::ReconfigureResponse& response);
  void write_parameters(const dynamic_reconfigure::Config& request) TRIDENT_REQUIRES(mutex_);

  ros::NodeHandle node_;
  Refusals& refusals_;
  Apply apply_;
  Mutex mutex_;
  ReconfigureTable table_ TRIDENT_GUARDED_BY(mutex_);
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer service_;
};

}  // namespace trident::ros_utils
