// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/carmen_log.h"

#include <bzlib.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

std::string flaser(const std::string& ranges, const std::string& poses_and_stamp) {
  return "FLASER " + ranges + " " + poses_and_stamp + " host 0.1\n";
}

class CarmenLogTest : public testing::Test {
 protected:
  std::string path_ = testing::TempDir() + "carmen_log_test_" + std::to_string(getpid()) + ".log";
  ~CarmenLogTest() override { std::filesystem::remove(path_); }

  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }
  std::vector<ScanRecord> read(CarmenLog& log) const {
    std::vector<ScanRecord> records;
    ScanRecord record;
    while (log.next(record)) records.push_back(record);
    return records;
  }
  std::vector<ScanRecord> read_text(const std::string& text) const {
    write(text);
    CarmenLog log(path_);
    return read(log);
  }
};

TEST_F(CarmenLogTest, FlaserCarriesLaserAndBase) {
  // The base looks along +y, the laser sits 4 cm behind its middle.
  const auto records = read_text("# a comment\n\nODOM 0 0 0 0 0 0 5 host 0\n" +
                                 flaser("2 1.5 2.5",
                                        "1.0 1.96 1.570796 1.0 2.0 1.570796 "
                                        "976052857.337530"));
  ASSERT_EQ(records.size(), 1U);
  const ScanRecord& record = records[0];
  EXPECT_EQ(record.scan.stamp_ns, 976052857'337530000);
  EXPECT_NEAR(record.scan.T_base_laser.p.x(), -0.04, 1e-9);
  EXPECT_NEAR(record.scan.T_base_laser.p.y(), 0.0, 1e-9);
  EXPECT_EQ(record.T_odom_base.p, Eigen::Vector2d(1.0, 2.0));
  EXPECT_FLOAT_EQ(record.scan.ranges[1], 2.5F);
}

class BeamAngles : public CarmenLogTest,
                   public testing::WithParamInterface<std::pair<int, double>> {};

TEST_P(BeamAngles, AreThoseOfSickScanners) {
  const auto [beams, step_deg] = GetParam();
  std::string ranges = std::to_string(beams);
  for (int i = 0; i < beams; ++i) ranges += " 1.0";
  const auto records = read_text(flaser(ranges, "0 0 0 0 0 0 1"));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(records[0].scan.angle_min, beams == 401 ? -50.0 * kDegree : -90.0 * kDegree, 1e-12);
  EXPECT_NEAR(records[0].scan.angle_increment, step_deg * kDegree, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(All, BeamAngles,
                         testing::Values(std::pair(180, 1.0), std::pair(181, 1.0),
                                         std::pair(360, 0.5), std::pair(361, 0.5),
                                         std::pair(401, 0.25), std::pair(721, 0.25)));

TEST_F(CarmenLogTest, StampsAreLabels) {
  const auto records =
      read_text(flaser("1 1", "0 0 0 0 0 0 10.5") + flaser("1 2", "0 0 0 0 0 0 9.9") +
                flaser("1 3", "0 0 0 0 0 0 10.5"));
  ASSERT_EQ(records.size(), 3U);
  EXPECT_EQ(records[1].scan.stamp_ns, 9'900'000'000);
  EXPECT_FLOAT_EQ(records[2].scan.ranges[0], 3.0F);
}

TEST_F(CarmenLogTest, ReadingsAtTheLimitAreNoReturns) {
  const auto records = read_text("PARAM robot_front_laser_max 8.0 host 0\n" +
                                 flaser("4 7.99 8.0 81.91 nan", "0 0 0 0 0 0 1"));
  ASSERT_EQ(records.size(), 1U);
  EXPECT_TRUE(records[0].scan.is_return(0));
  for (const std::size_t beam : {1U, 2U, 3U}) EXPECT_FALSE(records[0].scan.is_return(beam));
}

TEST_F(CarmenLogTest, RobotlaserCarriesItsAngles) {
  const auto records = read_text(
      "PARAM laser_time_increment 0.0001 host 0\n"
      "ROBOTLASER1 0 -1.5 3.0 1.5 30.0 0.01 0 3 1.0 29.0 30.0 0 "
      "0.3 0 0.1 0 0 0 0 0 0.2 0.2 0 1700000000.123456789 host 1.0\n");
  ASSERT_EQ(records.size(), 1U);
  const LaserScan& scan = records[0].scan;
  EXPECT_EQ(scan.angle_min, -1.5);
  EXPECT_EQ(scan.angle_increment, 1.5);
  EXPECT_EQ(scan.time_increment, 0.0001);
  EXPECT_EQ(scan.stamp_ns, 1700000000'123456789);
  EXPECT_NEAR(scan.T_base_laser.p.x(), 0.3, 1e-12);
  EXPECT_NEAR(scan.T_base_laser.angle, 0.1, 1e-12);
  EXPECT_TRUE(scan.is_return(1));
  EXPECT_FALSE(scan.is_return(2));
}

TEST_F(CarmenLogTest, RearLaserIsReadOnDemand) {
  write(flaser("1 1", "0 0 0 0 0 0 1") + "RLASER 1 2.0 -0.2 0 3.141593 0 0 0 1.1 host 0\n");
  CarmenLog log(path_, CarmenLog::Laser::kRear);
  const auto records = read(log);
  ASSERT_EQ(records.size(), 1U);
  EXPECT_NEAR(records[0].scan.T_base_laser.p.x(), -0.2, 1e-9);
  EXPECT_NEAR(std::abs(records[0].scan.T_base_laser.angle), 180.0 * kDegree, 1e-5);
}

TEST_F(CarmenLogTest, BadLinesAreNamedAndPassedOver) {
  write(flaser("1 1", "0 0 0 0 0 0 1") + flaser("3 1 2", "0 0 0 0 0 0 2") +
        flaser("1 x", "0 0 0 0 0 0 3") + flaser("1 1", "0 0 nan 0 0 0 4") +
        flaser("99999999 1", "0 0 0 0 0 0 5") + flaser("1 1", "0 0 0 0 0 0 6") + "FLASER 2 1.0");
  CarmenLog log(path_);
  EXPECT_EQ(read(log).size(), 2U);
  ASSERT_EQ(log.problems().count(), 5U);
  const auto& texts = log.problems().texts();
  EXPECT_EQ(texts[1], path_ + ":3: FLASER: reading 1 of 1 is missing or not a number");
  EXPECT_EQ(texts[2], path_ + ":4: FLASER: the laser's pose is not three finite numbers");
  EXPECT_NE(texts[3].find("number of readings 99999999, legal: 1 to 100000"), std::string::npos);
  EXPECT_NE(texts[4].find(":7: FLASER: reading 2 of 2 is missing or not a number (truncated file)"),
            std::string::npos)
      << texts[4];
}

// A log whose odometry was lost, or that has one pose twice.
TEST_F(CarmenLogTest, OfTwoEqualPosesTheParameterGivesWhereTheLaserSits) {
  write("PARAM robot_frontlaser_offset -0.04 1 host 1\n" + flaser("1 1", "0 0 0 0 0 0 1") +
        flaser("1 1", "0 0 0 0 0 0 2"));
  CarmenLog log(path_);
  const auto records = read(log);
  ASSERT_EQ(records.size(), 2U);
  for (const ScanRecord& record : records) {
    EXPECT_EQ(record.scan.T_base_laser.p, Eigen::Vector2d(-0.04, 0.0));
  }
  EXPECT_EQ(log.problems().count(), 0U);
}

TEST_F(CarmenLogTest, ALaserThatMovesKeepsItsFirstPlace) {
  write(flaser("1 1", "0.1 0 0 0 0 0 1") + flaser("1 1", "5 5 0 4 5 0 2") +
        flaser("1 1", "5 5 0 4 5 0 3"));
  CarmenLog log(path_);
  const auto records = read(log);
  ASSERT_EQ(records.size(), 3U);
  EXPECT_NEAR(records[2].scan.T_base_laser.p.x(), 0.1, 1e-9);
  ASSERT_EQ(log.problems().count(), 1U);
  EXPECT_NE(log.problems().texts()[0].find(":2: the laser moves on the base by 0.9 m"),
            std::string::npos)
      << log.problems().texts()[0];
}

std::string many_scans() {
  std::string text;
  for (int i = 0; i < 5000; ++i) {
    text += flaser("3 1 2 " + std::to_string(i), "0 0 0 0 0 0 " + std::to_string(i));
  }
  return text;
}

std::string bzip2(std::string text) {
  std::string packed(text.size() + 1000, '\0');
  unsigned size = static_cast<unsigned>(packed.size());
  BZ2_bzBuffToBuffCompress(packed.data(), &size, text.data(), static_cast<unsigned>(text.size()), 1,
                           0, 0);
  packed.resize(size);
  return packed;
}

std::string gzip(const std::string& text, const std::string& path) {
  gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  std::ifstream packed(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(packed), {}};
}

TEST_F(CarmenLogTest, CompressionDoesNotMatter) {
  const std::string text = many_scans();
  const std::size_t half = text.find('\n', text.size() / 2) + 1;
  const std::vector<std::string> files = {text, gzip(text, path_), bzip2(text),
                                          bzip2(text.substr(0, half)) + bzip2(text.substr(half))};
  for (const std::string& bytes : files) {
    write(bytes);
    CarmenLog log(path_);
    const auto records = read(log);
    ASSERT_EQ(records.size(), 5000U);
    EXPECT_EQ(records[4999].scan.stamp_ns, 4999'000'000'000);
    EXPECT_EQ(log.problems().count(), 0U);
    EXPECT_NEAR(log.progress(), 1.0, 1e-9);
  }
}

TEST_F(CarmenLogTest, TruncatedCompressionIsReported) {
  const std::string text = many_scans();
  const std::string gz = gzip(text, path_);
  const std::string bz2 = bzip2(text);
  for (const std::string& bytes : {gz.substr(0, gz.size() / 2), bz2.substr(0, bz2.size() / 2)}) {
    write(bytes);
    CarmenLog log(path_);
    const std::size_t scans = read(log).size();
    EXPECT_LT(scans, 5000U);
    ASSERT_GE(log.problems().count(), 1U);
    EXPECT_NE(log.problems().texts().back().find("truncated file"), std::string::npos);
  }
}

TEST_F(CarmenLogTest, DamagedCompressionIsReported) {
  std::string bytes = bzip2(many_scans());
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
  write(bytes);
  CarmenLog log(path_);
  read(log);
  ASSERT_GE(log.problems().count(), 1U);
  EXPECT_NE(log.problems().texts().back().find("damaged bzip2 data"), std::string::npos);
}

TEST_F(CarmenLogTest, MissingFileIsAnError) { EXPECT_THROW(CarmenLog("no/such.log"), Error); }

}  // namespace
}  // namespace trident::slam
