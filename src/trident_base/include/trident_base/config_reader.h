// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "trident_base/config_node.h"
#include "trident_base/config_types.h"
#include "trident_base/string_util.h"

namespace trident::config_detail {

/// What a value reader must know to explain an error.
struct ValueContext {
  const std::string& file;  ///< for ConfigError::file()
  Range range;              ///< of the field that the value belongs to
  std::string unit;  ///< "N s^2", taken from the "[…]" that ends a field's doc; may be empty.
};

/// Throws ConfigError: the value is not what was `expected`.
[[noreturn]] void fail_type(const ValueContext& context, const ConfigNode& node,
                            const std::string& path, const std::string& expected);
/// Throws ConfigError: the value is of the right type and not `legal`.
[[noreturn]] void fail_range(const ValueContext& context, const ConfigNode& node,
                             const std::string& path, const std::string& legal);

/// true or false, also as True or TRUE, without quotes; throws ConfigError for anything else.
bool read_bool(const ValueContext&, const ConfigNode&, const std::string& path);
/// A number within the field's range; throws ConfigError for another one and for NaN.
double read_double(const ValueContext&, const ConfigNode&, const std::string& path);
/// The text of a scalar; throws ConfigError for a list, a map or nothing.
const std::string& read_string(const ValueContext&, const ConfigNode&, const std::string& path);
/// Throws ConfigError unless the node is a list of that size; kAnySize: of any.
const ConfigNode& expect_sequence(const ValueContext&, const ConfigNode&, const std::string& path,
                                  int size_or_any);
/// Throws ConfigError unless the node is a map.
const ConfigNode& expect_map(const ValueContext&, const ConfigNode&, const std::string& path);
/// Index of the name that the scalar is; throws ConfigError with the nearest name for another one.
std::size_t read_choice(const ValueContext&, const ConfigNode&, const std::string& path,
                        const std::vector<std::string>& names);

/// Whole numbers, exactly: `is_negative` and `magnitude` of the text; range checks both the field's
/// range and [lowest, highest] of the type.
struct WholeNumber {
  bool is_negative;              ///< the text begins with "-"
  unsigned long long magnitude;  ///< absolute value
};
/// Throws ConfigError for a text with a fraction or an exponent, too.
WholeNumber read_whole_number(const ValueContext&, const ConfigNode&, const std::string& path,
                              long long lowest, unsigned long long highest);

/// What stands in the brackets that end `doc`; "" when it does not end in "]".
std::string unit_of(const char* doc);
/// "parent.key"; "parent/key" below an absolute ROS name; "key" at the top.
std::string child_path(const std::string& parent, const std::string& key);
/// "parent[index]", counted from 0.
inline std::string item_path(const std::string& parent, std::size_t index) {
  return parent + '[' + std::to_string(index) + ']';
}

inline constexpr int kAnySize = -1;  ///< see expect_sequence()

/// The names of an enum in the order of its table.
template <class T>
std::vector<std::string> enum_name_list() {
  std::vector<std::string> names;
  for (const auto& entry : enum_names(T{})) names.emplace_back(entry.name);
  return names;
}

/// The archive that fills a struct from one map node. `finish` reports, in this order: unknown
/// keys, missing keys, a failed validate().
class ConfigReader {
 public:
  /// Throws ConfigError unless `node` is a map. `node` and `file` must outlive the reader.
  ConfigReader(const ConfigNode& node, const std::string& file, std::string path);

  /// Replaces `value` when the map has the key. Throws ConfigError for a value that does not fit.
  template <class T>
  void field(const char* name, T& value, const char* doc = "") {
    if (const ConfigNode* child = take(name)) read_child(*child, name, value, Range::any(), doc);
  }
  /// The same, with the numbers in it limited to a range.
  template <class T>
  void field(const char* name, T& value, Range range, const char* doc = "") {
    static_assert(range_applies_v<T>, "a Range is for numbers and for lists and maps of numbers");
    if (const ConfigNode* child = take(name)) read_child(*child, name, value, range, doc);
  }
  /// As `field`, but there is no default: the file must have the key.
  template <class T>
  void required(const char* name, T& value, const char* doc = "") {
    field(name, value, doc);
    note_required(name, doc, "");
  }
  /// The same with a range.
  template <class T>
  void required(const char* name, T& value, Range range, const char* doc = "") {
    field(name, value, range, doc);
    note_required(name, doc, range.text());
  }

  /// Fills a struct through its visit() and then calls its validate(), if it has one; an Error from
  /// there becomes a ConfigError with file, line and path.
  template <class T>
  static void read_struct(const ConfigNode& node, const std::string& file, const std::string& path,
                          T& value) {
    ConfigReader reader(node, file, path);
    value.visit(reader);
    reader.finish();
    if constexpr (is_validated_v<T>) {
      try {
        value.validate();
      } catch (const ConfigError&) {
        throw;
      } catch (const Error& error) {
        throw ConfigError(file, node.line, path, error.what());
      }
    }
  }

 private:
  struct MissingKey {
    std::string key;  ///< Path.
    std::string problem;
  };

  const ConfigNode* take(const char* name);
  void note_required(const char* name, const char* doc, const std::string& legal);
  void finish() const;

  template <class T>
  void read_child(const ConfigNode& node, const char* name, T& value, Range range,
                  const char* doc) const {
    read(ValueContext{file_, range, unit_of(doc)}, node, child_path(path_, name), value);
  }

  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   bool& value) {
    value = read_bool(c, node, path);
  }
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   std::string& value) {
    value = read_string(c, node, path);
  }
  template <class T>
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   T& value) {
    static_assert(is_number_v<T> || is_named_enum_v<T> || is_visitable_v<T>,
                  "a field needs a type with visit(archive), an enum with enum_names, a number, "
                  "bool or text, or a vector, array, optional, map or Eigen vector of these");
    if constexpr (std::is_floating_point_v<T>) {
      const double wide = read_double(c, node, path);
      if (std::isfinite(wide) && std::abs(wide) > std::numeric_limits<T>::max()) {
        fail_range(c, node, path, "a single-precision number");
      }
      value = static_cast<T>(wide);
    } else if constexpr (std::is_integral_v<T>) {
      using Limits = std::numeric_limits<T>;
      const WholeNumber n = read_whole_number(c, node, path, Limits::min(), Limits::max());
      value = static_cast<T>(n.is_negative ? 0 - n.magnitude : n.magnitude);
    } else if constexpr (is_named_enum_v<T>) {
      value = enum_names(T{})[read_choice(c, node, path, enum_name_list<T>())].value;
    } else if constexpr (is_visitable_v<T>) {
      read_struct(node, c.file, path, value);
    }
  }
  template <class T>
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   std::optional<T>& value) {
    if (node.kind == ConfigNode::Kind::kNull) {
      value.reset();
    } else {
      read(c, node, path, value.emplace());
    }
  }
  template <class T>
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   std::vector<T>& value) {
    const ConfigNode& list = expect_sequence(c, node, path, kAnySize);
    value.clear();
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      T item{};
      read(c, list.items[i], item_path(path, i), item);
      value.push_back(std::move(item));
    }
  }
  template <class T, std::size_t N>
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   std::array<T, N>& value) {
    const ConfigNode& list = expect_sequence(c, node, path, N);
    for (std::size_t i = 0; i < N; ++i) read(c, list.items[i], item_path(path, i), value[i]);
  }
  template <int N>
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   Eigen::Matrix<double, N, 1>& value) {
    const ConfigNode& list = expect_sequence(c, node, path, N);
    value.resize(static_cast<Eigen::Index>(list.items.size()));
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      value[static_cast<Eigen::Index>(i)] = read_double(c, list.items[i], item_path(path, i));
    }
  }
  template <class T>
  static void read(const ValueContext& c, const ConfigNode& node, const std::string& path,
                   std::map<std::string, T>& value) {
    const ConfigNode& map = expect_map(c, node, path);
    value.clear();
    for (std::size_t i = 0; i < map.items.size(); ++i) {
      T item{};
      read(c, map.items[i], child_path(path, map.keys[i]), item);
      value.emplace(map.keys[i], std::move(item));
    }
  }

  const ConfigNode& node_;
  const std::string& file_;
  std::string path_;
  std::vector<std::string> known_;
  std::vector<MissingKey> missing_;
};

}  // namespace trident::config_detail
