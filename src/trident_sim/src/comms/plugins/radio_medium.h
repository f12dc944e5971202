// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "comms/links/radio_links.h"
#include "comms/mac/radio_channel.h"
#include "comms/plugins/radio_inbox.h"
#include "trident_sim/comms/radio.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// Where no radio works: a vertical cylinder.
struct OutageRegion {
  Eigen::Vector2d center;  ///< world frame [m]
  double radius_m = 0.0;
};

/// The radios of a world, found by their ports, and what happens between them.
class RadioMedium : public Radio, private LinkLosses {
 public:
  /// `world` must outlive it.
  RadioMedium(World& world, const PathLossParams& params, std::vector<OutageRegion> regions = {});

  /// Changes what radios say of themselves, for all that come.
  using Override = std::function<void(RadioEnd*)>;
  void set_override(Override change) { override_ = std::move(change); }

  /// Lets happen what happens in a step, whose state at its end is the world's.
  void step(const StepInfo& info);
  /// As no radio had ever sent.
  void reset();
  void state(StateArchive& archive);

  std::vector<std::string> names() override;
  /// Whether there are radios, or were when it looked last.
  bool has_radios() const { return !numbers_.empty() || !present_ends().empty(); }
  bool send(const std::string& source, const std::string& destination, std::string data,
            const RadioQos& qos) override;
  std::vector<RadioMessage> receive(const std::string& name, int port) override;
  RadioLimits limits(const std::string& name) override;
  double rate_bit_s(const std::string& source, const std::string& destination) override;
  std::vector<RadioLink> links(const std::string& source) override;
  void set_outage(const std::string& source, const std::string& destination,
                  SimTime until) override;
  std::string state_text() const override;

 private:
  /// Between two names, the first in alphabetical order first.
  using Pair = std::pair<std::string, std::string>;

  std::map<std::string, std::shared_ptr<const RadioEnd>> present_ends() const;
  /// Follows radios that have come or gone since.
  void look();
  int number(const std::string& name);
  double loss_db(int a, int b) override;
  static Pair pair_of(const std::string& a, const std::string& b);
  bool is_cut(int a, int b) const;
  void drop_outages_of(const std::string& name);
  void add(const std::shared_ptr<const RadioEnd>& end);
  void follow_outages(SimTime now);
  bool is_in_outage_region(int station);
  void take_deliveries();
  RadioLink link(int source, int destination);

  World& world_;
  RadioLinks links_;
  std::vector<OutageRegion> outage_regions_;
  Override override_;
  std::map<int, std::shared_ptr<const RadioEnd>> own_;  ///< as the radio's plugin has it
  RadioChannel channel_;
  std::map<std::string, int> numbers_;                    ///< of the radios that are there
  std::map<std::pair<std::string, int>, Inbox> inboxes_;  ///< by radio and port
  std::map<std::string, SimTime> out_until_;              ///< by command
  std::map<Pair, SimTime> cut_until_;
  SimTime now_;                ///< of the step's beginning
  std::uint64_t dropped_ = 0;  ///< messages that nobody has asked for in time
  std::uint64_t ports_version_ = ~std::uint64_t{0};
};

}  // namespace trident::sim
