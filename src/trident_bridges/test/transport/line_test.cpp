// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "running_loop.h"
#include "transport/descriptor.h"
#include "transport/line_sender.h"
#include "transport/line_settings.h"

namespace trident::bridges {
namespace {

class Line : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "lineXXXXXX";
    folder_ = mkdtemp(name.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  EndpointOptions options(const std::string& url) const {
    EndpointOptions result = Recorded::options_of(url);
    result.retry_s = 0.01;
    return result;
  }
  Descriptor open_device(const std::string& name) const {
    return Descriptor(open(path(name).c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  }

  std::filesystem::path folder_;
  EpollLoop loop_;
};

std::string read_all(int descriptor) {
  std::array<char, 65536> buffer;
  const auto size = read(descriptor, buffer.data(), buffer.size());
  return {buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

void write_all(int descriptor, const std::string& text) {
  EXPECT_EQ(write(descriptor, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

TEST_F(Line, APtyAndASerialLineTalk) {
  Recorded far(loop_, options("pty://" + path("gps") + ":921600"));
  Recorded near(loop_, options(path("gps") + ":921600"));
  ASSERT_TRUE(run_until(loop_, [&] { return far.has_joined() && near.has_joined(); }));
  std::string all_bytes;
  for (int i = 0; i < 256; ++i) all_bytes += static_cast<char>(i);
  EXPECT_TRUE(near.endpoint->send(1, bytes_of(all_bytes)));
  EXPECT_TRUE(far.endpoint->send(1, bytes_of(all_bytes)));
  ASSERT_TRUE(run_until(loop_, [&] { return far.text[1].size() == 256; }));
  ASSERT_TRUE(run_until(loop_, [&] { return near.text[1].size() == 256; }));
  EXPECT_EQ(far.text[1], all_bytes);
  EXPECT_EQ(near.text[1], all_bytes);
}

TEST_F(Line, BlocksThatWaitForTheLineLeaveInTurn) {
  Recorded pty(loop_, options("pty://" + path("gps") + ":460800"));
  const Descriptor reader = open_device("gps");
  ASSERT_TRUE(run_until(loop_, [&] { return pty.has_joined(); }));
  const std::string first = "first,", second = "second,", third = "third";
  const std::vector<Bytes> blocks{bytes_of(first), bytes_of(second), bytes_of(third)};
  EXPECT_EQ(pty.endpoint->send_batch(1, blocks), 3);
  std::string text;
  ASSERT_TRUE(run_until(loop_, [&] { return (text += read_all(reader.get())).size() >= 18; }));
  EXPECT_EQ(text, "first,second,third");
  EXPECT_EQ(pty.endpoint->counts().sent, 3U);
}

TEST_F(Line, WhatIsSentThroughAPtyThatNobodyReadsIsDropped) {
  Recorded pty(loop_, options("pty://" + path("gps")));
  EXPECT_FALSE(pty.endpoint->send(1, bytes_of("old")));
  EXPECT_TRUE(pty.endpoint->peers().empty());
  const Descriptor reader = open_device("gps");
  ASSERT_TRUE(run_until(loop_, [&] { return pty.has_joined(); }));
  EXPECT_EQ(pty.endpoint->send_to_all(bytes_of("new")), 1);
  std::string text;
  ASSERT_TRUE(run_until(loop_, [&] { return !(text += read_all(reader.get())).empty(); }));
  EXPECT_EQ(text, "new");
}

TEST_F(Line, ALaterReaderOfAPtyDoesNotGetTheEarliersRest) {
  Recorded pty(loop_, options("pty://" + path("gps") + ":4000000"));
  Descriptor reader = open_device("gps");
  ASSERT_TRUE(run_until(loop_, [&] { return pty.has_joined(); }));
  pty.endpoint->send(1, bytes_of("not read"));
  ASSERT_TRUE(run_until(loop_, [&] { return pty.endpoint->counts().sent == 1; }));
  reader.reset();
  ASSERT_TRUE(run_until(loop_, [&] { return !pty.left.empty(); }));
  pty.joined.clear();
  reader = open_device("gps");
  ASSERT_TRUE(run_until(loop_, [&] { return pty.has_joined(); }));
  pty.endpoint->send(1, bytes_of("for the second"));
  std::string text;
  ASSERT_TRUE(run_until(loop_, [&] { return (text += read_all(reader.get())).size() >= 14; }));
  EXPECT_EQ(text, "for the second");
}

TEST_F(Line, APtyWhosePeerNeverReadsCutsWholeBlocksAndKeepsRunning) {
  Recorded pty(loop_, options("pty://" + path("gps") + ":4000000"));
  const Descriptor reader = open_device("gps");
  ASSERT_TRUE(run_until(loop_, [&] { return pty.has_joined(); }));
  const std::string block = std::string(998, 'x') + "\r\n";
  std::size_t taken = 0;
  while (pty.endpoint->counts().cut < 10) {
    taken += pty.endpoint->send(1, bytes_of(block)) ? 1 : 0;
    loop_.run_once(0.0);
  }
  std::string text;
  ASSERT_TRUE(run_until(
      loop_, [&] { return (text += read_all(reader.get())).size() == taken * block.size(); }));
  for (std::size_t i = 0; i < text.size(); i += block.size()) {
    ASSERT_EQ(text.substr(i, block.size()), block);
  }
}

TEST_F(Line, ASerialDeviceContinuesWhenItIsPluggedInAgain) {
  Recorded serial(loop_, options("serial://" + path("tty")));
  ASSERT_TRUE(run_until(loop_, [&] { return !serial.warnings.empty(); }));
  EXPECT_NE(serial.warnings[0].find("No such file or directory"), std::string::npos);
  for (std::size_t run = 1; run <= 3; ++run) {
    // A device whose far end vanishes behaves as one that is unplugged.
    const Descriptor device(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    ASSERT_EQ(unlockpt(device.get()), 0);
    std::filesystem::create_symlink(ptsname(device.get()), path("tty"));
    ASSERT_TRUE(run_until(loop_, [&] { return serial.has_joined(); }));
    serial.joined.clear();
    write_all(device.get(), "run" + std::to_string(run));
    ASSERT_TRUE(run_until(loop_, [&] { return serial.text[1].size() == 4 * run; }));
    std::filesystem::remove(path("tty"));
    EXPECT_EQ(serial.endpoint->counts().reconnects, run - 1);
  }
  EXPECT_EQ(serial.text[1], "run1run2run3");
  ASSERT_TRUE(run_until(loop_, [&] { return serial.endpoint->peers().empty(); }));
  EXPECT_FALSE(serial.endpoint->send(1, bytes_of("nobody")));
}

// A pseudo-terminal whose far end a test has.
struct FarEnd {
  FarEnd() : master(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    EXPECT_EQ(unlockpt(master.get()), 0);
    name = ptsname(master.get());
  }
  Descriptor master;
  std::string name;
};

// Ends what a serial endpoint reads; returns terminals that other programs have opened since.
std::vector<FarEnd> strangers_after(EpollLoop& loop, Recorded& serial,
                                    std::unique_ptr<FarEnd> own) {
  EXPECT_TRUE(run_until(loop, [&] { return serial.has_joined(); }));
  const std::string name = own->name;
  own.reset();
  EXPECT_TRUE(run_until(loop, [&] { return serial.endpoint->peers().empty(); }));
  std::vector<FarEnd> strangers(3);
  for (const FarEnd& stranger : strangers) EXPECT_NE(stranger.name, name);
  EXPECT_TRUE(run_until(loop, [&] { return !serial.warnings.empty(); }));
  EXPECT_EQ(serial.endpoint->counts().reconnects, 0U);
  return strangers;
}

TEST_F(Line, ATerminalThatHasVanishedIsNotReplacedByAStrangersOfItsNumber) {
  auto own = std::make_unique<FarEnd>();
  Recorded serial(loop_, options("serial://" + own->name));
  strangers_after(loop_, serial, std::move(own));
  EXPECT_NE(serial.warnings[0].find("No such file or directory"), std::string::npos);
}

TEST_F(Line, ALinkThatWasLeftBehindDoesNotLeadToAStrangersTerminal) {
  auto own = std::make_unique<FarEnd>();
  std::filesystem::create_symlink(own->name, path("tty"));
  Recorded serial(loop_, options("serial://" + path("tty")));
  const auto strangers = strangers_after(loop_, serial, std::move(own));
  std::filesystem::remove(path("tty"));
  std::filesystem::create_symlink(strangers[0].name, path("tty"));
  EXPECT_TRUE(run_until(loop_, [&] { return serial.endpoint->counts().reconnects == 1; }));
}

TEST_F(Line, ADeviceHasOneReader) {
  Recorded pty(loop_, options("pty://" + path("gps")));
  auto first = std::make_unique<Recorded>(loop_, options(path("gps")));
  ASSERT_TRUE(run_until(loop_, [&] { return first->has_joined(); }));
  Recorded second(loop_, options(path("gps")));
  ASSERT_TRUE(run_until(loop_, [&] { return !second.warnings.empty(); }));
  EXPECT_NE(second.warnings[0].find("Device or resource busy"), std::string::npos);
  first.reset();
  EXPECT_TRUE(run_until(loop_, [&] { return second.has_joined(); }));
}

TEST_F(Line, ABlockDoesNotLeaveBeforeItsLastByteWould) {
  Recorded pty(loop_, options("pty://" + path("gps") + ":50"));
  const Descriptor reader = open_device("gps");
  ASSERT_TRUE(run_until(loop_, [&] { return pty.has_joined(); }));
  EXPECT_TRUE(pty.endpoint->send(1, bytes_of(std::string(4000, 'x'))));  // 800 s at 50 baud
  EXPECT_FALSE(pty.endpoint->send(1, bytes_of(std::string(1000, 'x'))));
  loop_.run_once(0.0);
  EXPECT_EQ(read_all(reader.get()), "");
  EXPECT_EQ(pty.endpoint->counts().cut, 1U);
  EndpointOptions at_once = options("pty://" + path("fast") + ":50");
  at_once.keeps_baud = false;
  Recorded fast(loop_, at_once);
  const Descriptor fast_reader = open_device("fast");
  ASSERT_TRUE(run_until(loop_, [&] { return fast.has_joined(); }));
  EXPECT_TRUE(fast.endpoint->send(1, bytes_of(std::string(1000, 'x'))));
  EXPECT_EQ(fast.endpoint->counts().sent, 1U);
}

TEST_F(Line, ALinkOfAnEarlierRunIsReplacedAndAFileIsNot) {
  std::filesystem::create_symlink("/dev/pts/99999", path("gps"));
  {
    const Recorded pty(loop_, options("pty://" + path("gps")));
    EXPECT_NE(std::filesystem::read_symlink(path("gps")), "/dev/pts/99999");
  }
  EXPECT_FALSE(std::filesystem::is_symlink(path("gps")));
  std::ofstream(path("file")) << "kept";
  EXPECT_NE(refusal_of(options("pty://" + path("file"))).find("File exists"), std::string::npos);
  EXPECT_NE(refusal_of(options("serial://" + path("file"))).find("device"), std::string::npos);
  EXPECT_NE(refusal_of(options("pty://" + path("no/gps"))).find("No such file"), std::string::npos);
}

TEST(LineSchedule, BlocksFollowEachOtherAtTheLinesSpeed) {
  LineSchedule schedule(0.01);
  EXPECT_DOUBLE_EQ(schedule.leave_s(5.0, 100), 6.0);
  EXPECT_DOUBLE_EQ(schedule.leave_s(5.5, 50), 6.5);    // waits for the first
  EXPECT_DOUBLE_EQ(schedule.leave_s(10.0, 50), 10.5);  // the line was free
  schedule.hold(12.0);
  EXPECT_DOUBLE_EQ(schedule.leave_s(11.0, 50), 12.5);
  LineSchedule at_once(0.0);
  EXPECT_DOUBLE_EQ(at_once.leave_s(5.0, 100), 5.0);
}

TEST(Options, AnIllegalOneIsNamedWithItsRange) {
  EndpointOptions options = Recorded::options_of("udp://@");
  options.max_peers = 0;
  EXPECT_EQ(refusal_of(options), "max_peers 0 is not legal; legal: 1 to 4096");
  options = Recorded::options_of("/dev/ttyS0");
  options.stop_bits = 3;
  EXPECT_EQ(refusal_of(options), "stop_bits 3 is not legal; legal: 1, 2");
}

}  // namespace
}  // namespace trident::bridges
