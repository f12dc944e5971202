// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/modbus/message_fields.h"

#include <utility>

#include "field_path.h"
#include "scalar_codec.h"

namespace trident::bridges::modbus {
namespace {

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

/// Skips what stands in front of a field.
const MessageField& skip_to(const std::string& name, const MessageDefinition& definition,
                            const std::string& type, Cursor& cursor) {
  const MessageField* found = nullptr;
  for (const MessageField& field : definition.fields(type)) {
    found = &field;
    if (field.name == name) break;
    skip(definition, field, cursor);
  }
  return *found;
}

/// Reads as many elements of a number or a text as there are.
bool read_elements(WireType type, std::size_t count, Cursor& cursor, Value& value) {
  if (type == WireType::kString) {
    const Bytes text = cursor.take(cursor.length());
    value.text.assign(text.begin(), text.end());
    return cursor.is_good();
  }
  const std::size_t size = wire_size(type);
  for (std::size_t i = 0; i < count && cursor.is_good(); ++i) {
    const Bytes bytes = cursor.take(size);
    if (!bytes.empty()) value.numbers.push_back(read_scalar(type, bytes));
  }
  return cursor.is_good();
}

}  // namespace

FieldReader::FieldReader(MessageDefinition definition, const std::string& path)
    : definition_(std::move(definition)),
      steps_(parse_field_path(path)),
      target_(target_of(definition_, steps_)),
      is_array_(is_whole_array(steps_.back(), target_)) {}

bool FieldReader::read(Bytes message, Value& value) const {
  value.numbers.clear();
  value.text.clear();
  Cursor cursor(message);
  const std::string* type = &definition_.type();
  std::size_t count = 1;
  for (const PathStep& step : steps_) {
    const MessageField& field = skip_to(step.name, definition_, *type, cursor);
    count = elements_of(field, cursor);
    if (step.element != PathStep::kWhole) {
      if (static_cast<std::size_t>(step.element) >= count) return false;
      skip_elements(definition_, field, static_cast<std::size_t>(step.element), cursor);
      count = 1;
    }
    type = &field.message;
  }
  return read_elements(target_.type, count, cursor, value);
}

}  // namespace trident::bridges::modbus
