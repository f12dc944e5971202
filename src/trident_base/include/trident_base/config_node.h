// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trident_base/error.h"

namespace trident {

/// A configuration that cannot be used. `what()` is complete:
/// "<file>:<line>: <key path>: <problem with value and legal range>".
class ConfigError : public Error {
 public:
  /// `line` counts from 1; 0 when the source has no lines (a parameter server).
  ConfigError(std::string file, int line, std::string key, const std::string& problem);

  const std::string& file() const { return file_; }  ///< as `what()` names it
  int line() const { return line_; }                 ///< from 1; 0: the source has no lines
  /// Path of the key, e.g. "rotors[2].force_constant"; empty for the document itself.
  const std::string& key() const { return key_; }

 private:
  std::string file_;
  int line_;
  std::string key_;
};

/// One value of a configuration before it has a type: what YAML text says, with its line. Other
/// sources (the ROS parameter server) build the same tree and get the same checks.
struct ConfigNode {
  /// What YAML's syntax alone shows; a scalar's type is decided by the field that reads it.
  enum class Kind { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;        ///< decides which of the members below count
  int line = 0;                   ///< where it begins, from 1; 0: the source has no lines
  std::string scalar;             ///< Text of a kScalar.
  bool quoted = false;            ///< A quoted scalar is text, never a number or a truth value.
  std::vector<ConfigNode> items;  ///< Items of a kSequence; values of a kMap.
  std::vector<std::string> keys;  ///< Keys of a kMap, parallel to `items`, each once.
  std::vector<int> key_lines;     ///< Lines of the keys, parallel to `keys`.

  /// The value of a key; nullptr when absent.
  const ConfigNode* find(std::string_view key) const;
  /// The value as an error text shows it: 0.5, 'text', a list of 3 items, a map, nothing.
  std::string describe() const;
};

/// Parses one YAML document; empty text gives an empty map. `file_label` names the source in
/// errors. Throws ConfigError for malformed text, a second document, a duplicate or non-scalar key,
/// or an alias that would make the tree larger than a million nodes.
ConfigNode parse_yaml(const std::string& text, const std::string& file_label);

/// The text of a file; throws ConfigError naming the file when it cannot be read.
std::string read_config_file(const std::string& path);

}  // namespace trident
