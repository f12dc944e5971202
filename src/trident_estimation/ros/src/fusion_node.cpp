// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_estimation_ros/fusion_node.h"

#include <algorithm>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_estimation_ros/fusion_messages.h"
#include "trident_ros/diagnostic_counter.h"
#include "trident_ros/message_checks.h"
#include "trident_ros/node_params.h"

namespace trident::estimation {
namespace {

constexpr double kReportPeriod_s = 1.0;  // wall time
constexpr std::uint32_t kQueue = 100;

std::vector<RobotStart> starts(const FusionNodeParams& params) {
  std::vector<RobotStart> result;
  for (const auto& [name, robot] : params.all_robots()) result.push_back(robot_start(robot));
  return result;
}

std::vector<FusedRobot> fused_robots(const FusionNodeParams& params) {
  std::vector<FusedRobot> result;
  for (const auto& [name, robot] : params.all_robots()) result.push_back({name, robot.kind});
  return result;
}

Eigen::MatrixXd default_covariance(const FusionRobotParams& robot, PoseRows rows) {
  const double p = robot.pose_sigma * robot.pose_sigma;
  const double r = robot.pose_turn_sigma * robot.pose_turn_sigma;
  if (rows == PoseRows::kPlanar) return Eigen::Vector3d(p, p, r).asDiagonal();
  return (Eigen::VectorXd(6) << p, p, p, r, r, r).finished().asDiagonal();
}

std::string type_of(const ros::M_string& publisher) {
  const auto type = publisher.find("type");
  return type == publisher.end() ? "" : type->second;
}

}  // namespace

FusionNode::FusionNode(ros::NodeHandle& node, const FusionNodeParams& params)
    : params_(params),
      fusion_(starts(params), params.options()),
      output_(node, fused_robots(params), params.common_frame, params.fused),
      refusals_(node),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10)) {
  for (const auto& [name, robot] : params.all_robots()) robots_.push_back({name, robot});
  heard_.resize(robots_.size());
  subscribe(node);
  update_timer_ = node.createTimer(ros::Duration(1.0 / params.update_rate),
                                   [this](const ros::TimerEvent&) { update(); });
  report_timer_ = node.createWallTimer(ros::WallDuration(kReportPeriod_s),
                                       [this](const ros::WallTimerEvent&) { publish_reports(); });
}

template <class Message>
void FusionNode::subscribe(ros::NodeHandle& node, const std::string& topic,
                           std::function<void(const Message&)> take) {
  const boost::function<void(const boost::shared_ptr<Message const>&)> guarded =
      [this, topic, take = std::move(take)](const boost::shared_ptr<Message const>& message) {
        try {
          take(*message);
        } catch (const Error& error) {
          refusals_.note(topic, topic + ": " + error.what());
        }
      };
  subscribers_.push_back(node.subscribe<Message>(topic, kQueue, guarded));
}

void FusionNode::subscribe(ros::NodeHandle& node) {
  for (std::size_t i = 0; i < robots_.size(); ++i) subscribe(node, i);
  for (const std::string& topic : params_.sighting_topics) {
    subscribe<trident_msgs::Detection>(
        node, topic, [this, topic](const auto& message) { on_detection(topic, message); });
  }
  for (const FusionRangeParams& range : params_.ranges) subscribe_range(node, range);
  if (!params_.fused) return;
  for (const char* topic : {"/tf", "/tf_static"}) {
    subscribers_.push_back(node.subscribe(topic, kQueue, &FusionNode::on_transforms, this));
  }
}

void FusionNode::subscribe_range(ros::NodeHandle& node, const FusionRangeParams& range) {
  const std::size_t robot = index_of(range.robot), other = index_of(range.other);
  subscribe<sensor_msgs::Range>(node, range.topic, [=](const sensor_msgs::Range& message) {
    const SimTime stamp = checked_stamp(message.header, ros::Time::now());
    const double value = static_cast<double>(message.range);
    if (!(value >= 0.0 && value <= ros_utils::kFarthestM)) {
      throw Error("range is " + number_text(value) + " m, legal: in [0, 1e+08]");
    }
    fusion_.add(radio_range({stamp, range.topic}, robot, other, value, range.sigma * range.sigma));
  });
}

void FusionNode::subscribe(ros::NodeHandle& node, std::size_t robot) {
  const FusionRobotParams& own = robots_[robot].params;
  if (!own.pose_topic.empty()) subscribe_poses(node, robot, false);
  if (!own.shared_pose_topic.empty()) subscribe_poses(node, robot, true);
  if (!own.gnss_topic.empty()) {
    const GeodeticPlace origin{params_.world_origin.x(), params_.world_origin.y(),
                               params_.world_origin.z()};
    subscribe<sensor_msgs::NavSatFix>(node, own.gnss_topic, [=](const auto& message) {
      const SimTime stamp = checked_stamp(message.header, ros::Time::now());
      const GnssFix fix = gnss_fix(message, origin, robots_[robot].params.gnss_sigma);
      fusion_.add(gnss({stamp, robots_[robot].params.gnss_topic}, robot, fix.p_world_antenna,
                       robots_[robot].params.gnss_antenna, fix.covariance));
    });
  }
  if (!own.compass_topic.empty()) {
    subscribe<sensor_msgs::Imu>(node, own.compass_topic, [=](const sensor_msgs::Imu& message) {
      const SimTime stamp = checked_stamp(message.header, ros::Time::now());
      geometry_msgs::Pose turned;
      turned.orientation = message.orientation;
      const double sigma = robots_[robot].params.compass_sigma;
      fusion_.add(compass({stamp, robots_[robot].params.compass_topic}, robot,
                          from_pose(turned).rpy().z(), sigma * sigma));
    });
  }
  if (!own.pressure_topic.empty()) {
    subscribe<sensor_msgs::FluidPressure>(node, own.pressure_topic, [=](const auto& message) {
      const SimTime stamp = checked_stamp(message.header, ros::Time::now());
      const double sigma = robots_[robot].params.pressure_sigma;
      fusion_.add(altitude({stamp, robots_[robot].params.pressure_topic}, robot,
                           pressure_height(message, params_.pressure_reference),
                           Eigen::Vector3d::Zero(), sigma * sigma));
    });
  }
}

/// Poses have one of three types, which is known when a publisher connects.
void FusionNode::subscribe_poses(ros::NodeHandle& node, std::size_t robot, bool is_shared) {
  const FusionRobotParams& own = robots_[robot].params;
  const std::string topic = is_shared ? own.shared_pose_topic : own.pose_topic;
  const auto take = [=](const ros_utils::AnySubscriptionHelper::Bytes& bytes,
                        const ros::M_string& publisher) {
    try {
      const std::string type = type_of(publisher);
      if (!is_pose_type(type)) {
        throw Error("'" + ros_utils::quoted(type) +
                    "' has no pose; legal: nav_msgs/Odometry, geometry_msgs/PoseStamped, "
                    "geometry_msgs/PoseWithCovarianceStamped; " +
                    pose_topics_of(robots_[robot].name));
      }
      is_shared ? on_shared_pose(topic, robot, type, *bytes) : on_pose(topic, robot, type, *bytes);
    } catch (const Error& error) {
      refusals_.note(topic, topic + ": " + error.what());
    }
  };
  auto options = ros_utils::any_subscription(topic, kQueue, take, nullptr);
  subscribers_.push_back(node.subscribe(options));
}

/// Topics of a robot that are poses, as the master knows them.
std::string FusionNode::pose_topics_of(const std::string& name) const {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::string found;
  for (const ros::master::TopicInfo& topic : topics) {
    if (topic.name.rfind("/" + name + "/", 0) != 0 || !is_pose_type(topic.datatype)) continue;
    found += (found.empty() ? "" : ", ") + topic.name;
  }
  return found.empty() ? "no topic of " + name + " is a pose" : "poses of " + name + ": " + found;
}

std::size_t FusionNode::index_of(const std::string& name) const {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (robots_[i].name == name) return i;
  }
  throw Error("'" + ros_utils::quoted(name) + "' is not a robot of the team");
}

void FusionNode::on_pose(const std::string& topic, std::size_t robot, const std::string& type,
                         const std::string& bytes) {
  const StampedPose message = pose_from_bytes(type, bytes);
  const SimTime stamp = checked_stamp(message.header, ros::Time::now());
  const SE3 T_map_base = from_pose(message.pose.pose);
  const FusionRobotParams& own = robots_[robot].params;
  const PoseCovariance known = pose_covariance(message.pose, own.planar);
  if (known.matrix.size() == 0 && message.has_covariance) {
    refusals_.note(topic + " covariance",
                   topic + ": covariance is zero, legal: positive definite; pose_sigma " +
                       number_text(own.pose_sigma) + " m and pose_turn_sigma " +
                       number_text(own.pose_turn_sigma) + " rad are used instead");
  }
  fusion_.note_pose(robot, stamp, T_map_base);
  fusion_.add(map_pose(
      {stamp, topic}, robot, T_map_base,
      known.matrix.size() == 0 ? default_covariance(own, known.rows) : known.matrix, known.rows));
  if (own.waterline) add_waterline(stamp, robot);
  note_heard(robot, message.header.stamp);
}

void FusionNode::note_heard(std::size_t robot, const ros::Time& stamp) {
  if (!heard_[robot] || stamp > *heard_[robot]) heard_[robot] = stamp;
}

void FusionNode::add_waterline(SimTime stamp, std::size_t robot) {
  const FusionRobotParams& own = robots_[robot].params;
  fusion_.add(altitude({stamp, robots_[robot].name + " waterline"}, robot, own.water_level,
                       Eigen::Vector3d::Zero(), own.waterline_sigma * own.waterline_sigma));
}

void FusionNode::on_shared_pose(const std::string& topic, std::size_t robot,
                                const std::string& type, const std::string& bytes) {
  const StampedPose message = pose_from_bytes(type, bytes);
  const SimTime stamp = checked_stamp(message.header, ros::Time::now());
  if (message.header.frame_id != params_.common_frame) {
    throw Error("frame_id is '" + ros_utils::quoted(message.header.frame_id) + "', legal: '" +
                params_.common_frame + "'");
  }
  const PoseCovariance known = pose_covariance(message.pose, false);
  if (known.matrix.rows() != 6) throw Error("covariance is not positive definite");
  fusion_.add(world_pose({stamp, topic}, robot, from_pose(message.pose.pose), known.matrix, true));
}

void FusionNode::on_detection(const std::string& topic, const trident_msgs::Detection& detection) {
  const SimTime stamp = checked_stamp(detection.header, ros::Time::now());
  Sighting seen = sighting_of(detection, params_.sighting_angle_sigma);
  seen.observer = index_of(detection.observer);
  seen.target = index_of(detection.label);
  if (seen.observer == seen.target) {
    throw Error("label is '" + ros_utils::quoted(detection.label) + "', which is the observer");
  }
  const std::string frame = detection.observer + "/base_link";
  if (detection.header.frame_id != frame) {
    throw Error("frame_id is '" + ros_utils::quoted(detection.header.frame_id) + "', legal: '" +
                frame + "'");
  }
  fusion_.add(sighting({stamp, topic + " " + detection.observer + " " + detection.label}, seen));
}

/// An edge of the tree of frames has one owner.
void FusionNode::on_transforms(const ros::MessageEvent<tf2_msgs::TFMessage const>& event) {
  if (event.getPublisherName() == ros::this_node::getName()) return;
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    for (const Robot& robot : robots_) {
      const std::string frame = FusionOutput::map_frame(robot.name);
      if (transform.child_frame_id != frame) continue;
      refusals_.note("two owners of " + frame,
                     "'" + ros_utils::quoted(event.getPublisherName()) + "' publishes " +
                         ros_utils::quoted(transform.header.frame_id) + " -> " + frame +
                         ", too; legal: one of both (fused: false here)");
    }
  }
}

void FusionNode::update() {
  const ros::Time now = ros::Time::now();
  if (now.isZero()) return;
  if (now + ros::Duration(params_.keep) < last_update_) {
    refusals_.note("time went back", "the clock went back by " +
                                         number_text((last_update_ - now).toSec()) +
                                         " s; what was believed is forgotten");
    fusion_.restart();
    std::fill(heard_.begin(), heard_.end(), std::nullopt);
  }
  last_update_ = now;
  note_outcomes(fusion_.update());
  const auto belief = fusion_.at({static_cast<std::int64_t>(now.toNSec())});
  if (belief) output_.publish(now, *belief, heard_);
}

/// Sources whose covariances are not believed, sorted.
std::vector<std::string> FusionNode::accused_sources() const {
  std::vector<std::string> accused;
  for (const auto& [source, report] : fusion_.reports()) {
    if (report.trust.inflation > 1.0) accused.push_back(source);
  }
  return accused;
}

void FusionNode::note_outcomes(const std::vector<Outcome>& outcomes) {
  for (const Outcome& outcome : outcomes) {
    if (outcome.kind == Outcome::Kind::kRefused) refusals_.note("measurement", outcome.reason);
  }
  std::vector<std::string> accused = accused_sources();
  for (const std::string& source : accused) {
    if (std::binary_search(accused_.begin(), accused_.end(), source)) continue;
    refusals_.note(source + " covariance",
                   source +
                       ": its covariances are too small for what it measures; they are "
                       "inflated (by how much: /diagnostics)");
  }
  accused_ = std::move(accused);
}

/// A status of each source.
void FusionNode::publish_reports() {
  if (diagnostics_.getNumSubscribers() == 0) return;
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  for (const auto& [source, report] : fusion_.reports()) {
    diagnostic_msgs::DiagnosticStatus status;
    const bool is_accused = report.trust.inflation > 1.0;
    status.name = ros::this_node::getName() + ": source " + source;
    status.level = is_accused ? diagnostic_msgs::DiagnosticStatus::WARN
                              : diagnostic_msgs::DiagnosticStatus::OK;
    status.message = is_accused ? "covariances are too small, inflated" : "OK";
    const std::pair<const char*, double> values[] = {
        {"used", static_cast<double>(report.used)},
        {"gated", static_cast<double>(report.gated)},
        {"refused", static_cast<double>(report.refused)},
        {"inflation", report.trust.inflation},
        {"share beyond the median", report.trust.share}};
    for (const auto& [key, value] : values) {
      status.values.push_back(ros_utils::key_value(key, number_text(value)));
    }
    array.status.push_back(std::move(status));
  }
  diagnostics_.publish(array);
}

int team_fusion_main(int argc, char** argv) {
  ros::init(argc, argv, "team_fusion");
  ros::NodeHandle node, private_node("~");
  try {
    const auto params = ros_utils::load_params<FusionNodeParams>(private_node);
    const FusionNode fusion(node, params);
    ros::spin();
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

}  // namespace trident::estimation
