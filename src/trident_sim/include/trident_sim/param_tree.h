// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trident::sim {

/// One XML element below a `<plugin>`: what is kept of it once the SDF document is gone.
struct ParamNode {
  std::string name;
  std::string text;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<ParamNode> children;

  const ParamNode* find(std::string_view child_name) const;
};

/// Legal values of a number, both ends included.
struct Limits {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
};

/// Typed, checked reading of a plugin's parameters. Every error names the model, the plugin, the
/// element, its value and the legal range. Copies know together what was read.
class PluginParams {
 public:
  PluginParams(const ParamNode& root, std::string owner) : root_(&root), owner_(std::move(owner)) {}

  bool has(std::string_view key) const { return node(key) != nullptr; }
  /// The element itself, with what is below it; nullptr when it is missing.
  const ParamNode* node(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  std::string required_text(std::string_view key) const;
  double number(std::string_view key, double fallback, Limits limits = {}) const;
  int integer(std::string_view key, int fallback, Limits limits = {}) const;
  int required_integer(std::string_view key, Limits limits = {}) const;
  bool flag(std::string_view key, bool fallback) const;
  Eigen::Vector3d vector3(std::string_view key, const Eigen::Vector3d& fallback) const;
  const std::string& owner() const { return owner_; }
  /// Names of the elements that nobody has asked for, each once.
  std::vector<std::string> unread() const;

  /// Throws the one error about `key`.
  [[noreturn]] void refuse(std::string_view key, std::string_view value,
                           std::string_view expected) const;

 private:
  std::optional<std::string> raw(std::string_view key) const;

  const ParamNode* root_;
  std::string owner_;
  std::shared_ptr<std::set<std::string, std::less<>>> read_ =
      std::make_shared<std::set<std::string, std::less<>>>();
};

}  // namespace trident::sim
