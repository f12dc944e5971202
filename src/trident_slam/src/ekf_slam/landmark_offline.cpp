// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// landmark_offline FILE [--config FILE.yaml] --out DIR: a log of landmarks in; the path of the
// filter, its landmarks and, where the log names the landmark that was seen, the score of its
// association out.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "logs/process_cost.h"
#include "trident_base/error.h"
#include "trident_base/yaml_config.h"
#include "trident_slam/ekf_slam.h"
#include "trident_slam/landmark_log.h"
#include "trident_slam/offline_run.h"

namespace trident::slam {
namespace {

constexpr char kUsage[] =
    "usage: landmark_offline FILE [--config FILE.yaml] --out DIR\n"
    "FILE: ODOMETRY and LANDMARK lines as GTSAM keeps Victoria Park (plain, gzip, bzip2).\n"
    "Writes causal.tum and trajectory.tum (stamps: ids of poses; a filter has no other final\n"
    "poses), landmarks.csv and timing.json into DIR.\n";

/// Of a tree by a laser scanner [m]; such logs give larger ones. A configuration may say otherwise.
constexpr double kObservationSigma = 0.25;

struct Options {
  std::string log_file;
  std::string config_file;
  std::string out_dir;
};

void require_files(const Options& options) {
  if (options.log_file.empty() || options.out_dir.empty()) {
    throw Error(std::string("FILE and --out are needed\n") + kUsage);
  }
}

Options parse(int argc, char** argv) {
  Options options;
  const std::map<std::string, std::string*> valued = {{"--config", &options.config_file},
                                                      {"--out", &options.out_dir}};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto option = valued.find(word);
    if (option != valued.end() && i + 1 < argc) {
      *option->second = argv[++i];
    } else if (word[0] != '-' && options.log_file.empty()) {
      options.log_file = word;
    } else {
      throw Error("'" + word + "' is not understood\n" + kUsage);
    }
  }
  require_files(options);
  return options;
}

std::ofstream open(const std::string& path) {
  std::ofstream file(path);
  if (!file) throw Error(path + ": cannot be written");
  return file;
}

void write_landmarks(const EkfSlam& slam, const std::string& path) {
  std::ofstream file = open(path);
  file << "id,x,y,var_x,cov_xy,var_y,sightings\n";
  for (const EkfSlam::Landmark& landmark : slam.landmarks()) {
    const Eigen::Matrix2d& P = landmark.covariance;
    char line[200];
    std::snprintf(line, sizeof(line), "%d,%.6f,%.6f,%.6g,%.6g,%.6g,%d\n", landmark.id,
                  landmark.p_map.x(), landmark.p_map.y(), P(0, 0), P(0, 1), P(1, 1),
                  landmark.sightings);
    file << line;
  }
}

void write_timing(const AssociationScore& score, std::size_t steps, std::size_t landmarks,
                  const std::string& path) {
  const ProcessCost cost = process_cost();
  char text[500];
  std::snprintf(text, sizeof(text),
                "{\"method\": \"ekf_slam\", \"scans\": %zu, \"observations\": %d, \"unused\": %d, "
                "\"association_share\": %.4f, \"true_landmarks\": %d, \"landmarks\": %zu, "
                "\"cpu_s\": %.3f, \"peak_rss_mb\": %.1f}\n",
                steps, score.observations, score.unused, score.correct_share(),
                score.true_landmarks, landmarks, cost.cpu_s, cost.peak_rss_mb);
  open(path) << text;
  std::cout << text;
}

void run(const Options& options) {
  EkfSlamParams params;
  params.observation_sigma = kObservationSigma;
  if (!options.config_file.empty()) params = load_yaml<EkfSlamParams>(options.config_file);
  const std::vector<LandmarkLogStep> steps = read_landmark_log(options.log_file);
  std::error_code error;
  std::filesystem::create_directories(options.out_dir, error);
  if (error) throw Error(options.out_dir + ": cannot be made: " + error.message());

  EkfSlam slam(params);
  std::vector<std::vector<int>> found;
  std::ofstream causal = open(options.out_dir + "/causal.tum");
  std::ofstream final_poses = open(options.out_dir + "/trajectory.tum");
  for (const LandmarkLogStep& step : steps) {
    slam.predict(step.T_before_now, step.covariance);
    found.push_back(slam.observe(step.observations));
    const std::string line =
        tum_line({std::int64_t{step.pose_id} * 1'000'000'000, slam.T_map_base()});
    causal << line << '\n';
    final_poses << line << '\n';
  }
  write_landmarks(slam, options.out_dir + "/landmarks.csv");
  write_timing(score_association(steps, found), steps.size(), slam.landmark_count(),
               options.out_dir + "/timing.json");
}

}  // namespace
}  // namespace trident::slam

int main(int argc, char** argv) {
  try {
    trident::slam::run(trident::slam::parse(argc, argv));
  } catch (const std::exception& error) {
    std::cerr << "landmark_offline: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
