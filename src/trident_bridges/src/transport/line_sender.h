// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "transport/byte_queue.h"
#include "transport/endpoint_base.h"

namespace trident::bridges {

/// When blocks leave a line that carries one byte after another. A block leaves whole at the
/// instant at which its last byte would have left: a reader takes a pause within a Modbus frame for
/// the frame's end ("MODBUS over Serial Line" V1.02, 2.5.1.1).
class LineSchedule {
 public:
  /// `byte_s`: of a byte with its start, parity and stop bits [s]; 0: blocks leave at once.
  explicit LineSchedule(double byte_s) : byte_s_(byte_s) {}

  /// When a block leaves that is handed in at `now_s`, after those before it [s].
  double leave_s(double now_s, std::size_t bytes) {
    if (free_s_ < now_s) free_s_ = now_s;
    free_s_ += byte_s_ * static_cast<double>(bytes);
    return free_s_;
  }
  /// The line stood still until now: the reader took nothing.
  void hold(double now_s) {
    if (free_s_ < now_s) free_s_ = now_s;
  }

 private:
  double byte_s_;
  double free_s_ = 0.0;  ///< when the last block that was handed in has left
};

/// Sends blocks through a serial line or a pseudo-terminal at the line's speed.
class LineSender {
 public:
  /// `byte_s` as of LineSchedule. What waits is limited to `queue_bytes` and to what the line
  /// carries in a second, at least kMinQueue: what is older is of no use. `loop` and `counts` must
  /// outlive it.
  LineSender(PollLoop& loop, EndpointCounts& counts, double byte_s, std::size_t queue_bytes);

  static constexpr std::size_t kMinQueue = 4096;  ///< bytes

  /// Writes to this descriptor from now on, which the loop watches for kReadable.
  void attach(int descriptor);
  /// Writes no more, and forgets what waits.
  void detach();
  /// Takes a block; false, and it is counted as cut, when it does not fit what waits.
  bool take(Bytes block);
  /// Continues: the descriptor can be written to.
  void write();

 private:
  void begin_block(double handed_in_s);
  void write_some();
  void set_blocked(bool is_blocked);

  PollLoop& loop_;
  EndpointCounts& counts_;
  LineSchedule schedule_;
  ByteQueue queue_;  ///< before each block its length, four bytes
  int descriptor_ = -1;
  std::uint32_t rest_ = 0;   ///< bytes of the first block that are not written
  bool is_blocked_ = false;  ///< the descriptor takes nothing now
  DelayedCall departure_;    ///< of the first block
};

}  // namespace trident::bridges
