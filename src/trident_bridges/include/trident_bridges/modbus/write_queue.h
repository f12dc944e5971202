// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "trident_bridges/modbus/pdu.h"
#include "trident_bridges/modbus/register_map.h"

namespace trident::bridges::modbus {

/// One request that writes neighbors.
struct WriteBatch {
  Pdu pdu;                           ///< of function 5, 6, 15 or 16
  std::vector<std::size_t> entries;  ///< in the order of their addresses
};

/// The values that a client is to write: the newest of each entry, which is written when it has
/// changed.
class WriteQueue {
 public:
  /// `map` must outlive the queue.
  explicit WriteQueue(const RegisterMap& map);

  /// What became of a value that was set.
  enum class Outcome {
    kQueued,     ///< will be written
    kUnchanged,  ///< the device has it
    kRefused,    ///< is out of [min, max], or not finite
  };
  /// See Client::set().
  Outcome set(std::size_t entry, const Value& value, double time_s);
  /// The next request, whose entries are in flight until one of the next three is called.
  std::optional<WriteBatch> take();
  /// The device has taken them.
  void accept(const std::vector<std::size_t>& entries);
  /// The device has refused them. Of several it is not known which; each is written alone then.
  /// Returns whether they will be tried again.
  bool refuse(const std::vector<std::size_t>& entries);
  /// They were lost: commands with a timeout are dropped, others stay due.
  void lose(const std::vector<std::size_t>& entries);
  /// All that was written may be forgotten by the device.
  void restart();

 private:
  struct State {
    std::vector<std::uint8_t> wanted;  ///< as on the wire; empty: nothing yet
    std::vector<std::uint8_t> sent;    ///< empty: the device may have anything
    double last_s = -1e18;             ///< when it was queued last, in simulated time
    bool is_due = false, is_in_flight = false;
    bool is_alone = false;  ///< is not written with others
  };
  bool may_join(const RegisterEntry& first, const RegisterEntry& last, std::size_t next) const;
  std::vector<std::size_t> joined(std::size_t begin) const;
  std::vector<std::uint8_t> values_of(const std::vector<std::size_t>& entries) const;
  Pdu request(const std::vector<std::size_t>& entries) const;

  const RegisterMap& map_;
  std::vector<std::size_t> order_;  ///< entries that may be written, by table and address
  std::vector<State> states_;       ///< of each entry
  std::size_t next_ = 0;            ///< place in order_ where the search for one that is due begins
};

}  // namespace trident::bridges::modbus
