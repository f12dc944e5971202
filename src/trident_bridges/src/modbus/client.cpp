// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/client.h"

#include <algorithm>
#include <utility>

#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

/// Bits as they are kept: one byte each.
void unpack_bits(Bytes packed, int count, std::vector<std::uint8_t>& bits) {
  bits.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = (packed[i / 8] >> (i % 8)) & 1U;
}

/// "'a' (holding 3) and 4 more".
std::string labels_of(const RegisterMap& map, const std::vector<std::size_t>& entries) {
  std::string first = map.entries[entries.front()].label();
  if (entries.size() == 1) return first;
  return first + " and " + std::to_string(entries.size() - 1) + " more";
}

}  // namespace

Client::Client(RegisterMap map, bool may_pipeline, ClientEvents events)
    : map_(std::move(map)),
      events_(std::move(events)),
      max_in_flight_(may_pipeline ? static_cast<std::size_t>(map_.spec.pipeline) : 1),
      blocks_(read_blocks(map_)),
      states_(blocks_.size()),
      writes_(map_) {}

void Client::poll() {
  for (BlockState& state : states_) {
    if (state.is_due) ++counts_.skipped;
    state.is_due = true;
  }
}

void Client::set(std::size_t entry, const Value& value, double time_s) {
  if (writes_.set(entry, value, time_s) != WriteQueue::Outcome::kRefused) return;
  const RegisterEntry& refused = map_.entries[entry];
  fail("value refused", refused.label() + " is not set to " + value_to_text(value) + ", legal: " +
                            range_text(refused) + " of type " + refused.layout.type.text());
}

std::optional<Outgoing> Client::next(double now_s) {
  if (in_flight_.size() >= max_in_flight_) return std::nullopt;
  if (!retries_.empty()) {
    Transaction again = std::move(retries_.front());
    retries_.erase(retries_.begin());
    return send(std::move(again), now_s);
  }
  std::optional<Transaction> transaction = make_write();
  if (!transaction) transaction = make_read();
  if (!transaction) return std::nullopt;
  return send(std::move(*transaction), now_s);
}

std::optional<Client::Transaction> Client::make_write() {
  std::optional<WriteBatch> batch = writes_.take();
  if (!batch) return std::nullopt;
  Transaction transaction;
  transaction.pdu = batch->pdu;
  transaction.writes = std::move(batch->entries);
  return transaction;
}

std::optional<Client::Transaction> Client::make_read() {
  for (std::size_t tried = 0; tried < blocks_.size(); ++tried) {
    const std::size_t index = (next_block_ + tried) % blocks_.size();
    BlockState& state = states_[index];
    if (!state.is_due || state.is_in_flight) continue;
    state.is_due = false;
    state.is_in_flight = true;
    next_block_ = index + 1;
    const ReadBlock& block = blocks_[index];
    Transaction transaction;
    transaction.block = index;
    transaction.pdu =
        encode_request(read_request(block.function, static_cast<std::uint16_t>(block.address),
                                    static_cast<std::uint16_t>(block.count)));
    return transaction;
  }
  return std::nullopt;
}

Outgoing Client::send(Transaction transaction, double now_s) {
  ++counts_.requests;
  ++transaction.attempts;
  transaction.number = ++last_number_;
  transaction.deadline_s = now_s + map_.spec.response_timeout;
  in_flight_.push_back(std::move(transaction));
  const Transaction& sent = in_flight_.back();
  return {sent.number, static_cast<std::uint8_t>(map_.spec.unit), sent.pdu};
}

void Client::receive(std::optional<std::uint16_t> number, std::uint8_t unit, Bytes pdu) {
  const auto found = std::find_if(in_flight_.begin(), in_flight_.end(), [&](const Transaction& t) {
    return !number || t.number == *number;
  });
  if (found == in_flight_.end() || unit != map_.spec.unit) {
    ++counts_.late;
    return;
  }
  const Transaction transaction = std::move(*found);
  in_flight_.erase(found);
  const Response response = decode_response(decode_request(transaction.pdu.bytes()).request, pdu);
  if (response.kind == Response::Kind::kMalformed) {
    ++counts_.malformed;
    fail("malformed response", response.problem);
    return give_up(transaction);
  }
  ++counts_.responses;
  set_answering(true);
  finish(transaction, response);
}

void Client::finish(const Transaction& transaction, const Response& response) {
  if (response.kind == Response::Kind::kException) ++counts_.exceptions;
  if (transaction.block) {
    finish_read(*transaction.block, response);
  } else {
    finish_write(transaction, response);
  }
}

/// `all`: what was read of the whole block.
void Client::report_if_new(std::size_t block, std::size_t number, Bytes all) {
  const std::vector<std::uint8_t>& last = states_[block].last;
  const RegisterEntry& entry = map_.entries[number];
  const std::size_t width = entry.is_bit() ? 1 : 2;
  const std::size_t begin = width * (entry.address - blocks_[block].address);
  const Bytes own = all.subspan(begin, width * entry.addresses());
  const bool is_same = !last.empty() && std::equal(own.begin(), own.end(), last.begin() + begin);
  if (!events_.read || (is_same && entry.publish == Publish::kChange)) return;
  read_value(entry, own, value_);
  events_.read(number, value_);
}

void Client::finish_read(std::size_t index, const Response& response) {
  const ReadBlock& block = blocks_[index];
  BlockState& state = states_[index];
  state.is_in_flight = false;
  if (response.kind == Response::Kind::kException) {
    return fail("read refused", function_text(block.function) + ": " +
                                    labels_of(map_, block.entries) + ": " +
                                    exception_text(response.exception));
  }
  counts_.registers += static_cast<std::uint64_t>(block.count);
  const bool is_bit = is_bit_function(block.function);
  std::vector<std::uint8_t> bits;
  if (is_bit) unpack_bits(response.values, block.count, bits);
  const Bytes all = is_bit ? Bytes(bits) : response.values;
  for (const std::size_t number : block.entries) report_if_new(index, number, all);
  state.last.assign(all.begin(), all.end());
}

void Client::finish_write(const Transaction& transaction, const Response& response) {
  if (response.kind != Response::Kind::kException) {
    counts_.writes += transaction.writes.size();
    return writes_.accept(transaction.writes);
  }
  if (writes_.refuse(transaction.writes)) return;
  fail("write refused",
       labels_of(map_, transaction.writes) + ": " + exception_text(response.exception));
}

void Client::give_up(const Transaction& transaction) {
  if (transaction.attempts <= map_.spec.retries) {
    retries_.push_back(transaction);
    return;
  }
  set_answering(false);
  const std::string attempts = std::to_string(transaction.attempts) + " attempts of " +
                               number_text(map_.spec.response_timeout) + " s each";
  if (transaction.block) {
    states_[*transaction.block].is_in_flight = false;
    fail("no answer",
         labels_of(map_, blocks_[*transaction.block].entries) + " was not read in " + attempts);
  } else {
    writes_.lose(transaction.writes);
    fail("no answer", labels_of(map_, transaction.writes) + " was not written in " + attempts);
  }
}

void Client::update(double now_s) {
  for (std::size_t i = 0; i < in_flight_.size();) {
    if (now_s < in_flight_[i].deadline_s) {
      ++i;
      continue;
    }
    const Transaction overdue = std::move(in_flight_[i]);
    in_flight_.erase(in_flight_.begin() + static_cast<std::ptrdiff_t>(i));
    ++counts_.timeouts;
    give_up(overdue);
  }
}

std::optional<double> Client::deadline_s() const {
  std::optional<double> earliest;
  for (const Transaction& transaction : in_flight_) {
    earliest = std::min(earliest.value_or(transaction.deadline_s), transaction.deadline_s);
  }
  return earliest;
}

void Client::disconnect() {
  in_flight_.clear();
  retries_.clear();
  for (BlockState& state : states_) state.is_in_flight = state.is_due = false;
  writes_.restart();
  set_answering(false);
}

void Client::set_answering(bool answers) {
  if (answers == is_answering_) return;
  is_answering_ = answers;
  if (events_.answering) events_.answering(answers);
}

void Client::fail(const std::string& kind, const std::string& text) {
  if (events_.failed) events_.failed(kind, text);
}

}  // namespace trident::bridges::modbus
