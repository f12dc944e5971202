// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/landmark_log.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "trident_base/error.h"

namespace trident::slam {
namespace {

const std::string kOdometry = " 0.0001 0 0 4e-06 0 4e-06\n";

class LandmarkLogTest : public testing::Test {
 protected:
  std::string path_ = testing::TempDir() + "landmark_log_test_" + std::to_string(getpid());
  ~LandmarkLogTest() override { std::filesystem::remove(path_); }

  std::vector<LandmarkLogStep> read(const std::string& text) const {
    std::ofstream(path_) << text;
    return read_landmark_log(path_);
  }
  std::string error_of(const std::string& text) const {
    try {
      read(text);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(LandmarkLogTest, ReadsMotionsAndSights) {
  const auto steps = read("# park\nODOMETRY 0 1 0.5 0.1 -0.2" + kOdometry +
                          "LANDMARK 1 2 11.5 -3.2 0.4 0.1 0.5\n\nODOMETRY 1 3 1 0 0" + kOdometry);
  ASSERT_EQ(steps.size(), 3U);
  EXPECT_EQ(steps[0].pose_id, 0);
  EXPECT_EQ(steps[1].T_before_now.p, Eigen::Vector2d(0.5, 0.1));
  EXPECT_EQ(steps[1].covariance(1, 1), 4e-6);
  ASSERT_EQ(steps[1].ids, std::vector<int>{2});
  EXPECT_EQ(steps[1].observations[0].covariance(1, 0), 0.1);
  EXPECT_EQ(steps[2].pose_id, 3);
}

TEST_F(LandmarkLogTest, ErrorsNameFileLineAndField) {
  const std::string first = "ODOMETRY 0 1 0 0 0" + kOdometry;
  EXPECT_EQ(error_of(first + "LANDMARK 1 2 x 0 1 0 1\n"),
            path_ + ":2: field 'x' must be a finite number");
  EXPECT_EQ(error_of(first + "LANDMARK 4 2 1 0 1 0 1\n"),
            path_ + ":2: a landmark seen from pose 4, which is not the latest");
  EXPECT_NE(error_of(first + "ODOMETRY 7 8 0 0 0" + kOdometry).find(":2: odometry from pose 7"),
            std::string::npos);
  EXPECT_NE(error_of("VERTEX 1\n").find("must be ODOMETRY or LANDMARK"), std::string::npos);
  EXPECT_NE(error_of("").find("holds no ODOMETRY line"), std::string::npos);
  EXPECT_NE(error_of("ODOMETRY 0 1 0 0\n").find("field 'dyaw'"), std::string::npos);
  EXPECT_THROW(read_landmark_log(path_ + ".absent"), Error);
}

TEST_F(LandmarkLogTest, TheScoreCountsSplitAndMergedLandmarks) {
  LandmarkLogStep step;
  step.ids = {1, 1, 1, 2, 2, 3};
  step.observations.resize(6);
  // 1 is split (10 mostly), 2 and 3 are merged (20 is mostly 2).
  const AssociationScore score = score_association({step}, {{10, 10, 11, 20, 20, 20}});
  EXPECT_EQ(score.correct, 4);
  EXPECT_EQ(score.observations, 6);
  EXPECT_EQ(score.true_landmarks, 3);
  EXPECT_EQ(score.found_landmarks, 3);
  EXPECT_EQ(score_association({step}, {{-1, -1, -1, -1, -1, -1}}).unused, 6);
  EXPECT_THROW(score_association({step}, {}), Error);
}

TEST(VictoriaPark, AssociationsAreFoundWithoutTheirIds) {
  const char* data = std::getenv("TRIDENT_DATA");
  if (data == nullptr) GTEST_SKIP() << "TRIDENT_DATA is not set: Victoria Park is NOT tested";
  const std::string file = std::string(data) + "/landmark/victoria_park.txt";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is absent: NOT tested";
  const std::vector<LandmarkLogStep> steps = read_landmark_log(file);
  EkfSlamParams params;
  params.observation_sigma = 0.25;  // what the trees' residuals show; the file says 0.63
  EkfSlam slam(params);
  std::vector<std::vector<int>> found;
  for (const LandmarkLogStep& step : steps) {
    slam.predict(step.T_before_now, step.covariance);
    found.push_back(slam.observe(step.observations));
  }
  const AssociationScore score = score_association(steps, found);
  EXPECT_EQ(score.observations, 3640);
  EXPECT_GT(score.correct_share(), 0.9);
  EXPECT_LT(score.unused, 0.05 * score.observations);
}

}  // namespace
}  // namespace trident::slam
