// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace trident::slam {

/// main() of the node `name`: initialises ROS and calls `run`, which returns when the node has
/// ended. Returns the exit code: 1 after an exception, which is reported in one line on stderr.
int run_program(int argc, char** argv, const std::string& name, const std::function<void()>& run);

}  // namespace trident::slam
