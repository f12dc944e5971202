// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "trident_base/config_reader.h"

namespace trident {

/// A key of a configuration with a single value, for programs that show keys or change them.
struct ConfigField {
  enum class Kind { kBool, kWhole, kNumber, kText, kChoice };

  std::string name;  ///< With those of the maps that it is in: "CostCritic/cost_weight".
  Kind kind = Kind::kText;
  Range range;               ///< Of a kWhole or kNumber; a whole number's within its type's limits.
  std::string default_text;  ///< As YAML, a text without quotes; "" where is_optional.
  bool is_optional = false;  ///< Without the key something else decides.
  std::string doc;           ///< As visit() has it.
  std::vector<std::string> choices;  ///< Of a kChoice.
};

namespace config_detail {

/// The archive that lists the fields of a struct that have a single value.
class FieldLister {
 public:
  /// `prefix`: what names begin with. Appends to `fields`, which must outlive it.
  FieldLister(std::string prefix, std::vector<ConfigField>* fields)
      : prefix_(std::move(prefix)), fields_(fields) {}

  /// Adds a field whose value is the default.
  template <class T>
  void field(const char* name, const T& value, const char* doc = "") {
    add(name, value, Range::any(), doc);
  }
  /// The same with a range.
  template <class T>
  void field(const char* name, const T& value, Range range, const char* doc = "") {
    add(name, value, range, doc);
  }
  /// As field().
  template <class T>
  void required(const char* name, const T& value, const char* doc = "") {
    add(name, value, Range::any(), doc);
  }
  /// The same with a range.
  template <class T>
  void required(const char* name, const T& value, Range range, const char* doc = "") {
    add(name, value, range, doc);
  }

 private:
  template <class T>
  void add(const char* name, const T& value, Range range, const char* doc) {
    if constexpr (is_visitable_v<T>) {
      FieldLister below(prefix_ + name + '/', fields_);
      T copy = value;
      copy.visit(below);
    } else if constexpr (is_single_v<T>) {
      ConfigField field = described<T>(range);
      field.name = prefix_ + name;
      field.default_text = text(value);
      field.doc = doc;
      fields_->push_back(std::move(field));
    }  // lists and maps have more than one value
  }
  template <class T>
  void add(const char* name, const std::optional<T>& value, Range range, const char* doc) {
    add(name, value.value_or(T{}), range, doc);
    if (value || !is_single_v<T>) return;
    fields_->back().default_text.clear();
    fields_->back().is_optional = true;
  }

  template <class T>
  static constexpr bool is_single_v =
      std::is_arithmetic_v<T> || is_named_enum_v<T> || std::is_same_v<T, std::string>;

  template <class T>
  static ConfigField described(Range range) {
    ConfigField field;
    field.range = range;
    if constexpr (std::is_same_v<T, bool>) {
      field.kind = ConfigField::Kind::kBool;
    } else if constexpr (is_named_enum_v<T>) {
      field.kind = ConfigField::Kind::kChoice;
      field.choices = enum_name_list<T>();
    } else if constexpr (std::is_arithmetic_v<T>) {
      field.kind = std::is_integral_v<T> ? ConfigField::Kind::kWhole : ConfigField::Kind::kNumber;
    }
    return field;
  }

  static std::string text(bool value) { return value ? "true" : "false"; }
  static std::string text(const std::string& value) { return value; }
  template <class T>
  static std::string text(const T& value) {
    if constexpr (is_named_enum_v<T>) {
      for (const auto& entry : enum_names(T{})) {
        if (entry.value == value) return entry.name;
      }
      return "";
    } else if constexpr (std::is_integral_v<T>) {
      return std::to_string(value);
    } else {
      return number_text(value);
    }
  }

  std::string prefix_;
  std::vector<ConfigField>* fields_;
};

}  // namespace config_detail

/// The fields of a struct with visit() that have a single value, in their order, those of structs
/// within it included; lists and maps are left out. `defaults`: whose values are the defaults.
template <class T>
std::vector<ConfigField> config_fields(const T& defaults = T{}) {
  std::vector<ConfigField> fields;
  config_detail::FieldLister lister("", &fields);
  T copy = defaults;
  copy.visit(lister);
  return fields;
}

/// A factory that knows which parameters it reads, where its registration says so:
/// `factory.fields = config_fields<Params>()`.
template <class Signature>
struct DescribedFactory : std::function<Signature> {
  using std::function<Signature>::function;

  std::vector<ConfigField> fields;  ///< Empty: not known.
};

}  // namespace trident
