// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace trident::bridges::modbus {

/// Types that the serialization of ROS 1 knows by itself.
enum class WireType {
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kTime,
  kDuration,
  kString,
  kMessage,  ///< fields of its own
};

/// Bytes that a value takes; 0: it depends on the value.
std::size_t wire_size(WireType type);

/// A field of a message.
struct MessageField {
  static constexpr int kSingle = -1;    ///< as `length`: no array
  static constexpr int kVariable = -2;  ///< as `length`: an array of any length

  std::string name;
  std::string type_text;               ///< as the definition has it, without brackets
  WireType type = WireType::kMessage;  ///< of an array: of its elements
  std::string message;                 ///< full name of a kMessage's type
  int length = kSingle;                ///< of a fixed array: its elements
};

/// The definition of a message type of ROS 1 and of those in it, as publishers send it in the
/// header of a connection: text of the type itself, and of each other one below a line of 80 "="
/// and "MSG: package/Type".
class MessageDefinition {
 public:
  /// Throws Error for a line that is no field, an unknown type, or a type that holds itself.
  MessageDefinition(std::string type, std::string text);

  const std::string& type() const { return type_; }  ///< "sensor_msgs/BatteryState"
  const std::string& text() const { return text_; }  ///< as it was given
  /// Fields of one of its types; that type must be known.
  const std::vector<MessageField>& fields(const std::string& type) const {
    return types_.at(type).fields;
  }
  /// Fields of the type itself.
  const std::vector<MessageField>& fields() const { return fields(type_); }
  /// The MD5 sum by which ROS 1 compares types.
  std::string md5sum() const { return md5sum_of(type_); }
  /// Whether the message begins with a std_msgs/Header.
  bool has_header() const;

 private:
  struct Type {
    std::vector<MessageField> fields;
    std::vector<std::string> constants;  ///< "type name=value"
  };

  void add_type(const std::string& name, const std::string& text);
  void check_types() const;
  void check_acyclic(const std::string& name, std::vector<std::string>& above) const;
  std::string md5sum_of(const std::string& name) const;

  std::string type_, text_;
  std::map<std::string, Type> types_;
};

/// Full names of the message types that the text of one definition uses: "std_msgs/Header". For a
/// program that collects them; lines that are no fields are left out.
std::vector<std::string> used_types(const std::string& type, const std::string& text);

}  // namespace trident::bridges::modbus
