// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "graph_slam/session/session_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

namespace fs = std::filesystem;

BinaryWriter numbers(std::uint32_t first, std::uint32_t count) {
  BinaryWriter writer;
  for (std::uint32_t i = 0; i < count; ++i) writer.put(first + i);
  return writer;
}

class SessionFile : public ::testing::Test {
 protected:
  SessionFile() { fs::create_directories(folder_); }
  ~SessionFile() override { fs::remove_all(folder_); }

  static std::string bytes_of(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  static void put(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }
  std::uint32_t first_number() const { return read_session_file(path_).get<std::uint32_t>(); }

  std::string folder_ = ::testing::TempDir() + "/session_file_" + std::to_string(getpid());
  std::string path_ = folder_ + "/a.posegraph";
  std::string unfinished_ = path_ + ".new";
};

TEST_F(SessionFile, AtEveryByteOfASaveTheOneBeforeItStillLoads) {
  write_session_file(path_, numbers(2, 4));
  const std::string next = bytes_of(path_);
  write_session_file(path_, numbers(1, 4));
  EXPECT_FALSE(fs::exists(unfinished_));
  for (std::size_t written = 0; written <= next.size(); ++written) {
    put(unfinished_, next.substr(0, written));  // the process ended here
    ASSERT_EQ(first_number(), 1U) << written;
  }
  write_session_file(path_, numbers(2, 4));  // a leftover file does not disturb
  EXPECT_EQ(first_number(), 2U);
  EXPECT_EQ(bytes_of(path_), next);
}

TEST_F(SessionFile, EveryCutAndEveryChangedByteIsReported) {
  write_session_file(path_, numbers(1, 4));
  const std::string whole = bytes_of(path_);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] ^= 0x20;
    for (const std::string& bytes : {changed, whole.substr(0, i), whole + "x"}) {
      put(path_, bytes);
      try {
        read_session_file(path_);
        FAIL() << "byte " << i << " accepted";
      } catch (const Error& error) {
        ASSERT_NE(std::string(error.what()).find(path_), std::string::npos) << error.what();
      }
    }
  }
}

// Sessions of 80 kB are written one after the other until the writer is killed; whenever that is,
// a whole one is there, and never an older one than was there before.
TEST_F(SessionFile, AKilledWriterLeavesAWholeSession) {
  write_session_file(path_, numbers(0, 20'000));
  for (int round = 0; round < 10; ++round) {
    const std::uint32_t before = first_number();
    const pid_t writer = fork();
    ASSERT_GE(writer, 0);
    if (writer == 0) {
      for (std::uint32_t i = before + 1;; ++i) write_session_file(path_, numbers(i, 20'000));
    }
    // Killed in the middle of a file, or, every other time, once a few have been written.
    const std::uint32_t least = before + (round % 2 == 0 ? 0 : 3);
    while (first_number() < least || !fs::exists(unfinished_)) {
    }
    kill(writer, SIGKILL);
    waitpid(writer, nullptr, 0);
    EXPECT_GE(first_number(), least);
  }
}

TEST_F(SessionFile, AFolderThatIsNotThereIsNamed) {
  const std::string path = folder_ + "/no/such/folder/a.posegraph";
  try {
    write_session_file(path, numbers(1, 1));
    FAIL() << "written";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              path + ".new: cannot be written: No such file or directory");
  }
}

}  // namespace
}  // namespace trident::slam
