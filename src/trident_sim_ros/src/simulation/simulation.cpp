// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "simulation.h"

#include <std_msgs/Bool.h>

#include <algorithm>
#include <thread>

#include "conversions/conversions.h"
#include "radio_rules.h"
#include "trident_base/error.h"

namespace trident::sim {
namespace {

using std::chrono::duration;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr auto kScanPeriod = milliseconds(2);
/// Up to this speed /clock and the state topics go out at every step.
constexpr double kEveryStepFactor = 2.0;
/// A delay longer than this is not caught up with in a burst.
constexpr double kGivenUpDelay_s = 0.25;

/// The parameter tf_prefix of a namespace or the next one above that has it.
std::string find_tf_prefix(const std::string& robot_namespace) {
  const ros::NodeHandle node("/" + robot_namespace);
  std::string name, prefix;
  if (node.searchParam("tf_prefix", name)) node.getParam(name, prefix);
  return prefix;
}

}  // namespace

/// The order matters: /gazebo/ready is latched as false before anything slow, plugins are
/// registered before the world asks for them, and the binder sees the ports that the world's models
/// have made.
Simulation::Simulation(ros::NodeHandle& node, const ServerOptions& options)
    : node_(node),
      options_(options),
      rules_(options.loss),
      diagnostics_(node),
      performance_(node),
      paused_(options.paused) {
  register_builtin_plugins(registry_);
  for (const std::string& library : options.plugin_libraries) registry_.load_shared_object(library);
  ready_ = node_.advertise<std_msgs::Bool>("/gazebo/ready", 1, true);
  ready_.publish(std_msgs::Bool());
  const auto report = [this](Severity severity, const std::string& text)
                          TRIDENT_REQUIRES(mutex_) { this->report(severity, text); };
  for (const std::string& warning : resources_.warnings()) report(Severity::kWarning, warning);
  WorldSpec spec = load_world_file(
      options.world_file, resources_,
      [&](const std::string& text) TRIDENT_REQUIRES(mutex_) { report(Severity::kWarning, text); },
      odd_elements());
  if (!options.radio_rules.empty()) use_radio_rules(options.radio_rules, &spec);
  world_ =
      std::make_unique<World>(spec, resources_, registry_,
                              WorldOptions{options.seed, options.timing, report, find_tf_prefix,
                                           options.sensor_threads, log, odd_elements()});
  pace_.real_time_factor = options.real_time_factor >= 0.0 ? options.real_time_factor
                                                           : spec.physics.real_time_update_rate_hz *
                                                                 spec.physics.max_step_size_s;
  binder_ = std::make_unique<PortBinder>(node_, world_->ports());
  inputs_ = std::make_unique<InputBinder>(node_, world_->ports(), repeatability_);
  relay_ = std::make_unique<RadioRelay>(world_->ports(), *binder_, *inputs_);
  topics_ = std::make_unique<StateTopics>(node_, options.max_clock_rate_hz,
                                          options.pub_clock_frequency_hz);
  files_ = std::make_unique<RunFiles>(options.out_dir, options.seed);
  choose_policy();
  losses_ = std::make_unique<LossWatch>(
      rules_, repeatability_, report, [this]() TRIDENT_REQUIRES(mutex_) { paused_ = true; },
      [this](const std::string& error) TRIDENT_REQUIRES(mutex_) { fail(error); },
      [this](const LossWatch::Silence& silence) TRIDENT_REQUIRES(mutex_) { end_stuck(silence); });
  gate_ = std::make_unique<LockstepGate>(node_, options_, *losses_, probe_);
  answers_ = std::make_unique<AnsweredInputs>(options_, world_->ports(), *binder_, *inputs_,
                                              *losses_, probe_, report);
  autopilots_ = std::make_unique<AutopilotGate>(*world_, *losses_);
  calls_ = std::make_unique<RadioCalls>(node_, *world_, *losses_, report);
  sync_topics();
  topics_->publish_clock(world_->time());
  for (const std::string& warning : options.warnings) this->report(Severity::kWarning, warning);
}

void Simulation::log(Severity severity, const std::string& text) {
  if (severity == Severity::kError) {
    ROS_ERROR("%s", one_line(text).c_str());
  } else {
    ROS_WARN("%s", one_line(text).c_str());
  }
}

void Simulation::report(Severity severity, const std::string& text) {
  log(severity, text);
  diagnostics_.remember(severity, text);
}

/// As fast as possible nothing that decides may hang on the wall clock; in real time people may be
/// about, who rather see the others fly on.
void Simulation::choose_policy() {
  if (!options_.has_default_policy) return;
  rules_.policy = pace_.real_time_factor <= 0.0 ? LossPolicy::kWait : LossPolicy::kFreeRun;
}

void Simulation::fail(const std::string& error) {
  if (!error_.empty()) return;
  error_ = error;
  end_reason_ = "error";
  report(Severity::kError, error);
}

/// A service that changes the world while time runs makes the run depend on when it was called.
void Simulation::note_change(const std::string& who) {
  if (repeatability_.running()) {
    repeatability_.spoil(one_line(who), world_->time(), "called outside of the lockstep");
  }
}

/// Ports come and go with models: topics, inputs, what joins the two, the gate and the answers
/// follow in this order, as each builds on what the one before has bound.
void Simulation::sync_topics() {
  binder_->sync();
  inputs_->sync();
  relay_->sync();
  gate_->sync(*world_, *binder_);
  answers_->sync();
  calls_->sync();
  binder_->scan_subscribers();
}

/// The stepping thread. It holds the world for one step at a time; services take their turn between
/// steps, by a FairMutex, so that a world as fast as possible does not starve them.
std::string Simulation::run() {
  {
    const Lock lock(mutex_);
    restart_pace();
  }
  next_second_ = Clock::now();
  while (ros::ok() && !stopped_ && run_once()) {
  }
  const Lock lock(mutex_);
  ended_ = true;
  stepped_.notify_all();
  calls_->end("the run has ended");
  if (end_reason_.empty()) {
    end_reason_ = "interrupted";
    if (repeatability_.running() && is_flowing_) {
      repeatability_.spoil("the end of the run", world_->time(), "interrupted as time ran");
    }
  }
  topics_->publish(*world_, true);
  files_->finish(*world_,
                 {end_reason_, error_, duration<double>(Clock::now() - first_step_.wall).count(),
                  first_step_.is_made ? world_->time() - first_step_.sim : SimTime{0}},
                 repeatability_);
  return end_reason_;
}

/// One turn: housekeeping by the wall clock, then a step if the run is not paused, is on pace, has
/// the answers that it waits for, and every controller in lockstep has answered. False: the run has
/// ended.
bool Simulation::run_once() {
  ros_utils::hand_over("stepping thread takes the world");
  const Lock lock(mutex_);
  if (Clock::now() >= next_scan_) run_housekeeping();
  if (finished()) return false;
  const bool stepping = steps_wanted_ > 0;
  if ((paused_ && !stepping) || !start_allowed()) {
    stand();
    return true;
  }
  repeatability_.set_running(true);
  is_flowing_ = true;
  if (!stepping && !pace_allows()) return true;
  is_flowing_ = false;  // until the step: who waits at the end of the run stands
  if (!answers_allow_step() || !calls_allow_step()) return true;
  if (!autopilots_->allows_step(world_->time())) return true;
  const auto publish_clock = [this]() TRIDENT_REQUIRES(mutex_) {
    topics_->publish_clock(world_->time());
  };
  if (!gate_->allows_step(*world_, mutex_, publish_clock)) return true;
  make_step();
  is_flowing_ = true;
  if (stepping && --steps_wanted_ == 0) {
    repeatability_.set_running(false);
    show_standing_world();
    stepped_.notify_all();
  }
  return true;
}

/// A turn without a step. Waiting costs no pace, and who reads the topics sees the latest state.
void Simulation::stand() {
  repeatability_.set_running(false);
  gate_->check_losses_at_start();
  restart_pace();
  show_standing_world();
  gate_->poll_while_paused();
  autopilots_->poll();
  wait(milliseconds(1));
}

void Simulation::show_standing_world() {
  topics_->publish_clock(world_->time());
  binder_->publish_held_display();
}

std::string Simulation::missing_for_start() {
  const std::string parts[] = {gate_->missing_for_start(*world_), answers_->missing_for_start()};
  return parts[0] + (parts[0].empty() || parts[1].empty() ? "" : ", ") + parts[1];
}

bool Simulation::start_allowed() {
  // Time zero is held once; who goes away later is the business of the policy.
  if (!first_step_.is_made && !answers_->missing_for_start().empty()) return false;
  return gate_->start_allowed(*world_, *binder_);
}

bool Simulation::answers_allow_step() {
  if (answers_->allows_step(world_->time())) return true;
  AnsweredInputs& answers = *answers_;
  {
    const Unlock unlocked(mutex_);
    answers.wait();
  }
  answers_->check_timeouts(world_->time());
  return false;  // the world may have changed meanwhile
}

bool Simulation::calls_allow_step() {
  if (calls_->allows_step(world_->time())) return true;
  RadioCalls& calls = *calls_;
  {
    const Unlock unlocked(mutex_);
    calls.wait();
  }
  calls_->check_timeouts(world_->time());
  return false;  // the world may have changed meanwhile
}

/// One whom the world waits for may wait for a call by radio, which takes simulated time.
void Simulation::end_stuck(const LossWatch::Silence& silence) {
  if (!silence.nodes || calls_ == nullptr) return;
  calls_->abort_calls_of(silence.nodes(),
                         "the world waits for " + silence.who + ", which " + silence.what);
}

/// Several conditions may hold at once; the last one checked names the end.
bool Simulation::finished() {
  const SimTime now = world_->time();
  if (options_.end_on_finish) {
    const SimTime end = gate_->sources_end();
    if (end.ns > 0 && now >= end) end_reason_ = "finished";
  }
  if (options_.end_time_s > 0.0 && now >= SimTime::from_seconds(options_.end_time_s)) {
    end_reason_ = "end_time";
  }
  if (options_.iterations > 0 && world_->step_count() >= options_.iterations) {
    end_reason_ = "iterations";
  }
  return !end_reason_.empty();
}

/// From here on wall time and simulated time are compared: a pause or a change of speed leaves no
/// debt to be caught up with.
void Simulation::restart_pace() {
  pace_.wall = Clock::now();
  pace_.sim = world_->time();
}

/// Waits at most 5 ms at a time, so that services and the end of the process are not held up by a
/// slow world.
bool Simulation::pace_allows() {
  if (pace_.real_time_factor <= 0.0) return true;
  const double due_s =
      (world_->time() + world_->dt() - pace_.sim).seconds() / pace_.real_time_factor;
  const double ahead_s = due_s - duration<double>(Clock::now() - pace_.wall).count();
  if (ahead_s < -kGivenUpDelay_s) restart_pace();
  if (ahead_s <= 0.0) return true;
  wait(microseconds(static_cast<int>(std::min(ahead_s, 0.005) * 1e6)));
  return false;
}

/// Releases the world meanwhile; the thread takes its place in the queue again afterwards.
void Simulation::wait(microseconds time) {
  const Unlock unlocked(mutex_);
  std::this_thread::sleep_for(std::max(time, microseconds(1)));
}

/// What a controller answers goes out before what only displays or recorders need: transforms and
/// odometry, then the states that the lockstep waits for, then all other samples.
void Simulation::make_step() {
  if (!first_step_.is_made) {
    first_step_.is_made = true;
    first_step_.wall = Clock::now();
    first_step_.sim = world_->time();
  }
  // Who has begun to read since the last step, and waited for that, hears of this one.
  binder_->scan_subscribers();
  inputs_->deliver(world_->time());
  answers_->deliver(world_->time());
  calls_->deliver(world_->time());
  world_->step();
  relay_->take_outputs(world_->time());
  answers_->look_for_samples(world_->time());
  const bool every_step =
      pace_.real_time_factor > 0.0 && pace_.real_time_factor <= kEveryStepFactor;
  topics_->publish(*world_, every_step);
  binder_->publish_fresh(PortRank::kTransform, PortRank::kOdometry, every_step);
  gate_->send_states(world_->time());
  binder_->publish_fresh(PortRank::kState, PortRank::kSensor, every_step);
  calls_->take();
  files_->record(*world_);
}

/// What need not happen in every step, by the wall clock: looking for subscribers takes locks of
/// roscpp.
void Simulation::run_housekeeping() {
  const auto now = Clock::now();
  next_scan_ = now + kScanPeriod;
  binder_->scan_subscribers();
  topics_->scan(*world_);
  relay_->look_for_types(world_->time());
  calls_->look_for_types();
  topics_->catch_up_clock(world_->time());
  performance_.publish(*world_);
  if (!is_ready_) announce_readiness();
  if (pace_.real_time_factor <= 0.0) gate_->pin_controllers();
  for (const std::string& line : gate_->drain_events()) ROS_INFO("%s", line.c_str());
  log_notes();
  if (now < next_second_) return;
  next_second_ = now + std::chrono::seconds(1);
  publish_diagnostics();
  const SimTime end =
      options_.end_time_s > 0.0 ? SimTime::from_seconds(options_.end_time_s) : gate_->sources_end();
  files_->progress(*world_, end, gate_->vehicle_count(), describe_state());
}

void Simulation::log_notes() {
  Repeatability::Note note;
  while (repeatability_.take_unlogged(&note)) {
    const std::string text = "not repeatable: " + note.who +
                             ", t = " + seconds_text(note.time.seconds()) + ": " + note.why;
    ROS_INFO("%s", text.c_str());
    diagnostics_.remember(Severity::kWarning, text);
  }
}

/// True once: what comes or goes afterwards is reported, but not taken back.
void Simulation::announce_readiness() {
  if (!missing_for_start().empty()) return;
  is_ready_ = true;
  std_msgs::Bool message;
  message.data = 1;
  ready_.publish(message);
}

std::string Simulation::describe_state() {
  const bool waits = options_.holds_time_zero() || !options_.answers.empty();
  if (!first_step_.is_made && waits) {
    const std::string missing = missing_for_start();
    if (!missing.empty()) return "waiting for " + missing;
  }
  if (const std::string who = losses_->waited_for(); !who.empty()) return "waiting for " + who;
  return paused_ ? "paused" : "running";
}

void Simulation::publish_diagnostics() {
  if (!diagnostics_.wanted()) return;
  DiagnosticsTopic::Notes notes{{"simulation", describe_state()}};
  for (const auto& [name, in_lockstep] : gate_->vehicle_states()) {
    notes.emplace_back("controller of " + name,
                       in_lockstep ? "in lockstep" : "free-running or absent");
  }
  if (const auto relay = find_relay(*world_)) add_relay_notes(*relay, &notes);
  if (const std::string calls = calls_->describe(); !calls.empty()) {
    notes.emplace_back("radio: calls of services", calls);
  }
  diagnostics_.publish(*world_, notes);
}

/// With time zero a run begins again, with its files and its record of what was not repeatable.
void Simulation::reset(bool with_time) {
  if (with_time) {
    world_->reset();
    first_step_.is_made = false;
    repeatability_.clear();
    files_->restart();
  } else {
    world_->reset_models();
  }
  gate_->clear(with_time);
  inputs_->clear();
  answers_->clear();
  if (with_time) calls_->clear();
  restart_pace();
  topics_->restart();
  topics_->publish_clock(world_->time());
}

double Simulation::max_update_rate_hz() const {
  return pace_.real_time_factor / world_->physics().max_step_size_s;
}

void Simulation::set_max_update_rate_hz(double rate) {
  pace_.real_time_factor = rate * world_->physics().max_step_size_s;
  choose_policy();
  restart_pace();
}

/// Called by a service thread, which waits for the stepping thread: only that one steps the world.
SimTime Simulation::step(std::uint64_t n, const std::string& node) {
  const Lock lock(mutex_);
  if (ended_) throw Error("the run has ended");
  if (calls_->waits_for(node)) {
    throw Error("the world waits for " + node +
                " to answer a call by radio, legal: steps after that");
  }
  if (steps_wanted_ > 0) throw Error("another /gazebo/step call is in progress");
  steps_wanted_ = n;
  wait_until(stepped_, mutex_,
             [this]() TRIDENT_REQUIRES(mutex_) { return steps_wanted_ == 0 || ended_; });
  if (steps_wanted_ > 0) throw Error("the run ended before the steps were made");
  return world_->time();
}

SimTime Simulation::enroll_source(const std::string& node, const std::vector<std::string>& vehicles,
                                  SimTime period, SimTime end, bool waits_beyond_end) {
  const SimTime start =
      gate_->enroll_source(node, vehicles, period, end, waits_beyond_end, world_->time());
  topics_->set_state_period(period);
  return start;
}

}  // namespace trident::sim
