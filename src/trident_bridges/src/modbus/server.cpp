// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/server.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "map_checks.h"
#include "trident_base/string_util.h"
#include "trident_bridges/modbus/mbap.h"
#include "trident_bridges/modbus/response.h"
#include "trident_bridges/modbus/rtu.h"

namespace trident::bridges::modbus {
namespace {

/// The table that a function works on; of 23 that of holding registers, as of all others.
Table table_of(Function function) {
  switch (function) {
    case Function::kReadCoils:
    case Function::kWriteSingleCoil:
    case Function::kWriteMultipleCoils:
      return Table::kCoil;
    case Function::kReadDiscreteInputs:
      return Table::kDiscrete;
    case Function::kReadInputRegisters:
      return Table::kInput;
    default:
      return Table::kHolding;
  }
}

}  // namespace

Server::Server(RegisterMap map, ServerEvents events)
    : map_(std::move(map)),
      events_(std::move(events)),
      image_(map_.entries),
      writers_(map_.entries.size()) {}

/// Over TCP 255 and 0 mean the device at the other end (Implementation Guide, section 4.4.2), on a
/// serial line 0 means all.
bool Server::is_for_us(const Caller& caller, std::uint8_t unit) const {
  const bool is_direct = !caller.is_serial && unit == kTcpDeviceUnit;
  return unit == map_.spec.unit || unit == kBroadcastUnit || is_direct;
}

Pdu Server::respond(const Task& task, std::uint8_t unit, const DecodedRequest& decoded) {
  const Function function = task.request.function;
  if (!is_for_us(task.caller, unit)) {
    return exception_response(
        function, refuse(task, ExceptionCode::kGatewayTargetFailed, "unknown unit",
                         "unit " + std::to_string(unit) +
                             ", legal: " + std::to_string(map_.spec.unit) + ", 0 and 255"));
  }
  if (decoded.is_legal) return answer(task);
  return exception_response(function,
                            refuse(task, decoded.refusal, "illegal request", decoded.problem));
}

std::optional<Pdu> Server::handle(const Caller& caller, std::uint8_t unit, Bytes request,
                                  double now_s) {
  // On a serial line the other devices answer for themselves.
  if (caller.is_serial && !is_for_us(caller, unit)) return std::nullopt;
  restart_times(now_s);
  ++counts_.requests;
  const DecodedRequest decoded = decode_request(request);
  const Pdu response = respond({caller, decoded.request, now_s}, unit, decoded);
  if (caller.is_serial && unit == kBroadcastUnit) return std::nullopt;
  return response;
}

Pdu Server::answer(const Task& task) {
  const Function function = task.request.function;
  if (function == Function::kReadDeviceIdentification) {
    return device_id_response(map_.spec.identity, task.request);
  }
  return task.request.writes() ? answer_write(task) : answer_read(task, table_of(function));
}

Server::Refusal Server::check_read(const Task& task, Table table) {
  const int missing =
      image_.first_missing(table, task.request.read_address, task.request.read_count);
  return missing < 0 ? std::nullopt : Refusal(refuse_address(task, table, missing));
}

Pdu Server::answer_read(const Task& task, Table table) {
  const Request& request = task.request;
  if (const Refusal refusal = check_read(task, table)) {
    return exception_response(request.function, *refusal);
  }
  const int address = request.read_address, count = request.read_count;
  counts_.reads += request.read_count;
  if (is_bit_function(request.function)) {
    Pdu pdu = begin_read_response(request.function, packed_size(count));
    image_.pack_bits(table, address, count, pdu.append_zeros(packed_size(count)));
    return pdu;
  }
  Pdu pdu = begin_read_response(request.function, 2U * count);
  pdu.append(image_.registers(table, address, count));
  return pdu;
}

Pdu Server::answer_write(const Task& task) {
  const Request& request = task.request;
  // What cannot be read refuses the write of function 23, too: it is executed whole or not at all.
  Refusal refusal;
  if (request.read_count > 0) refusal = check_read(task, Table::kHolding);
  if (!refusal) refusal = write(task);
  if (refusal) return exception_response(request.function, *refusal);
  return request.read_count > 0 ? answer_read(task, Table::kHolding) : write_response(request);
}

Server::Refusal Server::write(const Task& task) {
  if (const Refusal refusal = plan_writes(task)) return refusal;
  counts_.writes += task.request.write_count;
  for (std::size_t i = 0; i < planned_; ++i) {
    const PlannedWrite& write = plan_[i];
    const RegisterEntry& entry = map_.entries[write.entry];
    const Span<std::uint8_t> wire = image_.wire(entry);
    std::copy(write.wire.begin(), write.wire.end(), wire.begin());
    writers_[write.entry] = {task.caller.id, task.now_s, entry.timeout.has_value()};
  }
  if (!events_.written) return std::nullopt;
  for (std::size_t i = 0; i < planned_; ++i) {
    events_.written(plan_[i].entry, plan_[i].value, false);
  }
  return std::nullopt;
}

Server::Refusal Server::plan_writes(const Task& task) {
  const Request& request = task.request;
  const Table table = table_of(request.function);
  const int end = request.write_address + request.write_count;
  planned_ = 0;
  for (int address = request.write_address; address < end;) {
    const int owner = image_.owner(table, address);
    if (owner < 0) return refuse_address(task, table, address);
    if (const Refusal refusal = plan_write(task, static_cast<std::size_t>(owner))) return refusal;
    address = map_.entries[static_cast<std::size_t>(owner)].end();
  }
  return std::nullopt;
}

Server::Refusal Server::plan_write(const Task& task, std::size_t index) {
  const RegisterEntry& entry = map_.entries[index];
  if (!entry.is_writable()) {
    return refuse(task, ExceptionCode::kIllegalAddress, "not writable",
                  entry.label() + " can only be read, legal: values of access write");
  }
  if (const Refusal refusal = check_part(task, entry)) return refusal;
  if (planned_ == plan_.size()) plan_.emplace_back();
  PlannedWrite& write = plan_[planned_++];
  const Bytes current = std::as_const(image_).wire(entry);
  write.entry = index;
  write.wire.assign(current.begin(), current.end());
  overlay(task, entry, write.wire);
  read_value(entry, write.wire, write.value);
  if (const Refusal refusal = check_writer(task, index)) return refusal;
  if (const Refusal refusal = check_value(task, index)) return refusal;
  return check_rate(task, index);
}

/// Half a value would be one that nobody meant. Of several values in a row some may be written.
Server::Refusal Server::check_part(const Task& task, const RegisterEntry& entry) {
  const int size = entry.is_bit() ? 1 : entry.layout.type.registers();
  const int begin = std::max<int>(task.request.write_address, entry.address);
  const int end = std::min(task.request.write_address + task.request.write_count, entry.end());
  if ((begin - entry.address) % size == 0 && (end - entry.address) % size == 0) return std::nullopt;
  return refuse(task, ExceptionCode::kIllegalAddress, "value in part",
                entry.label() + " takes " + address_text(entry) + ", legal: all of them at once");
}

void Server::overlay(const Task& task, const RegisterEntry& entry, Span<std::uint8_t> wire) const {
  const Request& request = task.request;
  const int begin = std::max<int>(request.write_address, entry.address);
  const int end = std::min(request.write_address + request.write_count, entry.end());
  for (int address = begin; address < end; ++address) {
    const std::size_t from = address - request.write_address, to = address - entry.address;
    if (entry.is_bit()) {
      wire[to] = (request.values[from / 8] >> (from % 8)) & 1U;
      continue;
    }
    std::uint16_t word = 0;
    if (request.function == Function::kMaskWriteRegister) {
      word = (word_at(wire, 2 * to) & request.and_mask) |
             (request.or_mask & static_cast<std::uint16_t>(~request.and_mask));
    } else {
      word = word_at(request.values, 2 * from);
    }
    wire[2 * to] = static_cast<std::uint8_t>(word >> 8);
    wire[2 * to + 1] = static_cast<std::uint8_t>(word & 0xFF);
  }
}

Server::Refusal Server::check_writer(const Task& task, std::size_t index) {
  const Writer& writer = writers_[index];
  const double held_s = task.now_s - writer.last_s;
  const bool is_free = writer.caller == kNobody || held_s >= map_.spec.hold;
  if (is_free || writer.caller == task.caller.id) return std::nullopt;
  return refuse(task, ExceptionCode::kBusy, "other writer",
                map_.entries[index].label() + " was written by another client " +
                    number_text(held_s) + " s ago, legal: after " + number_text(map_.spec.hold) +
                    " s");
}

Server::Refusal Server::check_value(const Task& task, std::size_t index) {
  const RegisterEntry& entry = map_.entries[index];
  for (const Number& number : plan_[planned_ - 1].value.numbers) {
    const double value = as_double(number);
    if (std::isfinite(value) && value >= entry.min.value_or(value) &&
        value <= entry.max.value_or(value)) {
      continue;
    }
    return refuse(task, ExceptionCode::kIllegalValue, "value out of range",
                  entry.label() + ": " + number_to_text(number) + ", legal: " + range_text(entry));
  }
  return std::nullopt;
}

Server::Refusal Server::check_rate(const Task& task, std::size_t index) {
  const RegisterEntry& entry = map_.entries[index];
  if (!entry.rate) return std::nullopt;
  // Half a step of the register: a ramp along the limit is rounded to steps.
  const double step = entry.layout.type.is_real() ? 1e-6 : 0.5;
  const double most =
      *entry.rate * (task.now_s - writers_[index].last_s) + step * std::abs(entry.scale);
  const Value before = value(index);
  const std::vector<Number>& numbers = plan_[planned_ - 1].value.numbers;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double change = std::abs(as_double(numbers[i]) - as_double(before.numbers[i]));
    if (change <= most || std::isnan(change)) continue;
    return refuse(task, ExceptionCode::kBusy, "rate",
                  entry.label() + ": change of " + number_text(change) + " in " +
                      number_text(task.now_s - writers_[index].last_s) +
                      " s, legal: " + number_text(*entry.rate) + " per s");
  }
  return std::nullopt;
}

ExceptionCode Server::refuse(const Task& task, ExceptionCode code, const std::string& kind,
                             const std::string& problem) {
  ++counts_.exceptions;
  if (events_.refused) {
    events_.refused(kind, task.caller.address + ": " + function_text(task.request.function) + ": " +
                              problem + "; " + exception_text(code));
  }
  return code;
}

ExceptionCode Server::refuse_address(const Task& task, Table table, int address) {
  return refuse(task, ExceptionCode::kIllegalAddress, "unknown address",
                "address " + std::to_string(address) + " of table " + table_text(table) +
                    ", legal: those of " + map_.file);
}

void Server::update(double now_s) {
  restart_times(now_s);
  for (std::size_t i = 0; i < writers_.size(); ++i) {
    const RegisterEntry& entry = map_.entries[i];
    if (!writers_[i].is_watched || now_s - writers_[i].last_s < *entry.timeout) continue;
    writers_[i].is_watched = false;
    ++counts_.safe;
    const Value& safe = entry.initial;
    write_value(entry, safe, image_.wire(entry));
    if (events_.written) events_.written(i, safe, true);
  }
}

void Server::release(std::uint32_t caller) {
  for (Writer& writer : writers_) {
    if (writer.caller == caller) writer.caller = kNobody;
  }
}

/// After a reset of the simulation a write lies in the future: it counts as of now.
void Server::restart_times(double now_s) {
  if (now_s < now_s_) {
    for (Writer& writer : writers_) writer.last_s = std::min(writer.last_s, now_s);
  }
  now_s_ = now_s;
}

Fit Server::set(std::size_t entry, const Value& value) {
  return write_value(map_.entries[entry], value, image_.wire(map_.entries[entry]));
}

Value Server::value(std::size_t entry) const {
  Value result;
  read_value(map_.entries[entry], image_.wire(map_.entries[entry]), result);
  return result;
}

}  // namespace trident::bridges::modbus
