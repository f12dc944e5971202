// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges/mavlink/frames.h"
#include "trident_bridges/mavlink/whole_number.h"

#include <gtest/gtest.h>

#include <vector>

#include "trident_base/angle.h"
#include "trident_base/random_stream.h"

namespace trident::bridges::mavlink {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kDegree = kPi / 180.0;

TEST(Frames, DirectionsOfTheWorldKeepTheirMeaning) {
  const Vector3d north(1, 0, 0), east(0, 1, 0), down(0, 0, 1);  // in NED
  EXPECT_EQ(swap_world(north), Vector3d(0, 1, 0));              // in ENU
  EXPECT_EQ(swap_world(east), Vector3d(1, 0, 0));
  EXPECT_EQ(swap_world(down), Vector3d(0, 0, -1));
}

TEST(Frames, DirectionsOfTheBodyKeepTheirMeaning) {
  EXPECT_EQ(swap_body({1, 0, 0}), Vector3d(1, 0, 0));
  EXPECT_EQ(swap_body({0, 1, 0}), Vector3d(0, -1, 0));
  EXPECT_EQ(swap_body({0, 0, 1}), Vector3d(0, 0, -1));
}

struct YawRow {
  const char* heading;
  double ned_deg, enu_deg;
};

TEST(Frames, HeadingsKeepTheirMeaning) {
  const std::vector<YawRow> rows{
      {"north", 0, 90},       {"east", 90, 0},    {"south", 180, -90},       {"west", -90, 180},
      {"north-east", 45, 45}, {"west", 270, 180}, {"south-west", -135, -135}};
  for (const YawRow& row : rows) {
    EXPECT_NEAR(std::cos(swap_yaw(row.ned_deg * kDegree) - row.enu_deg * kDegree), 1.0, 1e-12)
        << row.heading;
    EXPECT_NEAR(std::cos(swap_yaw(row.enu_deg * kDegree) - row.ned_deg * kDegree), 1.0, 1e-12)
        << row.heading;
  }
}

struct AttitudeRow {
  const char* pose;
  Vector3d forward_enu, up_enu;         // of the body, in the world
  double roll_deg, pitch_deg, yaw_deg;  // aerospace angles of FRD in NED
};

TEST(Frames, AttitudesKeepTheirMeaning) {
  const std::vector<AttitudeRow> rows{
      {"level, to the north", {0, 1, 0}, {0, 0, 1}, 0, 0, 0},
      {"level, to the east", {1, 0, 0}, {0, 0, 1}, 0, 0, 90},
      {"nose up, to the north", {0, 0, 1}, {0, -1, 0}, 0, 90, 0},
      {"right wing down, to the north", {0, 1, 0}, {1, 0, 0}, 90, 0, 0},
      {"on its back, to the west", {-1, 0, 0}, {0, 0, -1}, 180, 0, -90},
  };
  for (const AttitudeRow& row : rows) {
    const Quaterniond ned = AngleAxisd(row.yaw_deg * kDegree, Vector3d::UnitZ()) *
                            AngleAxisd(row.pitch_deg * kDegree, Vector3d::UnitY()) *
                            AngleAxisd(row.roll_deg * kDegree, Vector3d::UnitX());
    const Quaterniond enu = swap_attitude(ned);
    EXPECT_NEAR((enu * Vector3d::UnitX() - row.forward_enu).norm(), 0.0, 1e-12) << row.pose;
    EXPECT_NEAR((enu * Vector3d::UnitZ() - row.up_enu).norm(), 0.0, 1e-12) << row.pose;
  }
}

TEST(Frames, EachConversionIsItsOwnInverseAndFitsTheOthers) {
  const RandomStream random(3, "frames");
  for (std::uint64_t i = 0; i < 200; ++i) {
    const auto number = [&](std::uint32_t channel) { return random.normal(i, channel); };
    const Quaterniond q = Quaterniond(number(0), number(1), number(2), number(3)).normalized();
    const Vector3d v(number(4), number(5), number(6));
    EXPECT_LT(swap_attitude(swap_attitude(q)).angularDistance(q), 1e-7);
    EXPECT_EQ(swap_world(swap_world(v)), v);
    EXPECT_EQ(swap_body(swap_body(v)), v);
    // A vector of the body is the same in the world by either path.
    EXPECT_LT((swap_world(q * v) - swap_attitude(q) * swap_body(v)).norm(), 1e-12);
  }
}

TEST(Frames, CovariancesFollowTheirVectors) {
  const RandomStream random(4, "covariances");
  Matrix6 root;
  for (int i = 0; i < 36; ++i) root(i / 6, i % 6) = random.normal(0, static_cast<unsigned>(i));
  const Matrix6 covariance = root * root.transpose();
  Matrix6 world = Matrix6::Zero(), body = Matrix6::Zero();
  for (int i = 0; i < 6; ++i) {
    const Vector3d first = root.col(i).head<3>(), second = root.col(i).tail<3>();
    Eigen::Matrix<double, 6, 1> column;
    column << swap_world(first), swap_world(second);
    world += column * column.transpose();
    column << swap_body(first), swap_body(second);
    body += column * column.transpose();
  }
  EXPECT_LT((swap_world_covariance(covariance) - world).norm(), 1e-12);
  EXPECT_LT((swap_body_covariance(covariance) - body).norm(), 1e-12);
}

TEST(WholeNumbers, AreTheNearestThatAFieldHolds) {
  EXPECT_EQ(to_whole<std::int8_t>(-1000.0), -128);
  EXPECT_EQ(to_whole<std::uint32_t>(1e12), 4'294'967'295U);
  EXPECT_EQ(to_whole<std::int16_t>(std::nan("")), 0);
  EXPECT_EQ(degrees_e7(-47.12345678), -471'234'568);
  EXPECT_EQ(millimeters(1.0006), 1001);
  EXPECT_EQ(centimeters(-400.0), -32'768);
}

TEST(WholeNumbers, ACourseIsBelowAWholeTurn) {
  EXPECT_EQ(centidegrees(-0.5 * kPi), 27'000);
  EXPECT_EQ(centidegrees(deg_to_rad(359.999)), 0);
  EXPECT_EQ(centidegrees(-1e-12), 0);
}

}  // namespace
}  // namespace trident::bridges::mavlink
