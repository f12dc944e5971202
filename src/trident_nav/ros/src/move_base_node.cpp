// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_nav_ros/move_base_node.h"

#include <geometry_msgs/Twist.h>
#include <move_base_msgs/RecoveryStatus.h>
#include <nav_msgs/Path.h>
#include <std_msgs/String.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <cmath>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_nav_ros/frames.h"
#include "trident_nav_ros/input_checks.h"
#include "trident_ros/topic_peers.h"

namespace trident::nav {
namespace {

constexpr double kWarningPeriod_s = 5.0;

}  // namespace

MoveBaseNode::MoveBaseNode(ros::NodeHandle& node, const ros::NodeHandle& private_node,
                           const VoxelAdvertiser& voxels)
    : refusals_(node),
      transforms_(buffer_,
                  [this](const std::string& problem) { refusals_.note("transform", problem); }),
      parts_(make_move_base_parts(private_node, buffer_, refusals_)) {
  parts_->global->advertise_voxels(voxels);
  parts_->local->advertise_voxels(voxels);
  serve_plugins(private_node);
  serve(node, private_node);
  if (!parts_->params.lockstep) global_updates_.thread = std::thread([this] { update_global(); });
}

MoveBaseNode::~MoveBaseNode() {
  global_updates_.is_ending = true;
  parts_->world->set_plan_listener({});
  if (global_updates_.thread.joinable()) global_updates_.thread.join();
}

void MoveBaseNode::serve(ros::NodeHandle& node, ros::NodeHandle private_node) {
  links_.command = node.advertise<geometry_msgs::Twist>("cmd_vel", 1);
  links_.current_goal = private_node.advertise<geometry_msgs::PoseStamped>("current_goal", 1, true);
  links_.global_path = private_node.advertise<nav_msgs::Path>(parts_->planner_space + "/plan", 1);
  links_.local_path =
      private_node.advertise<nav_msgs::Path>(parts_->controller_space + "/global_plan", 1);
  links_.action_goal = node.advertise<move_base_msgs::MoveBaseActionGoal>("move_base/goal", 1);
  links_.recovery =
      node.advertise<move_base_msgs::RecoveryStatus>("move_base/recovery_status", 1, true);
  if (parts_->params.lockstep) {
    // Latched: what is said before the simulator has connected would be lost.
    links_.not_repeatable = node.advertise<std_msgs::String>("/gazebo/not_repeatable", 10, true);
  }
  links_.simple_goal = node.subscribe<geometry_msgs::PoseStamped>(
      "move_base_simple/goal", 1,
      [this](const geometry_msgs::PoseStampedConstPtr& message) { on_simple_goal(*message); });
  links_.odometry = node.subscribe<nav_msgs::Odometry>(
      parts_->control.odom_topic, 5,
      [this](const nav_msgs::OdometryConstPtr& message) { on_odometry(*message); });
  links_.make_plan = private_node.advertiseService("make_plan", &MoveBaseNode::make_plan, this);
  links_.planner_make_plan = private_node.advertiseService(parts_->planner_space + "/make_plan",
                                                           &MoveBaseNode::make_plan, this);
  links_.clear_costmaps =
      private_node.advertiseService("clear_costmaps", &MoveBaseNode::clear_costmaps, this);
  goals_ = std::make_unique<GoalTopics>(node, "move_base");
  goals_->start();
  reconfiguration_ = std::make_unique<Reconfiguration>(private_node, *parts_, refusals_);
}

void MoveBaseNode::serve_plugins(const ros::NodeHandle& private_node) {
  const MoveBaseParams& params = parts_->params;
  links_.control = std::make_unique<ControlTopics>(
      ros::NodeHandle(private_node, parts_->controller_space), params.base_local_planner,
      parts_->local->frame(), buffer_, refusals_);
  if (parts_->planner->potential_source() == nullptr) return;
  links_.potential = std::make_unique<PotentialTopic>(
      ros::NodeHandle(private_node, parts_->planner_space), params.base_global_planner);
  parts_->world->set_plan_listener([this](const GridGeometry& geometry) {
    std_msgs::Header header;
    header.frame_id = parts_->global->frame();
    header.stamp = ros::Time::now();
    links_.potential->publish(parts_->planner->potential_source(), geometry, header);
  });
}

void MoveBaseNode::on_simple_goal(const geometry_msgs::PoseStamped& message) {
  const std::string problem = goal_problem(message.pose);
  if (!problem.empty()) {
    refusals_.note("goal", "the goal on move_base_simple/goal is refused: " + problem);
    return;
  }
  move_base_msgs::MoveBaseActionGoal goal;
  goal.header.stamp = ros::Time::now();
  goal.goal.target_pose = message;
  links_.action_goal.publish(goal);
}

void MoveBaseNode::on_odometry(const nav_msgs::Odometry& message) {
  const std::string problem = odometry_problem(message, ros::Time::now());
  if (!problem.empty()) {
    refusals_.note("odometry",
                   "odometry on " + parts_->control.odom_topic + " is not used: " + problem);
    return;
  }
  parts_->world->note_odometry(message.header.stamp.toSec());
  const geometry_msgs::Twist& twist = message.twist.twist;
  {
    const std::lock_guard lock(odometry_mutex_);
    measured_ = {twist.linear.x, twist.linear.y, twist.angular.z};
  }
  if (parts_->params.lockstep) lockstep_.samples.push(message.header.stamp.toSec());
}

/// While the robot drives, and once for each set of names.
void MoveBaseNode::warn_of_rivals() {
  if (!is_driving_) return;
  const std::string topic = links_.command.getTopic();
  const std::string text = ros_utils::rivals_text(topic, ros_utils::topic_publishers(topic));
  if (!text.empty()) refusals_.count("command", text);
  if (!text.empty() && text != warned_.rivals) ROS_WARN("%s", text.c_str());
  warned_.rivals = text;
}

void MoveBaseNode::update_global() {
  ros::WallRate poll(200.0);
  double updated_s = -1.0;
  ros::WallTime asked = ros::WallTime::now();
  while (!global_updates_.is_ending && ros::ok()) {
    const double now_s = ros::Time::now().toSec();
    if (now_s < updated_s || now_s - updated_s >= parts_->global->update_period_s() - 1e-6) {
      parts_->global->update(now_s);
      updated_s = now_s;
    }
    if ((ros::WallTime::now() - asked).toSec() > kWarningPeriod_s) {
      asked = ros::WallTime::now();
      warn_of_rivals();
    }
    poll.sleep();
  }
}

void MoveBaseNode::run() {
  if (parts_->params.lockstep) {
    run_in_lockstep();
  } else {
    run_by_clock();
  }
}

void MoveBaseNode::run_by_clock() {
  double frequency = parts_->navigator->params().controller_frequency;
  ros::Rate rate(frequency);
  while (ros::ok()) {
    reconfiguration_->apply();
    if (frequency != parts_->navigator->params().controller_frequency) {
      frequency = parts_->navigator->params().controller_frequency;
      rate = ros::Rate(frequency);
    }
    const double now_s = ros::Time::now().toSec();
    watch_.begin(now_s, ros::WallTime::now().toSec(), 1.0 / frequency);
    cycle(now_s);
    log_missed_periods(now_s);
    rate.sleep();
  }
  send({});
}

void MoveBaseNode::note_step(const char* step) { watch_.note(step, ros::WallTime::now().toSec()); }

/// Periods count while there is a goal.
void MoveBaseNode::log_missed_periods(double now_s) {
  if (!goals_->is_active()) watch_.pause();
  const std::string text = watch_.take_text(now_s);
  if (!text.empty()) ROS_WARN("%s", text.c_str());
}

void MoveBaseNode::cycle(double now_s) {
  note_time(now_s);
  parts_->local->update(now_s);
  note_step("The update of the local costmap");
  take_goals(now_s);
  if (!goals_->is_active()) return;
  std::string problem;
  if (unplaced_goal_ && !place_goal(now_s, &problem)) {
    if (goals_->is_active()) stand(now_s, problem);
    return;
  }
  const std::optional<NavigatorInput> sensed = sense(now_s, &problem);
  if (!sensed) return stand(now_s, problem);
  parts_->world->set_robot(sensed->robot_global, sensed->state.pose);
  note_step("The look-up of transforms");
  const auto lock = parts_->local->lock();
  note_step("The wait for the local costmap");
  NavigatorInput input = *sensed;
  input.local = parts_->local->costmap().grid();
  links_.control->prepare(now_s, *parts_->controller, *parts_->moving);
  input.tracks = parts_->moving->at(now_s);
  act(input, parts_->navigator->step(input));
  links_.control->publish(*parts_->controller, input.tracks);
  note_step("The search for a command");
}

/// The navigator's clock does not go back: after a jump it begins with its goal again.
void MoveBaseNode::note_time(double now_s) {
  const double back_s = std::exchange(warned_.cycled_s, now_s) - now_s;
  if (back_s <= 0.0) return;
  refusals_.note("time", "time went back by " + number_text(back_s) + " s to " +
                             number_text(now_s) + " s; the goal is pursued as if it were new");
  if (unplaced_goal_) unplaced_goal_->since_s = now_s;
  if (parts_->navigator->is_active()) {
    parts_->navigator->set_goal(parts_->navigator->goal(), now_s);
  }
}

void MoveBaseNode::take_goals(double now_s) {
  if (const auto goal = goals_->take_new()) {
    const std::string problem = goal_problem(goal->target_pose.pose);
    if (!problem.empty()) {
      const bool is_turn = problem.find("orientation") == 0;
      end_goal(NavigatorStatus::kAborted,
               std::string("Aborting on goal because it was sent with an invalid ") +
                   (is_turn ? "quaternion" : "position") + ": " + problem + ".");
      return;
    }
    parts_->navigator->cancel();
    unplaced_goal_ = UnplacedGoal{goal->target_pose, now_s};
    warned_.waiting_s = now_s;
  } else if (goals_->is_cancel_requested()) {
    parts_->navigator->cancel();
    unplaced_goal_.reset();
    send({});
    goals_->cancel();
  }
}

/// Gives the goal to the navigator as soon as its pose in the global costmap is known.
bool MoveBaseNode::place_goal(double now_s, std::string* problem) {
  *problem = parts_->global->missing();
  if (!problem->empty()) return false;
  const std::string& frame = parts_->global->frame();
  const std::string from = frame_name(unplaced_goal_->pose.header.frame_id);
  std::optional<Pose2> T_global_from = Pose2{};
  if (from.empty()) {
    *problem = "the goal has no frame";
    end_goal(NavigatorStatus::kAborted, "Aborting on goal because it has no frame");
    return false;
  }
  if (from != frame) {
    T_global_from = newest_pose(buffer_, frame, from, now_s, INFINITY, problem);
    if (!T_global_from) {
      give_up_frame(now_s, *problem);
      return false;
    }
  }
  const Pose2 goal = placed_in(*T_global_from, to_pose2(unplaced_goal_->pose.pose));
  unplaced_goal_.reset();
  parts_->navigator->set_goal(goal, now_s);
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  message.header.stamp.fromSec(now_s);
  message.pose = to_message(goal);
  links_.current_goal.publish(message);
  return true;
}

/// A frame that is still unknown although the robot's own have been there for some time will not
/// come.
void MoveBaseNode::give_up_frame(double now_s, const std::string& problem) {
  std::string of_robot;
  if (!parts_->global->robot(now_s, &of_robot)) unplaced_goal_->since_s = now_s;
  const double patience_s = parts_->navigator->params().planner_patience;
  if (now_s - unplaced_goal_->since_s < patience_s) return;
  end_goal(NavigatorStatus::kAborted,
           "Failed to find a valid plan. Even after executing recovery behaviors. "
           "planner_patience of " +
               number_text(patience_s) + " s is over: " + problem + ".");
}

std::optional<NavigatorInput> MoveBaseNode::sense(double now_s, std::string* problem) {
  NavigatorInput input;
  input.now_s = now_s;
  const std::optional<Pose2> local = parts_->local->robot(now_s, problem, &input.state.time_s);
  if (!local) return std::nullopt;
  const std::optional<Pose2> T = T_global_local(now_s, problem);
  if (!T) return std::nullopt;
  input.state.pose = *local;
  input.robot_global = placed_in(*T, *local);
  const std::lock_guard lock(odometry_mutex_);
  input.state.twist = measured_;
  return input;
}

/// Whether it is time again for a warning that the robot waits, which is then given.
bool MoveBaseNode::is_warning_due(double now_s) {
  if (now_s >= warned_.waiting_s && now_s - warned_.waiting_s < kWarningPeriod_s) return false;
  warned_.waiting_s = now_s;
  return true;
}

void MoveBaseNode::stand(double now_s, const std::string& why) {
  if (is_driving_) send({});
  refusals_.count("waiting", why);
  if (is_warning_due(now_s)) ROS_WARN("The robot waits: %s.", why.c_str());
}

void MoveBaseNode::send(const Twist2& twist) {
  geometry_msgs::Twist message;
  message.linear.x = twist.vx;
  message.linear.y = twist.vy;
  message.angular.z = twist.wz;
  lockstep_.answer = message;
  if (!parts_->params.lockstep) links_.command.publish(message);
  is_driving_ = twist.vx != 0.0 || twist.vy != 0.0 || twist.wz != 0.0;
}

void MoveBaseNode::act(const NavigatorInput& input, const NavigatorOutput& output) {
  move_base_msgs::MoveBaseFeedback feedback;
  feedback.base_position.header.frame_id = parts_->global->frame();
  feedback.base_position.header.stamp.fromSec(input.now_s);
  feedback.base_position.pose = to_message(input.robot_global);
  goals_->publish_feedback(feedback);
  if (output.has_new_path) publish_path(input.now_s);
  if (output.recovery) note_recovery(*output.recovery, input);
  if (output.status != NavigatorStatus::kActive) {
    end_goal(output.status, output.text);
    return;
  }
  send(output.twist);
  if (output.waiting.empty() || !is_warning_due(input.now_s)) return;
  ROS_WARN("%s", output.waiting.c_str());
}

void MoveBaseNode::end_goal(NavigatorStatus status, const std::string& text) {
  send({});
  lockstep_.awaits_goal = true;
  unplaced_goal_.reset();
  parts_->navigator->cancel();
  if (status == NavigatorStatus::kSucceeded) {
    goals_->succeed(text);
    return;
  }
  ROS_ERROR("%s", text.c_str());
  goals_->abort(text);
}

void MoveBaseNode::note_recovery(const RecoveryNote& note, const NavigatorInput& input) {
  ROS_WARN("Recovery %zu of %zu, %s: %s", note.index + 1, note.count, note.name.c_str(),
           note.cause.c_str());
  move_base_msgs::RecoveryStatus message;
  message.pose_stamped.header.frame_id = parts_->global->frame();
  message.pose_stamped.header.stamp.fromSec(input.now_s);
  message.pose_stamped.pose = to_message(input.robot_global);
  message.current_recovery_number = static_cast<std::uint16_t>(note.index);
  message.total_number_of_recoveries = static_cast<std::uint16_t>(note.count);
  message.recovery_behavior_name = note.name;
  links_.recovery.publish(message);
}

void MoveBaseNode::publish_path(double now_s) {
  const nav_msgs::Path message =
      path_message(parts_->navigator->path(), parts_->global->frame(), now_s);
  links_.global_path.publish(message);
  links_.local_path.publish(message);
}

/// A pose in the global costmap's frame; nothing: `problem` says why.
std::optional<Pose2> MoveBaseNode::placed_globally(const geometry_msgs::PoseStamped& pose,
                                                   double now_s, std::string* problem) const {
  *problem = goal_problem(pose.pose);
  if (!problem->empty()) return std::nullopt;
  const std::string from = frame_name(pose.header.frame_id);
  const auto T_global_from =
      newest_pose(buffer_, parts_->global->frame(), from, now_s, INFINITY, problem);
  if (!T_global_from) return std::nullopt;
  return placed_in(*T_global_from, to_pose2(pose.pose));
}

bool MoveBaseNode::make_plan(nav_msgs::GetPlan::Request& request,
                             nav_msgs::GetPlan::Response& response) {
  const double now_s = ros::Time::now().toSec();
  std::string problem;
  const bool starts_here = request.start.header.frame_id.empty();
  const auto start = starts_here ? parts_->global->robot(now_s, &problem)
                                 : placed_globally(request.start, now_s, &problem);
  const auto goal = start ? placed_globally(request.goal, now_s, &problem) : std::nullopt;
  if (!goal) {
    refusals_.note("make_plan",
                   std::string("make_plan, ") + (start ? "goal: " : "start: ") + problem);
    return false;
  }
  const PlanOutcome outcome = parts_->world->plan_now(*start, *goal);
  if (outcome.failure != Failure::kNone)
    refusals_.note("make_plan", "make_plan: " + outcome.reason);
  response.plan = path_message(outcome.path, parts_->global->frame(), now_s);
  return true;
}

bool MoveBaseNode::clear_costmaps(std_srvs::Empty::Request& /*request*/,
                                  std_srvs::Empty::Response& /*response*/) {
  for (CostmapNode* costmap : {parts_->local.get(), parts_->global.get()}) {
    const auto lock = costmap->lock();
    forget_area(costmap->costmap(), {}, {0.0, Layer::Side::kOutside, AffectedMaps::kBoth, {}});
  }
  return true;
}

int move_base_main(int argc, char** argv, const VoxelAdvertiser& voxels) {
  ros::init(argc, argv, "move_base");
  ros::NodeHandle node, private_node("~");
  ros::AsyncSpinner spinner(2);
  try {
    spinner.start();
    MoveBaseNode move_base(node, private_node, voxels);
    move_base.run();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::nav
