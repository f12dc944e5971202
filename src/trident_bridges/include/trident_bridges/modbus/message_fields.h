// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "trident_bridges/modbus/message_definition.h"
#include "trident_bridges/modbus/pdu.h"
#include "trident_bridges/modbus/value.h"

namespace trident::bridges::modbus {

/// One step of a field's path: a name, and which element of an array.
struct PathStep {
  static constexpr int kWhole = -1;  ///< as `element`: no element, or all of them
  std::string name;
  int element = kWhole;
};

/// "pose.covariance[3]" in its steps. Throws Error for what is no path.
std::vector<PathStep> parse_field_path(const std::string& path);

/// Reads a field of serialized messages of one type: a number, the elements of an array of numbers,
/// a text; bool is 0 or 1, time and duration are seconds.
class FieldReader {
 public:
  /// Throws Error for a path that does not lead to such a field, with the nearest name.
  FieldReader(MessageDefinition definition, const std::string& path);

  /// Reads the field into `value`. False: the bytes are no such message, or have no such element.
  bool read(Bytes message, Value& value) const;
  /// The field that the path leads to.
  const MessageField& field() const { return target_; }
  /// Whether the path leads to all elements of an array.
  bool is_array() const { return is_array_; }

 private:
  MessageDefinition definition_;
  std::vector<PathStep> steps_;
  MessageField target_;
  bool is_array_ = false;
};

/// Writes serialized messages of one type in which some fields have values, and all others are zero
/// or empty. A header's stamp is the time that is given.
class MessageWriter {
 public:
  /// Throws Error for a path that does not lead to a number, an array of numbers or a text.
  /// `paths`: of the fields, in the order of the values.
  MessageWriter(const MessageDefinition& definition, const std::vector<std::string>& paths);

  /// Appends a message to `out`. As many values as paths; elements that are missing are zero, a
  /// number that the field cannot hold is the nearest one that it can. A fixed array takes as many
  /// elements as it has.
  void write(Span<const Value> values, std::uint32_t stamp_s, std::uint32_t stamp_ns,
             std::vector<std::uint8_t>& out) const;

 private:
  friend class WriterBuilder;
  /// Bytes that are always the same, and behind them what one value or the stamp is written to.
  struct Piece {
    static constexpr int kNothing = -1, kStamp = -2;  ///< as `value`
    std::vector<std::uint8_t> constant;
    int value = kNothing;  ///< number of a path
    WireType type{};       ///< of the value, or of its elements
    int length = MessageField::kSingle;
  };

  static void append_numbers(const Piece& piece, const std::vector<Number>& numbers,
                             std::vector<std::uint8_t>& out);

  std::vector<Piece> pieces_;
};

}  // namespace trident::bridges::modbus
