// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/message_fields.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scalar_codec.h"
#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

constexpr int kMaxElement = 4096;  // of an array of any length, which must be that long then

/// What is still to be read of a message. A message that is too short is at its end.
class Cursor {
 public:
  explicit Cursor(Bytes bytes) : rest_(bytes) {}

  Bytes take(std::size_t size) {
    if (size > rest_.size()) {
      is_good_ = false;
      rest_ = {};
      return {};
    }
    const Bytes taken = rest_.first(size);
    rest_ = rest_.subspan(size);
    return taken;
  }
  /// The length in front of a text or an array.
  std::size_t length() {
    const Bytes bytes = take(4);
    return bytes.empty() ? 0 : static_cast<std::size_t>(scalar_bits(bytes));
  }
  std::size_t remaining() const { return rest_.size(); }
  bool is_good() const { return is_good_; }

 private:
  Bytes rest_;
  bool is_good_ = true;
};

void skip(const MessageDefinition& definition, const MessageField& field, Cursor& cursor);

void skip_elements(const MessageDefinition& definition, const MessageField& field,
                   std::size_t count, Cursor& cursor) {
  if (const std::size_t size = wire_size(field.type)) {
    cursor.take(size * count);
    return;
  }
  for (std::size_t i = 0; i < count && cursor.is_good(); ++i) {
    if (field.type == WireType::kString) {
      cursor.take(cursor.length());
      continue;
    }
    const std::size_t before = cursor.remaining();
    for (const MessageField& part : definition.fields(field.message)) {
      skip(definition, part, cursor);
    }
    if (cursor.remaining() == before) return;  // empty ones, however many there are
  }
}

std::size_t elements_of(const MessageField& field, Cursor& cursor) {
  if (field.length == MessageField::kSingle) return 1;
  return field.length == MessageField::kVariable ? cursor.length()
                                                 : static_cast<std::size_t>(field.length);
}

void skip(const MessageDefinition& definition, const MessageField& field, Cursor& cursor) {
  skip_elements(definition, field, elements_of(field, cursor), cursor);
}

/// The field of a type by its name; throws Error with the nearest one.
const MessageField& field_named(const MessageDefinition& definition, const std::string& type,
                                const std::string& name) {
  const auto& fields = definition.fields(type);
  std::vector<std::string> names;
  for (const MessageField& field : fields) {
    if (field.name == name) return field;
    names.push_back(field.name);
  }
  throw Error(type + " has no field " + unknown_name_text(name, names));
}

void check_element(const PathStep& step, const MessageField& field) {
  if (step.element == PathStep::kWhole) return;
  const int count = field.length == MessageField::kVariable ? kMaxElement : field.length;
  if (field.length == MessageField::kSingle) {
    throw Error("field '" + field.name + "' is no array");
  }
  if (step.element >= count) {
    throw Error("element " + std::to_string(step.element) + " of '" + field.name +
                "', legal: 0 to " + std::to_string(count - 1));
  }
}

/// The field that a path leads to, checked.
MessageField target_of(const MessageDefinition& definition, const std::vector<PathStep>& steps) {
  std::string type = definition.type();
  MessageField field;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    field = field_named(definition, type, steps[i].name);
    check_element(steps[i], field);
    const bool is_last = i + 1 == steps.size();
    const bool is_array =
        field.length != MessageField::kSingle && steps[i].element == PathStep::kWhole;
    if (is_last == (field.type == WireType::kMessage)) {
      throw Error("field '" + field.name + "' of " + type + " is " +
                  (is_last ? "a " + field.message + ", legal: a number or a text in it"
                           : "a " + field.type_text + ", which has no fields"));
    }
    if (is_array && (!is_last || field.type == WireType::kString)) {
      throw Error("field '" + field.name + "' of " + type +
                  " is an array, of which one element must be named: " + field.name + "[0]");
    }
    type = field.message;
  }
  return field;
}

}  // namespace

std::vector<PathStep> parse_field_path(const std::string& path) {
  std::vector<PathStep> steps;
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    PathStep step{path.substr(begin, end - begin)};
    if (const std::size_t open = step.name.find('['); open != std::string::npos) {
      const auto number =
          step.name.back() == ']'
              ? number_from_text(step.name.substr(open + 1, step.name.size() - open - 2))
              : std::nullopt;
      if (!number || *number < 0 || *number > kMaxElement || *number != std::floor(*number)) {
        throw Error("field '" + path + "': '" + step.name + "', legal: name[0] to name[4096]");
      }
      step.element = static_cast<int>(*number);
      step.name.resize(open);
    }
    if (step.name.empty()) throw Error("field '" + path + "', legal: names with dots between them");
    steps.push_back(std::move(step));
    begin = end + 1;
  }
  return steps;
}

FieldReader::FieldReader(MessageDefinition definition, const std::string& path)
    : definition_(std::move(definition)),
      steps_(parse_field_path(path)),
      target_(target_of(definition_, steps_)),
      is_array_(target_.length != MessageField::kSingle &&
                steps_.back().element == PathStep::kWhole) {}

bool FieldReader::read(Bytes message, Value& value) const {
  value.numbers.clear();
  value.text.clear();
  Cursor cursor(message);
  const std::string* type = &definition_.type();
  std::size_t count = 1;
  for (const PathStep& step : steps_) {
    const MessageField* found = nullptr;
    for (const MessageField& field : definition_.fields(*type)) {
      found = &field;
      if (field.name == step.name) break;
      skip(definition_, field, cursor);
    }
    count = elements_of(*found, cursor);
    if (step.element != PathStep::kWhole) {
      if (static_cast<std::size_t>(step.element) >= count) return false;
      skip_elements(definition_, *found, static_cast<std::size_t>(step.element), cursor);
      count = 1;
    }
    type = &found->message;
  }
  if (target_.type == WireType::kString) {
    const Bytes text = cursor.take(cursor.length());
    value.text.assign(text.begin(), text.end());
    return cursor.is_good();
  }
  const std::size_t size = wire_size(target_.type);
  for (std::size_t i = 0; i < count && cursor.is_good(); ++i) {
    const Bytes bytes = cursor.take(size);
    if (!bytes.empty()) value.numbers.push_back(read_scalar(target_.type, bytes));
  }
  return cursor.is_good();
}

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
      Paths own;
      for (const std::size_t path : paths) {
        if (steps_[path].size() > depth && steps_[path][depth].name == field.name) {
          own.push_back(path);
        }
      }
      if (is_header && own.empty()) {
        add_header();
      } else {
        add_field(field, own, depth);
      }
      is_header = false;
    }
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
    int count = std::max(field.length, 0);
    if (field.length == MessageField::kVariable) {
      for (const std::size_t path : paths) count = std::max(count, steps_[path][depth].element + 1);
      write_scalar(WireType::kUint32, Number{std::int64_t{count}}, pieces_.back().constant);
    }
    for (int i = 0; i < count; ++i) {
      Paths own;
      for (const std::size_t path : paths) {
        if (steps_[path][depth].element == i) own.push_back(path);
      }
      add_element(field, own, depth);
    }
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

void MessageWriter::write(Span<const Value> values, std::uint32_t stamp_s, std::uint32_t stamp_ns,
                          std::vector<std::uint8_t>& out) const {
  const auto word = [&out](std::uint64_t value) {
    write_scalar(WireType::kUint32, Number{value}, out);
  };
  for (const Piece& piece : pieces_) {
    out.insert(out.end(), piece.constant.begin(), piece.constant.end());
    if (piece.value == Piece::kNothing) continue;
    if (piece.value == Piece::kStamp) {
      word(stamp_s);
      word(stamp_ns);
      continue;
    }
    const Value& value = values[static_cast<std::size_t>(piece.value)];
    if (piece.type == WireType::kString) {
      word(value.text.size());
      out.insert(out.end(), value.text.begin(), value.text.end());
      continue;
    }
    std::size_t count = 1;
    if (piece.length == MessageField::kVariable) word(count = value.numbers.size());
    if (piece.length >= 0) count = static_cast<std::size_t>(piece.length);
    for (std::size_t i = 0; i < count; ++i) {
      write_scalar(piece.type, i < value.numbers.size() ? value.numbers[i] : Number{}, out);
    }
  }
}

}  // namespace trident::bridges::modbus
