// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What the elements of libtrident_radio.so and libtrident_radio_medium.so say.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "comms/links/path_loss.h"
#include "comms/links/radio_end.h"
#include "comms/plugins/radio_medium.h"
#include "trident_sim/param_tree.h"

namespace trident::sim {

/// The robot's namespace without outer slashes; of one without a namespace the model's name.
std::string radio_name(const PluginParams& params, const std::string& model);
/// What is not among the elements stays. Throws Error, as all of these do.
void read_radio_end(const PluginParams& params, RadioEnd* end);
/// <outages>.
std::vector<RadioOutage> read_outages(const PluginParams& params);
/// <status_rate> [Hz].
double read_status_rate_hz(const PluginParams& params, double fallback = 2.0);

/// What the elements of a medium say.
struct RadioAir {
  PathLossParams path;
  std::vector<OutageRegion> outage_regions;  ///< where no radio works
  double status_rate_hz = 2.0;               ///< of all links
};
/// What is not among the elements stays.
void read_radio_air(const PluginParams& params, RadioAir* air);

/// Keys and values of a file as the elements of a plugin.
ParamNode as_elements(const std::map<std::string, std::string>& texts);
/// Throws Error for a key of a file that no element has.
void refuse_unread(const PluginParams& params);

}  // namespace trident::sim
