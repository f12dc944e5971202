// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/signing.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mavlink/packets.h"
#include "trident_base/error.h"
#include "trident_bridges/mavlink/dialect.h"
#include "trident_bridges/mavlink/packet_parser.h"
#include "trident_bridges/mavlink/packet_writer.h"
#include "trident_bridges/mavlink/signing_file.h"

namespace trident::bridges::mavlink {
namespace {

constexpr SigningTime kNow = 1'000'000'000'000;
const SigningKey kKey{1, 2, 3, 4, 5};

/// Keeps the memory for the next Signing, as a file does, and counts.
class KeptMemory : public SigningStore {
 public:
  SigningMemory load() override { return memory; }
  void save(const SigningMemory& kept) override {
    memory = kept;
    ++saves;
  }
  SigningMemory memory;
  int saves = 0;
};

/// Somebody who signs.
struct Sender {
  explicit Sender(const SigningKey& key, std::uint8_t link = 4, SigningTime now = kNow)
      : signing(key, nullptr, now), signer(signing, link), writer(&signer) {}
  std::vector<std::uint8_t> packet() { return testing::packet_of(writer, testing::attitude(1.0F)); }
  Signing signing;
  PacketSigner signer;
  PacketWriter writer;
};

SignatureVerdict check(Signing& signing, const std::vector<std::uint8_t>& bytes) {
  PacketParser parser(true);
  parser.feed(bytes);
  const auto packet = parser.next();
  EXPECT_TRUE(packet);
  return packet ? signing.check(*packet) : SignatureVerdict::kWrong;
}

TEST(Signing, APacketIsAcceptedOnce) {
  Signing receiver(kKey, nullptr, kNow);
  Sender sender(kKey);
  const auto first = sender.packet(), second = sender.packet();
  EXPECT_EQ(check(receiver, first), SignatureVerdict::kAccepted);
  EXPECT_EQ(check(receiver, first), SignatureVerdict::kReplayed);
  EXPECT_EQ(check(receiver, second), SignatureVerdict::kAccepted);
  EXPECT_EQ(check(receiver, first), SignatureVerdict::kReplayed);
  EXPECT_EQ(receiver.counts()[static_cast<std::size_t>(SignatureVerdict::kReplayed)], 2U);
}

TEST(Signing, AnotherKeyOrAChangedBitIsWrong) {
  Signing receiver(kKey, nullptr, kNow);
  Sender stranger(SigningKey{9}), sender(kKey);
  EXPECT_EQ(check(receiver, stranger.packet()), SignatureVerdict::kWrong);
  const auto good = sender.packet();
  for (std::size_t i = good.size() - kSignatureSize; i < good.size(); ++i) {
    auto changed = good;
    changed[i] ^= 1;
    EXPECT_EQ(check(receiver, changed), SignatureVerdict::kWrong) << i;
  }
  EXPECT_EQ(check(receiver, good), SignatureVerdict::kAccepted);
}

TEST(Signing, UnsignedPacketsAreRefusedButRadioStatus) {
  Signing receiver(kKey, nullptr, kNow);
  PacketWriter writer;
  EXPECT_EQ(check(receiver, testing::packet_of(writer, testing::attitude(1.0F))),
            SignatureVerdict::kUnsigned);
  EXPECT_EQ(check(receiver, testing::mavlink1(testing::attitude(1.0F))),
            SignatureVerdict::kMavlink1);
  EXPECT_EQ(check(receiver, testing::packet_of(writer, pack(mavlink_radio_status_t{}, {51, 68}))),
            SignatureVerdict::kAccepted);
}

TEST(Signing, WhatIsOlderThanAMinuteIsRefused) {
  Signing receiver(kKey, nullptr, kNow);
  Sender old(kKey, 1, kNow - kSigningMinute - 10), newer(kKey, 2, kNow - kSigningMinute + 10);
  EXPECT_EQ(check(receiver, old.packet()), SignatureVerdict::kTooOld);
  EXPECT_EQ(check(receiver, newer.packet()), SignatureVerdict::kAccepted);
  receiver.advance(kNow + 1000);
  EXPECT_EQ(check(receiver, newer.packet()), SignatureVerdict::kTooOld);
}

TEST(Signing, LinksThatAreNotListedAreRefused) {
  Signing receiver(kKey, nullptr, kNow);
  receiver.accept_links({1, 4});
  Sender listed(kKey, 4), other(kKey, 5);
  EXPECT_EQ(check(receiver, listed.packet()), SignatureVerdict::kAccepted);
  EXPECT_EQ(check(receiver, other.packet()), SignatureVerdict::kWrongLink);
}

TEST(Signing, EachLinkOfASenderHasTimesOfItsOwn) {
  Signing receiver(kKey, nullptr, kNow);
  Sender sender(kKey);
  PacketSigner other_link(sender.signing, 9);
  PacketWriter other(&other_link);
  const auto early = testing::packet_of(other, testing::attitude(2.0F));
  EXPECT_EQ(check(receiver, sender.packet()), SignatureVerdict::kAccepted);
  EXPECT_EQ(check(receiver, early), SignatureVerdict::kAccepted);
}

TEST(Signing, AfterARestartNothingIsAcceptedTwice) {
  KeptMemory store;
  Sender sender(kKey);
  const auto packet = sender.packet();
  {
    Signing receiver(kKey, &store, kNow);
    EXPECT_EQ(check(receiver, packet), SignatureVerdict::kAccepted);
  }
  Signing receiver(kKey, &store, 0);  // whose clock was lost
  EXPECT_EQ(check(receiver, packet), SignatureVerdict::kReplayed);
}

TEST(Signing, TimesAreKeptEachMinuteAndNoneIsUsedTwiceAfterACrash) {
  KeptMemory store;
  auto crashed = std::make_unique<Signing>(kKey, &store, kNow);
  EXPECT_EQ(store.saves, 1);
  crashed->advance(kNow + kSigningMinute - 1);
  EXPECT_EQ(store.saves, 1);
  crashed->advance(kNow + kSigningMinute);
  EXPECT_EQ(store.saves, 2);
  const SigningMemory at_crash = store.memory;
  crashed->advance(kNow + 2 * kSigningMinute - 1);  // the latest that it can have used
  EXPECT_GE(at_crash.newest, kNow + 2 * kSigningMinute - 1);
}

TEST(Signing, TimeCountsFromTheYear2015InTensOfMicroseconds) {
  EXPECT_EQ(signing_time(1'420'070'400'000'000'000), 0U);
  EXPECT_EQ(signing_time(1'420'070'401'000'000'000), 100'000U);
  EXPECT_EQ(signing_time(0), 0U);
}

/// A folder of its own for each test.
class SigningFiles : public ::testing::Test {
 protected:
  SigningFiles() : folder_(::testing::TempDir() + "signing_files") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  std::string write(const std::string& name, const std::string& text, mode_t mode) const {
    const std::string path = folder_ + "/" + name;
    std::ofstream(path) << text;
    ::chmod(path.c_str(), mode);
    return path;
  }
  std::string error_of(const std::string& path) const {
    try {
      read_signing_key(path);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string folder_;
};

TEST_F(SigningFiles, AKeyIsReadFromAFileThatOthersCannotRead) {
  const std::string digits = "00" + std::string(60, 'a') + "Ff";
  const SigningKey key = read_signing_key(write("key", digits + "\n", 0600));
  EXPECT_EQ(key[0], 0x00);
  EXPECT_EQ(key[1], 0xAA);
  EXPECT_EQ(key[31], 0xFF);
  EXPECT_NE(error_of(write("open", digits, 0640)).find("mode 640"), std::string::npos);
  EXPECT_NE(error_of(folder_ + "/missing").find("cannot be read"), std::string::npos);
  EXPECT_NE(error_of(write("short", "abcd", 0600)).find("4 characters"), std::string::npos);
  EXPECT_NE(error_of(write("odd", std::string(64, 'g'), 0600)).find("64 hex"), std::string::npos);
  EXPECT_NE(error_of("/dev/null").find("is a device"), std::string::npos);
}

TEST_F(SigningFiles, MemoryIsReadAsItWasKept) {
  SigningFile file(folder_ + "/times");
  EXPECT_EQ(file.load().newest, 0U);
  SigningMemory memory;
  memory.newest = kNow;
  memory.streams[{{1, 1}, 7}] = kNow - 5;
  memory.streams[{{255, 190}, 0}] = kNow - 6;
  file.save(memory);
  const SigningMemory kept = file.load();
  EXPECT_EQ(kept.newest, kNow);
  EXPECT_EQ(kept.streams.size(), 2U);
  EXPECT_EQ(kept.streams.at({{1, 1}, 7}), kNow - 5);
  EXPECT_EQ(std::filesystem::exists(folder_ + "/times.new"), false);
}

TEST_F(SigningFiles, MalformedMemoryIsAnError) {
  for (const char* text :
       {"", "something", "trident signing times 1\nx", "trident signing times 1\n5\n300 1 1 9\n",
        "trident signing times 1\n5\n1 1 1\n1 x"}) {
    SigningFile file(write("times", text, 0600));
    EXPECT_THROW(file.load(), Error) << text;
  }
}

TEST_F(SigningFiles, AFolderThatIsMissingIsAnError) {
  SigningFile file(folder_ + "/missing/times");
  EXPECT_THROW(file.save({}), Error);
}

}  // namespace
}  // namespace trident::bridges::mavlink
