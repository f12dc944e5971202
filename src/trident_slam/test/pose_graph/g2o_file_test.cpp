// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "pose_graph/random_graphs.h"
#include "trident_base/error.h"
#include "trident_slam/pose_graph_g2o.h"

namespace trident::slam {
namespace {

class G2oFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    file_ = testing::TempDir() + "trident_" + test->name() + ".g2o";
  }
  void TearDown() override {
    std::remove(file_.c_str());
    std::remove((file_ + ".gz").c_str());
  }

  auto read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_g2o(file_);
  }
  // What the error says, without the name of the file.
  std::string problem(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(file_, 0), 0u) << message;
      return message.substr(file_.size());
    }
    return "no error";
  }

  std::string file_;
};

constexpr char kPlane[] =
    "# a comment\n"
    "VERTEX_SE2 0 0 0 0\n"
    "VERTEX_SE2 5 1.5 +2 -0.5\r\n"
    "\n"
    "FIX 5\n"
    "EDGE_SE2 0 5 1 2 3.5 1 0 0 2 0.5 3 \n";

TEST_F(G2oFile, ReadsThePlane) {
  const auto graph = std::get<PoseGraph2d>(read(kPlane));
  ASSERT_EQ(graph.vertices().size(), 2u);
  EXPECT_EQ(graph.pose(5).p, Eigen::Vector2d(1.5, 2.0));
  EXPECT_TRUE(graph.vertices()[1].is_fixed);
  ASSERT_EQ(graph.edges().size(), 1u);
  const auto& edge = graph.edges().front();
  EXPECT_EQ(edge.information(1, 2), 0.5);
  EXPECT_EQ(edge.information(2, 1), 0.5);
  EXPECT_NEAR(edge.T_from_to.angle, 3.5 - 6.283185307179586, 1e-15);
  EXPECT_FALSE(edge.is_trusted);
}

template <class Group>
void check_round_trip(const std::string& file) {
  PoseGraph<Group> graph = grid_graph<Group>(3, 4, 0.1, 1);
  graph.set_fixed(2, true);
  write_g2o(graph, file);
  const auto first = std::get<PoseGraph<Group>>(read_g2o(file));
  write_g2o(first, file);
  const auto again = std::get<PoseGraph<Group>>(read_g2o(file));
  ASSERT_EQ(again.vertices().size(), 12u);
  ASSERT_EQ(again.edges().size(), graph.edges().size());
  EXPECT_TRUE(again.vertices()[2].is_fixed);
  EXPECT_NEAR(pose_graph_chi2(again), pose_graph_chi2(graph), 1e-9);
  for (int id = 0; id < 12; ++id) {
    EXPECT_LT((graph.pose(id).inverse() * again.pose(id)).log().norm(), 1e-14);
  }
}

TEST_F(G2oFile, WritesWhatItReads) {
  check_round_trip<SE2>(file_);
  check_round_trip<SE3>(file_);
  check_round_trip<SE3>(file_ + ".gz");
  std::ifstream packed(file_ + ".gz", std::ios::binary);
  EXPECT_EQ(packed.get(), 0x1f);  // gzip's mark
}

TEST_F(G2oFile, PlacesVerticesThatAreNotThere) {
  const auto graph =
      std::get<PoseGraph2d>(read("EDGE_SE2 7 8 1 0 0.5 1 0 0 1 0 1\n"
                                 "EDGE_SE2 9 8 1 0 0 1 0 0 1 0 1\n"));
  ASSERT_EQ(graph.vertices().size(), 3u);
  EXPECT_EQ(graph.vertices()[0].id, 7);
  EXPECT_NEAR(pose_graph_chi2(graph), 0.0, 1e-20);
}

TEST_F(G2oFile, NamesLineFieldAndValue) {
  const std::string edge = std::string(kPlane).substr(0, std::string(kPlane).find("EDGE"));
  EXPECT_EQ(problem(edge + "EDGE_SE2 0 5 1 2 x3 1 0 0 2 0 3\n"),
            ":6: theta is 'x3', but must be a finite number");
  EXPECT_EQ(problem(edge + "EDGE_SE2 0 5 1 2 3 1 0 nan 2 0 3\n"),
            ":6: information(0,2) is 'nan', but must be a finite number");
  EXPECT_EQ(problem(edge + "EDGE_SE2 0 5 1 2 3 1 0 0 2 0\n"),
            ":6: information(2,2) is missing, but must be a finite number");
  EXPECT_EQ(problem(edge + "EDGE_SE2 0 5 1 2 3 1 0 0 2 0 3 4\n"),
            ":6: what follows the last field is '4', but must be nothing");
  EXPECT_EQ(problem(edge + "EDGE_SE2 0 0.5 1 2 3 1 0 0 2 0 3\n"),
            ":6: to is '0.5', but must be a whole number that fits into 32 bits");
  EXPECT_EQ(problem(edge + "EDGE_SE2 0 6 1 2 3 1 0 0 2 0 3\n"),
            ":6: to is '6', but must be the id of a vertex of this file");
  EXPECT_EQ(problem(edge + "EDGE_SE2 5 5 1 2 3 1 0 0 2 0 3\n"),
            ":6: to is '5', but must be another vertex than from");
  EXPECT_EQ(problem(edge + "VERTEX_SE2 5 1 2 3\n"),
            ":6: id is '5', but must be new: line 3 has it");
  EXPECT_EQ(problem(edge + "FIX\n"),
            ":6: id is missing, but must be a whole number that fits into 32 bits");
  EXPECT_EQ(problem("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 2\n"),
            ":1: the length of the quaternion is '2', but must be 1");
  EXPECT_EQ(problem("VERTEX_XY 0 0 0\n").substr(0, 39), ":1: the tag is 'VERTEX_XY', but must be");
  const std::string noise("\x1b\0\xff 0\n", 6);
  EXPECT_EQ(problem(noise).substr(0, 39), ":1: the tag is '\\x1b\\x00\\xff', but must");
}

TEST_F(G2oFile, IndefiniteInformationBecomesTheNearestThatIsNot) {
  std::ofstream(file_) << kPlane << "EDGE_SE2 5 0 1 2 3 1 0 0 -2 0 3\n"
                       << "EDGE_SE2 5 0 1 2 3 1 2 0 1 0 3\n";
  G2oWarnings warnings;
  const auto graph =
      std::get<PoseGraph2d>(read_g2o(file_, IndefiniteInformation::kNearest, &warnings));
  ASSERT_EQ(graph.edges().size(), 3u);
  EXPECT_TRUE(graph.edges()[1].information.isApprox(
      Eigen::Vector3d(1.0, 0.0, 3.0).asDiagonal().toDenseMatrix(), 1e-12));
  // Eigenvalues 3 along (1, 1) and -1 along (1, -1): the second one goes.
  Eigen::Matrix3d nearest = Eigen::Matrix3d::Zero();
  nearest.topLeftCorner<2, 2>().setConstant(1.5);
  nearest(2, 2) = 3.0;
  EXPECT_TRUE(graph.edges()[2].information.isApprox(nearest, 1e-12));
  EXPECT_EQ(warnings.indefinite, 2u);
  EXPECT_EQ(warnings.text, file_ +
                               ": the information of 2 of 3 edges is not positive semidefinite; "
                               "the nearest matrix that is stands for it (" +
                               file_ + ":7 is the first, with a least eigenvalue of -2)");
  try {
    read_g2o(file_, IndefiniteInformation::kRefuse);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(),
              file_ + ":7: the least eigenvalue of the information is '-2', but must be >= 0");
  }
}

TEST_F(G2oFile, NamesTheFile) {
  EXPECT_EQ(problem(""), ": holds no vertex and no edge");
  EXPECT_EQ(problem("VERTEX_SE2 0 0 0 0\nVERTEX_SE3:QUAT 1 0 0 0 0 0 0 1\n"),
            ": holds both SE2 and SE3, but must be of one kind");
  EXPECT_THROW(read_g2o(file_ + ".none"), Error);
  EXPECT_THROW(write_g2o(PoseGraph2d(), file_ + "/none/a.g2o"), Error);
}

TEST_F(G2oFile, DamagedArchiveIsAnError) {
  write_g2o(grid_graph<SE2>(9, 9, 0.1, 1), file_ + ".gz");
  std::ifstream in(file_ + ".gz", std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::ofstream(file_, std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_THROW(read_g2o(file_), Error);
}

}  // namespace
}  // namespace trident::slam
