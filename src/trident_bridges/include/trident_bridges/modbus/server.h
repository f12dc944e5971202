// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/modbus/pdu.h"
#include "trident_bridges/modbus/register_image.h"
#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// Who sends a request.
struct Caller {
  std::uint32_t id = 1;    ///< of the connection, from 1; a serial line has one for all masters
  std::string address;     ///< for messages: "tcp 127.0.0.1:40012"
  bool is_serial = false;  ///< requests for other units are not answered, and unit 0 is all of them
};

/// What a server reports to its owner, during its calls.
struct ServerEvents {
  /// A value was written by a client and accepted, or has become its safe value since the writer is
  /// silent. The number is that of RegisterMap::entries.
  std::function<void(std::size_t entry, const Value& value, bool is_safe)> written;
  /// A request was refused: its kind, of a small set, and a sentence with the caller, the field,
  /// its value and the legal range.
  std::function<void(const std::string& kind, const std::string& text)> refused;
};

/// What a server has done since it was made.
struct ServerCounts {
  std::uint64_t requests = 0;    ///< for this device
  std::uint64_t exceptions = 0;  ///< of those, refused
  std::uint64_t reads = 0;       ///< registers and bits that were read
  std::uint64_t writes = 0;      ///< registers and bits that were written
  std::uint64_t safe = 0;        ///< values that became safe as their writer fell silent
};

/// A Modbus device: answers requests by a map, without sockets and clocks. Times are those of the
/// simulation, in seconds, and come with the calls; one that jumps back restarts all limits.
///
/// A write is executed whole or refused whole: by exception 2 where an address is not there or not
/// writable, or where it covers a value in part; by 3 where a value is not finite or out of
/// [min, max]; by 6 where it changes faster than `rate`, or where another client wrote the value
/// less than `hold` ago. A value with `timeout` becomes `safe` when no write of it was accepted for
/// so long.
class Server {
 public:
  /// All values are initial ones.
  Server(RegisterMap map, ServerEvents events);

  /// Answers a request of any bytes. Empty: nothing is to be sent, as the request is for another
  /// unit of a serial line, or for all.
  std::optional<Pdu> handle(const Caller& caller, std::uint8_t unit, Bytes request, double now_s);
  /// Makes values safe whose writer is silent.
  void update(double now_s);
  /// A connection has ended: others may write at once.
  void release(std::uint32_t caller);

  /// Sets the value of an entry; what does not fit is clamped, NaN of an integer is left out.
  Fit set(std::size_t entry, const Value& value);
  /// The value of an entry.
  Value value(std::size_t entry) const;
  const RegisterMap& map() const { return map_; }         ///< as it was given
  const ServerCounts& counts() const { return counts_; }  ///< since it was made

 private:
  static constexpr std::uint32_t kNobody = 0;  ///< as Caller::id
  /// The writer of an entry.
  struct Writer {
    std::uint32_t caller = kNobody;
    double last_s = -1e18;    ///< of the last accepted write
    bool is_watched = false;  ///< becomes safe after the entry's timeout
  };
  /// A request that is being answered.
  struct Task {
    const Caller& caller;
    const Request& request;
    double now_s;
  };
  /// A value that a request writes.
  struct PlannedWrite {
    std::size_t entry = 0;
    std::vector<std::uint8_t> wire;
    Value value;
  };
  using Refusal = std::optional<ExceptionCode>;

  bool is_for_us(const Caller& caller, std::uint8_t unit) const;
  Pdu respond(const Task& task, std::uint8_t unit, const DecodedRequest& decoded);
  Pdu answer(const Task& task);
  Pdu answer_read(const Task& task, Table table);
  Pdu answer_write(const Task& task);
  Refusal check_read(const Task& task, Table table);
  Refusal write(const Task& task);
  Refusal plan_writes(const Task& task);
  Refusal plan_write(const Task& task, std::size_t entry);
  Refusal check_part(const Task& task, const RegisterEntry& entry);
  Refusal check_value(const Task& task, std::size_t entry);
  Refusal check_rate(const Task& task, std::size_t entry);
  Refusal check_writer(const Task& task, std::size_t entry);
  void overlay(const Task& task, const RegisterEntry& entry, Span<std::uint8_t> wire) const;
  ExceptionCode refuse(const Task& task, ExceptionCode code, const std::string& kind,
                       const std::string& problem);
  ExceptionCode refuse_address(const Task& task, Table table, int address);
  void restart_times(double now_s);

  RegisterMap map_;
  ServerEvents events_;
  RegisterImage image_;
  std::vector<Writer> writers_;  ///< of each entry
  std::vector<PlannedWrite> plan_;
  std::size_t planned_ = 0;  ///< of `plan_` count in this request
  double now_s_ = -1e18;
  ServerCounts counts_;
};

}  // namespace trident::bridges::modbus
