// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "topics/diagnostics_topic.h"
#include "trident_sim/comms/relay.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Has the world's radios follow a file of rules; a world that has no air for radios gets it.
void use_radio_rules(const std::string& file, WorldSpec* spec);

/// What has crossed by rules so far, a note for each rule and pair of robots.
void add_relay_notes(const RelayReport& relay, DiagnosticsTopic::Notes* notes);

}  // namespace trident::sim
