// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>

#include "trident_base/config_node.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

std::string error_of(const std::string& text) {
  try {
    parse_yaml(text, "v.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(YamlTree, KeepsTheLinesOfKeysAndValues) {
  const ConfigNode root = parse_yaml("a: 1\nb:\n  c: [x,\n    'y']\n", "v.yaml");
  EXPECT_EQ(root.key_lines, (std::vector{1, 2}));
  const ConfigNode* c = root.find("b")->find("c");
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->line, 3);
  EXPECT_EQ(c->items[0].line, 3);
  EXPECT_FALSE(c->items[0].quoted);
  EXPECT_EQ(c->items[1].line, 4);
  EXPECT_TRUE(c->items[1].quoted);
  EXPECT_EQ(root.find("z"), nullptr);
}

TEST(YamlTree, LongTextIsShownShort) {
  ConfigNode node;
  node.kind = ConfigNode::Kind::kScalar;
  node.scalar = std::string(1000, 'x');
  EXPECT_EQ(node.describe(), std::string(60, 'x') + "...");
}

TEST(YamlTree, MalformedTextNamesTheLine) {
  for (const char* text : {"a: 1\nb: [1, 2\nc: 3", "a: 1\nb: 'open", "a: 1\n\tb: 2", "a: 1\n  b: 2",
                           "a: 1\nb: *c", "a: 1\n]"}) {
    const std::string error = error_of(text);
    EXPECT_TRUE(starts_with(error, "v.yaml:2: ") || starts_with(error, "v.yaml:3: ")) << error;
  }
  EXPECT_TRUE(starts_with(error_of("a: [1, 2"), "v.yaml:1: malformed YAML: "));
}

TEST(YamlTree, DuplicateKeysAreErrorsWithBothLines) {
  EXPECT_EQ(error_of("a: 1\nb: 2\na: 3"), "v.yaml:3: a: duplicate key, given before on line 1");
  EXPECT_EQ(error_of("l:\n- {x: 1, x: 2}"),
            "v.yaml:2: l[0].x: duplicate key, given before on line 2");
}

TEST(YamlTree, KeysMustBeText) {
  EXPECT_EQ(error_of("? [1, 2]\n: 3"), "v.yaml:1: a key must be text, but is a list of 2 items");
}

TEST(YamlTree, TagsOtherThanTextAreRefused) {
  EXPECT_EQ(error_of("a: !degrees 90"), "v.yaml:1: a: the tag '!degrees' is not supported");
  EXPECT_EQ(error_of("a: !set {b: 1}"), "v.yaml:1: a: the tag '!set' is not supported");
}

TEST(YamlTree, OnlyOneDocumentIsLegal) {
  EXPECT_EQ(error_of("a: 1\n---\nb: 2"), "v.yaml:2: a second document; only one is legal");
  EXPECT_EQ(error_of("---\na: 1\n...\n# end\n"), "no error");
}

TEST(YamlTree, AnAliasCannotStandForItsOwnValue) {
  EXPECT_EQ(error_of("a: &x [1, *x]"), "v.yaml:1: a[1]: an alias inside the value it stands for");
}

TEST(YamlTree, AliasesCannotExplode) {
  std::string text = "a0: &a0 [x, x]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string previous = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + previous + ", " +
            previous + "]\n";
  }
  EXPECT_NE(error_of(text).find("more than a million values"), std::string::npos);
}

TEST(YamlTree, DeepNestingIsAnErrorNotACrash) {
  EXPECT_TRUE(starts_with(error_of(std::string(100'000, '[')), "v.yaml:1: "));
}

}  // namespace
}  // namespace trident
