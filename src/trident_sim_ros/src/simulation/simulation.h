// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "lockstep/answered_inputs.h"
#include "lockstep/autopilot_gate.h"
#include "lockstep/lockstep_gate.h"
#include "lockstep/loss_watch.h"
#include "lockstep/node_probe.h"
#include "lockstep/radio_calls.h"
#include "run/repeatability.h"
#include "run/run_files.h"
#include "run/server_options.h"
#include "topics/diagnostics_topic.h"
#include "topics/input_binder.h"
#include "topics/performance_topic.h"
#include "topics/port_binder.h"
#include "topics/radio_relay.h"
#include "topics/state_topics.h"
#include "trident_base/mutex.h"
#include "trident_ros/schedule_fuzz.h"
#include "trident_sim/world.h"

namespace trident::sim {

/// The world and the thread that steps it. Services reach the world through Access, between steps.
class Simulation {
 public:
  /// Throws Error when the world cannot be loaded.
  Simulation(ros::NodeHandle& node, const ServerOptions& options);

  /// Steps until the end of the run or of ROS, or stop(). Returns the reason of the end.
  std::string run();
  /// What has ended the run before its end; "" where nothing has.
  const std::string& error() const { return error_; }
  /// From any thread: run() comes to its end.
  void stop() { stopped_ = true; }

  /// Exclusive use of the world while it lives, from the next step's end on at the latest.
  class TRIDENT_SCOPED_CAPABILITY Access {
   public:
    explicit Access(Simulation& simulation) TRIDENT_ACQUIRE(simulation.mutex_)
        : simulation_(simulation) {
      ros_utils::hand_over("service asks for the world");
      simulation_.mutex_.lock();
    }
    ~Access() TRIDENT_RELEASE() {
      // A request that was refused has changed nothing.
      const bool is_refused = std::uncaught_exceptions() > exceptions_;
      if (!changed_by_.empty() && !is_refused) simulation_.note_change(changed_by_);
      simulation_.mutex_.unlock();
    }
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;
    // That there is one shows that the mutex is held.
    World& world() const TRIDENT_NO_THREAD_SAFETY_ANALYSIS { return *simulation_.world_; }
    /// The same for `who`, from outside, who is about to change something; a running world reaches
    /// that at a time that is left to chance.
    World& changed_by(const std::string& who) const TRIDENT_NO_THREAD_SAFETY_ANALYSIS {
      changed_by_ = who;
      return *simulation_.world_;
    }

   private:
    Simulation& simulation_;
    const int exceptions_ = std::uncaught_exceptions();
    mutable std::string changed_by_;
  };

  /// What is done with elements of files that cannot be used.
  OddElements odd_elements() const {
    return options_.strict ? OddElements::kRefuse : OddElements::kLeaveOut;
  }

  // With Access held:
  void set_paused(bool paused) TRIDENT_REQUIRES(mutex_) { paused_ = paused; }
  bool paused() const TRIDENT_REQUIRES(mutex_) { return paused_; }
  /// Another run of the same may end otherwise: `who` has done something that chance had a part in.
  void spoil(const std::string& who, const std::string& why) TRIDENT_REQUIRES(mutex_) {
    repeatability_.spoil(who, world_->time(), why);
  }
  /// After models came or went: topics and vehicle links follow.
  void sync_topics() TRIDENT_REQUIRES(mutex_);
  void reset(bool with_time) TRIDENT_REQUIRES(mutex_);
  double max_update_rate_hz() const TRIDENT_REQUIRES(mutex_);
  void set_max_update_rate_hz(double rate) TRIDENT_REQUIRES(mutex_);
  SimTime enroll_source(const std::string& node, const std::vector<std::string>& vehicles,
                        SimTime period, SimTime end, bool waits_beyond_end)
      TRIDENT_REQUIRES(mutex_);
  void release_source(const std::string& node) TRIDENT_REQUIRES(mutex_) {
    gate_->release_source(node);
  }

  /// Makes n steps for a node and returns when they are done and published; throws Error when the
  /// run ends first, another call is in progress, or the world waits for that node. Without Access.
  SimTime step(std::uint64_t n, const std::string& node);

 private:
  using Clock = std::chrono::steady_clock;

  static void log(Severity severity, const std::string& text);
  void note_change(const std::string& who) TRIDENT_REQUIRES(mutex_);
  void fail(const std::string& error) TRIDENT_REQUIRES(mutex_);
  void choose_policy() TRIDENT_REQUIRES(mutex_);
  void report(Severity severity, const std::string& text) TRIDENT_REQUIRES(mutex_);
  bool run_once();
  void stand() TRIDENT_REQUIRES(mutex_);
  void show_standing_world() TRIDENT_REQUIRES(mutex_);
  bool start_allowed() TRIDENT_REQUIRES(mutex_);
  std::string missing_for_start() TRIDENT_REQUIRES(mutex_);
  bool answers_allow_step() TRIDENT_REQUIRES(mutex_);
  bool calls_allow_step() TRIDENT_REQUIRES(mutex_);
  void end_stuck(const LossWatch::Silence& silence) TRIDENT_REQUIRES(mutex_);
  bool finished() TRIDENT_REQUIRES(mutex_);
  void restart_pace() TRIDENT_REQUIRES(mutex_);
  bool pace_allows() TRIDENT_REQUIRES(mutex_);
  void wait(std::chrono::microseconds time) TRIDENT_REQUIRES(mutex_);
  void make_step() TRIDENT_REQUIRES(mutex_);
  void run_housekeeping() TRIDENT_REQUIRES(mutex_);
  void log_notes() TRIDENT_REQUIRES(mutex_);
  void announce_readiness() TRIDENT_REQUIRES(mutex_);
  void publish_diagnostics() TRIDENT_REQUIRES(mutex_);
  std::string describe_state() TRIDENT_REQUIRES(mutex_);

  /// Simulated time per wall time, kept from a moment of both.
  struct Pace {
    double real_time_factor = 1.0;
    Clock::time_point wall;
    SimTime sim;
  };
  struct FirstStep {
    bool is_made = false;
    Clock::time_point wall;
    SimTime sim;  ///< before it
  };

  ros::NodeHandle& node_;
  const ServerOptions options_;
  LossRules rules_;
  Repeatability repeatability_;
  Resources resources_;
  PluginRegistry registry_;
  DiagnosticsTopic diagnostics_ TRIDENT_GUARDED_BY(mutex_);
  mutable FairMutex mutex_;
  std::atomic<bool> stopped_{false};
  std::unique_ptr<World> world_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<PortBinder> binder_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<InputBinder> inputs_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<RadioRelay> relay_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<StateTopics> topics_ TRIDENT_PT_GUARDED_BY(mutex_);
  PerformanceTopic performance_ TRIDENT_GUARDED_BY(mutex_);
  std::unique_ptr<RunFiles> files_ TRIDENT_PT_GUARDED_BY(mutex_);
  NodeProbe probe_;
  std::unique_ptr<LossWatch> losses_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<LockstepGate> gate_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<AnsweredInputs> answers_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<AutopilotGate> autopilots_ TRIDENT_PT_GUARDED_BY(mutex_);
  std::unique_ptr<RadioCalls> calls_ TRIDENT_PT_GUARDED_BY(mutex_);

  bool paused_ TRIDENT_GUARDED_BY(mutex_) = false;
  bool is_flowing_ TRIDENT_GUARDED_BY(mutex_) = false;  ///< no step is being waited for
  bool ended_ TRIDENT_GUARDED_BY(mutex_) = false;
  std::uint64_t steps_wanted_ TRIDENT_GUARDED_BY(mutex_) = 0;
  std::condition_variable_any stepped_;
  Pace pace_ TRIDENT_GUARDED_BY(mutex_);
  Clock::time_point next_scan_, next_second_;
  FirstStep first_step_ TRIDENT_GUARDED_BY(mutex_);
  std::string end_reason_, error_;
  ros::Publisher ready_;  ///< latched: everything that was declared is there
  bool is_ready_ TRIDENT_GUARDED_BY(mutex_) = false;
};

}  // namespace trident::sim
