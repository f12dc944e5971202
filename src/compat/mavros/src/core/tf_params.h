// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "trident_ros/node_params.h"

namespace trident::mavros {

/// Of a transform that a plugin sends or follows.
struct TfParams {
  bool send = false;                         ///< whether it is sent
  bool listen = false;                       ///< whether it is followed, in place of topics
  std::string frame_id = "map";              ///< parent
  std::string child_frame_id = "base_link";  ///< child
  std::string global_frame_id = "earth";     ///< kept for files; has no effect
  bool send_fcu = false;                     ///< kept for files; has no effect
  double rate_limit = 50.0;                  ///< of what is followed [Hz]

  /// Of a plugin that follows a transform `map` -> `child`, at most `rate` [Hz].
  static TfParams followed(std::string child, double rate) {
    TfParams params;
    params.child_frame_id = std::move(child);
    params.rate_limit = rate;
    return params;
  }

  /// Lists the fields for the parameter reader and the reference.
  template <class Archive>
  void visit(Archive& ar) {
    ar.field("send", send, "whether the transform is sent, by plugins that have one");
    ar.field("listen", listen, "whether /tf is followed, in place of topics, by plugins that can");
    ar.field("frame_id", frame_id, "parent of the transform");
    ar.field("child_frame_id", child_frame_id, "child of the transform");
    ar.field("global_frame_id", global_frame_id, "kept for files; has no effect");
    ar.field("send_fcu", send_fcu, "kept for files; has no effect");
    ar.field("rate_limit", rate_limit, Range::positive(), "of a transform that is followed [Hz]");
  }
};

}  // namespace trident::mavros
