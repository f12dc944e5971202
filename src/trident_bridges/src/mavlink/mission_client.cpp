// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/mission_client.h"

#include <utility>

#include "mavlink/mission_messages.h"

namespace trident::bridges::mavlink {
namespace {

// The vehicle repeats its requests; this end does so only if it hears nothing of them.
constexpr double kUploadPatience_s = 1.0;

}  // namespace

MissionClient::MissionClient(Address self, MessageSink send,
                             std::function<void(const MissionOutcome&)> finished)
    : self_(self), send_(std::move(send)), finished_(std::move(finished)) {}

void MissionClient::upload(Address target, MissionType type, Mission mission, SimTime now) {
  const Message first =
      count_message(mission.size(), target, static_cast<std::uint8_t>(type), self_);
  begin({Kind::kUpload, target, type, std::move(mission), 0, false, {}, {}, now}, first, now);
}

void MissionClient::download(Address target, MissionType type, SimTime now) {
  mavlink_mission_request_list_t payload{};
  payload.target_system = target.system;
  payload.target_component = target.component;
  payload.mission_type = static_cast<std::uint8_t>(type);
  begin({Kind::kDownload, target, type, {}, 0, false, {}, {}, now}, pack(payload, self_), now);
}

void MissionClient::clear(Address target, MissionType type, SimTime now) {
  mavlink_mission_clear_all_t payload{};
  payload.target_system = target.system;
  payload.target_component = target.component;
  payload.mission_type = static_cast<std::uint8_t>(type);
  begin({Kind::kClear, target, type, {}, 0, false, {}, {}, now}, pack(payload, self_), now);
}

void MissionClient::begin(Transfer transfer, const Message& first, SimTime now) {
  if (transfer_) cancel();
  transfer_ = std::move(transfer);
  send(first, now);
}

void MissionClient::send(const Message& message, SimTime now) {
  transfer_->last = message;
  transfer_->timer.start(now);
  send_(message);
}

void MissionClient::cancel() {
  if (!transfer_) return;
  send_(ack_message(MissionResult::kCancelled, transfer_->target,
                    static_cast<std::uint8_t>(transfer_->type), self_));
  end({MissionResult::kCancelled, "cancelled by this end"});
}

bool MissionClient::concerns(Address source, std::uint8_t type, Kind kind) const {
  return transfer_ && transfer_->kind == kind && source.system == transfer_->target.system &&
         (transfer_->target.component == 0 || source.component == transfer_->target.component) &&
         type == static_cast<std::uint8_t>(transfer_->type);
}

/// Calls `use` with the payload if the message is of that type and of this transfer.
template <typename Payload, typename Use>
bool MissionClient::take(const Message& message, Kind kind, SimTime now, Use use) {
  if (!is<Payload>(message)) return false;
  const auto payload = unpack<Payload>(message);
  const Address target{payload.target_system, payload.target_component};
  if (!is_for(target, self_) || !concerns(message.source, payload.mission_type, kind)) return false;
  transfer_->heard = now;
  use(payload);
  return true;
}

bool MissionClient::handle_upload(const Message& message, SimTime now) {
  return take<mavlink_mission_request_int_t>(
             message, Kind::kUpload, now, [&](const auto& p) { on_request(p.seq, true, now); }) ||
         take<mavlink_mission_request_t>(message, Kind::kUpload, now,
                                         [&](const auto& p) { on_request(p.seq, false, now); });
}

bool MissionClient::handle_download(const Message& message, SimTime now) {
  const auto on_item_message = [&](const auto&) { on_item(message, now); };
  return take<mavlink_mission_count_t>(message, Kind::kDownload, now,
                                       [&](const auto& p) { on_count(p.count, now); }) ||
         take<mavlink_mission_item_int_t>(message, Kind::kDownload, now, on_item_message) ||
         take<mavlink_mission_item_t>(message, Kind::kDownload, now, on_item_message);
}

bool MissionClient::handle(const Message& message, SimTime now) {
  if (!transfer_) return false;
  return handle_upload(message, now) || handle_download(message, now) ||
         take<mavlink_mission_ack_t>(message, transfer_->kind, now,
                                     [&](const auto& p) { on_ack(p.type); });
}

/// [s] after which the last message is repeated.
double MissionClient::patience_s() const {
  const Transfer& transfer = *transfer_;
  const bool is_waiting_for_request = transfer.kind == Kind::kUpload && transfer.has_begun &&
                                      transfer.next < transfer.mission.size();
  return is_waiting_for_request ? kUploadPatience_s : transfer.timer.timeout_s();
}

void MissionClient::update(SimTime now) {
  if (!transfer_) return;
  if ((now - transfer_->heard).seconds() >= kSilence_s) {
    const std::string place = transfer_->has_begun ? "item " + std::to_string(transfer_->next)
                                                   : std::string("the first answer");
    return end({MissionResult::kError, std::string(text_of(transfer_->type)) + ": " + place +
                                           ": system " + std::to_string(transfer_->target.system) +
                                           " was silent for 10 s"});
  }
  if (transfer_->timer.is_due(now) && transfer_->timer.waited_s(now) >= patience_s()) {
    transfer_->timer.retry(now);
    send_(transfer_->last);
  }
}

void MissionClient::on_request(std::size_t item, bool is_int, SimTime now) {
  Transfer& transfer = *transfer_;
  if (item >= transfer.mission.size()) {
    send_(ack_message(MissionResult::kInvalidSequence, transfer.target,
                      static_cast<std::uint8_t>(transfer.type), self_));
    return end({MissionResult::kInvalidSequence, "the vehicle asks for item " +
                                                     std::to_string(item) + " of " +
                                                     std::to_string(transfer.mission.size())});
  }
  if (!transfer.has_begun) transfer.timer.answered(now);
  transfer.has_begun = true;
  transfer.next = item + 1;
  const ItemHeader header{transfer.target, static_cast<std::uint16_t>(item),
                          static_cast<std::uint8_t>(transfer.type)};
  const MissionItem& content = transfer.mission[item];
  send(is_int ? item_int_message(content, header, self_) : item_message(content, header, self_),
       now);
}

void MissionClient::on_count(std::size_t count, SimTime now) {
  Transfer& transfer = *transfer_;
  if (transfer.has_begun && transfer.mission.size() == count) return;  // the same answer again
  if (count > kMaxMissionItems) {
    return end({MissionResult::kNoSpace, std::string(text_of(transfer.type)) + " of " +
                                             std::to_string(count) + " items, legal: up to " +
                                             std::to_string(kMaxMissionItems)});
  }
  transfer.timer.answered(now);
  transfer.has_begun = true;
  transfer.mission.assign(count, {});
  transfer.next = 0;
  request_next(now);
}

void MissionClient::request_next(SimTime now) {
  Transfer& transfer = *transfer_;
  const auto type = static_cast<std::uint8_t>(transfer.type);
  if (transfer.next == transfer.mission.size()) {
    send_(ack_message(MissionResult::kAccepted, transfer.target, type, self_));
    return end({});
  }
  send(request_message({transfer.target, static_cast<std::uint16_t>(transfer.next), type}, true,
                       self_),
       now);
}

void MissionClient::on_item(const Message& message, SimTime now) {
  Transfer& transfer = *transfer_;
  const ReceivedItem received = *read_item(message);
  const std::size_t item = received.header.sequence;
  if (!transfer.has_begun || item > transfer.next) return;
  if (item < transfer.next) return transfer.timer.answered_twice();
  if (!received.verdict.is_accepted()) return end(received.verdict);
  transfer.timer.answered(now);
  transfer.mission[item] = received.item;
  ++transfer.next;
  request_next(now);
}

void MissionClient::on_ack(std::uint8_t result) {
  const Transfer& transfer = *transfer_;
  const auto verdict = static_cast<MissionResult>(result);
  if (verdict != MissionResult::kAccepted) {
    return end({verdict, std::string(text_of(transfer.type)) + ": system " +
                             std::to_string(transfer.target.system) + " answers " +
                             text_of(verdict)});
  }
  // One that comes earlier is the answer to something else.
  if (transfer.kind == Kind::kUpload && transfer.next < transfer.mission.size()) return;
  if (transfer.kind != Kind::kDownload) end({});
}

void MissionClient::end(MissionVerdict verdict) {
  Transfer done = *std::move(transfer_);
  transfer_.reset();
  const bool is_whole = done.kind == Kind::kDownload && verdict.is_accepted();
  MissionOutcome outcome{done.type, std::move(verdict), {}};
  if (is_whole) outcome.mission = std::move(done.mission);
  if (finished_) finished_(outcome);
}

}  // namespace trident::bridges::mavlink
