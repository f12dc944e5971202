// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_sim/param_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "trident_base/error.h"
#include "trident_base/string_util.h"

namespace trident::sim {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string describe(Limits limits) {
  std::ostringstream out;
  out << "a finite number";
  if (std::isfinite(limits.lo) || std::isfinite(limits.hi)) {
    out << " in [" << limits.lo << ", " << limits.hi << "]";
  }
  return out.str();
}

std::optional<double> finite_number(const std::string& text) {
  const std::optional<double> value = number_from_text(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace

const ParamNode* ParamNode::find(std::string_view child_name) const {
  for (const ParamNode& child : children) {
    if (child.name == child_name) return &child;
  }
  return nullptr;
}

/// The text of an element that exists; asking for it counts as reading it.
std::optional<std::string> PluginParams::raw(std::string_view key) const {
  const ParamNode* found = node(key);
  if (found == nullptr) return std::nullopt;
  return trimmed(found->text);
}

/// Errors of the new reader name the outer element, too; of "name[i]" the queries are those of
/// "name", as all of its elements have the same content.
PluginParams PluginParams::below(std::string_view key) const {
  static const ParamNode kNothing{};
  const ParamNode* const element = node(key);
  PluginParams reader(element != nullptr ? *element : kNothing,
                      owner_ + " <" + std::string(key) + ">");
  reader.prefix_ = prefix_ + std::string(key.substr(0, key.find('['))) + "/";
  reader.queries_ = queries_;
  return reader;
}

ParamQuery& PluginParams::query(std::string_view key) const {
  return (*queries_)[prefix_ + std::string(key.substr(0, key.find('[')))];
}

void PluginParams::note(std::string_view key, ParamQuery::Kind kind, const std::string& fallback,
                        Limits limits) const {
  ParamQuery& known = query(key);
  if (kind > known.kind) known = {kind, fallback, limits, known.is_required};
}

/// "name[i]" is the i-th element of that name, from 1, as in XPath; "name" the first.
const ParamNode* PluginParams::node(std::string_view key) const {
  const std::string_view name = key.substr(0, key.find('['));
  query(name);
  if (name.size() == key.size()) return root_->find(name);
  std::size_t number = std::stoul(std::string(key.substr(name.size() + 1)));
  for (const ParamNode& child : root_->children) {
    if (child.name == name && --number == 0) return &child;
  }
  return nullptr;
}

/// Repeated elements are named once: what matters is that nothing reads them.
std::vector<std::string> PluginParams::unread() const {
  std::vector<std::string> names;
  for (const ParamNode& child : root_->children) {
    const bool is_known = queries_->count(prefix_ + child.name) > 0;
    if (!is_known && std::find(names.begin(), names.end(), child.name) == names.end()) {
      names.push_back(child.name);
    }
  }
  return names;
}

void PluginParams::refuse(std::string_view key, std::string_view value,
                          std::string_view expected) const {
  throw Error(owner_ + ": <" + std::string(key) + "> is '" + std::string(value) + "', expected " +
              std::string(expected));
}

std::string PluginParams::text(std::string_view key, std::string_view fallback) const {
  note(key, ParamQuery::Kind::kText, std::string(fallback));
  return raw(key).value_or(std::string(fallback));
}

std::string PluginParams::required_text(std::string_view key) const {
  note(key, ParamQuery::Kind::kText, "");
  query(key).is_required = true;
  const auto value = raw(key);
  if (!value || value->empty()) {
    throw Error(owner_ + ": required element <" + std::string(key) + "> is missing or empty");
  }
  return *value;
}

double PluginParams::number(std::string_view key, double fallback, Limits limits) const {
  note(key, ParamQuery::Kind::kNumber, number_text(fallback), limits);
  return read_number(key, fallback, limits);
}

/// NaN and infinities are refused whatever the limits: none of the simulator's numbers may be one.
double PluginParams::read_number(std::string_view key, double fallback, Limits limits) const {
  const auto text = raw(key);
  if (!text) return fallback;
  const std::optional<double> value = finite_number(*text);
  if (!value || *value < limits.lo || *value > limits.hi) refuse(key, *text, describe(limits));
  return *value;
}

/// Through a double, as files write whole numbers as "8.0", too.
int PluginParams::integer(std::string_view key, int fallback, Limits limits) const {
  note(key, ParamQuery::Kind::kInteger, std::to_string(fallback), limits);
  const double value = read_number(key, fallback, limits);
  if (value != std::floor(value) || std::abs(value) > 1e9) {
    refuse(key, *raw(key), "a whole number");
  }
  return static_cast<int>(value);
}

int PluginParams::required_integer(std::string_view key, Limits limits) const {
  required_text(key);
  return integer(key, 0, limits);
}

bool PluginParams::flag(std::string_view key, bool fallback) const {
  note(key, ParamQuery::Kind::kFlag, fallback ? "true" : "false");
  const auto text = raw(key);
  if (!text) return fallback;
  const auto is_one_of = [&text](const std::array<std::string_view, 4>& words) {
    return std::find(words.begin(), words.end(), *text) != words.end();
  };
  if (is_one_of({"1", "true", "True", "TRUE"})) return true;
  if (is_one_of({"0", "false", "False", "FALSE"})) return false;
  refuse(key, *text, "true or false");
}

std::size_t PluginParams::choose(std::string_view key, std::size_t fallback,
                                 const std::vector<std::string>& words) const {
  const std::string word = text(key, words[fallback]);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) refuse(key, word, join(words, " or "));
  return static_cast<std::size_t>(found - words.begin());
}

/// Word by word, so that a fourth number is an error and not ignored.
Eigen::Vector3d PluginParams::vector3(std::string_view key, const Eigen::Vector3d& fallback) const {
  note(key, ParamQuery::Kind::kVector,
       number_text(fallback.x()) + " " + number_text(fallback.y()) + " " +
           number_text(fallback.z()));
  const auto text = raw(key);
  if (!text) return fallback;
  std::istringstream in(*text);
  std::string word;
  Eigen::Vector3d value;
  for (int i = 0; i < 3; ++i) {
    const std::optional<double> number = in >> word ? finite_number(word) : std::nullopt;
    if (!number) refuse(key, *text, "three finite numbers");
    value[i] = *number;
  }
  if (in >> word) refuse(key, *text, "three finite numbers");
  return value;
}

}  // namespace trident::sim
