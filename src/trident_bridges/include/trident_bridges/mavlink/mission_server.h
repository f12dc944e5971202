// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/mission.h"
#include "trident_bridges/mavlink/retry_timer.h"

namespace trident::bridges::mavlink {

struct ItemHeader;
struct ReceivedItem;

/// What a vehicle decides about its missions. Each may be left empty.
struct MissionServerEvents {
  /// Whether an item may be part of a list.
  std::function<MissionVerdict(MissionType, std::size_t index, const MissionItem&)> check_item;
  /// Whether a whole list may replace the old one: DO_JUMP's targets, polygons of a fence ...
  std::function<MissionVerdict(MissionType, const Mission&)> check_mission;
  /// A list was replaced or cleared; the server has the new one.
  std::function<void(MissionType)> changed;
  /// MISSION_SET_CURRENT asks for this item of the mission.
  std::function<MissionVerdict(std::uint16_t index)> set_current;
  /// Something was refused: one sentence for STATUSTEXT, with the rule, the value and the limit.
  std::function<void(const std::string& reason)> refused;
};

/// The vehicle's end of the mission protocol (https://mavlink.io/en/services/mission.html). A list
/// replaces the old one whole or not at all. Who reads a list reads the one that was there when he
/// began. Requests that are not answered are repeated; one partner uploads at a time.
class MissionServer {
 public:
  static constexpr double kSilence_s = 5.0;  ///< after which an upload has failed

  MissionServer(Address self, MessageSink send, MissionServerEvents events);

  /// True when the message belongs to this protocol and is for this vehicle.
  bool handle(const Message& message, SimTime now);
  /// Repeats and gives up; to be called at least every 50 ms while is_busy().
  void update(SimTime now);
  bool is_busy() const { return upload_.has_value(); }  ///< somebody uploads

  /// The list in force.
  const Mission& mission(MissionType type) const { return *missions_[index(type)]; }
  /// Replaces a list from this side. `changed` is not called.
  void set_mission(MissionType type, Mission mission);

 private:
  struct Upload {
    Address peer;
    MissionType type = MissionType::kMission;
    std::size_t next = 0, end = 0;  // items that are still to come
    Mission items;
    bool asks_int = true;  // by MISSION_REQUEST_INT
    RetryTimer timer;
  };
  struct Reader {
    std::shared_ptr<const Mission> mission;
    SimTime last;
  };
  struct Finished {
    Address peer;
    MissionType type = MissionType::kMission;
    std::size_t last = 0;  // index of the last item
    SimTime when;
  };

  static std::size_t index(MissionType type) { return static_cast<std::size_t>(type); }

  template <typename Payload, typename Use>
  bool take(const Message& message, Use use);
  bool handle_upload(const Message& message, SimTime now);
  bool handle_download(const Message& message, SimTime now);
  bool handle_order(const Message& message);
  void on_count(Address peer, std::uint8_t type, std::size_t count, SimTime now);
  void on_partial(Address peer, std::uint8_t type, int first, int last, SimTime now);
  void on_item(const Message& message, SimTime now);
  void on_request_list(Address peer, std::uint8_t type, SimTime now);
  void on_request(Address peer, std::uint8_t type, std::size_t item, bool is_int, SimTime now);
  void on_ack(Address peer, std::uint8_t type, std::uint8_t result);
  void on_clear(Address peer, std::uint8_t type);
  void on_set_current(Address peer, std::uint16_t item);

  /// Begins an upload unless another partner's is in progress.
  void begin(Upload upload, SimTime now);
  void request_next(SimTime now);
  void send_request();
  bool uploads(Address peer, std::uint8_t type) const;
  void accept_again(Address peer, const ItemHeader& last, SimTime now);
  MissionVerdict verdict_of(const ReceivedItem& received) const;
  void take_item(const ReceivedItem& received, SimTime now);
  void clear_lists(std::uint8_t type);
  void finish(SimTime now);
  void fail(const MissionVerdict& verdict);
  void refuse(Address peer, std::uint8_t type, const MissionVerdict& verdict);
  std::optional<MissionType> legal_type(Address peer, std::uint8_t type);

  Address self_;
  MessageSink send_;
  MissionServerEvents events_;
  std::array<std::shared_ptr<const Mission>, kMissionTypes> missions_;
  std::optional<Upload> upload_;
  std::optional<Finished> finished_;
  std::map<std::pair<Address, MissionType>, Reader> readers_;
};

}  // namespace trident::bridges::mavlink
