// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace trident::sim {

/// Initialises ODE for the process and for this thread, as often as it is called. ODE's messages
/// are kept here instead of going to stderr.
void init_ode();

/// Messages that ODE has had for this thread, and the last one.
std::uint64_t ode_message_count();
const std::string& last_ode_message();

}  // namespace trident::sim
