// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "trident_base/config_document.h"
#include "trident_base/config_node.h"
#include "trident_base/config_reader.h"
#include "trident_base/config_types.h"

namespace trident {

// Strict configuration: a plain struct with defaults names its fields once, and that one list reads
// YAML, checks it, and writes the reference table.
//
//   struct Motor {
//     double time_constant_up = 0.0125;
//     std::vector<double> angles;
//     template <class Archive>
//     void visit(Archive& ar) {                       // must return void
//       ar.field("time_constant_up", time_constant_up, Range::positive(), "spin-up lag [s]");
//       ar.required("angles", angles, Range{-3.2, 3.2}, "azimuth of each rotor [rad]");
//     }
//     void validate() const;                          // optional: rules across fields; throws
//     Error
//   };
//   const auto motor = load_yaml<Motor>("config/motor.yaml");
//
// Field types: bool, whole numbers, float, double, std::string, enums with enum_names()
// (config_types.h), structs with visit(), Eigen column vectors, std::array, and std::vector,
// std::optional, std::map<std::string, …> of these. A list or a map in the file replaces the
// default one.
//
// Errors, each a ConfigError with file, line, key path, value and what is legal: malformed YAML,
// duplicate key, unknown key (with the nearest known one), missing required key, wrong type, out of
// range, NaN, wrong number of items, failed validate().

/// Fills a T from an already parsed tree, e.g. one made from ROS parameters.
template <class T>
T load_config_node(const ConfigNode& node, const std::string& file_label) {
  T value{};
  config_detail::ConfigReader::read_struct(node, file_label, "", value);
  return value;
}

/// Fills a T from YAML text; `file_label` stands for the file in errors.
template <class T>
T load_yaml_string(const std::string& text, const std::string& file_label) {
  return load_config_node<T>(parse_yaml(text, file_label), file_label);
}

/// Fills a T from a YAML file.
template <class T>
T load_yaml(const std::string& path) {
  return load_yaml_string<T>(read_config_file(path), path);
}

/// The reference table of T's keys in markdown: key, type, default, legal values, meaning.
template <class T>
std::string document() {
  std::vector<config_detail::DocumentRow> rows;
  config_detail::ConfigDocumenter documenter("", &rows);
  T value{};
  value.visit(documenter);
  return config_detail::markdown_table(rows);
}

}  // namespace trident
