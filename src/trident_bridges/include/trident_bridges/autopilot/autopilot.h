// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "trident_bridges/autopilot/answer.h"
#include "trident_bridges/autopilot/drive_guide.h"
#include "trident_bridges/autopilot/fence.h"
#include "trident_bridges/autopilot/flight_guide.h"
#include "trident_bridges/autopilot/mission.h"
#include "trident_bridges/autopilot/modes.h"
#include "trident_bridges/autopilot/parameter_table.h"
#include "trident_bridges/autopilot/requests.h"
#include "trident_bridges/autopilot/watch.h"

namespace trident::bridges {

/// Whom an autopilot steers, and in whose habits.
struct AutopilotOptions {
  Flavor flavor = Flavor::kArduPilot;                ///< modes, parameters, rules
  VehicleClass vehicle = VehicleClass::kMultirotor;  ///< decides the set-points
  int system_id = 1;                                 ///< 1 to 255
};

/// What an autopilot has to say to its ground stations.
struct AutopilotEvent {
  /// Which.
  enum class Kind {
    kText,            ///< `text`, with `severity`
    kMissionReached,  ///< item `index`
    kHomeChanged,     ///< home() is another place
  };
  Kind kind = Kind::kText;  ///< which
  int severity = 6;         ///< of MAV_SEVERITY: 3 error, 4 warning, 6 info
  std::string text;         ///< a whole sentence
  int index = 0;            ///< of a mission item
};

/// The mind of one vehicle: modes, arming, failsafes, fence, missions. A pure state machine: it is
/// fed requests and states with simulated times and gives set-points and events; nothing is decided
/// by any other clock. A refusal names the rule, the value that was found and the limit.
class Autopilot {
 public:
  /// Disarmed, in the flavor's first mode.
  explicit Autopilot(const AutopilotOptions& options);

  /// What a ground station or companion computer asks for.
  Answer handle(const Request& request, SimTime now);
  /// A set-point of a companion computer; `stamp` by its clock where it has one, else `now`.
  Answer set_target(const Target& target, SimTime stamp, SimTime now);
  /// What counts as a set-point at that time; see Watch.
  void keep_targets(SimTime when) { watch_.keep_targets(when); }
  /// Sticks of a pilot or ground station.
  void set_sticks(const Sticks& sticks, SimTime now) { watch_.note_sticks(sticks, now); }
  /// A heartbeat of a ground station.
  void note_ground_station(SimTime now) { watch_.note_ground_station(now); }
  /// Replaces the mission as a whole; a refused one changes nothing.
  Answer load_mission(std::vector<MissionItem> items);
  /// Replaces the fence's regions as a whole; refused ones change nothing.
  Answer load_fence(std::vector<Fence::Region> regions);
  /// Changes one parameter.
  Answer set_parameter(std::string_view name, double value);
  /// Whether that mode is refused now, but will not be if set-points continue to come: see Watch.
  bool is_offboard_near(std::uint32_t custom_mode, SimTime now) const;
  /// What stands against arming now; empty: nothing.
  std::vector<std::string> arming_problems(SimTime now) const;

  /// One step, at the stamp of the state: failsafes first, then the mode.
  Setpoint step(SimTime now, const VehicleState& state);
  /// Everything that happened since it was last asked.
  std::vector<AutopilotEvent> take_events();

  bool is_armed() const { return is_armed_; }  ///< motors may turn
  bool is_landed() const;                      ///< always, but of a multirotor in the air
  Mode mode() const { return mode_; }          ///< the present one
  std::uint32_t custom_mode() const;           ///< the same, as the flavor counts
  const ParameterTable& parameters() const { return parameters_; }      ///< all
  const MissionExecutor& mission() const { return mission_; }           ///< as it stands
  const std::optional<Eigen::Vector3d>& home() const { return home_; }  ///< once known, world
  const Setpoint& setpoint() const { return setpoint_; }                ///< of the last step
  const Fence& fence() const { return fence_; }                         ///< as it stands

 private:
  struct Handler;  // of each request
  friend struct Handler;

  Answer arm(const ArmRequest& request, SimTime now);
  Answer check_arming(SimTime now);
  void become_armed(const std::string& report_text, SimTime now);
  Answer disarm_on_request(bool is_forced);
  void disarm(const std::string& reason);
  std::optional<std::string> fence_problem(const Eigen::Vector3d& p_world_m) const;
  bool must_take_off_before(const Target& target) const;
  Answer enter_requested(const ModeEntry& entry, SimTime now);
  std::optional<std::string> mode_problem(Mode mode, SimTime now) const;
  void enter(Mode mode, SimTime now);
  void begin(Mode mode, SimTime now);
  void begin_return(SimTime now);
  bool is_left_alone(Mode wanted) const;
  void act(const FailsafeAction& action, SimTime now);
  void guide(SimTime now);
  void advance(SimTime now);
  void advance_mission(SimTime now);
  void carry_out(const MissionOrder& order, SimTime now);
  void apply(const MissionReport& report, SimTime now);
  void advance_return(SimTime now);
  void advance_by_sticks(SimTime now);
  void end_landing(SimTime now);
  bool has_arrived(SimTime now) const;
  void go_to(const Eigen::Vector3d& p_world_m, SimTime now);
  void stop(SimTime now);
  void set_home(const Eigen::Vector3d& p_world_m);
  void report(int severity, std::string text);
  bool flies() const { return options_.vehicle == VehicleClass::kMultirotor; }

  /// Where a return has come to.
  struct ReturnProgress {
    enum class Stage { kClimb, kCross, kWait, kLand };
    Stage stage = Stage::kClimb;
    SimTime waits_since;
  };

  AutopilotOptions options_;
  ParameterTable parameters_;
  AutopilotLimits limits_;
  Fence fence_;
  Watch watch_;
  MissionExecutor mission_;
  FlightGuide flight_;
  DriveGuide drive_;
  Mode mode_;
  Mode mode_to_arm_in_;  // the last that it can be armed in
  ReturnProgress return_;
  bool is_armed_ = false;
  bool sticks_lead_ = false;
  std::optional<Eigen::Vector3d> home_;
  VehicleState state_;
  Setpoint setpoint_;
  std::vector<AutopilotEvent> events_;
};

}  // namespace trident::bridges
