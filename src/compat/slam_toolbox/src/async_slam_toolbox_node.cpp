// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_programs.h"

int main(int argc, char** argv) {
  return trident::slam::run_slam_toolbox(argc, argv, trident::slam::ToolboxMode::kAsync);
}
