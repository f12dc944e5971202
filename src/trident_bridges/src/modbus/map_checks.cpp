// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "map_checks.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "ros_names.h"
#include "trident_base/string_util.h"

namespace trident::bridges::modbus {
namespace {

/// The check of one register: the fields of the file, and the entry that they make.
class EntryChecks {
 public:
  EntryChecks(const RegisterSpec& spec, const MapSpec& map, const EntrySource& source)
      : spec_(spec), map_(map), source_(source) {}

  RegisterEntry entry() {
    copy_fields();
    place();
    choose_type();
    check_size();
    check_access();
    check_limits();
    choose_message();
    set_initial();
    return std::move(entry_);
  }

 private:
  /// Throws the error of one key, at its line.
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const {
    const ConfigNode* const value = source_.item.find(key);
    throw ConfigError(source_.file, value != nullptr ? value->line : source_.item.line,
                      source_.path + "." + key, problem);
  }
  void copy_fields();
  void place();
  void place_modicon();
  void choose_type();
  ValueType read_type() const;
  void check_size() const;
  void check_scale() const;
  void check_access() const;
  void check_keys_of_writes() const;
  void check_limits() const;
  void check_safe() const;
  void choose_message();
  void check_names() const;
  void check_bits() const;
  void set_initial();

  const RegisterSpec& spec_;
  const MapSpec& map_;
  const EntrySource& source_;
  RegisterEntry entry_;
};

void EntryChecks::copy_fields() {
  entry_.name = spec_.name;
  entry_.line = source_.item.line;
  entry_.scale = spec_.scale;
  entry_.offset = spec_.offset;
  entry_.access = spec_.access;
  entry_.min = spec_.min;
  entry_.max = spec_.max;
  entry_.rate = spec_.rate;
  entry_.safe = spec_.safe;
  entry_.timeout = spec_.timeout;
  entry_.publish = spec_.publish;
  entry_.topic = spec_.topic;
  entry_.field = spec_.field;
  entry_.unit = spec_.unit;
  entry_.doc = spec_.doc;
  entry_.layout.words = spec_.words;
  entry_.layout.bytes = spec_.bytes;
  entry_.layout.count = spec_.count;
}

void EntryChecks::place() {
  if (map_.numbering == Numbering::kModicon) return place_modicon();
  if (!spec_.table) fail("table", "is required; legal: coil, discrete, input, holding");
  if (spec_.address >= kTableAddresses) {
    fail("address", std::to_string(spec_.address) + ", legal: 0 to 65535");
  }
  entry_.table = *spec_.table;
  entry_.address = static_cast<int>(spec_.address);
}

/// Five or six digits, of which the first is the table: 40001 and 400001 are the first holding
/// register.
void EntryChecks::place_modicon() {
  const std::uint32_t digit = spec_.address > 99'999 ? 100'000 : 10'000;
  const std::uint32_t table = spec_.address / digit, number = spec_.address % digit;
  const std::array<std::pair<std::uint32_t, Table>, 4> tables{
      {{0, Table::kCoil}, {1, Table::kDiscrete}, {3, Table::kInput}, {4, Table::kHolding}}};
  const auto* const found = std::find_if(tables.begin(), tables.end(),
                                         [&](const auto& row) { return row.first == table; });
  if (found == tables.end() || number == 0 || number > kTableAddresses) {
    fail("address", std::to_string(spec_.address) +
                        ", legal: 1 to 9999 coil, 10001 to 19999 discrete, 30001 to 39999 input, "
                        "40001 to 49999 holding, or with six digits 300001 to 365536 and so forth");
  }
  if (spec_.table && *spec_.table != found->second) {
    fail("table", table_text(*spec_.table) + ", but address " + std::to_string(spec_.address) +
                      " is that of table " + table_text(found->second));
  }
  entry_.table = found->second;
  entry_.address = static_cast<int>(number - 1);
}

ValueType EntryChecks::read_type() const {
  try {
    return parse_value_type(*spec_.type);
  } catch (const ConfigError&) {
    throw;
  } catch (const Error& error) {
    fail("type", error.what());
  }
}

void EntryChecks::choose_type() {
  ValueType& type = entry_.layout.type;
  type.kind = entry_.is_bit() ? ValueKind::kBool : ValueKind::kUint16;
  if (!spec_.type) return;
  type = read_type();
  if (entry_.is_bit() && type.kind != ValueKind::kBool) {
    fail("type", type.text() + " of table " + table_text(entry_.table) + ", legal: bool");
  }
}

bool is_number(const ValueType& type) { return type.is_integer() || type.is_real(); }

/// Whether several values of the entry may be one array.
bool may_be_array(const RegisterEntry& entry) {
  const ValueType& type = entry.layout.type;
  return entry.is_bit() || type.kind == ValueKind::kBool || is_number(type);
}

/// One value is read and written by one request, so that its parts are always of one moment.
int most_addresses(const RegisterEntry& entry) {
  if (entry.is_bit()) return entry.is_writable() ? kMaxWriteBits : kMaxReadBits;
  return entry.is_writable() ? kMaxWriteRegisters : kMaxReadRegisters;
}

void EntryChecks::check_size() const {
  if (!may_be_array(entry_) && spec_.count != 1) {
    fail("count",
         std::to_string(spec_.count) + " of type " + entry_.layout.type.text() + ", legal: 1");
  }
  check_scale();
  const int most = most_addresses(entry_);
  if (entry_.addresses() > most) {
    fail("count", "it takes " + std::to_string(entry_.addresses()) + " addresses, legal: up to " +
                      std::to_string(most));
  }
  if (entry_.end() > kTableAddresses) {
    fail("address", address_text(entry_) + ", legal: up to 65535");
  }
}

void EntryChecks::check_scale() const {
  const ValueType& type = entry_.layout.type;
  if (spec_.scale == 0.0) fail("scale", "0, legal: any other finite number");
  if (!is_number(type) && !entry_.is_unscaled()) {
    fail(spec_.scale != 1.0 ? "scale" : "offset", "a " + type.text() + " has no scale and offset");
  }
}

void EntryChecks::check_access() const {
  if (!entry_.is_writable()) return check_keys_of_writes();
  if (entry_.table == Table::kDiscrete || entry_.table == Table::kInput) {
    fail("access", "table " + table_text(entry_.table) + " can only be read; legal: read");
  }
}

void EntryChecks::check_keys_of_writes() const {
  const std::pair<const char*, bool> of_writes[] = {{"min", spec_.min.has_value()},
                                                    {"max", spec_.max.has_value()},
                                                    {"rate", spec_.rate.has_value()},
                                                    {"safe", spec_.safe.has_value()},
                                                    {"timeout", spec_.timeout.has_value()}};
  for (const auto& [key, is_set] : of_writes) {
    if (is_set) fail(key, "only of access: write or read_write");
  }
}

bool has_limits(const RegisterSpec& spec) { return spec.min || spec.max || spec.rate || spec.safe; }

void EntryChecks::check_limits() const {
  const bool is_text = entry_.layout.type.kind == ValueKind::kString;
  if (is_text && has_limits(spec_)) {
    fail("type", "a " + entry_.layout.type.text() + " has no min, max, rate and safe");
  }
  if (spec_.min && spec_.max && *spec_.min > *spec_.max) {
    fail("min",
         number_text(*spec_.min) + ", legal: up to max, which is " + number_text(*spec_.max));
  }
  check_safe();
}

void EntryChecks::check_safe() const {
  if (!spec_.safe) {
    if (spec_.timeout) fail("timeout", "needs a value of safe, which counts after it");
    return;
  }
  const double safe = *spec_.safe;
  if (safe < spec_.min.value_or(safe) || safe > spec_.max.value_or(safe)) {
    fail("safe", number_text(safe) + ", legal: in " + range_text(entry_));
  }
}

/// "UInt16" of uint16, "Float32" of float32.
std::string message_name(std::string type) {
  const std::size_t capitals = starts_with(type, "uint") ? 2 : 1;
  for (std::size_t i = 0; i < capitals; ++i) {
    type[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(type[i])));
  }
  return type;
}

/// The type of std_msgs that holds what the registers hold.
std::string default_message(const RegisterEntry& entry) {
  const ValueType& type = entry.layout.type;
  if (type.kind == ValueKind::kString) return "std_msgs/String";
  if (type.kind == ValueKind::kBits || type.kind == ValueKind::kBool) return "std_msgs/Bool";
  const std::string name = entry.is_unscaled() ? message_name(type.text()) : "Float64";
  return "std_msgs/" + name + (entry.layout.count > 1 ? "MultiArray" : "");
}

void EntryChecks::check_names() const {
  if (spec_.name.empty()) fail("name", "is empty");
  if (!spec_.topic.empty() && !is_topic(spec_.topic)) {
    fail("topic", "'" + spec_.topic + "' is no name of a topic; legal: letters, digits, _ and /");
  }
  if (!spec_.message.empty() && !is_message_type(spec_.message)) {
    fail("message", "'" + spec_.message + "' is no type of a message; legal: package/Type");
  }
  check_bits();
}

void EntryChecks::check_bits() const {
  for (const std::string& bit : entry_.layout.type.bits) {
    if (bit != "-" && !is_name(bit)) fail("type", "'" + bit + "' is no name of a bit");
  }
}

void EntryChecks::choose_message() {
  check_names();
  entry_.message = spec_.message.empty() ? default_message(entry_) : spec_.message;
}

void EntryChecks::set_initial() {
  Value& value = entry_.initial;
  if (entry_.layout.type.kind == ValueKind::kString) {
    value.text = spec_.initial.value_or("");
    return;
  }
  double number = spec_.safe.value_or(0.0);
  if (spec_.initial) {
    const auto read = number_from_text(*spec_.initial);
    if (!read) fail("initial", "'" + *spec_.initial + "', legal: a number");
    if (spec_.safe) fail("initial", "what has a safe value begins with that");
    number = *read;
  }
  value.numbers.assign(static_cast<std::size_t>(entry_.layout.count), number);
}

}  // namespace

std::string table_text(Table table) {
  for (const auto& row : enum_names(table)) {
    if (row.value == table) return row.name;
  }
  return "";
}

std::string address_text(const RegisterEntry& entry) {
  const std::string first = std::to_string(entry.address);
  if (entry.addresses() == 1) return "address " + first;
  return "addresses " + first + " to " + std::to_string(entry.end() - 1);
}

std::string range_text(const RegisterEntry& entry) {
  const std::string unit = entry.unit.empty() ? "" : " " + entry.unit;
  return "[" + (entry.min ? number_text(*entry.min) : "-inf") + ", " +
         (entry.max ? number_text(*entry.max) : "inf") + "]" + unit;
}

RegisterEntry make_entry(const RegisterSpec& spec, const MapSpec& map, const EntrySource& source) {
  return EntryChecks(spec, map, source).entry();
}

}  // namespace trident::bridges::modbus
