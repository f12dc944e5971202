// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// A message of any type as the bytes that it is sent as; nobody looks into it.
struct BytesSample {
  SimTime stamp;                            ///< of its header; zero: it has none
  std::shared_ptr<const std::string> data;  ///< never nullptr once published
  std::string origin;  ///< of an output: name of the input that its messages come from
};

/// A stamp further ahead of the simulated time than this is of another clock: the message counts
/// when it comes.
constexpr SimTime kFarAhead{10'000'000'000};

}  // namespace trident::sim
