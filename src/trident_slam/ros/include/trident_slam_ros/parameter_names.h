// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

namespace trident::slam {

using ParameterNames = std::vector<std::string>;

/// An archive that only learns names.
struct FieldNames {
  ParameterNames names;
  template <class... Rest>
  void field(const char* name, const Rest&... /*rest*/) {
    names.emplace_back(name);
  }
  template <class... Rest>
  void required(const char* name, const Rest&... /*rest*/) {
    names.emplace_back(name);
  }
};

/// Names of a parameter struct's fields.
template <class Params>
ParameterNames field_names() {
  FieldNames archive;
  Params defaults;
  defaults.visit(archive);
  return archive.names;
}

/// Parameters that a node was given and that do nothing.
struct UnusedParameters {
  ParameterNames without_effect;     ///< upstream's, which mean nothing here
  std::vector<std::string> unknown;  ///< each with what may have been meant
};

UnusedParameters unused_parameters(const ParameterNames& given, const ParameterNames& used,
                                   const ParameterNames& upstream);

/// Tells once in the log which private parameters do nothing.
void tell_unused(const ros::NodeHandle& own, const ParameterNames& used,
                 const ParameterNames& upstream);

}  // namespace trident::slam
