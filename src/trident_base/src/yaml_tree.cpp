// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "trident_base/config_node.h"

namespace trident {
namespace {

// Bounds what nested aliases expand to: a file of a kilobyte may hold a billion values.
constexpr std::size_t kMaxNodes = 1'000'000;

// The tag of a plain value is "?", of a quoted one "!".
bool is_untagged(const std::string& tag) { return tag.empty() || tag == "?"; }

std::size_t count_nodes(const ConfigNode& node) {
  std::size_t count = 1;
  for (const ConfigNode& item : node.items) count += count_nodes(item);
  return count;
}

// Builds the tree from parser events, because yaml-cpp's own tree keeps no lines of keys, accepts
// duplicate keys and lets an alias point into its own value.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& file) : file_(file) {}

  ConfigNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++document_count_ > 1) fail(mark.line + 1, "a second document; only one is legal");
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(node_at(mark, ConfigNode::Kind::kNull), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto it = anchors_.find(anchor);
    if (it == anchors_.end()) fail(mark.line + 1, "an alias inside the value it stands for");
    count(count_nodes(it->second), mark.line + 1);
    // The value is copied, so that readers need not know of aliases.
    add(it->second, YAML::NullAnchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    ConfigNode node = node_at(mark, ConfigNode::Kind::kScalar);
    node.scalar = value;
    // Quotes, or the tag !!str, make text of what would be a number or a bool.
    node.quoted = tag == "!" || tag == "tag:yaml.org,2002:str";
    if (!node.quoted) check_tag(tag, node.line);
    add(std::move(node), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    check_tag(tag, mark.line + 1);
    open_.push_back({node_at(mark, ConfigNode::Kind::kSequence), anchor});
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    check_tag(tag, mark.line + 1);
    open_.push_back({node_at(mark, ConfigNode::Kind::kMap), anchor});
  }
  void OnMapEnd() override { close(); }

 private:
  struct OpenNode {
    ConfigNode node;
    YAML::anchor_t anchor;
  };

  static bool expects_key(const ConfigNode& node) {
    return node.kind == ConfigNode::Kind::kMap && node.keys.size() == node.items.size();
  }

  [[noreturn]] void fail(int line, const std::string& problem) const {
    throw ConfigError(file_, line, path(), problem);
  }

  // Path of the value that is being built.
  std::string path() const {
    std::string result;
    for (const auto& [node, anchor] : open_) {
      if (node.kind == ConfigNode::Kind::kSequence) {
        result += '[' + std::to_string(node.items.size()) + ']';
      } else if (!expects_key(node)) {
        result += (result.empty() ? "" : ".") + node.keys.back();
      }
    }
    return result;
  }

  void check_tag(const std::string& tag, int line) const {
    if (!is_untagged(tag)) fail(line, "the tag '" + tag + "' is not supported");
  }

  void count(std::size_t nodes, int line) {
    node_count_ += nodes;
    if (node_count_ > kMaxNodes) fail(line, "more than a million values");
  }

  ConfigNode node_at(const YAML::Mark& mark, ConfigNode::Kind kind) {
    ConfigNode node;
    node.kind = kind;
    node.line = mark.line + 1;
    count(1, node.line);
    return node;
  }

  void close() {
    OpenNode done = std::move(open_.back());
    open_.pop_back();
    add(std::move(done.node), done.anchor);
  }

  void add(ConfigNode node, YAML::anchor_t anchor) {
    // Complete values only are kept by their anchors,
    // hence an alias within its own value is an error.
    if (anchor != YAML::NullAnchor) anchors_[anchor] = node;
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (ConfigNode& parent = open_.back().node; expects_key(parent)) {
      add_key(&parent, node);
    } else {
      parent.items.push_back(std::move(node));
    }
  }

  void add_key(ConfigNode* map, const ConfigNode& key) {
    if (key.kind != ConfigNode::Kind::kScalar) {
      fail(key.line, "a key must be text, but is " + key.describe());
    }
    const auto same = std::find(map->keys.begin(), map->keys.end(), key.scalar);
    const bool is_duplicate = same != map->keys.end();
    const auto index = static_cast<std::size_t>(same - map->keys.begin());
    // The key is there before the error, so that the error's path ends in it.
    map->keys.push_back(key.scalar);
    map->key_lines.push_back(key.line);
    if (is_duplicate) {
      fail(key.line,
           "duplicate key, given before on line " + std::to_string(map->key_lines[index]));
    }
  }

  const std::string& file_;
  ConfigNode root_;
  std::vector<OpenNode> open_;
  std::map<YAML::anchor_t, ConfigNode> anchors_;
  std::size_t node_count_ = 0;
  int document_count_ = 0;
};

}  // namespace

ConfigNode parse_yaml(const std::string& text, const std::string& file_label) {
  TreeBuilder builder(file_label);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw ConfigError(file_label, error.mark.line + 1, "", "malformed YAML: " + error.msg);
  }
  ConfigNode root = builder.take_root();
  // An empty file is a map without keys: all its values have their defaults.
  if (root.kind == ConfigNode::Kind::kNull) {
    root.kind = ConfigNode::Kind::kMap;
    root.line = 1;
  }
  return root;
}

}  // namespace trident
