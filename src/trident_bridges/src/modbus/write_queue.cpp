// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/write_queue.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trident::bridges::modbus {
namespace {

/// Part of an entry's timeout after which a value is written though it has not changed.
constexpr double kRefreshPart = 1.0 / 3.0;

/// Whether a value of the entry may be sent.
bool is_legal(const RegisterEntry& entry, const Value& value) {
  return std::all_of(value.numbers.begin(), value.numbers.end(), [&entry](const Number& number) {
    const double real = as_double(number);
    return std::isfinite(real) && real >= entry.min.value_or(real) &&
           real <= entry.max.value_or(real);
  });
}

/// Writes a value as on the wire; false: its registers cannot hold it.
bool encode(const RegisterEntry& entry, const Value& value, std::vector<std::uint8_t>& wire) {
  wire.resize(static_cast<std::size_t>(entry.addresses()) * (entry.is_bit() ? 1 : 2));
  return write_value(entry, value, wire) == Fit::kExact;
}

/// Whether the device would soon take the entry's writer for silent.
bool is_stale(const RegisterEntry& entry, double age_s) {
  return entry.timeout && age_s >= *entry.timeout * kRefreshPart;
}

Function write_function(bool is_bit, bool is_single) {
  if (is_bit) return is_single ? Function::kWriteSingleCoil : Function::kWriteMultipleCoils;
  return is_single ? Function::kWriteSingleRegister : Function::kWriteMultipleRegisters;
}

}  // namespace

WriteQueue::WriteQueue(const RegisterMap& map) : map_(map), states_(map.entries.size()) {
  for (std::size_t i = 0; i < map.entries.size(); ++i) {
    if (map.entries[i].is_writable()) order_.push_back(i);
  }
  std::sort(order_.begin(), order_.end(), [&map](std::size_t a, std::size_t b) {
    return std::make_pair(map.entries[a].table, map.entries[a].address) <
           std::make_pair(map.entries[b].table, map.entries[b].address);
  });
}

WriteQueue::Outcome WriteQueue::set(std::size_t index, const Value& value, double time_s) {
  const RegisterEntry& entry = map_.entries[index];
  State& state = states_[index];
  if (!is_legal(entry, value) || !encode(entry, value, state.wanted)) return Outcome::kRefused;
  if (time_s < state.last_s) state.last_s = -1e18;  // the simulation was reset
  if (state.wanted == state.sent && !is_stale(entry, time_s - state.last_s))
    return Outcome::kUnchanged;
  state.is_due = true;
  state.last_s = time_s;
  return Outcome::kQueued;
}

bool WriteQueue::may_join(const RegisterEntry& first, const RegisterEntry& last,
                          std::size_t next) const {
  const RegisterEntry& entry = map_.entries[next];
  const State& state = states_[next];
  const int most = entry.is_bit() ? kMaxWriteBits : kMaxWriteRegisters;
  return state.is_due && !state.is_in_flight && !state.is_alone && entry.table == last.table &&
         entry.address == last.end() && entry.end() - first.address <= most;
}

/// Entries that are due with the one at that place of the order, as far as one request takes them.
std::vector<std::size_t> WriteQueue::joined(std::size_t begin) const {
  std::vector<std::size_t> entries{order_[begin]};
  if (states_[order_[begin]].is_alone) return entries;
  const RegisterEntry& first = map_.entries[order_[begin]];
  for (std::size_t i = begin + 1; i < order_.size(); ++i) {
    if (!may_join(first, map_.entries[entries.back()], order_[i])) break;
    entries.push_back(order_[i]);
  }
  return entries;
}

std::optional<WriteBatch> WriteQueue::take() {
  for (std::size_t tried = 0; tried < order_.size(); ++tried) {
    const std::size_t begin = (next_ + tried) % order_.size();
    const State& first = states_[order_[begin]];
    if (!first.is_due || first.is_in_flight) continue;
    WriteBatch batch;
    batch.entries = joined(begin);
    for (const std::size_t index : batch.entries) {
      State& state = states_[index];
      state.is_due = false;
      state.is_in_flight = true;
      state.sent = state.wanted;
    }
    next_ = (begin + batch.entries.size()) % order_.size();
    batch.pdu = request(batch.entries);
    return batch;
  }
  return std::nullopt;
}

/// What is sent of entries, bits packed.
std::vector<std::uint8_t> WriteQueue::values_of(const std::vector<std::size_t>& entries) const {
  std::vector<std::uint8_t> values;
  for (const std::size_t index : entries) {
    values.insert(values.end(), states_[index].sent.begin(), states_[index].sent.end());
  }
  if (!map_.entries[entries.front()].is_bit()) return values;
  std::vector<std::uint8_t> packed(packed_size(values.size()));
  for (std::size_t bit = 0; bit < values.size(); ++bit) {
    if (values[bit] != 0) packed[bit / 8] |= static_cast<std::uint8_t>(1U << (bit % 8));
  }
  return packed;
}

Pdu WriteQueue::request(const std::vector<std::size_t>& entries) const {
  const RegisterEntry& first = map_.entries[entries.front()];
  const int count = map_.entries[entries.back()].end() - first.address;
  const Function function = write_function(first.is_bit(), count == 1);
  const std::vector<std::uint8_t> values = values_of(entries);
  return encode_request(write_request(function, static_cast<std::uint16_t>(first.address),
                                      static_cast<std::uint16_t>(count), values));
}

void WriteQueue::accept(const std::vector<std::size_t>& entries) {
  for (const std::size_t index : entries) {
    states_[index].is_in_flight = states_[index].is_alone = false;
  }
}

bool WriteQueue::refuse(const std::vector<std::size_t>& entries) {
  const bool is_one = entries.size() == 1;
  for (const std::size_t index : entries) {
    State& state = states_[index];
    state.is_in_flight = false;
    state.sent.clear();
    if (is_one) continue;
    state.is_alone = true;
    state.is_due = true;
  }
  return !is_one;
}

void WriteQueue::lose(const std::vector<std::size_t>& entries) {
  for (const std::size_t index : entries) {
    State& state = states_[index];
    state.is_in_flight = false;
    state.sent.clear();
    state.is_due = !map_.entries[index].timeout.has_value();
  }
}

void WriteQueue::restart() {
  for (const std::size_t index : order_) {
    State& state = states_[index];
    state.is_in_flight = false;
    state.sent.clear();
    state.is_due = !state.wanted.empty() && !map_.entries[index].timeout.has_value();
  }
}

}  // namespace trident::bridges::modbus
