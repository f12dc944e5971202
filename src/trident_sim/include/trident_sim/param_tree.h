// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trident::sim {

/// One XML element below a `<plugin>`: what is kept of it once the SDF document is gone.
struct ParamNode {
  std::string name;  ///< of the element, without a namespace prefix being removed
  std::string text;  ///< as in the file; PluginParams cuts white space off its ends
  std::vector<std::pair<std::string, std::string>> attributes;  ///< in file order
  std::vector<ParamNode> children;  ///< in file order, repeated names included

  /// The first child of that name; nullptr when it has no such child.
  const ParamNode* find(std::string_view child_name) const;
};

/// Legal values of a number, both ends included.
struct Limits {
  double lo = -std::numeric_limits<double>::infinity();  ///< infinite: no limit
  double hi = std::numeric_limits<double>::infinity();   ///< infinite: no limit
};

/// What a plugin has asked for of one element, whether the file has it or not.
struct ParamQuery {
  /// From what says least about an element to what says most.
  enum class Kind { kElement, kText, kNumber, kInteger, kFlag, kVector };
  Kind kind = Kind::kElement;  ///< the one that says most of those asked for
  std::string fallback;        ///< as a file would say it; empty for elements and required ones
  Limits limits;               ///< of a number
  bool is_required = false;    ///< without it the model is refused
};

/// By name; what is below an element has the element's name and a slash before its own.
using ParamQueries = std::map<std::string, ParamQuery, std::less<>>;

/// Typed, checked reading of a plugin's parameters. Every error names the model, the plugin, the
/// element, its value and the legal range. Copies know together what was read.
class PluginParams {
 public:
  /// `root` must outlive the reader; `owner` begins its errors: "model 'm' plugin 'p'".
  PluginParams(const ParamNode& root, std::string owner) : root_(&root), owner_(std::move(owner)) {}

  /// The reader of the element `key`, empty where that is missing; `queries` of both are one.
  PluginParams below(std::string_view key) const;

  /// Whether the element exists, be it empty. Asking counts as reading, see unread().
  bool has(std::string_view key) const { return node(key) != nullptr; }
  /// The element itself, with what is below it; nullptr when it is missing.
  const ParamNode* node(std::string_view key) const;
  /// Its text without white space at the ends; `fallback` only where the element is missing: an
  /// empty element is an empty text.
  std::string text(std::string_view key, std::string_view fallback) const;
  /// Throws Error when the element is missing or empty.
  std::string required_text(std::string_view key) const;
  /// Throws Error for an element that is empty, no finite number, or outside of `limits`.
  /// `fallback` is not checked.
  double number(std::string_view key, double fallback, Limits limits = {}) const;
  /// As number(); throws Error for a number with a fraction, or beyond 1e9, too.
  int integer(std::string_view key, int fallback, Limits limits = {}) const;
  /// As integer(), where the element must be there.
  int required_integer(std::string_view key, Limits limits = {}) const;
  /// true, True, TRUE, 1 or false, False, FALSE, 0. Throws Error for anything else.
  bool flag(std::string_view key, bool fallback) const;
  /// Three finite numbers with white space between them. Throws Error for more, fewer or others.
  Eigen::Vector3d vector3(std::string_view key, const Eigen::Vector3d& fallback) const;
  /// One of a few words, each with its value; `fallback` is among the values. Throws Error for
  /// another word.
  template <class Choice>
  Choice choice(std::string_view key, Choice fallback,
                const std::vector<std::pair<std::string, Choice>>& known) const {
    std::vector<std::string> words;
    std::size_t usual = 0;
    for (const auto& [word, value] : known) {
      if (value == fallback) usual = words.size();
      words.push_back(word);
    }
    return known[choose(key, usual, words)].second;
  }
  const std::string& owner() const { return owner_; }  ///< what errors begin with
  /// Names of the elements that nobody has asked for, each once.
  std::vector<std::string> unread() const;
  /// What was asked for so far, by this reader and its copies. The reference of plugins is made of
  /// it.
  const ParamQueries& queries() const { return *queries_; }

  /// Throws the one error about `key`.
  [[noreturn]] void refuse(std::string_view key, std::string_view value,
                           std::string_view expected) const;

 private:
  std::optional<std::string> raw(std::string_view key) const;
  ParamQuery& query(std::string_view key) const;
  /// Keeps the query if it says more about the element than those before it.
  void note(std::string_view key, ParamQuery::Kind kind, const std::string& fallback,
            Limits limits = {}) const;
  double read_number(std::string_view key, double fallback, Limits limits) const;
  /// Index of the word that the element has; `fallback` where it is missing.
  std::size_t choose(std::string_view key, std::size_t fallback,
                     const std::vector<std::string>& words) const;

  const ParamNode* root_;
  std::string owner_, prefix_;
  std::shared_ptr<ParamQueries> queries_ = std::make_shared<ParamQueries>();
};

}  // namespace trident::sim
