// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Talks to a running lee_position_controller_node in this namespace, which has the parameters of
// the firefly and gains of RotorS; run by test_controller_nodes.py, once per life of a simulator.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <mav_msgs/Actuators.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <limits>
#include <map>
#include <mutex>
#include <random>
#include <thread>

#include "trident_control/lee_position_controller.h"

namespace trident::control {
namespace {

using namespace std::chrono_literals;

constexpr auto kTimeout = 5s;
constexpr auto kTimeOfNoAnswer = 200ms;
const std::vector<double> kZeros(6, 0.0);

LeeParams firefly_params() {
  LeeParams params;  // as in lee_controller_firefly.yaml and firefly.yaml
  params.gains.attitude = {3.0, 3.0, 0.15};
  params.gains.angular_rate = {0.52, 0.52, 0.18};
  return params;
}

nav_msgs::Odometry to_message(const OdometryState& state, double stamp_s) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(stamp_s);
  message.header.frame_id = "world";
  message.child_frame_id = "UAV1/odometry_sensor1";
  const auto set = [](auto& to, const Eigen::Vector3d& from) {
    to.x = from.x();
    to.y = from.y();
    to.z = from.z();
  };
  set(message.pose.pose.position, state.p_world_body);
  set(message.twist.twist.linear, state.v_body);
  set(message.twist.twist.angular, state.w_body);
  message.pose.pose.orientation.w = state.R_world_body.w();
  message.pose.pose.orientation.x = state.R_world_body.x();
  message.pose.pose.orientation.y = state.R_world_body.y();
  message.pose.pose.orientation.z = state.R_world_body.z();
  message.pose.covariance.fill(1.5);
  return message;
}

geometry_msgs::PoseStamped pose(double stamp_s, double x, double y, double z, double yaw) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = ros::Time(stamp_s);
  message.pose.position.x = x;
  message.pose.position.y = y;
  message.pose.position.z = z;
  message.pose.orientation.w = std::cos(yaw / 2);
  message.pose.orientation.z = std::sin(yaw / 2);
  return message;
}

/// The other end of the controller's topics.
class Peer {
 public:
  Peer() : spinner_(1) {
    const auto hints = ros::TransportHints().tcpNoDelay();
    odometry_ = node_.advertise<nav_msgs::Odometry>("odometry", 100);
    pose_ = node_.advertise<geometry_msgs::PoseStamped>("command/pose", 10);
    trajectory_ =
        node_.advertise<trajectory_msgs::MultiDOFJointTrajectory>("command/trajectory", 10);
    motors_ = node_.subscribe("command/motor_speed", 100, &Peer::on_motors, this, hints);
    accepted_ = node_.subscribe("command/accepted_setpoint", 100, &Peer::on_accepted, this, hints);
    spinner_.start();
    const auto is_connected = [this] {
      return odometry_.getNumSubscribers() && pose_.getNumSubscribers() &&
             trajectory_.getNumSubscribers() && motors_.getNumPublishers() &&
             accepted_.getNumPublishers();
    };
    while (ros::ok() && !is_connected()) std::this_thread::sleep_for(5ms);
    settle();
  }

  /// The controller's answer to one state; empty without an answer.
  std::vector<double> answer(const OdometryState& state, double stamp_s,
                             std::chrono::milliseconds limit = kTimeout) {
    const ros::Time stamp(stamp_s);
    odometry_.publish(to_message(state, stamp_s));
    std::unique_lock<std::mutex> lock(mutex_);
    const auto has_come = [&] { return answers_.count(stamp) > 0; };
    if (!changed_.wait_for(lock, limit, has_come)) return {};
    const std::vector<double> speeds = answers_[stamp];
    answers_.clear();
    return speeds;
  }

  /// Publishes a stamped set-point; true when it is confirmed.
  template <typename Message>
  bool confirmed(ros::Publisher Peer::*publisher, const Message& message,
                 std::chrono::milliseconds limit = kTimeout) {
    std::unique_lock<std::mutex> lock(mutex_);
    confirmations_.clear();
    (this->*publisher).publish(message);
    return changed_.wait_for(lock, limit,
                             [&] { return confirmations_.count(message.header.stamp) > 0; });
  }

  std::string topic_of_confirmation(const ros::Time& stamp) { return confirmations_.at(stamp); }

  ros::Publisher odometry_, pose_, trajectory_;

 private:
  // A publisher counts a subscriber before the controller's socket thread has read the handshake of
  // ours; states are sent until one is answered.
  void settle() {
    for (int i = 1; ros::ok(); ++i) {
      if (!answer({}, 1e-3 * i, 100ms).empty()) return;
    }
  }
  void on_motors(const mav_msgs::Actuators::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    answers_[message->header.stamp] = message->angular_velocities;
    changed_.notify_all();
  }
  void on_accepted(const std_msgs::Header::ConstPtr& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    confirmations_[message->stamp] = message->frame_id;
    changed_.notify_all();
  }

  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
  ros::Subscriber motors_, accepted_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<ros::Time, std::vector<double>> answers_;
  std::map<ros::Time, std::string> confirmations_;
};

/// Every test begins with a reset of the simulation to stamps near zero.
class LeeNode : public testing::Test {
 protected:
  void SetUp() override {
    static Peer one_peer;
    peer = &one_peer;
    peer->answer({}, 1e6);
    ASSERT_EQ(peer->answer({}, 0.01), kZeros);
  }

  std::vector<double> expected(const OdometryState& state, const TrajectoryPoint& point) const {
    std::vector<double> speeds(6);
    EXPECT_EQ(controller.compute(state, point, speeds), ControlStatus::ok);
    return speeds;
  }

  TrajectoryPoint point(double x, double y, double z, double yaw) const {
    TrajectoryPoint result;
    result.p_world = Eigen::Vector3d(x, y, z);
    result.yaw = yaw_from_quaternion({std::cos(yaw / 2), 0.0, 0.0, std::sin(yaw / 2)});
    return result;
  }

  const LeePositionController controller{firefly_params()};
  Peer* peer = nullptr;
};

TEST_F(LeeNode, answers_zeros_with_the_stamp_of_the_state_until_a_command_comes) {
  for (int i = 2; i < 20; ++i) EXPECT_EQ(peer->answer({}, 0.01 * i), kZeros);
}

TEST_F(LeeNode, answers_equal_the_core_to_the_bit) {
  ASSERT_TRUE(peer->confirmed(&Peer::pose_, pose(0.02, 1.0, -2.0, 3.0, 0.7)));
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 2; i < 200; ++i) {
    OdometryState state;
    state.p_world_body = Eigen::Vector3d(unit(random), unit(random), unit(random));
    state.v_body = Eigen::Vector3d(unit(random), unit(random), unit(random));
    state.w_body = Eigen::Vector3d(unit(random), unit(random), unit(random));
    state.R_world_body =
        Eigen::Quaterniond(2.0, unit(random), unit(random), unit(random)).normalized();
    EXPECT_EQ(peer->answer(state, 0.01 * i), expected(state, point(1.0, -2.0, 3.0, 0.7)));
  }
}

TEST_F(LeeNode, a_stamped_trajectory_acts_at_its_stamps_with_feed_forward) {
  trajectory_msgs::MultiDOFJointTrajectory trajectory;
  trajectory.header.stamp = ros::Time(0.05);
  trajectory.points.resize(2);
  for (int i = 0; i < 2; ++i) {
    auto& p = trajectory.points[static_cast<std::size_t>(i)];
    p.time_from_start = ros::Duration(0.03 * i);
    p.transforms.resize(1);
    p.velocities.resize(1);
    p.accelerations.resize(1);
    p.transforms[0].rotation.w = 1.0;
    p.transforms[0].translation.z = 1.0 + i;
    p.velocities[0].linear.x = 0.5;
    p.velocities[0].angular.z = 0.1;
    p.accelerations[0].linear.y = -0.3;
  }
  ASSERT_TRUE(peer->confirmed(&Peer::trajectory_, trajectory));
  EXPECT_EQ(peer->topic_of_confirmation(ros::Time(0.05)),
            ros::names::resolve("command/trajectory"));
  for (int k = 2; k < 12; ++k) {
    TrajectoryPoint reference = point(0.0, 0.0, k < 8 ? 1.0 : 2.0, 0.0);
    reference.v_world.x() = 0.5;
    reference.a_world.y() = -0.3;
    reference.yaw_rate = 0.1;
    EXPECT_EQ(peer->answer({}, 0.01 * k), k < 5 ? kZeros : expected({}, reference)) << k;
  }
}

TEST_F(LeeNode, refuses_nan_set_points_and_keeps_the_last_good_one) {
  ASSERT_TRUE(peer->confirmed(&Peer::pose_, pose(0.02, 0.0, 0.0, 1.0, 0.0)));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(peer->confirmed(&Peer::pose_, pose(0.03, nan, 0.0, 1.0, 0.0), kTimeOfNoAnswer));
  trajectory_msgs::MultiDOFJointTrajectory no_transform;
  no_transform.header.stamp = ros::Time(0.03);
  no_transform.points.resize(1);
  EXPECT_FALSE(peer->confirmed(&Peer::trajectory_, no_transform, kTimeOfNoAnswer));
  no_transform.points.clear();
  EXPECT_FALSE(peer->confirmed(&Peer::trajectory_, no_transform, kTimeOfNoAnswer));
  EXPECT_EQ(peer->answer({}, 0.04), expected({}, point(0.0, 0.0, 1.0, 0.0)));
}

TEST_F(LeeNode, does_not_answer_a_nan_state_but_the_next_one) {
  ASSERT_TRUE(peer->confirmed(&Peer::pose_, pose(0.02, 0.0, 0.0, 1.0, 0.0)));
  OdometryState bad;
  bad.v_body.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(peer->answer(bad, 0.03, kTimeOfNoAnswer).empty());
  EXPECT_EQ(peer->answer({}, 0.04), expected({}, point(0.0, 0.0, 1.0, 0.0)));
}

TEST_F(LeeNode, a_reset_of_the_simulation_ends_the_flight) {
  ASSERT_TRUE(peer->confirmed(&Peer::pose_, pose(0.02, 0.0, 0.0, 1.0, 0.0)));
  EXPECT_NE(peer->answer({}, 0.03), kZeros);
  EXPECT_EQ(peer->answer({}, 0.01), kZeros);
}

}  // namespace
}  // namespace trident::control

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "lee_node_check", ros::init_options::AnonymousName);
  const ros::NodeHandle keeps_ros_running;
  return RUN_ALL_TESTS();
}
