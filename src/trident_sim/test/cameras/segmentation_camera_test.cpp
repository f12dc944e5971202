// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Labels of what is seen, and the boxes around it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "camera_robot.h"

namespace trident::sim {
namespace {

/// Distance at which a ray from the origin hits a level box; infinite: it does not.
double hit_distance(const Eigen::Vector3d& d, const Eigen::Vector3d& center,
                    const Eigen::Vector3d& size) {
  const Eigen::Array3d low = (center - 0.5 * size).array() / d.array();
  const Eigen::Array3d high = (center + 0.5 * size).array() / d.array();
  const double enter = low.min(high).maxCoeff(), leave = low.max(high).minCoeff();
  return enter <= leave ? enter : std::numeric_limits<double>::infinity();
}

TEST(SegmentationCamera, LabelsAndBoxesAreExact) {
  TestWorld world(weightless());
  const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> things = {
      {{3.5, 0.3, 0.0}, {1, 2, 1}}, {{2.25, 0.5037, 0.1012}, {0.5, 0.4, 0.4}}};
  const char* const names[] = {"big", "small"};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& [p, size] = things[i];
    world.add(make_visual(names[i], BoxShape{size}, at(p.x(), p.y(), p.z())));
  }
  world.add(make_visual("hidden", BoxShape{{0.2, 0.2, 0.2}}, at(6, 0.3, 0)));
  world.add(robot_with_camera({}));
  auto& image = listen_to<ImageSample>(world, "r/eye/segmentation/image_raw");
  auto& boxes = listen_to<BoundingBoxesSample>(world, "r/eye/segmentation/boxes");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(100);
  ASSERT_EQ(boxes.value.boxes.size(), 2u);
  EXPECT_EQ(image.value.encoding, "mono16");
  // Numbers of the models in name order, from 1: big, hidden, robot, small.
  const std::uint32_t labels[] = {1, 4};
  std::array<BoundingBoxesSample::Box, 2> expected;
  for (std::uint32_t row = 0; row < 120; ++row) {
    for (std::uint32_t column = 0; column < 160; ++column) {
      const Eigen::Vector3d d(1.0, -(column - info.value.K[2]) / info.value.K[0],
                              -(row - info.value.K[5]) / info.value.K[4]);
      const double big = hit_distance(d, things[0].first, things[0].second);
      const double small = hit_distance(d, things[1].first, things[1].second);
      const std::size_t pixel = 2 * (std::size_t{row} * 160 + column);
      const int label = image.value.data[pixel] + 256 * image.value.data[pixel + 1];
      if (std::isinf(big) && std::isinf(small)) {
        EXPECT_EQ(label, 0) << column << " " << row;
        continue;
      }
      const std::size_t nearest = big < small ? 0 : 1;
      EXPECT_EQ(label, static_cast<int>(labels[nearest])) << column << " " << row;
      BoundingBoxesSample::Box& box = expected[nearest];
      if (box.pixels++ == 0) box.x_min = column, box.y_min = row;
      box.x_min = std::min(box.x_min, column);
      box.x_max = std::max(box.x_max, column);
      box.y_max = row;
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const BoundingBoxesSample::Box &box = boxes.value.boxes[i], &right = expected[i];
    EXPECT_EQ(box.name, names[i]);
    EXPECT_EQ(box.label, labels[i]);
    EXPECT_EQ(box.pixels, right.pixels);
    EXPECT_EQ(box.x_min, right.x_min);
    EXPECT_EQ(box.x_max, right.x_max);
    EXPECT_EQ(box.y_min, right.y_min);
    EXPECT_EQ(box.y_max, right.y_max);
  }
}

TEST(SegmentationCamera, LabelsLinksOnRequest) {
  TestWorld world(weightless());
  ModelSpec pair = make_visual("pair", BoxShape{{1, 1, 1}}, at(4, 0, 0));
  pair.links.push_back(pair.links[0]);
  pair.links[1].name = "other";
  pair.links[1].T_model_link = at(0, 2, 0);
  world.add(pair);
  CameraOptions options;
  options.params = {{"labels", "link"}};
  world.add(robot_with_camera(options));
  auto& boxes = listen_to<BoundingBoxesSample>(world, "r/eye/segmentation/boxes");
  world->step(100);
  ASSERT_EQ(boxes.value.boxes.size(), 2u);
  EXPECT_EQ(boxes.value.boxes[0].name, "pair::link");
  EXPECT_EQ(boxes.value.boxes[1].name, "pair::other");
  EXPECT_GT(boxes.value.boxes[0].x_min, boxes.value.boxes[1].x_max) << "+y is left";
}

}  // namespace
}  // namespace trident::sim
