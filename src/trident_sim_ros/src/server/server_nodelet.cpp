// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <nodelet/nodelet.h>

#include <atomic>
#include <exception>
#include <memory>
#include <pluginlib/class_list_macros.hpp>
#include <thread>

#include "server.h"

namespace trident::sim {

/// gzserver for a nodelet manager: topics pass as objects between it and the manager's other
/// nodelets. Its arguments are gzserver's; when the run comes to its end, so does the manager.
class ServerNodelet : public nodelet::Nodelet {
 public:
  ~ServerNodelet() override {
    if (!server_) return;
    is_unloaded_ = true;
    server_->stop();
    thread_.join();
  }

  void onInit() override {
    try {
      start();
    } catch (const std::exception& error) {
      NODELET_FATAL("%s", error.what());  // the manager says only that it failed
      throw;
    }
  }

 private:
  void start() {
    ServerOptions options = read_server_options(getPrivateNodeHandle(), getMyArgv());
    options.shares_process = true;
    if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
    server_ = std::make_unique<Server>(getNodeHandle(), getPrivateNodeHandle(), options);
    thread_ = std::thread([this] { run(); });
  }

  void run() {
    const std::string reason = server_->run();
    if (is_unloaded_) return;
    NODELET_INFO("end of the run: %s", reason.c_str());
    ros::requestShutdown();
  }

  std::unique_ptr<Server> server_;
  std::thread thread_;
  std::atomic<bool> is_unloaded_{false};
};

}  // namespace trident::sim

PLUGINLIB_EXPORT_CLASS(trident::sim::ServerNodelet, nodelet::Nodelet)
