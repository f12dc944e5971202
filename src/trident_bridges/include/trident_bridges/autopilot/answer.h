// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

namespace trident::bridges {

/// What becomes of a request; the numbers are MAVLink's MAV_RESULT.
enum class Result {
  kAccepted = 0,
  kTemporarilyRejected = 1,  ///< a rule forbids it now
  kDenied = 2,               ///< a value of it is not legal
  kUnsupported = 3,          ///< nobody here knows it
  kFailed = 4,               ///< it was tried
  kInProgress = 5,           ///< it was begun
};

/// Answer to a request. A refusal's text names the rule, the value that was found and the limit.
struct Answer {
  Result result = Result::kAccepted;  ///< what becomes of it
  std::string text;                   ///< empty where all is said by the result

  /// Whether it is done or begun.
  bool is_good() const { return result == Result::kAccepted || result == Result::kInProgress; }
};

/// A refusal for now.
inline Answer refused(std::string text) { return {Result::kTemporarilyRejected, std::move(text)}; }
/// A refusal of a value.
inline Answer denied(std::string text) { return {Result::kDenied, std::move(text)}; }

}  // namespace trident::bridges
