// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam/landmark_log.h"

#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "logs/fields.h"
#include "trident_base/error.h"
#include "trident_slam/line_reader.h"

namespace trident::slam {
namespace {

/// One line, field by field, with errors that say where.
class Line {
 public:
  Line(const LineReader& reader, std::string_view text)
      : reader_(reader), fields_(text), kind_(fields_.word()) {}

  std::string_view kind() const { return kind_; }

  double number(const char* field) {
    double value = 0.0;
    if (!fields_.finite(value)) fail(std::string("field '") + field + "' must be a finite number");
    return value;
  }

  int id(const char* field) {
    std::size_t value = 0;
    if (!fields_.count(value) || value > std::numeric_limits<int>::max()) {
      fail(std::string("field '") + field + "' must be a whole number in [0, 2147483647]");
    }
    return static_cast<int>(value);
  }

  /// The upper triangle of a covariance, row by row.
  template <int N>
  Eigen::Matrix<double, N, N> covariance() {
    Eigen::Matrix<double, N, N> result;
    for (int row = 0; row < N; ++row) {
      for (int column = row; column < N; ++column) {
        result(row, column) = result(column, row) = number("covariance");
      }
      if (result(row, row) < 0.0) fail("the covariance has a negative diagonal");
    }
    return result;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(reader_.path() + ":" + std::to_string(reader_.line_number()) + ": " + problem);
  }

 private:
  const LineReader& reader_;
  Fields fields_;
  std::string_view kind_;
};

/// The first line names the pose that the log begins with. Steps must follow each other: a gap
/// would be motion that nobody has reported.
void read_odometry(Line& line, std::vector<LandmarkLogStep>& steps) {
  const int from = line.id("from");
  if (steps.empty()) {
    steps.emplace_back();
    steps.back().pose_id = from;
  }
  if (steps.back().pose_id != from) {
    line.fail("odometry from pose " + std::to_string(from) + ", but the latest pose is " +
              std::to_string(steps.back().pose_id));
  }
  LandmarkLogStep step;
  step.pose_id = line.id("to");
  const double x = line.number("dx");
  const double y = line.number("dy");
  step.T_before_now = SE2::from_xy_yaw(x, y, line.number("dyaw"));
  step.covariance = line.covariance<3>();
  steps.push_back(std::move(step));
}

void read_landmark(Line& line, std::vector<LandmarkLogStep>& steps) {
  const int pose = line.id("pose");
  if (steps.empty() || steps.back().pose_id != pose) {
    line.fail("a landmark seen from pose " + std::to_string(pose) + ", which is not the latest");
  }
  steps.back().ids.push_back(line.id("landmark"));
  PointObservation observation;
  observation.p_base.x() = line.number("x");
  observation.p_base.y() = line.number("y");
  observation.covariance = line.covariance<2>();
  steps.back().observations.push_back(observation);
}

void read_line(Line& line, std::vector<LandmarkLogStep>& steps) {
  if (line.kind().empty() || line.kind()[0] == '#') return;
  if (line.kind() == "ODOMETRY") {
    read_odometry(line, steps);
  } else if (line.kind() == "LANDMARK") {
    read_landmark(line, steps);
  } else {
    line.fail("'" + std::string(line.kind()) + "' begins the line, must be ODOMETRY or LANDMARK");
  }
}

using Counts = std::map<std::pair<int, int>, int>;

/// a -> the b that it is seen as most often.
std::map<int, int> majority(const Counts& counts) {
  std::map<int, std::pair<int, int>> best;  // a -> (count, b)
  for (const auto& [key, count] : counts) {
    auto& entry = best[key.first];
    if (count > entry.first) entry = {count, key.second};
  }
  std::map<int, int> result;
  for (const auto& [a, entry] : best) result[a] = entry.second;
  return result;
}

/// Observations of landmarks that are mostly found as one, which is mostly them.
int count_mutual(const Counts& by_truth, const std::map<int, int>& mostly_seen_as,
                 const std::map<int, int>& mostly_is) {
  int correct = 0;
  for (const auto& [key, count] : by_truth) {
    const auto& [truth, found] = key;
    if (mostly_seen_as.at(truth) == found && mostly_is.at(found) == truth) correct += count;
  }
  return correct;
}

}  // namespace

std::vector<LandmarkLogStep> read_landmark_log(const std::string& file) {
  LineReader reader(file);
  std::vector<LandmarkLogStep> steps;
  std::string_view text;
  while (reader.next(text)) {
    Line line(reader, text);
    read_line(line, steps);
  }
  if (!reader.damage().empty()) throw Error(file + ": " + reader.damage());
  if (steps.empty()) throw Error(file + ": holds no ODOMETRY line");
  return steps;
}

/// An association is correct where a true landmark and a found one are each other's most frequent
/// partner: numbers of found landmarks are arbitrary, so that they are not compared themselves.
AssociationScore score_association(const std::vector<LandmarkLogStep>& steps,
                                   const std::vector<std::vector<int>>& found) {
  if (found.size() != steps.size()) throw Error("one list of associations is needed for each step");
  AssociationScore score;
  Counts by_truth;
  Counts by_found;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    for (std::size_t i = 0; i < steps[k].ids.size(); ++i) {
      ++score.observations;
      if (found[k][i] == EkfSlam::kAmbiguous) {
        ++score.unused;
        continue;
      }
      ++by_truth[{steps[k].ids[i], found[k][i]}];
      ++by_found[{found[k][i], steps[k].ids[i]}];
    }
  }
  const std::map<int, int> mostly_seen_as = majority(by_truth);
  const std::map<int, int> mostly_is = majority(by_found);
  score.correct = count_mutual(by_truth, mostly_seen_as, mostly_is);
  score.true_landmarks = static_cast<int>(mostly_seen_as.size());
  score.found_landmarks = static_cast<int>(mostly_is.size());
  return score;
}

}  // namespace trident::slam
