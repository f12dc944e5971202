// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "trident_base/config_reader.h"

namespace trident::config_detail {

/// One row of a reference table.
struct DocumentRow {
  std::string key;            ///< path from the top, "rotors[].force_constant"
  std::string type;           ///< in words: "list of 3 number"
  std::string default_value;  ///< as YAML, or "**required**"
  std::string legal;          ///< of each number or the choices; "": whatever the type allows
  std::string doc;            ///< the text that the field has in visit()
};

/// The rows under a heading row; without rows the heading alone.
std::string markdown_table(const std::vector<DocumentRow>& rows);

/// What a type contributes to a table: its name, its legal values, the text of a value, and the
/// rows below it. The second parameter is for the specialisations that hold for a kind of types.
template <class T, class = void>
struct Describe;

/// The archive that lists a struct's fields instead of filling them.
class ConfigDocumenter {
 public:
  /// `path`: of the struct, "" at the top. Appends to `rows`, which must outlive it.
  ConfigDocumenter(std::string path, std::vector<DocumentRow>* rows)
      : path_(std::move(path)), rows_(rows) {}

  /// A row for the field; its value is the default.
  template <class T>
  void field(const char* name, const T& value, const char* doc = "") {
    add(name, value, Describe<T>::legal(), Describe<T>::text(value), doc);
  }
  /// The same with a range in place of the type's own.
  template <class T>
  void field(const char* name, const T& value, Range range, const char* doc = "") {
    static_assert(range_applies_v<T>, "a Range is for numbers and for lists and maps of numbers");
    add(name, value, range.text(), Describe<T>::text(value), doc);
  }
  /// A row without a default.
  template <class T>
  void required(const char* name, const T& value, const char* doc = "") {
    add(name, value, Describe<T>::legal(), "**required**", doc);
  }
  /// The same with a range.
  template <class T>
  void required(const char* name, const T& value, Range range, const char* doc = "") {
    static_assert(range_applies_v<T>, "a Range is for numbers and for lists and maps of numbers");
    add(name, value, range.text(), "**required**", doc);
  }

 private:
  template <class T>
  void add(const char* name, const T& value, std::string legal, std::string default_value,
           const char* doc) {
    const std::string key = child_path(path_, name);
    rows_->push_back({key, Describe<T>::type(), std::move(default_value), std::move(legal), doc});
    Describe<T>::below(key, value, rows_);
  }

  std::string path_;
  std::vector<DocumentRow>* rows_;
};

/// A value without rows below it.
struct DescribeLeaf {
  /// Adds nothing.
  template <class T>
  static void below(const std::string&, const T&, std::vector<DocumentRow>*) {}
};

/// Truth values, as YAML 1.2 writes them.
template <>
struct Describe<bool> : DescribeLeaf {
  static std::string type() { return "bool"; }
  static std::string legal() { return "true, false"; }
  static std::string text(bool value) { return value ? "true" : "false"; }
};

/// Texts, in double quotes.
template <>
struct Describe<std::string> : DescribeLeaf {
  static std::string type() { return "text"; }
  static std::string legal() { return ""; }
  static std::string text(const std::string& value) { return '"' + value + '"'; }
};

/// Whole numbers by the limits of their type, others by "a finite number".
template <class T>
struct Describe<T, std::enable_if_t<is_number_v<T>>> : DescribeLeaf {
  static std::string type() { return std::is_integral_v<T> ? "whole number" : "number"; }
  static std::string legal() {
    if constexpr (std::is_integral_v<T>) {
      using Limits = std::numeric_limits<T>;
      return "in [" + std::to_string(Limits::min()) + ", " + std::to_string(Limits::max()) + ']';
    } else {
      return Range::any().text();
    }
  }
  static std::string text(T value) {
    if constexpr (std::is_integral_v<T>) {
      return std::to_string(value);
    } else {
      return number_text(value);
    }
  }
};

/// Enums by the names that their enum_names() lists.
template <class T>
struct Describe<T, std::enable_if_t<is_named_enum_v<T>>> : DescribeLeaf {
  static std::string type() { return "choice"; }
  static std::string legal() { return join(enum_name_list<T>()); }
  static std::string text(T value) {
    for (const auto& entry : enum_names(T{})) {
      if (entry.value == value) return entry.name;
    }
    return "";
  }
};

/// Structs: a row of their own without a value, and below it one for each of their fields.
template <class T>
struct Describe<T, std::enable_if_t<is_visitable_v<T>>> {
  static std::string type() { return "map"; }
  static std::string legal() { return ""; }
  static std::string text(const T&) { return ""; }
  static void below(const std::string& key, const T& value, std::vector<DocumentRow>* rows) {
    T copy = value;
    ConfigDocumenter documenter(key, rows);
    copy.visit(documenter);
  }
};

/// What may be missing: as the value itself, "none" by default.
template <class T>
struct Describe<std::optional<T>> {
  static std::string type() { return Describe<T>::type(); }
  static std::string legal() { return Describe<T>::legal(); }
  static std::string text(const std::optional<T>& value) {
    return value ? Describe<T>::text(*value) : "none";
  }
  static void below(const std::string& key, const std::optional<T>& value,
                    std::vector<DocumentRow>* rows) {
    Describe<T>::below(key, value.value_or(T{}), rows);
  }
};

/// Lists; the keys of an item stand below "key[]".
template <class List, class T>
struct DescribeList {
  static std::string type() { return "list of " + Describe<T>::type(); }
  static std::string legal() { return Describe<T>::legal(); }
  static std::string text(const List& value) {
    std::vector<std::string> parts;
    for (const auto& item : value) parts.push_back(Describe<T>::text(item));
    if (is_visitable_v<T> && !parts.empty()) return std::to_string(parts.size()) + " items";
    return '[' + join(parts) + ']';
  }
  static void below(const std::string& key, const List&, std::vector<DocumentRow>* rows) {
    Describe<T>::below(key + "[]", T{}, rows);
  }
};

/// Lists of any length.
template <class T>
struct Describe<std::vector<T>> : DescribeList<std::vector<T>, T> {};

/// Lists of exactly N items.
template <class T, std::size_t N>
struct Describe<std::array<T, N>> : DescribeList<std::array<T, N>, T> {
  static std::string type() { return "list of " + std::to_string(N) + ' ' + Describe<T>::type(); }
};

/// Vectors: lists of N numbers, or of any length where N is Eigen::Dynamic.
template <int N>
struct Describe<Eigen::Matrix<double, N, 1>> : DescribeList<Eigen::Matrix<double, N, 1>, double> {
  static std::string type() {
    return (N < 0 ? "list of " : "list of " + std::to_string(N) + ' ') + Describe<double>::type();
  }
};

/// Maps with free keys; the keys of a value stand below "key.<name>".
template <class T>
struct Describe<std::map<std::string, T>> {
  static std::string type() { return "map of name: " + Describe<T>::type(); }
  static std::string legal() { return Describe<T>::legal(); }
  static std::string text(const std::map<std::string, T>& value) {
    std::vector<std::string> parts;
    for (const auto& [name, item] : value) parts.push_back(name + ": " + Describe<T>::text(item));
    return '{' + join(parts) + '}';
  }
  static void below(const std::string& key, const std::map<std::string, T>&,
                    std::vector<DocumentRow>* rows) {
    Describe<T>::below(key + ".<name>", T{}, rows);
  }
};

}  // namespace trident::config_detail
