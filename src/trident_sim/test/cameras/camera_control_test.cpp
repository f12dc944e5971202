// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// What can be set on a camera while it runs, and what its lens says.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "camera_robot.h"
#include "trident_sim/commands.h"
#include "trident_sim/world/snapshot.h"

namespace trident::sim {
namespace {

CameraOptions gazebo_camera(const std::string& file = "libgazebo_ros_camera.so") {
  CameraOptions options;
  options.file = file;
  options.params = {{"cameraName", "eye"}, {"frameName", "optical"}};
  return options;
}

void set(TestWorld& world, const std::string& topic, double value) {
  auto* const port = world->ports().find_in<ScalarSample>("r/eye/" + topic);
  ASSERT_NE(port, nullptr) << topic;
  port->write({SimTime{}, value});
}

/// Columns of the only bright thing, from left to right.
double width_px(const ImageSample& image) {
  int first = -1, last = -1;
  const int row = static_cast<int>(image.height) / 2;
  for (int column = 0; column < static_cast<int>(image.width); ++column) {
    if (pixel(image, column, row)[0] == 0) continue;
    if (first < 0) first = column;
    last = column;
  }
  return first < 0 ? 0.0 : last - first + 1;
}

TEST(CameraControl, TheAngleOfViewCanBeSetAndIsReported) {
  TestWorld world(dark_world());
  world.add(make_visual("plate", BoxShape{{0.1, 1, 1}}, at(4.05, 0, 0), glowing(1, 1, 1)));
  world.add(robot_with_camera(gazebo_camera()));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  for (const double angle : {1.2, 0.6, 2.0}) {
    if (angle != 1.2) set(world, "set_hfov", angle);
    world->step(100);
    const double focal = 80.0 / std::tan(angle / 2.0);
    EXPECT_NEAR(info.value.K[0], focal, 1e-9);
    EXPECT_NEAR(info.value.K[4], focal, 1e-9);
    EXPECT_NEAR(info.value.P[0], focal, 1e-9);
    EXPECT_EQ(info.value.K[2], 80.5) << "the middle stays";
    EXPECT_NEAR(width_px(image.value), focal / 4.0, 1.0) << "1 m at 4 m";
  }
  world->reset_models();
  world->step(100);
  EXPECT_NEAR(info.value.K[0], 80.0 / std::tan(0.6), 1e-9) << "a reset brings the file's back";
}

TEST(CameraControl, TheRateCanBeSet) {
  TestWorld world(weightless());
  world.add(robot_with_camera(gazebo_camera()));
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(1000);
  EXPECT_EQ(info.count(), 10u);
  set(world, "set_update_rate", 50.0);
  world->step(1000);
  EXPECT_EQ(info.count(), 60u);
  set(world, "set_update_rate", 0.0);
  world->step(100);
  EXPECT_EQ(info.count(), 160u) << "0: every step";
}

TEST(CameraControl, BadNumbersAreRefusedWithOneWarning) {
  struct Case {
    const char* topic;
    double value;
    const char* text;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Case& bad :
       {Case{"set_hfov", 4.0, "set_hfov: 4 rad is refused, legal: 0.01 to 3.14"},
        Case{"set_hfov", kNan, "set_hfov: nan rad is refused"},
        Case{"set_update_rate", -1.0, "set_update_rate: -1 Hz is refused, legal: 0 to 1e+06"}}) {
    TestWorld world(weightless());
    world.add(robot_with_camera(gazebo_camera()));
    auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
    for (int i = 0; i < 10; ++i) {
      set(world, bad.topic, bad.value);
      world->step(100);
    }
    EXPECT_EQ(world.report_count(Severity::kWarning, bad.text), 1u) << bad.text;
    EXPECT_EQ(world.reports.size(), 1u);
    EXPECT_EQ(info.count(), 10u);
    EXPECT_NEAR(info.value.K[0], 80.0 / std::tan(0.6), 1e-9);
  }
}

TEST(CameraControl, AnAngleTooWideForTheDistortionIsRefused) {
  TestWorld world(weightless());
  CameraOptions options = gazebo_camera();
  options.angle_of_view_rad = 0.6;
  options.params.emplace_back("distortionK1", "-0.3");
  world.add(robot_with_camera(options));
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  set(world, "set_hfov", 0.8);
  world->step(100);
  set(world, "set_hfov", 3.0);
  world->step(300);
  EXPECT_EQ(world.report_count(Severity::kWarning, "the distortion is too strong"), 1u);
  EXPECT_NEAR(info.value.K[0], 80.0 / std::tan(0.4), 1e-9);
}

TEST(CameraControl, ATriggeredCameraTakesAPictureForEachTrigger) {
  TestWorld world(weightless());
  world.add(robot_with_camera(gazebo_camera("libgazebo_ros_triggered_camera.so")));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  auto* const trigger = world->ports().find_in<TriggerCommand>("r/eye/image_trigger");
  ASSERT_NE(trigger, nullptr);
  world->step(500);
  EXPECT_EQ(image.count(), 0u);
  for (const std::uint64_t expected : {1u, 2u}) {
    trigger->write({});
    world->step(1);
    EXPECT_EQ(image.count(), expected);
    EXPECT_EQ(image.value.stamp, world->time());
    EXPECT_EQ(info.value.stamp, world->time());
    world->step(200);
    EXPECT_EQ(image.count(), expected);
  }
}

TEST(CameraControl, ASnapshotKeepsWhatWasSet) {
  TestWorld world(dark_world());
  world.add(make_visual("plate", BoxShape{{0.1, 1, 1}}, at(4.05, 0, 0), glowing(1, 1, 1)));
  CameraOptions options = gazebo_camera();
  options.stddev = 0.05;
  world.add(robot_with_camera(options));
  auto& image = listen_to<ImageSample>(world, "r/eye/image_raw");
  set(world, "set_hfov", 0.5);
  set(world, "set_update_rate", 20.0);
  world->step(100);
  const Snapshot snapshot = world->save_snapshot();
  world->step(100);
  const std::vector<std::uint8_t> first = image.value.data;
  set(world, "set_hfov", 1.5);
  set(world, "set_update_rate", 3.0);
  world->step(700);
  EXPECT_NE(image.value.data, first);
  world->restore_snapshot(snapshot);
  world->step(100);
  EXPECT_EQ(image.value.data, first);
}

ParamNode lens_of(const std::string& child, const ParamList& numbers) {
  ParamNode node{child, "", {}, {}};
  for (const auto& [name, value] : numbers) node.children.push_back(text_node(name, value));
  return {"lens", "", {}, {node}};
}

TEST(CameraLens, IntrinsicsAndProjectionArePublishedAsTheyAreGiven) {
  TestWorld world(weightless());
  CameraOptions options = gazebo_camera();
  const ParamList k{{"fx", "150"}, {"fy", "140"}, {"cx", "81"}, {"cy", "59"}, {"s", "3"}};
  const ParamList p{{"p_fx", "149"}, {"p_fy", "139"}, {"p_cx", "82"},
                    {"p_cy", "58"},  {"tx", "-15"},   {"ty", "1"}};
  ParamNode lens = lens_of("intrinsics", k);
  lens.children.push_back(lens_of("projection", p).children[0]);
  options.extra.push_back(lens);
  world.add(robot_with_camera(options));
  auto& info = listen_to<CameraInfoSample>(world, "r/eye/camera_info");
  world->step(100);
  EXPECT_EQ(info.value.K, (std::array<double, 9>{150, 3, 81, 0, 140, 59, 0, 0, 1}));
  EXPECT_EQ(info.value.P, (std::array<double, 12>{149, 0, 82, -15, 0, 139, 58, 1, 0, 0, 1, 0}));
}

TEST(CameraLens, BadNumbersAreRefusedByName) {
  TestWorld world(weightless());
  CameraOptions options = gazebo_camera();
  options.extra = {lens_of("intrinsics", {{"fx", "0"}})};
  EXPECT_TRUE(contains(error_of([&] { world.add(robot_with_camera(options)); }),
                       "<camera> <lens> <intrinsics>: <fx> is '0'"));
  options.extra = {lens_of("projection", {{"p_cx", "nan"}})};
  EXPECT_TRUE(contains(error_of([&] { world.add(robot_with_camera(options)); }),
                       "<lens> <projection>: <p_cx> is 'nan'"));
}

/// As a file has it, through libsdformat, whose specification knows no `<projection>`.
TEST(CameraLens, IsReadFromAFile) {
  const std::string xml =
      "<sdf version='1.6'><world name='w'><model name='m'><static>true</static><link name='l'>"
      "<sensor name='eye' type='camera'><update_rate>10</update_rate><camera>"
      "<horizontal_fov>1.2</horizontal_fov><image><width>160</width><height>120</height></image>"
      "<clip><near>0.1</near><far>10</far></clip><lens><intrinsics><fx>150</fx><fy>140</fy>"
      "<cx>81</cx><cy>59</cy><s>0</s></intrinsics><projection><p_fx>149</p_fx><p_fy>139</p_fy>"
      "<p_cx>82</p_cx><p_cy>58</p_cy><tx>0</tx><ty>0</ty></projection></lens></camera>"
      "<plugin name='p' filename='libgazebo_ros_camera.so'><cameraName>eye</cameraName></plugin>"
      "</sensor></link></model></world></sdf>";
  const Resources resources;
  TestWorld world(load_world_string(xml, "test.world", resources, [](const std::string&) {}));
  auto& info = listen_to<CameraInfoSample>(world, "eye/camera_info");
  world->step(100);
  EXPECT_EQ(info.value.K[0], 150.0);
  EXPECT_EQ(info.value.K[5], 59.0);
  EXPECT_EQ(info.value.P[0], 149.0);
}

}  // namespace
}  // namespace trident::sim
