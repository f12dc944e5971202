// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>

#include <string>
#include <vector>

#include "trident_base/config_fields.h"
#include "trident_base/config_node.h"

namespace trident::ros_utils {

/// Parameters and their values in dynamic_reconfigure's terms. To those given comes the flag
/// `restore_defaults`, as move_base and its planners have it upstream: true gives all parameters
/// the values that they had at first. A number without a value, which something else decides, is
/// shown as NaN, and NaN takes its value away. Not thread-safe.
class ReconfigureTable {
 public:
  /// `values`: a map, as the parameters were given at first; other keys than those of the fields
  /// are kept as they are. Optional fields without a value are left out unless they are numbers.
  ReconfigureTable(const std::vector<ConfigField>& fields, ConfigNode values);

  /// Types, ranges, texts and defaults, in one group.
  dynamic_reconfigure::ConfigDescription description() const;
  /// The values at present.
  dynamic_reconfigure::Config config() const { return config_of(values_); }
  /// The map of the values at present.
  const ConfigNode& values() const { return values_; }

  /// What a request makes of the map. Numbers outside of a range become its nearest end, or stay
  /// where that end is not legal itself, for the reader of the map to refuse. Adds a sentence to
  /// `notes` for each that was changed and for each name that is not known.
  ConfigNode changed(const dynamic_reconfigure::Config& request,
                     std::vector<std::string>* notes) const;
  /// Takes the map that changed() has made.
  void set_values(ConfigNode values) { values_ = std::move(values); }

 private:
  struct Entry {
    ConfigField field;
    bool is_number_of_choice = false;  ///< A choice among whole numbers, which are sent as such.
    double lo = 0.0, hi = 0.0;         ///< Of a number, as they are published.

    /// Whether it is sent as a whole number.
    bool is_whole() const { return field.kind == ConfigField::Kind::kWhole || is_number_of_choice; }
  };

  static Entry entry_of(const ConfigField& field);
  const Entry* find(const std::string& name, std::vector<std::string>* notes) const;
  std::string text_of(const Entry& entry, const ConfigNode& values) const;
  void put(const Entry& entry, const std::string& text, dynamic_reconfigure::Config* config) const;
  dynamic_reconfigure::Config config_of(const ConfigNode& values) const;
  void take_number(const std::string& name, double value, ConfigNode* values,
                   std::vector<std::string>* notes) const;
  void take_text(const std::string& name, const std::string& value, ConfigNode* values,
                 std::vector<std::string>* notes) const;

  std::vector<Entry> entries_;
  ConfigNode first_;   ///< The values at first.
  ConfigNode values_;  ///< A map; keys with a slash are maps in it.
};

}  // namespace trident::ros_utils
