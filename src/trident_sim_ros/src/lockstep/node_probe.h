// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>

namespace trident::sim {

/// Distinguishes nodes that have ended from those that are slow or stopped: a process that lives
/// still has its port, and the kernel takes a connection to it. Asks the master and the port on a
/// thread of its own, since both may be slow.
class NodeProbe {
 public:
  enum class State {
    kUnknown,  ///< not asked yet, or never seen alive: somebody's name for what is no node
    kAlive,
    kGone  ///< it was alive, and has ended
  };

  /// The newest answer; asks again if there has been none for `period_s` of wall time.
  State look(const std::string& node, double period_s = 1.0);

  /// Whether a node sends a topic to this process, as it sees it itself. It comes to see that after
  /// this process does, and what it publishes in between reaches nobody. False also as long as it
  /// has not answered.
  bool sends(const std::string& node, const std::string& topic);

 private:
  struct Answers {
    std::mutex mutex;
    std::map<std::string, State> states;
    std::map<std::string, double> asked_at;  ///< < 0: an answer is awaited
    std::set<std::string> links;             ///< "node topic" that were seen
  };
  static void ask_for_links(const std::shared_ptr<Answers>& answers, const std::string& node);
  static void ask(const std::shared_ptr<Answers>& answers, const std::string& node);

  /// Outlives a question that has no answer yet.
  std::shared_ptr<Answers> answers_ = std::make_shared<Answers>();
};

}  // namespace trident::sim
