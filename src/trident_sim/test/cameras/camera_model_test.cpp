// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// The pinhole, its distortion, and the noise of pixels.
#include "cameras/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cameras/image_noise.h"
#include "cameras/view_table.h"
#include "test_world.h"

namespace trident::sim {
namespace {

Distortion barrel() { return {-0.28, 0.07, -0.005, 0.001, -0.0015}; }

TEST(CameraModel, SquarePixelsSpanTheAngleOfView) {
  const CameraModel model = CameraModel::from_angle_of_view(640, 480, 1.2);
  EXPECT_DOUBLE_EQ(model.cx, 319.5);
  EXPECT_DOUBLE_EQ(model.cy, 239.5);
  EXPECT_DOUBLE_EQ(model.fx, model.fy);
  // The left edge of the leftmost pixel looks half the angle to the left.
  const auto edge = model.back_project({-0.5, 239.5});
  ASSERT_TRUE(edge.has_value());
  EXPECT_NEAR(std::atan(edge->x()), -0.6, 1e-12);
  EXPECT_NEAR(edge->y(), 0.0, 1e-12);
}

TEST(CameraModel, BackProjectionUndoesProjection) {
  CameraModel model = CameraModel::from_angle_of_view(640, 480, 1.2);
  model.distortion = barrel();
  for (int row = 0; row < 480; row += 13) {
    for (int column = 0; column < 640; column += 13) {
      const Eigen::Vector2d pixel(column, row);
      const auto p = model.back_project(pixel);
      ASSERT_TRUE(p.has_value()) << pixel.transpose();
      EXPECT_LT((model.project({3.0 * p->x(), 3.0 * p->y(), 3.0}) - pixel).norm(), 1e-6);
    }
  }
}

TEST(Distortion, SlopeIsThatOfApply) {
  const Distortion distortion = barrel();
  constexpr double kStep = 1e-6;
  for (const Eigen::Vector2d& p :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.4, -0.3), Eigen::Vector2d(-0.7, 0.5)}) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(axis);
      const Eigen::Vector2d slope =
          (distortion.apply(p + step) - distortion.apply(p - step)) / (2.0 * kStep);
      EXPECT_LT((distortion.slope(p).col(axis) - slope).norm(), 1e-8);
    }
  }
}

TEST(Distortion, WhatAppearsNowhereOrTwiceIsNotUndone) {
  const Distortion folding{-0.5, 0.0, 0.0, 0.0, 0.0};  // nothing appears beyond r = 0.544
  EXPECT_TRUE(folding.undo({0.5, 0.0}).has_value());
  EXPECT_FALSE(folding.undo({0.6, 0.0}).has_value());
}

TEST(ViewTable, RefusesADistortionThatFoldsThePicture) {
  CameraModel model = CameraModel::from_angle_of_view(64, 48, 1.5);
  model.distortion.k1 = -0.5;
  const std::string error = error_of([&] { ViewTable(model, "sensor 'eye'"); });
  EXPECT_TRUE(contains(error, "sensor 'eye': the distortion is too strong"));
  EXPECT_TRUE(contains(error, "pixel 0, 0"));
}

TEST(PixelNoise, IsNormalAndOfItsKeyAlone) {
  constexpr std::uint64_t kPackets = 40000;
  const PixelNoise noise(12345), other(12346);
  double sum = 0.0, squares = 0.0, fourth = 0.0, adjacent = 0.0, between = 0.0;
  for (std::uint64_t packet = 0; packet < kPackets; ++packet) {
    const PacketFloats values = noise.normals(packet), others = other.normals(packet);
    for (std::size_t i = 0; i < kPacketLanes; ++i) {
      const double x = values[i];
      sum += x;
      squares += x * x;
      fourth += x * x * x * x;
      adjacent += x * static_cast<double>(values[(i + 1) % kPacketLanes]);
      between += x * static_cast<double>(others[i]);
    }
  }
  const double n = static_cast<double>(kPackets * kPacketLanes), five_sigma = 5.0 / std::sqrt(n);
  EXPECT_NEAR(sum / n, 0.0, five_sigma);
  EXPECT_NEAR(squares / n, 1.0, five_sigma * std::sqrt(2.0));
  EXPECT_NEAR(fourth / n, 3.0, 0.06) << "nothing beyond 3.7 sigma costs a little";
  EXPECT_NEAR(adjacent / n, 0.0, five_sigma);
  EXPECT_NEAR(between / n, 0.0, five_sigma);
  EXPECT_EQ(noise.normals(7), PixelNoise(12345).normals(7));
}

}  // namespace
}  // namespace trident::sim
