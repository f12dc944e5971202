// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/bag_file.h"

#include <gtest/gtest.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace trident::slam {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(std::uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

std::string field(const std::string& name, const std::string& value) {
  const std::string text = name + "=" + value;
  return bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

std::string record(const std::string& header, const std::string& data) {
  return bytes_of(static_cast<std::uint32_t>(header.size())) + header +
         bytes_of(static_cast<std::uint32_t>(data.size())) + data;
}

template <class M>
std::string connection(std::uint32_t id, const std::string& topic) {
  return record(field("conn", bytes_of(id)) + field("op", "\x07") + field("topic", topic),
                field("md5sum", ros::message_traits::MD5Sum<M>::value()) + field("topic", topic) +
                    field("type", ros::message_traits::DataType<M>::value()));
}

template <class M>
std::string message(std::uint32_t id, std::uint32_t time_s, const M& value) {
  std::string data(ros::serialization::serializationLength(value), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(data.data()),
                                     static_cast<std::uint32_t>(data.size()));
  ros::serialization::serialize(stream, value);
  return record(field("conn", bytes_of(id)) + field("op", "\x02") +
                    field("time", bytes_of(time_s) + bytes_of(0)),
                data);
}

std::string chunk(const std::string& content) {
  return record(field("compression", "none") + field("op", "\x05") +
                    field("size", bytes_of(static_cast<std::uint32_t>(content.size()))),
                content);
}

sensor_msgs::LaserScan scan(int number) {
  sensor_msgs::LaserScan made;
  made.header.frame_id = "laser";
  made.ranges.assign(20, static_cast<float>(number));
  return made;
}

/// Chunks of five scans each, one second apart.
std::string a_bag(int chunks) {
  std::string bag = "#ROSBAG V2.0\n";
  bag += record(field("op", "\x03") + field("index_pos", std::string(8, '\0')), "padding");
  for (int i = 0; i < chunks; ++i) {
    std::string content = connection<sensor_msgs::LaserScan>(0, "/scan");
    for (int k = 0; k < 5; ++k) {
      content += message(0, static_cast<std::uint32_t>(10 + 5 * i + k), scan(5 * i + k));
    }
    bag += chunk(content);
  }
  return bag;
}

class BagFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("bag_file_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string write(const std::string& content) const {
    const fs::path path = folder_ / "a.bag";
    std::ofstream(path, std::ios::binary) << content;
    return path.string();
  }
  /// First range of each scan that is whole.
  static std::vector<int> whole_scans(BagFile& bag) {
    std::vector<int> found;
    for (const BagFile::Message& message : bag.messages({"/scan"})) {
      try {
        const auto made = bag.instantiate<sensor_msgs::LaserScan>(message);
        if (made && !made->ranges.empty()) found.push_back(static_cast<int>(made->ranges[0]));
      } catch (const Error&) {
        continue;
      }
    }
    return found;
  }

  fs::path folder_;
};

TEST_F(BagFileTest, MessagesComeByTheirTimeWithoutAnIndex) {
  std::string content = connection<sensor_msgs::LaserScan>(3, "/scan");
  for (const std::uint32_t second : {7u, 5u, 6u, 5u}) {
    content += message(3, second, scan(static_cast<int>(second)));
  }
  BagFile bag(write("#ROSBAG V2.0\n" + chunk(content)));
  EXPECT_EQ(whole_scans(bag), (std::vector<int>{5, 5, 6, 7}));
  EXPECT_TRUE(bag.damage().empty());
  ASSERT_EQ(bag.connections().size(), 1u);
  EXPECT_EQ(bag.connections()[0].type, "sensor_msgs/LaserScan");
  EXPECT_TRUE(bag.messages({"/other"}).empty());
  EXPECT_EQ(bag.instantiate<tf2_msgs::TFMessage>(bag.messages({"/scan"})[0]), nullptr);
}

TEST_F(BagFileTest, WhatIsWholeNextToDamageIsUsedAndTheOffsetReported) {
  const std::string good = a_bag(3);
  std::string bad = good;
  const std::size_t second = good.find("compression=", good.find("compression=") + 1);
  bad.replace(second - 8, 4, "\xff\xff\xff\x7f");  // a header of 2 GB
  BagFile bag(write(bad));
  EXPECT_EQ(whole_scans(bag), (std::vector<int>{0, 1, 2, 3, 4, 10, 11, 12, 13, 14}));
  ASSERT_EQ(bag.damage().size(), 1u);
  EXPECT_NE(bag.damage()[0].find("damaged at offset " + std::to_string(second - 8) + ": "),
            std::string::npos)
      << bag.damage()[0];
}

TEST_F(BagFileTest, ARecordingThatEndsEarlyIsReadToItsEnd) {
  const std::string good = a_bag(2);
  BagFile bag(write(good.substr(0, good.size() - 300)));
  EXPECT_EQ(whole_scans(bag), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  ASSERT_EQ(bag.damage().size(), 1u);
  EXPECT_NE(bag.damage()[0].find("300 bytes early"), std::string::npos) << bag.damage()[0];
}

TEST_F(BagFileTest, AnArrayLongerThanItsMessageIsNotBelieved) {
  std::string bag_bytes = a_bag(1);
  const std::string length = bytes_of(20);
  bag_bytes.replace(bag_bytes.find(length + bytes_of(0)), 4, "\xff\xff\xff\xff");
  BagFile bag(write(bag_bytes));
  EXPECT_EQ(whole_scans(bag), (std::vector<int>{1, 2, 3, 4}));
  try {
    bag.instantiate<sensor_msgs::LaserScan>(bag.messages({"/scan"})[0]);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("an array of 4294967295 elements"), std::string::npos)
        << error.what();
  }
}

TEST_F(BagFileTest, WhatIsNoBagIsRefused) {
  for (const char* path : {"/dev/zero", "/nowhere/a.bag", "/tmp"}) {
    EXPECT_THROW(BagFile bag(path), Error) << path;
  }
  for (const std::string& content : {std::string(), std::string("#ROSBAG V1.2\nabc")}) {
    EXPECT_THROW(BagFile bag(write(content)), Error);
  }
  EXPECT_TRUE(BagFile(write("#ROSBAG V2.0\n")).connections().empty());
}

TEST_F(BagFileTest, DamageOfAnyKindCrashesNothing) {
  const std::string good = a_bag(3);
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round) {
    std::string bad = good;
    const int changes = 1 + static_cast<int>(random() % 8);
    for (int i = 0; i < changes; ++i) bad[random() % bad.size()] = static_cast<char>(random());
    if (random() % 4 == 0) bad.resize(random() % bad.size());
    try {
      BagFile bag(write(bad));
      EXPECT_LE(whole_scans(bag).size(), 15u);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()), "");
    }
  }
}

}  // namespace
}  // namespace trident::slam
