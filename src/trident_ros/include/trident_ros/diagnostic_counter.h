// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>

#include <map>
#include <mutex>
#include <string>

namespace trident::ros_utils {

/// Counts problems by kind: each kind is logged once and counted in /diagnostics. Thread-safe.
class DiagnosticCounter {
 public:
  /// `text` replaces the one of its kind before; `kind` should come from a small set.
  void note(const std::string& kind, const std::string& text);
  /// Each kind as a warning named "`node`: kind" with its newest text and its count.
  void add_to(diagnostic_msgs::DiagnosticArray& array, const std::string& node) const;

 private:
  struct Entry {
    std::string newest;
    std::uint64_t count = 0;
  };
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;
};

/// One row of a DiagnosticStatus.
diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value);

}  // namespace trident::ros_utils
