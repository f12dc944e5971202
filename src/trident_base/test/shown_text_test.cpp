// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/shown_text.h"

#include <gtest/gtest.h>

#include <string>

#include "trident_base/config_node.h"
#include "trident_base/string_util.h"

namespace trident {
namespace {

TEST(ShownText, LongWordsAreCutAndTheRestStays) {
  const std::string word(100000, 'x');
  EXPECT_EQ(with_short_words("f.txt:3: '" + word + "' is not a number; legal: a number"),
            "f.txt:3: '" + std::string(199, 'x') + "... is not a number; legal: a number");
}

TEST(ShownText, ShortWordsAndPathsStay) {
  const std::string path = "/data/" + std::string(300, 'd') + "/f.txt:3:";
  for (const std::string& text :
       {std::string(), std::string(200, 'x'), path + " empty", std::string("  a  b\n")}) {
    EXPECT_EQ(with_short_words(text), text);
  }
  const std::string endless = "/" + std::string(100000, 'x');
  EXPECT_EQ(with_short_words(endless).size(), 203u);
}

TEST(ShownText, NoCharacterIsCut) {
  std::string word;
  for (int i = 0; i < 150; ++i) word += "\xC3\xA4";
  word.insert(0, "x");
  const std::string shown = with_short_words(word);
  EXPECT_EQ(shown.size(), 199u + 3u);
  EXPECT_EQ(shown.substr(197), "\xC3\xA4...");
}

TEST(ShownText, WhatIsNoTextIsEscaped) {
  using std::string_literals::operator""s;
  EXPECT_EQ(with_short_words("f:1: '\x1b[2J\0\x7f\r' is bad\n\t"s),
            "f:1: '\\x1b[2J\\x00\\x7f\\x0d' is bad\n\t");
  EXPECT_EQ(with_short_words("\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x9A\x80"),
            "\xC3\xA4 \xE2\x82\xAC \xF0\x9F\x9A\x80");
  EXPECT_EQ(with_short_words("\xA4 \xC0\xAF \xE2\x82 \xFF"), "\\xa4 \\xc0\\xaf \\xe2\\x82 \\xff");
}

TEST(ShownText, AnUnknownNameOfAnySizeIsAnsweredAtOnce) {
  const std::string name(1 << 20, 'f');
  const std::string text = unknown_name_text(name, {"force", "mass"});
  EXPECT_LT(text.size(), 260u);
  EXPECT_NE(text.find("known: force, mass"), std::string::npos);
}

TEST(ShownText, AConfigurationIsNoDevice) {
  try {
    read_config_file("/dev/zero");
    FAIL() << "it has no end";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "/dev/zero: is a device, legal: a file of YAML");
  }
}

}  // namespace
}  // namespace trident
