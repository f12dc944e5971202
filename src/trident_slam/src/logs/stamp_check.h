// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace trident::slam {

/// Counts stamps that go back or jump ahead. They are labels, and nothing is sorted by them; but
/// who reads a log wants to know.
class StampCheck {
 public:
  /// Later than the one before by more is a jump [s].
  static constexpr double kJump = 10.0;

  void add(std::int64_t stamp_ns);
  std::size_t back() const { return back_.count; }
  std::size_t jumps() const { return jumps_.count; }
  /// Empty, or one line that counts them and names the first and the largest by its scan.
  std::string text() const;

 private:
  struct Kind {
    std::size_t count = 0;
    std::size_t first = 0;  ///< scan, from 1
    std::size_t largest = 0;
    double largest_s = 0.0;
    void add(std::size_t scan, double seconds);
    std::string text(const char* what) const;
  };
  std::size_t scans_ = 0;
  std::optional<std::int64_t> last_ns_;
  Kind back_;
  Kind jumps_;
};

}  // namespace trident::slam
