// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "trident_bridges/mavlink/message.h"
#include "trident_bridges/mavlink/mission.h"
#include "trident_bridges/mavlink/retry_timer.h"

namespace trident::bridges::mavlink {

/// How a transfer ended.
struct MissionOutcome {
  MissionType type = MissionType::kMission;  ///< of the list
  MissionVerdict verdict;                    ///< why it failed, if it did
  Mission mission;                           ///< after a download
};

/// The ground's end of the mission protocol: uploads, downloads and clears one list at a time.
class MissionClient {
 public:
  static constexpr double kSilence_s = 10.0;  ///< after which a transfer has failed

  /// `finished` is called once for each transfer, and may begin the next one.
  MissionClient(Address self, MessageSink send,
                std::function<void(const MissionOutcome&)> finished);

  /// Begins a transfer with the vehicle `target`; what was in progress ends as cancelled.
  void upload(Address target, MissionType type, Mission mission, SimTime now);
  void download(Address target, MissionType type, SimTime now);  ///< see upload()
  void clear(Address target, MissionType type, SimTime now);     ///< see upload()
  /// Ends what is in progress; the vehicle hears of it.
  void cancel();

  /// True when the message belongs to the transfer.
  bool handle(const Message& message, SimTime now);
  /// Repeats and gives up; to be called at least every 50 ms while is_busy().
  void update(SimTime now);
  bool is_busy() const { return transfer_.has_value(); }  ///< one is in progress
  std::size_t items_done() const { return transfer_ ? transfer_->next : 0; }  ///< of the transfer

 private:
  enum class Kind : std::uint8_t { kUpload, kDownload, kClear };
  struct Transfer {
    Kind kind = Kind::kUpload;
    Address target;
    MissionType type = MissionType::kMission;
    Mission mission;
    std::size_t next = 0;    // item that should come; after the last one that was sent
    bool has_begun = false;  // the vehicle has answered
    Message last;            // what to repeat
    RetryTimer timer;
    SimTime heard;  // of the vehicle, about this transfer
  };

  void begin(Transfer transfer, const Message& first, SimTime now);
  void send(const Message& message, SimTime now);
  template <typename Payload, typename Use>
  bool take(const Message& message, Kind kind, SimTime now, Use use);
  bool handle_upload(const Message& message, SimTime now);
  bool handle_download(const Message& message, SimTime now);
  void on_request(std::size_t item, bool is_int, SimTime now);
  void on_count(std::size_t count, SimTime now);
  void on_item(const Message& message, SimTime now);
  void on_ack(std::uint8_t result);
  void request_next(SimTime now);
  bool concerns(Address source, std::uint8_t type, Kind kind) const;
  double patience_s() const;
  void end(MissionVerdict verdict);

  Address self_;
  MessageSink send_;
  std::function<void(const MissionOutcome&)> finished_;
  std::optional<Transfer> transfer_;
};

}  // namespace trident::bridges::mavlink
