// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "port_binder.h"
#include "run_files.h"
#include "server_options.h"
#include "state_topics.h"
#include "trident_sim/world.h"
#include "vehicle_link.h"

namespace trident {

/// The world and the thread that steps it. Services reach the world through Access, between steps.
class Simulation {
 public:
  Simulation(ros::NodeHandle& node, const ServerOptions& options);
  ~Simulation();

  /// Steps until the end of the run or of ROS. Returns the reason of the end.
  std::string run();

  /// Exclusive use of the world while it lives; the stepping thread makes way.
  class Access {
   public:
    explicit Access(Simulation& simulation) : simulation_(simulation) {
      ++simulation_.waiting_;
      simulation_.mutex_.lock();
      --simulation_.waiting_;
    }
    ~Access() { simulation_.mutex_.unlock(); }
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;
    World& world() const { return *simulation_.world_; }

   private:
    Simulation& simulation_;
  };

  // With Access held:
  void set_paused(bool paused) { paused_ = paused; }
  bool paused() const { return paused_; }
  /// After models came or went: topics and vehicle links follow.
  void sync_topics();
  void reset(bool with_time);
  double max_update_rate_hz() const;
  void set_max_update_rate_hz(double rate);

  /// Makes n steps and returns when they are done and published; throws Error when the run ends first.
  SimTime step(std::uint64_t n);

  SimTime enrol_source(const std::string& node, const std::vector<std::string>& vehicles,
                       SimTime period, SimTime end);
  void release_source(const std::string& node);

 private:
  using Clock = std::chrono::steady_clock;

  void report(Severity severity, const std::string& text);
  bool run_once();
  bool finished();
  bool start_allowed();
  std::string missing_for_start();
  bool pace_allows();
  void wait(std::chrono::microseconds time);
  bool lockstep_allows();
  void check_losses();
  void check_vehicle(VehicleLink& vehicle, WallTime now);
  void check_source(SimTime time, WallTime now);
  void lose(const std::string& who, const std::string& why);
  void make_step();
  void publish_step(bool settled);
  void every_so_often();
  void publish_diagnostics();
  std::string describe_state();
  void tell_news();

  ros::NodeHandle& node_;
  ServerOptions options_;
  Resources resources_;
  PluginRegistry registry_;
  std::mutex mutex_;
  std::atomic<int> waiting_{0};
  std::unique_ptr<World> world_;
  std::unique_ptr<PortBinder> binder_;
  std::unique_ptr<StateTopics> topics_;
  std::unique_ptr<RunFiles> files_;
  InlineCallbackQueue inline_queue_;
  LockstepHub hub_;
  std::map<std::string, std::unique_ptr<VehicleLink>> vehicles_;

  bool paused_ = false;
  bool started_ = false;
  bool ended_ = false;
  std::uint64_t steps_wanted_ = 0;
  std::condition_variable_any stepped_;
  double real_time_factor_ = 1.0;
  Clock::time_point pace_wall_;
  SimTime pace_sim_;
  Clock::time_point next_scan_, next_second_, begin_, ready_for_start_since_, first_step_;
  SimTime first_step_time_;
  std::string end_reason_;
  std::vector<std::pair<Severity, std::string>> complaints_;  ///< for /diagnostics, the latest ones
  ros::Publisher diagnostics_;
};

}  // namespace trident
