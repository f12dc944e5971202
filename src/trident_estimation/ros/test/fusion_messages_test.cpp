// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/fusion_messages.h"

#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>

#include <cmath>
#include <limits>
#include <string>

#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_estimation_ros/fusion_node_params.h"
#include "trident_ros/node_params.h"

namespace trident::estimation {
namespace {

template <class Function>
std::string refusal(const Function& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

template <class Message>
std::string bytes_of(const Message& message) {
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

geometry_msgs::PoseWithCovariance pose(double variance) {
  geometry_msgs::PoseWithCovariance result;
  result.pose.position.x = 3.0;
  result.pose.orientation.w = 1.0;
  for (std::size_t i = 0; i < 6; ++i) result.covariance[7 * i] = variance;
  return result;
}

TEST(FusionPose, IsReadFromEachTypeThatHasOne) {
  nav_msgs::Odometry odometry;
  odometry.header.frame_id = "odom";
  odometry.pose = pose(0.5);
  const StampedPose read = pose_from_bytes("nav_msgs/Odometry", bytes_of(odometry));
  EXPECT_EQ(read.header.frame_id, "odom");
  EXPECT_EQ(read.pose.covariance[35], 0.5);
  EXPECT_TRUE(read.has_covariance);
  geometry_msgs::PoseStamped plain;
  plain.pose.position.y = 2.0;
  const StampedPose bare = pose_from_bytes("geometry_msgs/PoseStamped", bytes_of(plain));
  EXPECT_EQ(bare.pose.pose.position.y, 2.0);
  EXPECT_FALSE(bare.has_covariance);
  EXPECT_FALSE(is_pose_type("sensor_msgs/PointCloud2"));
  EXPECT_NE(refusal([] { pose_from_bytes("nav_msgs/Odometry", "abc"); }).find("3 bytes"),
            std::string::npos);
}

TEST(FusionPose, StampsThatWouldMakeAllOthersLateAreRefused) {
  std_msgs::Header header;
  const ros::Time now(100.0);
  EXPECT_EQ(refusal([&] { checked_stamp(header, now); }),
            "stamp is 0 s, legal: when it was measured");
  header.stamp = ros::Time(101.5);
  EXPECT_EQ(refusal([&] { checked_stamp(header, now); }),
            "stamp is 1.5 s ahead of the clock, legal: up to 1 s");
  header.stamp = ros::Time(100.5);
  EXPECT_EQ(checked_stamp(header, now), SimTime::from_seconds(100.5));
}

TEST(FusionPose, CovariancesThatAreNoneAreNamed) {
  EXPECT_EQ(pose_covariance(pose(0.0), false).matrix.size(), 0);
  EXPECT_EQ(pose_covariance(pose(0.5), false).matrix.rows(), 6);
  auto bad = pose(0.5);
  bad.covariance[1] = 0.1;
  EXPECT_EQ(refusal([&] { pose_covariance(bad, false); }), "covariance is not symmetric");
  bad.covariance[1] = bad.covariance[6] = 0.9;
  EXPECT_EQ(refusal([&] { pose_covariance(bad, false); }), "covariance is not positive definite");
  bad.covariance[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal([&] { pose_covariance(bad, false); }), "covariance is not finite");
  EXPECT_EQ(refusal([&] { pose_covariance(pose(-1.0), false); }),
            "covariance is not positive definite");
  EXPECT_NE(refusal([&] { pose_covariance(pose(1e13), false); }).find("legal: up to"),
            std::string::npos);
}

TEST(FusionPose, OfPlanarSlamHasThreeNumbers) {
  auto planar = pose(0.0);
  planar.covariance[0] = planar.covariance[7] = 0.2;
  planar.covariance[35] = 0.1;
  const PoseCovariance known = pose_covariance(planar, false);
  EXPECT_EQ(known.rows, PoseRows::kPlanar);
  EXPECT_NEAR(known.matrix(2, 2), 0.1, 1e-6);
  EXPECT_EQ(pose_covariance(pose(0.5), true).rows, PoseRows::kPlanar);
}

TEST(FusionGnss, PlacesAreEastNorthUpOfTheOrigin) {
  const GeodeticPlace origin{63.4389, 10.399, 20.0};
  EXPECT_LT(enu_from_geodetic(origin, origin).norm(), 1e-9);
  // A minute of latitude is a nautical mile: 1852 m in the mean, 1857.8 m here.
  const Eigen::Vector3d north = enu_from_geodetic({63.4389 + 1.0 / 60.0, 10.399, 20.0}, origin);
  EXPECT_NEAR(north.y(), 1858.0, 1.5);
  EXPECT_NEAR(north.x(), 0.0, 1e-6);
  EXPECT_NEAR(enu_from_geodetic({63.4389, 10.399, 32.0}, origin).z(), 12.0, 1e-6);
}

TEST(FusionGnss, FixesThatAreNoneAreRefused) {
  const GeodeticPlace origin{63.4389, 10.399, 0.0};
  sensor_msgs::NavSatFix fix;
  fix.latitude = 63.4389;
  fix.longitude = 10.399;
  EXPECT_NEAR(gnss_fix(fix, origin, 2.0).covariance(0, 0), 4.0, 1e-9);
  fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  fix.position_covariance[0] = fix.position_covariance[4] = fix.position_covariance[8] = 0.25;
  EXPECT_NEAR(gnss_fix(fix, origin, 2.0).covariance(0, 0), 0.25, 1e-6);
  fix.latitude = 91.0;
  EXPECT_NE(refusal([&] { gnss_fix(fix, origin, 2.0); }).find("latitude is 91"), std::string::npos);
  fix.status.status = -1;
  EXPECT_NE(refusal([&] { gnss_fix(fix, origin, 2.0); }).find("no fix"), std::string::npos);
}

TEST(FusionPressure, FallsByAMillibarIn8Meters) {
  sensor_msgs::FluidPressure message;
  message.fluid_pressure = 101325.0 - 100.0;
  EXPECT_NEAR(pressure_height(message, 101325.0), 8.3, 0.1);
  message.fluid_pressure = 0.0;
  EXPECT_NE(refusal([&] { pressure_height(message, 101325.0); }).find("0 Pa"), std::string::npos);
}

TEST(FusionSighting, HasTheVariancesAlongAndAcross) {
  trident_msgs::Detection detection;
  detection.pose = pose(0.0);
  detection.pose.pose.position.x = 0.0;
  detection.pose.pose.position.z = -20.0;
  detection.pose.covariance[0] = detection.pose.covariance[7] = 0.04;
  detection.pose.covariance[14] = 0.09;
  const Sighting seen = sighting_of(detection, 0.02);
  EXPECT_NEAR(seen.range, 20.0, 1e-12);
  EXPECT_NEAR(seen.range_variance, 0.09, 1e-6);
  EXPECT_NEAR(seen.direction_variance, 0.04 / 400.0, 1e-8);
  detection.pose.pose.position.z = 0.0;
  EXPECT_NE(refusal([&] { sighting_of(detection, 0.02); }).find("at least 0.01 m"),
            std::string::npos);
}

FusionNodeParams params_of(const std::string& yaml) {
  return load_yaml_string<FusionNodeParams>(yaml, "fusion.yaml");
}

TEST(FusionParams, TheTutorialsFileMakesATeamOfThree) {
  const FusionNodeParams params = params_of(
      "fusion_method: 1\nupdate_rate: 20.0\nuav_pose_topic: /uav/vins/odometry\n"
      "ugv_pose_topic: /ugv/scan_matched_points2\nusv_pose_topic: /usv/icp_odom\n");
  const auto robots = params.all_robots();
  ASSERT_EQ(robots.size(), 3U);
  EXPECT_EQ(robots.at("usv").pose_topic, "/usv/icp_odom");
  EXPECT_EQ(robots.at("uav").kind, "uav");
  EXPECT_EQ(params.options().kind, FilterKind::kUkf);
}

TEST(FusionParams, ContradictionsAreNamed) {
  EXPECT_NE(refusal([] { params_of("update_rate: 5.0\n"); }).find("no robot is given"),
            std::string::npos);
  EXPECT_NE(refusal([] {
              params_of("uav_pose_topic: /a\nranges: [{topic: r, robot: uav, other: ugv}]\n");
            }).find("'ugv' is not a robot"),
            std::string::npos);
}

TEST(FusionParams, ShippedFilesAreRead) {
  const auto shipped = load_yaml<FusionNodeParams>(FLEET_CONFIGS "/fusion.yaml");
  EXPECT_EQ(shipped.all_robots().size(), 3U);
  const auto coast = load_yaml<FusionNodeParams>(FLEET_CONFIGS "/fusion_coast.yaml");
  EXPECT_EQ(coast.all_robots().size(), 3U);
}

TEST(FusionParams, TheReferenceIsThatOfTheStruct) {
  const std::string page = ros_utils::params_page(
      "team_fusion_node",
      "Private parameters of the fusion of a team, printed from the node's struct.",
      ros_utils::document_params<FusionNodeParams>());
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/team_fusion_node.md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

}  // namespace
}  // namespace trident::estimation
