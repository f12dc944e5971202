// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// slam_offline FILE --method NAME [--config FILE] --out DIR: a log in, trajectories and a map out.
#include <memory>
#include <string>

#include "trident_base/error.h"
#include "trident_slam/carmen_log.h"
#include "trident_slam/offline_program.h"

namespace trident::slam {
namespace {

CarmenLog::Laser laser_named(const std::string& name) {
  if (name == "front") return CarmenLog::Laser::kFront;
  if (name == "rear") return CarmenLog::Laser::kRear;
  throw Error("--laser " + name + ": legal: front, rear");
}

std::unique_ptr<ScanSource> open_log(const OfflineCommand& command) {
  const auto laser = command.source.find("laser");
  return std::make_unique<CarmenLog>(
      command.log_file, laser_named(laser == command.source.end() ? "front" : laser->second));
}

}  // namespace
}  // namespace trident::slam

int main(int argc, char** argv) {
  return trident::slam::run_offline_program(argc, argv, {"--laser"}, trident::slam::open_log);
}
