// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_base/sha256.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <utility>

namespace trident {
namespace {

std::string digest_of(std::string_view text) {
  Sha256 hash;
  hash.update_string(text);
  return hash.hex_digest();
}

// Vectors of NIST's SHA-256 examples (FIPS 180-4).
TEST(Sha256, KnownAnswers) {
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest_of(std::string(1'000'000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, PiecesGiveTheSameDigestAsTheWhole) {
  Sha256 hash;
  hash.update("a", 1);
  hash.update_string("");
  hash.update_string("bc");
  EXPECT_EQ(hash.hex_digest(), digest_of("abc"));
}

TEST(Sha256, AfterAResetADigestIsOfWhatFollows) {
  Sha256 hash;
  hash.update_string("first");
  hash.digest_and_reset();
  hash.update_string("abc");
  const std::array<std::uint8_t, 32> digest = hash.digest_and_reset();
  EXPECT_EQ(digest[0], 0xba);
  EXPECT_EQ(digest[31], 0xad);
  hash.update_string("abc");
  EXPECT_EQ(hash.hex_digest(), digest_of("abc"));
}

TEST(Sha256, ADoubleIsItsLittleEndianBytes) {
  Sha256 hash;
  hash.update_double(-2.5);  // 0xC004000000000000
  EXPECT_EQ(hash.hex_digest(), digest_of(std::string("\0\0\0\0\0\0\x04\xC0", 8)));
}

TEST(Sha256, TheLastBitOfADoubleMatters) {
  Sha256 a;
  Sha256 b;
  a.update_double(1.0);
  b.update_double(1.0 + std::numeric_limits<double>::epsilon());
  EXPECT_NE(a.hex_digest(), b.hex_digest());
}

TEST(Sha256, ADigestCanBeTakenInBetween) {
  Sha256 hash;
  hash.update_string("ab");
  EXPECT_EQ(hash.hex_digest(), digest_of("ab"));
  EXPECT_EQ(hash.hex_digest(), digest_of("ab"));
  hash.update_string("c");
  Sha256 moved = std::move(hash);
  EXPECT_EQ(moved.hex_digest(), digest_of("abc"));
}

}  // namespace
}  // namespace trident
