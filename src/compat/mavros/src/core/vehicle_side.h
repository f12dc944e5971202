// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/link.h"
#include "core/mavros_params.h"
#include "trident_base/sim_time.h"
#include "trident_bridges/mavlink/command_client.h"
#include "trident_bridges/mavlink/heartbeat_monitor.h"
#include "trident_bridges/mavlink/status_text.h"
#include "trident_bridges/mavlink/timesync.h"
#include "trident_ros/refusals.h"

namespace trident::mavros {

using bridges::mavlink::CommandOutcome;
using bridges::mavlink::Heartbeat;

/// The vehicle that the node is for: what comes from it, what is sent to it, whether it is there,
/// and whose time its stamps are. In the loop's thread.
class VehicleSide {
 public:
  using Handler = std::function<void(const Message&)>;

  /// Opens the link. `refusals` and `loop` must outlive it. Throws Error with the URL and what is
  /// wrong with it.
  VehicleSide(const MavrosParams& params, ros_utils::Refusals& refusals, bridges::PollLoop& loop);

  /// Calls `handler` with each message of a type that comes from the vehicle.
  void on(std::uint32_t id, Handler handler) {
    handlers_.by_type[id].push_back(std::move(handler));
  }
  /// Calls `handler` with each packet that concerns this node, from whom it may be.
  void on_packet(std::function<void(const Packet&)> handler) {
    handlers_.packet.push_back(std::move(handler));
  }
  /// Calls `handler` when the vehicle appears (true) and when it is lost (false).
  void on_connection(std::function<void(bool)> handler) {
    handlers_.connection.push_back(std::move(handler));
  }
  /// Calls `handler` about 20 times a second of wall time, with now().
  void on_tick(std::function<void(SimTime)> handler) {
    handlers_.tick.push_back(std::move(handler));
  }
  /// To be called about 20 times a second.
  void tick();

  /// Sends a message of this node.
  void send(const Message& message) { link_.send(message); }
  /// Sends a whole packet of another program.
  void send_packet(bridges::Bytes packet) { link_.send_packet(packet); }
  /// Sends a command to the vehicle, or to all of them; `done` is called once. A refusal's reason
  /// is what the vehicle says in its texts.
  void command(const bridges::mavlink::Command& command, bool is_for_all,
               std::function<void(const CommandOutcome&)> done);

  Address self() const { return self_; }                     ///< of this node
  Address target() const { return target_; }                 ///< of the vehicle
  bool is_connected() const { return is_connected_; }        ///< HEARTBEATs come
  const Heartbeat& heartbeat() const { return heartbeat_; }  ///< the last one
  bool is_px4() const;                                       ///< by the HEARTBEAT
  /// Wall time, monotonic: for timeouts.
  SimTime now() const { return SimTime::from_seconds(loop_.now_s()); }
  /// Stamp of what the vehicle says of `since_boot_ns` by its clock.
  ros::Time stamp(std::int64_t since_boot_ns) const;
  /// As stamp(), of a field time_boot_ms.
  ros::Time stamp_ms(std::uint32_t time_boot_ms) const {
    return stamp(std::int64_t{time_boot_ms} * 1'000'000);
  }
  /// As stamp(), of a field time_usec.
  ros::Time stamp_us(std::uint64_t time_us) const {
    return stamp(static_cast<std::int64_t>(time_us) * 1000);
  }
  /// The vehicle's clock at a stamp, for fields time_boot_ms [ms]; 0: not known, or far from now.
  std::uint32_t boot_ms(const ros::Time& stamp) const;
  /// Clock of the vehicle minus this computer's; nullopt: not known.
  bridges::mavlink::TimesyncClient& timesync() { return timesync_; }

 private:
  void receive(const Packet& packet);
  void hand_on(const Message& message) const;
  std::optional<std::int64_t> clock_offset_ns() const;
  void note_heartbeat(const Message& message);
  void set_connected(bool is_connected);
  void note_text(const Message& message);
  /// The text that came since then; empty: none did.
  std::string reason_since(SimTime asked) const;
  void explain(const CommandOutcome& outcome, SimTime asked,
               const std::function<void(const CommandOutcome&)>& done);
  bridges::mavlink::BothTimes both_times() const;

  bridges::PollLoop& loop_;
  Address self_, target_;
  bool uses_own_time_, is_one_clock_;
  bool is_connected_ = false;
  Heartbeat heartbeat_;
  std::string newest_text_;
  SimTime newest_text_at_;
  /// Of plugins: whom what concerns.
  struct Handlers {
    std::map<std::uint32_t, std::vector<Handler>> by_type;
    std::vector<std::function<void(const Packet&)>> packet;
    std::vector<std::function<void(bool)>> connection;
    std::vector<std::function<void(SimTime)>> tick;
  };
  Handlers handlers_;
  bridges::mavlink::HeartbeatMonitor monitor_;
  bridges::mavlink::TimesyncClient timesync_;
  bridges::mavlink::StatusTextReader texts_;
  Link link_;
  bridges::mavlink::CommandClient commands_;
};

}  // namespace trident::mavros
