// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "field_path.h"
#include "scalar_codec.h"
#include "trident_base/error.h"
#include "trident_bridges/modbus/message_fields.h"

namespace trident::bridges::modbus {
namespace {

void append_word(std::uint64_t value, std::vector<std::uint8_t>& out) {
  write_scalar(WireType::kUint32, Number{value}, out);
}

}  // namespace

/// Builds the pieces of a writer by going through the definition.
class WriterBuilder {
 public:
  WriterBuilder(const MessageDefinition& definition, const std::vector<std::string>& paths,
                std::vector<MessageWriter::Piece>& pieces)
      : definition_(definition), pieces_(pieces) {
    for (const std::string& path : paths) {
      steps_.push_back(parse_field_path(path));
      target_of(definition, steps_.back());
    }
    pieces_.emplace_back();
  }

  void build() {
    std::vector<std::size_t> all(steps_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    add_message(definition_.type(), all, 0, definition_.has_header());
  }

 private:
  using Paths = std::vector<std::size_t>;  ///< numbers of paths that lead through a place
  using Piece = MessageWriter::Piece;

  void add_message(const std::string& type, const Paths& paths, std::size_t depth,
                   bool begins_with_header) {
    bool is_header = begins_with_header;
    for (const MessageField& field : definition_.fields(type)) {
      const Paths own = paths_to(field.name, paths, depth);
      if (is_header && own.empty()) {
        add_header();
      } else {
        add_field(field, own, depth);
      }
      is_header = false;
    }
  }

  Paths paths_to(const std::string& name, const Paths& paths, std::size_t depth) const {
    Paths own;
    for (const std::size_t path : paths) {
      if (steps_[path].size() > depth && steps_[path][depth].name == name) own.push_back(path);
    }
    return own;
  }
  Paths paths_to_element(int element, const Paths& paths, std::size_t depth) const {
    Paths own;
    for (const std::size_t path : paths) {
      if (steps_[path][depth].element == element) own.push_back(path);
    }
    return own;
  }

  /// Sequence number, stamp, frame.
  void add_header() {
    add_zeros(4);
    finish_piece({{}, Piece::kStamp, WireType::kTime, MessageField::kSingle});
    add_zeros(4);
  }

  void add_field(const MessageField& field, const Paths& paths, std::size_t depth) {
    if (field.length == MessageField::kSingle) return add_element(field, paths, depth);
    if (!paths.empty() && steps_[paths[0]][depth].element == PathStep::kWhole) {
      check_single(field, paths);
      return finish_piece({{}, static_cast<int>(paths[0]), field.type, field.length});
    }
    const int count = begin_array(field, paths, depth);
    for (int i = 0; i < count; ++i) add_element(field, paths_to_element(i, paths, depth), depth);
  }

  /// The number of elements; of an array of any length those that the paths need, written in front.
  int begin_array(const MessageField& field, const Paths& paths, std::size_t depth) {
    int count = std::max(field.length, 0);
    if (field.length != MessageField::kVariable) return count;
    for (const std::size_t path : paths) count = std::max(count, steps_[path][depth].element + 1);
    write_scalar(WireType::kUint32, Number{std::int64_t{count}}, pieces_.back().constant);
    return count;
  }

  void add_element(const MessageField& field, const Paths& paths, std::size_t depth) {
    if (field.type == WireType::kMessage) {
      add_message(field.message, paths, depth + 1, false);
    } else if (paths.empty()) {
      add_zeros(field.type == WireType::kString ? 4 : wire_size(field.type));
    } else {
      check_single(field, paths);
      finish_piece({{}, static_cast<int>(paths[0]), field.type, MessageField::kSingle});
    }
  }

  static void check_single(const MessageField& field, const Paths& paths) {
    if (paths.size() > 1) throw Error("field '" + field.name + "' is set by two values");
  }

  void add_zeros(std::size_t count) {
    std::vector<std::uint8_t>& constant = pieces_.back().constant;
    constant.resize(constant.size() + count);
  }
  /// Gives the last piece its value, and begins another one.
  void finish_piece(Piece value) {
    value.constant = std::move(pieces_.back().constant);
    pieces_.back() = std::move(value);
    pieces_.emplace_back();
  }

  const MessageDefinition& definition_;
  std::vector<MessageWriter::Piece>& pieces_;
  std::vector<std::vector<PathStep>> steps_;
};

MessageWriter::MessageWriter(const MessageDefinition& definition,
                             const std::vector<std::string>& paths) {
  WriterBuilder(definition, paths, pieces_).build();
}

/// As many as the field has; of an array of any length, all, with their number in front.
void MessageWriter::append_numbers(const Piece& piece, const std::vector<Number>& numbers,
                                   std::vector<std::uint8_t>& out) {
  std::size_t count = 1;
  if (piece.length == MessageField::kVariable) append_word(count = numbers.size(), out);
  if (piece.length >= 0) count = static_cast<std::size_t>(piece.length);
  for (std::size_t i = 0; i < count; ++i) {
    write_scalar(piece.type, i < numbers.size() ? numbers[i] : Number{}, out);
  }
}

void MessageWriter::write(Span<const Value> values, std::uint32_t stamp_s, std::uint32_t stamp_ns,
                          std::vector<std::uint8_t>& out) const {
  for (const Piece& piece : pieces_) {
    out.insert(out.end(), piece.constant.begin(), piece.constant.end());
    if (piece.value == Piece::kNothing) continue;
    if (piece.value == Piece::kStamp) {
      append_word(stamp_s, out);
      append_word(stamp_ns, out);
      continue;
    }
    const Value& value = values[static_cast<std::size_t>(piece.value)];
    if (piece.type == WireType::kString) {
      append_word(value.text.size(), out);
      out.insert(out.end(), value.text.begin(), value.text.end());
    } else {
      append_numbers(piece, value.numbers, out);
    }
  }
}

}  // namespace trident::bridges::modbus
