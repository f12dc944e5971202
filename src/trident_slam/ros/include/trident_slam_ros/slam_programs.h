// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace trident::slam {

/// The four nodes of slam_toolbox.
enum class ToolboxMode { kSync, kAsync, kLocalization, kLifelong };

// main() of nodes under their upstream names, with upstream's topics, services and parameters.
// Each returns the exit code: 1 for parameters that cannot be used, with one line that says why.
int run_slam_toolbox(int argc, char** argv, ToolboxMode mode);
int run_merge_maps(int argc, char** argv);  ///< joins session files by hand in RViz
int run_gmapping(int argc, char** argv);    ///< particle_slam_2d as slam_gmapping

}  // namespace trident::slam
