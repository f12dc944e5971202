// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/modbus/pdu.h"
#include "trident_bridges/modbus/read_blocks.h"
#include "trident_bridges/modbus/register_map.h"
#include "trident_bridges/modbus/response.h"
#include "trident_bridges/modbus/write_queue.h"

namespace trident::bridges::modbus {

/// What a client reports to its owner, during its calls.
struct ClientEvents {
  /// A value was read that has changed, or is published at each poll (RegisterEntry::publish). The
  /// number is that of RegisterMap::entries.
  std::function<void(std::size_t entry, const Value& value)> read;
  /// Something failed: its kind, of a small set, and a sentence with the field, its value and what
  /// is legal.
  std::function<void(const std::string& kind, const std::string& text)> failed;
  /// The device answers again, or does not any more.
  std::function<void(bool answers)> answering;
};

/// What a client has done since it was made.
struct ClientCounts {
  std::uint64_t requests = 0;    ///< that were sent, retries included
  std::uint64_t responses = 0;   ///< that answered one of them
  std::uint64_t registers = 0;   ///< registers and bits that were read
  std::uint64_t writes = 0;      ///< values that were written
  std::uint64_t exceptions = 0;  ///< requests that the device refused
  std::uint64_t timeouts = 0;    ///< requests without an answer
  std::uint64_t malformed = 0;   ///< answers that do not fit their request
  std::uint64_t late = 0;        ///< answers to nothing, or to what had timed out
  std::uint64_t skipped = 0;     ///< blocks that were not read when they were due again
};

/// A request that is to be sent.
struct Outgoing {
  std::uint16_t transaction = 0;  ///< to be repeated by the answer, over TCP
  std::uint8_t unit = 0;          ///< of the device
  Pdu pdu;
};

/// A client of one Modbus device: reads the values of a map in blocks, and writes those that
/// change, without sockets and clocks. Times are wall time in seconds and come with the calls.
/// The owner sends what next() returns until it returns nothing, after each other call.
class Client {
 public:
  /// `may_pipeline`: several requests may be in flight, as over TCP; on a serial line only one.
  Client(RegisterMap map, bool may_pipeline, ClientEvents events);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// All blocks are due to be read. Those that still are due from the last time are counted.
  void poll();
  /// A value is to be written, if it has changed, or if the device would take its writer for silent
  /// (after a third of the entry's timeout; `time_s` is of the simulation). One out of [min, max]
  /// is refused.
  void set(std::size_t entry, const Value& value, double time_s);
  /// The next request that may be sent.
  std::optional<Outgoing> next(double now_s);
  /// An answer has come. `transaction` is empty on a serial line.
  void receive(std::optional<std::uint16_t> transaction, std::uint8_t unit, Bytes pdu);
  /// Gives up requests whose answer is overdue.
  void update(double now_s);
  /// When update() has something to do; empty: nothing is in flight.
  std::optional<double> deadline_s() const;
  /// The connection has ended: what is in flight is lost, and commands that the device may have
  /// forgotten are due again, but for those with a timeout, which are too old by then.
  void disconnect();

  bool is_answering() const { return is_answering_; }     ///< the last request was answered
  const RegisterMap& map() const { return map_; }         ///< as it was given
  const ClientCounts& counts() const { return counts_; }  ///< since it was made

 private:
  /// A request without an answer.
  struct Transaction {
    std::uint16_t number = 0;
    Pdu pdu;
    std::optional<std::size_t> block;  ///< that is read
    std::vector<std::size_t> writes;   ///< entries that are written
    int attempts = 0;
    double deadline_s = 0.0;
  };
  /// A block's part in the polling.
  struct BlockState {
    bool is_due = false, is_in_flight = false;
    std::vector<std::uint8_t> last;  ///< what was read: two bytes a register, one a bit
  };

  std::optional<Transaction> make_write();
  std::optional<Transaction> make_read();
  Outgoing send(Transaction transaction, double now_s);
  void finish(const Transaction& transaction, const Response& response);
  void report_if_new(std::size_t block, std::size_t number, Bytes all);
  void finish_read(std::size_t block, const Response& response);
  void finish_write(const Transaction& transaction, const Response& response);
  void give_up(const Transaction& transaction);
  void set_answering(bool answers);
  void fail(const std::string& kind, const std::string& text);

  RegisterMap map_;
  ClientEvents events_;
  std::size_t max_in_flight_;
  std::vector<ReadBlock> blocks_;
  std::vector<BlockState> states_;
  std::size_t next_block_ = 0;  ///< where the search for one that is due begins
  WriteQueue writes_;
  std::vector<Transaction> in_flight_, retries_;
  std::uint16_t last_number_ = 0;
  bool is_answering_ = false;
  Value value_;  ///< storage that is used again
  ClientCounts counts_;
};

}  // namespace trident::bridges::modbus
