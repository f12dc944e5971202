// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "trident_base/se2.h"
#include "trident_slam/scan_source.h"

namespace trident::slam {

/// A command line of an offline program after it was read.
struct OfflineCommand {
  std::string log_file;                       ///< "-": the standard input
  std::string method;                         ///< a name of register_builtin_slam_2d()
  std::string config_file;                    ///< empty: the method's defaults
  std::string out_dir;                        ///< is made
  std::string session;                        ///< file to continue; empty: a new map
  std::optional<SE2> T_map_base;              ///< in the session; none: where it ended
  std::string kept_session;                   ///< file to write; empty: none
  bool shows_scans = false;                   ///< progress names each scan before it is worked on
  bool uses_odometry = true;                  ///< false: poses by scans alone
  std::map<std::string, std::string> source;  ///< what the source takes: name without dashes, value
};

/// Opens the log of a command. Throws Error when it cannot be opened.
using OpenSource = std::function<std::unique_ptr<ScanSource>(const OfflineCommand&)>;

/// main() of a program that runs a log through an algorithm: reads the command line, shows
/// progress and problems on the standard error, writes what `run_offline` writes and timing.json
/// (method, scans, problems, stamps that go back or jump, CPU seconds and peak memory, the scan
/// that cost the most, and what one search may cost). `source_options`: the options of the source
/// with their dashes. Returns the exit code.
int run_offline_program(int argc, char** argv, const std::vector<std::string>& source_options,
                        const OpenSource& open);

}  // namespace trident::slam
