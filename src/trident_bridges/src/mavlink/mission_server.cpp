// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/mission_server.h"

#include <algorithm>

#include "mavlink/mission_messages.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kReaderLimit_s = 30.0;  // a reader that is silent for longer has ended
constexpr double kRepeatLimit_s = 10.0;  // a lost MISSION_ACK is asked for within this
constexpr std::size_t kMaxReaders = 32;
constexpr std::uint32_t kTriesWithInt = 4;  // then every other request is a MISSION_REQUEST

std::string numbered(MissionType type, std::size_t item) {
  return std::string(text_of(type)) + " item " + std::to_string(item);
}

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

bool MissionServer::handle(const Message& message, SimTime now) {
  if (const auto item = read_item(message)) {
    if (!concerns(item->header.target, self_)) return false;
    on_item(message, now);
    return true;
  }
  return handle_list(message, now);
}

bool MissionServer::handle_list(const Message& message, SimTime now) {
  const Address peer = message.source;
  // Calls `use` with the payload if the message is of that type and for this vehicle.
  const auto take = [&](auto payload, auto use) {
    using Payload = decltype(payload);
    if (!is<Payload>(message)) return false;
    payload = unpack<Payload>(message);
    if (!concerns({payload.target_system, payload.target_component}, self_)) return false;
    use(payload);
    return true;
  };
  return take(mavlink_mission_count_t{},
              [&](const auto& p) { on_count(peer, p.mission_type, p.count, now); }) ||
         take(mavlink_mission_write_partial_list_t{},
              [&](const auto& p) {
                on_partial(peer, p.mission_type, p.start_index, p.end_index, now);
              }) ||
         take(mavlink_mission_request_list_t{},
              [&](const auto& p) { on_request_list(peer, p.mission_type, now); }) ||
         take(mavlink_mission_request_int_t{},
              [&](const auto& p) { on_request(peer, p.mission_type, p.seq, true, now); }) ||
         take(mavlink_mission_request_t{},
              [&](const auto& p) { on_request(peer, p.mission_type, p.seq, false, now); }) ||
         take(mavlink_mission_ack_t{},
              [&](const auto& p) { on_ack(peer, p.mission_type, p.type); }) ||
         take(mavlink_mission_clear_all_t{},
              [&](const auto& p) { on_clear(peer, p.mission_type); }) ||
         take(mavlink_mission_set_current_t{}, [&](const auto& p) { on_set_current(peer, p.seq); });
}

void MissionServer::update(SimTime now) {
  if (upload_ && upload_->timer.waited_s(now) >= kSilence_s) {
    fail({MissionResult::kCancelled, "upload ended: " + numbered(upload_->type, upload_->next) +
                                         " of " + std::to_string(upload_->end) +
                                         " did not come for 5 s; the old one stays"});
  }
  if (upload_ && upload_->timer.is_due(now)) {
    if (upload_->timer.tries() >= kTriesWithInt) upload_->asks_int = !upload_->asks_int;
    upload_->timer.retry(now);
    send_(request_message({upload_->peer, static_cast<std::uint16_t>(upload_->next),
                           static_cast<std::uint8_t>(upload_->type)},
                          upload_->asks_int, self_));
  }
}

std::optional<MissionType> MissionServer::legal_type(Address peer, std::uint8_t type) {
  if (type < kMissionTypes) return static_cast<MissionType>(type);
  refuse(peer, type,
         {MissionResult::kUnsupported, "mission type " + std::to_string(type) + ", legal: 0 to 2"});
  return std::nullopt;
}

void MissionServer::on_count(Address peer, std::uint8_t type, std::size_t count, SimTime now) {
  const auto legal = legal_type(peer, type);
  if (!legal) return;
  if (count > kMaxMissionItems) {
    return refuse(
        peer, type,
        {MissionResult::kNoSpace, std::string(text_of(*legal)) + " of " + std::to_string(count) +
                                      " items, legal: up to " + std::to_string(kMaxMissionItems)});
  }
  Upload upload;
  upload.peer = peer;
  upload.type = *legal;
  upload.end = count;
  upload.items.resize(count);
  begin(std::move(upload), now);
}

void MissionServer::on_partial(Address peer, std::uint8_t type, int first, int last, SimTime now) {
  const auto legal = legal_type(peer, type);
  if (!legal) return;
  const auto size = static_cast<int>(mission(*legal).size());
  if (first < 0 || last < first || last >= size) {
    return refuse(peer, type,
                  {MissionResult::kInvalidSequence,
                   std::string(text_of(*legal)) + " items " + std::to_string(first) + " to " +
                       std::to_string(last) + ", legal: within 0 to " + std::to_string(size - 1)});
  }
  Upload upload;
  upload.peer = peer;
  upload.type = *legal;
  upload.next = static_cast<std::size_t>(first);
  upload.end = static_cast<std::size_t>(last) + 1;
  upload.items = mission(*legal);
  begin(std::move(upload), now);
}

void MissionServer::begin(Upload upload, SimTime now) {
  if (upload_ && upload_->peer != upload.peer) {
    return refuse(
        upload.peer, static_cast<std::uint8_t>(upload.type),
        {MissionResult::kDenied, "upload refused: system " + std::to_string(upload_->peer.system) +
                                     " uploads a " + text_of(upload_->type) + " now"});
  }
  finished_.reset();
  upload_ = std::move(upload);
  if (upload_->next == upload_->end) return finish(now);
  request_next(now);
}

void MissionServer::request_next(SimTime now) {
  upload_->timer.start(now);
  send_(request_message({upload_->peer, static_cast<std::uint16_t>(upload_->next),
                         static_cast<std::uint8_t>(upload_->type)},
                        upload_->asks_int, self_));
}

void MissionServer::on_item(const Message& message, SimTime now) {
  ReceivedItem received = *read_item(message);
  const Address peer = message.source;
  const std::size_t item = received.header.sequence;
  if (!upload_) {
    // The partner has not heard that the upload was accepted.
    if (finished_ && finished_->peer == peer && item == finished_->last &&
        static_cast<std::uint8_t>(finished_->type) == received.header.type &&
        (now - finished_->when).seconds() < kRepeatLimit_s) {
      send_(ack_message(MissionResult::kAccepted, peer, received.header.type, self_));
    }
    return;
  }
  Upload& upload = *upload_;
  // Items of other partners or lists have nothing to do with this one.
  if (peer != upload.peer || received.header.type != static_cast<std::uint8_t>(upload.type)) return;
  if (item < upload.next) return upload.timer.answered_twice();
  if (item >= upload.end) {
    return fail({MissionResult::kInvalidSequence,
                 numbered(upload.type, item) + ", legal: below " + std::to_string(upload.end)});
  }
  if (item > upload.next) return;  // It is requested when its turn comes.
  MissionVerdict verdict = received.verdict;
  if (verdict.is_accepted()) verdict = check_place(received.item);
  if (verdict.is_accepted() && events_.check_item) {
    verdict = events_.check_item(upload.type, item, received.item);
  }
  if (!verdict.is_accepted()) {
    return fail({verdict.result, numbered(upload.type, item) + ": " + verdict.reason});
  }
  upload.timer.answered(now);
  upload.asks_int = received.is_int;
  upload.items[item] = received.item;
  if (++upload.next == upload.end) return finish(now);
  request_next(now);
}

void MissionServer::finish(SimTime now) {
  if (events_.check_mission) {
    const MissionVerdict verdict = events_.check_mission(upload_->type, upload_->items);
    if (!verdict.is_accepted()) return fail(verdict);
  }
  const Upload done = *std::move(upload_);
  upload_.reset();
  finished_ = Finished{done.peer, done.type, done.end - (done.end > 0 ? 1 : 0), now};
  set_mission(done.type, done.items);
  send_(ack_message(MissionResult::kAccepted, done.peer, static_cast<std::uint8_t>(done.type),
                    self_));
  if (events_.changed) events_.changed(done.type);
}

void MissionServer::fail(const MissionVerdict& verdict) {
  const Address peer = upload_->peer;
  const auto type = static_cast<std::uint8_t>(upload_->type);
  upload_.reset();
  refuse(peer, type, verdict);
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
                   numbered(*legal, item) + ", legal: below " + std::to_string(list.size())});
  }
  const ItemHeader header{peer, static_cast<std::uint16_t>(item), type};
  send_(is_int ? item_int_message(list[item], header, self_)
               : item_message(list[item], header, self_));
}

/// Ends what the partner does: his download, or his upload if he cancels it.
void MissionServer::on_ack(Address peer, std::uint8_t type, std::uint8_t result) {
  if (type >= kMissionTypes) return;
  readers_.erase({peer, static_cast<MissionType>(type)});
  const bool is_upload =
      upload_ && upload_->peer == peer && static_cast<std::uint8_t>(upload_->type) == type;
  if (is_upload && result != static_cast<std::uint8_t>(MissionResult::kAccepted)) upload_.reset();
}

void MissionServer::on_clear(Address peer, std::uint8_t type) {
  if (type != kAllMissionTypes && !legal_type(peer, type)) return;
  if (upload_ && upload_->peer == peer) upload_.reset();
  if (upload_) {
    return refuse(peer, type,
                  {MissionResult::kDenied, "clearing refused: system " +
                                               std::to_string(upload_->peer.system) + " uploads"});
  }
  for (std::uint8_t each = 0; each < kMissionTypes; ++each) {
    if (type != each && type != kAllMissionTypes) continue;
    set_mission(static_cast<MissionType>(each), {});
    if (events_.changed) events_.changed(static_cast<MissionType>(each));
  }
  send_(ack_message(MissionResult::kAccepted, peer, type, self_));
}

void MissionServer::on_set_current(Address peer, std::uint16_t item) {
  const std::size_t size = mission(MissionType::kMission).size();
  MissionVerdict verdict;
  if (item >= size) {
    verdict = {MissionResult::kInvalidSequence,
               numbered(MissionType::kMission, item) + ", legal: below " + std::to_string(size)};
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
