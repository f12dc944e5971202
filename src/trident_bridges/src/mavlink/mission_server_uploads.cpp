// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "mavlink/mission_messages.h"
#include "trident_bridges/mavlink/mission_server.h"

namespace trident::bridges::mavlink {
namespace {

constexpr double kRepeatLimit_s = 10.0;  // a lost MISSION_ACK is asked for within this

}  // namespace

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
  send_request();
}

void MissionServer::send_request() {
  send_(request_message({upload_->peer, static_cast<std::uint16_t>(upload_->next),
                         static_cast<std::uint8_t>(upload_->type)},
                        upload_->asks_int, self_));
}

/// The partner has not heard that the upload was accepted.
void MissionServer::accept_again(Address peer, const ItemHeader& last, SimTime now) {
  if (!finished_ || finished_->peer != peer || last.sequence != finished_->last) return;
  if (last.type != static_cast<std::uint8_t>(finished_->type)) return;
  if ((now - finished_->when).seconds() >= kRepeatLimit_s) return;
  send_(ack_message(MissionResult::kAccepted, peer, last.type, self_));
}

bool MissionServer::uploads(Address peer, std::uint8_t type) const {
  return upload_ && upload_->peer == peer && static_cast<std::uint8_t>(upload_->type) == type;
}

void MissionServer::on_item(const Message& message, SimTime now) {
  const ReceivedItem received = *read_item(message);
  const std::size_t item = received.header.sequence;
  if (!upload_) return accept_again(message.source, received.header, now);
  // Items of other partners or lists have nothing to do with this one.
  if (!uploads(message.source, received.header.type)) return;
  if (item < upload_->next) return upload_->timer.answered_twice();
  if (item >= upload_->end) {
    return fail(
        {MissionResult::kInvalidSequence,
         item_text(upload_->type, item) + ", legal: below " + std::to_string(upload_->end)});
  }
  // A later one is requested when its turn comes.
  if (item == upload_->next) take_item(received, now);
}

MissionVerdict MissionServer::verdict_of(const ReceivedItem& received) const {
  if (!received.verdict.is_accepted()) return received.verdict;
  MissionVerdict verdict = check_place(received.item);
  if (!verdict.is_accepted() || !events_.check_item) return verdict;
  return events_.check_item(upload_->type, received.header.sequence, received.item);
}

void MissionServer::take_item(const ReceivedItem& received, SimTime now) {
  Upload& upload = *upload_;
  const MissionVerdict verdict = verdict_of(received);
  if (!verdict.is_accepted()) {
    return fail({verdict.result, item_text(upload.type, upload.next) + ": " + verdict.reason});
  }
  upload.timer.answered(now);
  upload.asks_int = received.is_int;
  upload.items[upload.next] = received.item;
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

}  // namespace trident::bridges::mavlink
