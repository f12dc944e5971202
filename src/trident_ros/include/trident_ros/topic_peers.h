// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace trident::ros_utils {

/// A node at the other end of a connection that is established.
struct TopicPeer {
  int connection = 0;  ///< grows from connection to connection of this process
  std::string node;    ///< absolute name
};

/// Who reads a topic that this process publishes. A reader that has ended is not among them.
std::vector<TopicPeer> topic_readers(const std::string& topic);

/// Nodes that write a topic that this process subscribes to. One that was killed stays among them
/// until the master hears of its end: roscpp tries to reconnect until then.
std::vector<std::string> topic_writers(const std::string& topic);

}  // namespace trident::ros_utils
