// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "trident_base/config_document.h"

namespace trident {
namespace config_detail {

/// The archive that writes a struct as YAML: maps of numbers, words, texts and lists of these.
class ConfigWriter {
 public:
  /// `indent` stands before each line: that of the map that is written.
  explicit ConfigWriter(std::string indent = "") : indent_(std::move(indent)) {}

  /// Appends the key and its value. The texts of fields and their ranges are not written.
  template <class T>
  void field(const char* name, const T& value, const char* = "") {
    add(name, value);
  }
  template <class T>
  void field(const char* name, const T& value, Range, const char* = "") {
    add(name, value);
  }
  template <class T>
  void required(const char* name, const T& value, const char* = "") {
    add(name, value);
  }
  template <class T>
  void required(const char* name, const T& value, Range, const char* = "") {
    add(name, value);
  }
  const std::string& text() const { return text_; }  ///< complete lines

 private:
  template <class T>
  void add(const char* name, const T& value) {
    text_.append(indent_).append(name).append(":");
    if constexpr (is_visitable_v<T>) {
      ConfigWriter below(indent_ + "  ");
      T copy = value;
      copy.visit(below);
      text_.append("\n").append(below.text());
    } else {
      text_.append(" ").append(Describe<T>::text(value)).append("\n");
    }
  }

  std::string indent_, text_;
};

}  // namespace config_detail

/// `value` as the YAML that load_yaml_string() reads back to the bit. Its fields are maps (structs
/// with visit()), numbers, choices, texts without quotes in them, and lists of numbers.
template <class T>
std::string to_yaml(const T& value) {
  config_detail::ConfigWriter writer;
  T copy = value;
  copy.visit(writer);
  return writer.text();
}

/// `base` with what YAML text says of it; throws ConfigError as load_yaml_string() does.
template <class T>
T overlay_yaml_string(const std::string& text, const std::string& label, T base) {
  config_detail::ConfigReader::read_struct(parse_yaml(text, label), label, "", base);
  return base;
}

}  // namespace trident
