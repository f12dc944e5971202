// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "trident_sim/comms/radio.h"
#include "trident_sim/comms/relay.h"
#include "trident_sim/samples/radio_samples.h"
#include "trident_sim/state_archive.h"

namespace trident::sim {

/// Turns the links of a moment into what is published about them: what was counted, over the time
/// since the last report.
class LinkReporter {
 public:
  /// `relay` has the routes; nullptr: there are only links.
  void report(const std::vector<RadioLink>& links, const RelayReport* relay, SimTime now,
              LinkStatusArraySample* sample);
  void clear() { *this = LinkReporter(); }
  void state(StateArchive& archive) { archive(last_, last_time_); }

 private:
  LinkStatusSample status(const RadioLink& link, double elapsed_s) const;

  std::map<std::pair<std::string, std::string>, RadioLink> last_;
  SimTime last_time_;
};

}  // namespace trident::sim
