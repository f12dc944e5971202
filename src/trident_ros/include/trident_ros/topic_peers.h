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

/// What ROS says of the messages of a topic.
struct TopicType {
  std::string name;         ///< "nav_msgs/Odometry"; "": not known
  std::string md5sum;       ///< of its definition
  std::string definition;   ///< of the type and of those in it
  bool is_latched = false;  ///< who subscribes later gets the newest message
};

/// As a publisher has it that this process is connected to, before its first message, too.
TopicType topic_type(const std::string& topic);

/// Nodes that write a topic of any name, as the master knows them; asks the
/// master. Empty when it does not answer.
std::vector<std::string> topic_publishers(const std::string& topic);

/// A sentence that names all publishers of a topic of commands; empty unless there are at least
/// two.
std::string rivals_text(const std::string& topic, const std::vector<std::string>& publishers);

}  // namespace trident::ros_utils
