// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/mission_server.h"

#include <algorithm>

#include "mavlink/mission_messages.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kReaderLimit_s = 30.0;  // a reader that is silent for longer has ended
constexpr std::size_t kMaxReaders = 32;
constexpr std::uint32_t kTriesWithInt = 4;  // then every other request is a MISSION_REQUEST

/// Some ground stations address missions to the component that planned them in 2010.
bool concerns(Address target, Address self) {
  if (target.component == MAV_COMP_ID_MISSIONPLANNER) target.component = 0;
  return is_for(target, self);
}

}  // namespace

MissionServer::MissionServer(Address self, MessageSink send, MissionServerEvents events)
    : self_(self), send_(std::move(send)), events_(std::move(events)) {
  missions_.fill(std::make_shared<const Mission>());
}

void MissionServer::set_mission(MissionType type, Mission mission) {
  missions_[index(type)] = std::make_shared<const Mission>(std::move(mission));
}

/// Calls `use` with the payload if the message is of that type and for this vehicle.
template <typename Payload, typename Use>
bool MissionServer::take(const Message& message, Use use) {
  if (!is<Payload>(message)) return false;
  const auto payload = unpack<Payload>(message);
  if (!concerns({payload.target_system, payload.target_component}, self_)) return false;
  use(payload);
  return true;
}

bool MissionServer::handle(const Message& message, SimTime now) {
  if (const auto item = read_item(message)) {
    if (!concerns(item->header.target, self_)) return false;
    on_item(message, now);
    return true;
  }
  return handle_upload(message, now) || handle_download(message, now) || handle_order(message);
}

bool MissionServer::handle_upload(const Message& message, SimTime now) {
  const Address peer = message.source;
  return take<mavlink_mission_count_t>(
             message, [&](const auto& p) { on_count(peer, p.mission_type, p.count, now); }) ||
         take<mavlink_mission_write_partial_list_t>(message, [&](const auto& p) {
           on_partial(peer, p.mission_type, p.start_index, p.end_index, now);
         });
}

bool MissionServer::handle_download(const Message& message, SimTime now) {
  const Address peer = message.source;
  return take<mavlink_mission_request_list_t>(
             message, [&](const auto& p) { on_request_list(peer, p.mission_type, now); }) ||
         take<mavlink_mission_request_int_t>(
             message, [&](const auto& p) { on_request(peer, p.mission_type, p.seq, true, now); }) ||
         take<mavlink_mission_request_t>(
             message,
             [&](const auto& p) { on_request(peer, p.mission_type, p.seq, false, now); }) ||
         take<mavlink_mission_ack_t>(message,
                                     [&](const auto& p) { on_ack(peer, p.mission_type, p.type); });
}

bool MissionServer::handle_order(const Message& message) {
  const Address peer = message.source;
  return take<mavlink_mission_clear_all_t>(
             message, [&](const auto& p) { on_clear(peer, p.mission_type); }) ||
         take<mavlink_mission_set_current_t>(message,
                                             [&](const auto& p) { on_set_current(peer, p.seq); });
}

void MissionServer::update(SimTime now) {
  if (upload_ && upload_->timer.waited_s(now) >= kSilence_s) {
    fail({MissionResult::kCancelled, "upload ended: " + item_text(upload_->type, upload_->next) +
                                         " of " + std::to_string(upload_->end) +
                                         " did not come for 5 s; the old one stays"});
  }
  if (upload_ && upload_->timer.is_due(now)) {
    if (upload_->timer.tries() >= kTriesWithInt) upload_->asks_int = !upload_->asks_int;
    upload_->timer.retry(now);
    send_request();
  }
}

std::optional<MissionType> MissionServer::legal_type(Address peer, std::uint8_t type) {
  if (type < kMissionTypes) return static_cast<MissionType>(type);
  refuse(peer, type,
         {MissionResult::kUnsupported, "mission type " + std::to_string(type) + ", legal: 0 to 2"});
  return std::nullopt;
}

void MissionServer::refuse(Address peer, std::uint8_t type, const MissionVerdict& verdict) {
  send_(ack_message(verdict.result, peer, type, self_));
  if (events_.refused) events_.refused(verdict.reason);
}

void MissionServer::on_request_list(Address peer, std::uint8_t type, SimTime now) {
  const auto legal = legal_type(peer, type);
  if (!legal) return;
  for (auto it = readers_.begin(); it != readers_.end();) {
    it = (now - it->second.last).seconds() > kReaderLimit_s ? readers_.erase(it) : std::next(it);
  }
  const std::shared_ptr<const Mission>& mission = missions_[index(*legal)];
  if (readers_.size() < kMaxReaders) readers_[{peer, *legal}] = {mission, now};
  send_(count_message(mission->size(), peer, type, self_));
}

void MissionServer::on_request(Address peer, std::uint8_t type, std::size_t item, bool is_int,
                               SimTime now) {
  const auto legal = legal_type(peer, type);
  if (!legal) return;
  const auto reader = readers_.find({peer, *legal});
  if (reader != readers_.end()) reader->second.last = now;
  const Mission& list = reader != readers_.end() ? *reader->second.mission : mission(*legal);
  if (item >= list.size()) {
    return refuse(peer, type,
                  {MissionResult::kInvalidSequence,
                   item_text(*legal, item) + ", legal: below " + std::to_string(list.size())});
  }
  const ItemHeader header{peer, static_cast<std::uint16_t>(item), type};
  send_(is_int ? item_int_message(list[item], header, self_)
               : item_message(list[item], header, self_));
}

/// Ends what the partner does: his download, or his upload if he cancels it.
void MissionServer::on_ack(Address peer, std::uint8_t type, std::uint8_t result) {
  if (type >= kMissionTypes) return;
  readers_.erase({peer, static_cast<MissionType>(type)});
  const bool is_accepted = result == static_cast<std::uint8_t>(MissionResult::kAccepted);
  if (uploads(peer, type) && !is_accepted) upload_.reset();
}

void MissionServer::on_clear(Address peer, std::uint8_t type) {
  if (type != kAllMissionTypes && !legal_type(peer, type)) return;
  if (upload_ && upload_->peer == peer) upload_.reset();
  if (upload_) {
    return refuse(peer, type,
                  {MissionResult::kDenied, "clearing refused: system " +
                                               std::to_string(upload_->peer.system) + " uploads"});
  }
  clear_lists(type);
  send_(ack_message(MissionResult::kAccepted, peer, type, self_));
}

void MissionServer::clear_lists(std::uint8_t type) {
  for (std::uint8_t each = 0; each < kMissionTypes; ++each) {
    if (type != each && type != kAllMissionTypes) continue;
    set_mission(static_cast<MissionType>(each), {});
    if (events_.changed) events_.changed(static_cast<MissionType>(each));
  }
}

void MissionServer::on_set_current(Address peer, std::uint16_t item) {
  const std::size_t size = mission(MissionType::kMission).size();
  MissionVerdict verdict;
  if (item >= size) {
    verdict = {MissionResult::kInvalidSequence,
               item_text(MissionType::kMission, item) + ", legal: below " + std::to_string(size)};
  } else if (events_.set_current) {
    verdict = events_.set_current(item);
  }
  if (!verdict.is_accepted()) return refuse(peer, 0, verdict);
  mavlink_mission_current_t current{};
  current.seq = item;
  current.total = static_cast<std::uint16_t>(size);
  send_(pack(current, self_));
}

}  // namespace trident::bridges::mavlink
