// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/slam_node.h"

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_maps/map_file.h"
#include "trident_maps_ros/map_messages.h"
#include "trident_ros/message_checks.h"
#include "trident_slam/slam_2d_abilities.h"
#include "trident_slam_ros/motion_diagnosis.h"

namespace trident::slam {
namespace {

constexpr double kIntakePeriodS = 0.005;
constexpr double kDiagnosticsPeriodS = 1.0;
constexpr double kComplainEveryS = 5.0;
constexpr std::size_t kMostKinds = 100;  // of complaints: a stranger's names make ever more

ScanIntakeOptions intake_options(const SlamNodeOptions& options) {
  ScanIntakeOptions result;
  result.odom_frame = options.odom_frame;
  result.base_frame = options.base_frame;
  result.transform_timeout = options.transform_timeout;
  result.waits_for_all = options.is_sync;
  result.uses_mount = options.uses_mount;
  result.uses_gyro = !options.imu_topic.empty();
  return result;
}

diagnostic_msgs::KeyValue key_value(const std::string& key, const std::string& value) {
  diagnostic_msgs::KeyValue pair;
  pair.key = key;
  pair.value = value;
  return pair;
}

/// A problem's text without its numbers, what it quotes and what it has in brackets.
std::string kind_of(const std::string& text) {
  std::string kind;
  bool is_quoted = false;
  int depth = 0;
  for (const char letter : text) {
    if (letter == '\'') is_quoted = !is_quoted;
    if (letter == '(') ++depth;
    if (letter == ')') --depth;
    const bool is_digit = std::isdigit(static_cast<unsigned char>(letter)) != 0;
    if (!is_quoted && depth <= 0 && !is_digit) kind += letter;
  }
  return kind;
}

/// The file, without an ending, that a map is saved to when the node has to end.
std::string rescue_stem(const SlamNodeOptions& options) {
  namespace fs = std::filesystem;
  if (!options.autosave_file.empty()) {
    return fs::path(options.autosave_file).replace_extension().string() + "_rescued";
  }
  const char* const ros_home = std::getenv("ROS_HOME");
  const char* const home = std::getenv("HOME");
  const fs::path folder =
      ros_home != nullptr ? fs::path(ros_home) : fs::path(home != nullptr ? home : ".") / ".ros";
  std::string name = ros::this_node::getName().substr(1);
  for (char& letter : name) {
    if (letter == '/') letter = '_';
  }
  return (folder / (name + "_rescued")).string();
}

std::string text(const CalibrationEstimate& estimate) {
  if (!estimate.is_observed) return "not observable yet";
  const auto rounded = [](double value) { return number_text(std::round(1e5 * value) / 1e5); };
  return rounded(estimate.value) + " +- " + rounded(estimate.sigma);
}

}  // namespace

SlamNode::SlamNode(const ros::NodeHandle& private_handle, const SlamNodeOptions& options,
                   MakeSlam make)
    : options_(options),
      make_(std::move(make)),
      slam_(new_slam()),
      transforms_(ros::Duration(options.tf_buffer_duration)),
      intake_(intake_options(options), transforms_),
      stamps_(options.bag_loop_threshold),
      autosave_(
          options.autosave_file, options.autosave_interval, [this] { return session_snapshot(); },
          [this](const std::string& problem) { tell(problem); }) {
  transform_input_ = std::make_unique<ros_utils::TransformInput>(
      transforms_, [this](const std::string& problem) { tell(problem); });
  ros::NodeHandle handle;
  ros::NodeHandle own(private_handle);
  const MapPublisher::Periods periods{options.map_update_interval, options.map_changes_interval};
  map_publisher_ = std::make_unique<MapPublisher>(handle, options.map_topic, periods);
  // In the node's namespace, as services are, and beside the map.
  for (ros::NodeHandle* place : {&handle, &own}) {
    if (place == &own && own.getNamespace() == handle.getNamespace()) continue;
    pose_publishers_.push_back(
        place->advertise<geometry_msgs::PoseWithCovarianceStamped>(options.pose_topic, 10));
  }
  diagnostics_publisher_ = handle.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10);
  own.setCallbackQueue(&slow_queue_);
  map_service_ = own.advertiseService("dynamic_map", &SlamNode::get_map, this);
  intake_timer_ = handle.createWallTimer(ros::WallDuration(kIntakePeriodS),
                                         [this](const ros::WallTimerEvent&) { hand_over(); });
  diagnostics_timer_ =
      handle.createWallTimer(ros::WallDuration(kDiagnosticsPeriodS),
                             [this](const ros::WallTimerEvent&) { publish_diagnostics(); });
  if (options.transform_publish_period > 0.0) {
    correction_timer_ =
        handle.createTimer(ros::Duration(options.transform_publish_period),
                           [this](const ros::TimerEvent&) { publish_correction(); });
  }
  crash_rescue_ = std::make_unique<CrashRescue>([this] {
    // A lock that the thread that failed holds is never released.
    const std::unique_lock<std::mutex> lock(slam_mutex_, std::try_to_lock);
    save_what_there_is();
  });
  worker_ = std::thread([this] { work(); });
  if (!options.imu_topic.empty()) {
    imu_subscriber_ = handle.subscribe(options.imu_topic, 0, &SlamNode::receive_imu, this);
  }
  // Without a limit: in synchronous mode no scan may be lost.
  scan_subscriber_ =
      handle.subscribe(options.scan_topic, options.is_sync ? 0 : options.scan_queue_size,
                       &SlamNode::receive_scan, this);
  slow_spinner_.start();
}

std::unique_ptr<Slam2d> SlamNode::new_slam() const {
  std::unique_ptr<Slam2d> slam = make_();
  if (!options_.odom_frame.empty()) return slam;
  auto* able = dynamic_cast<Slam2dOdometryUse*>(slam.get());
  if (able == nullptr) throw Error("parameter odom_frame is empty, but this method needs odometry");
  able->set_uses_odometry(false);
  return slam;
}

SlamNode::~SlamNode() {
  slow_spinner_.stop();
  transform_input_.reset();
  scan_subscriber_.shutdown();
  imu_subscriber_.shutdown();
  {
    const std::lock_guard<std::mutex> lock(queue_mutex_);
    is_ending_ = true;
  }
  queue_changed_.notify_all();
  worker_.join();
  autosave_.finish();
}

// Each kind of problem is told now and then; all are counted.
void SlamNode::complain(const std::string& text) {
  last_problem_ = text;
  std::string kind = kind_of(text);
  const ros::WallTime now = ros::WallTime::now();
  if (complaints_.size() >= kMostKinds && complaints_.count(kind) == 0) kind.clear();
  ros::WallTime& told = complaints_[kind];
  if (!told.isZero() && (now - told).toSec() < kComplainEveryS) return;
  told = now;
  ROS_WARN("%s", text.c_str());
}

void SlamNode::count_problem(const std::string& text) {
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  problems_.add(text);
  last_problem_ = text;
}

void SlamNode::receive_scan(const sensor_msgs::LaserScanConstPtr& message) {
  if (!intake_.is_refused(*message, ros::Time::now())) {
    const ScanStamps::Step step = stamps_.add(message);
    follow_time(step);
    for (const auto& scan : step.scans) take_scan(scan);
  }
  hand_over();
}

void SlamNode::follow_time(const ScanStamps::Step& step) {
  if (!step.problem.empty()) tell(step.problem);
  if (step.was_ahead) intake_.leave_out_after(step.scans.front()->header.stamp, step.problem);
  if (!step.went_back) return;
  intake_.clear();
  tell("time went back by " + number_text(step.went_back->toSec()) +
       " s (a bag that is played in a loop?); parameter bag_loop");
  is_looping_ = options_.bag_loop == BagLoop::kIgnore;
  looping_until_ = *step.back_from;
  if (options_.bag_loop == BagLoop::kRestart) reset();
}

// What was mapped before is passed over.
bool SlamNode::is_in_bag_loop(const sensor_msgs::LaserScan& message) {
  if (message.header.stamp > looping_until_) is_looping_ = false;
  return is_looping_;
}

// Stamps are labels: a scan that is a little older than the last one is a scan like others.
void SlamNode::take_scan(const sensor_msgs::LaserScanConstPtr& message) {
  if (is_in_bag_loop(*message) || is_paused_) return;
  const double passed = std::abs((message->header.stamp - last_taken_).toSec());
  if (!last_taken_.isZero() && passed < options_.minimum_time_interval) return;
  if (count_++ % static_cast<std::size_t>(options_.throttle_scans) != 0) return;
  last_taken_ = message->header.stamp;
  intake_.add(message);
}

void SlamNode::hand_over() {
  std::vector<ScanRecord> records = intake_.take();
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  if (intake_.problems().count() > told_late_) {
    told_late_ = intake_.problems().count();
    complain(intake_.last_problem());
  }
  for (ScanRecord& record : records) {
    if (!options_.is_sync && !queue_.empty()) {
      dropped_ += queue_.size();
      queue_.clear();
    }
    queue_.push_back(std::move(record));
  }
  if (!records.empty()) queue_changed_.notify_all();
}

void SlamNode::work() {
  while (true) {
    std::unique_lock<std::mutex> lock(queue_mutex_);
    queue_changed_.wait(lock, [this] { return is_ending_ || (!is_held_ && !queue_.empty()); });
    if (is_ending_) return;
    const ScanRecord record = std::move(queue_.front());
    queue_.pop_front();
    lock.unlock();
    try {
      consume(record);
    } catch (const Error& error) {
      tell(std::string("scan is not used: ") + error.what());
    } catch (const std::exception& error) {
      rescue(error.what());
      return;
    }
  }
}

void SlamNode::run() {
  try {
    ros::spin();
  } catch (const std::exception& error) {
    rescue(error.what());
  }
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  if (!end_reason_.empty()) throw std::runtime_error(end_reason_);
}

// Something that nobody has foreseen: what is mapped is saved, and the node ends.
void SlamNode::rescue(const std::string& why) {
  {
    const std::lock_guard<std::mutex> lock(slam_mutex_);
    save_what_there_is();
  }
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  end_reason_ = why + " (unforeseen); the map is in " + rescue_stem(options_) + ".*";
  ros::requestShutdown();
}

void SlamNode::save_what_there_is() const {
  const std::string stem = rescue_stem(options_);
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(stem).parent_path(), ignored);
  const auto* session = dynamic_cast<const Slam2dSession*>(slam_.get());
  try {
    if (session != nullptr) session->session_snapshot()(stem + ".posegraph");
    trident::maps::save_map(stem, slam_->map());
  } catch (const Error& error) {
    std::fprintf(stderr, "the map cannot be saved: %s\n", error.what());  // NOLINT: log may be gone
  }
}

void SlamNode::consume(const ScanRecord& record) {
  const ros::Time stamp = ros::Time().fromNSec(static_cast<std::uint64_t>(record.scan.stamp_ns));
  autosave_.before_scan(stamp);
  ScanPose2d pose;
  std::vector<CalibrationEstimate> calibration;
  {
    const std::lock_guard<std::mutex> lock(slam_mutex_);
    pose = slam_->add_scan(record.scan, record.T_odom_base);
    const auto* calibrated = dynamic_cast<const Slam2dCalibrated*>(slam_.get());
    if (calibrated != nullptr) calibration = calibrated->odometry_calibration();
  }
  {
    const std::lock_guard<std::mutex> lock(queue_mutex_);
    T_map_odom_ = pose.T_map_base * record.T_odom_base.inverse();
    has_correction_ = true;
    calibration_ = std::move(calibration);
    newest_ = pose;
    ++used_;
    if (!pose.problem.empty()) {
      problems_.add(pose.problem);
      complain(pose.problem);
    }
  }
  publish_correction();
  publish_pose(record, pose);
  if (on_scan_) on_scan_(record, pose);
  publish_map_if_due(stamp);
  autosave_.after_scan(stamp);
}

void SlamNode::publish_pose(const ScanRecord& record, const ScanPose2d& pose) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header.stamp.fromNSec(static_cast<std::uint64_t>(record.scan.stamp_ns));
  message.header.frame_id = options_.map_frame;
  message.pose.pose = maps::to_pose_message(pose.T_map_base);
  constexpr std::array<std::size_t, 3> kPlanar = {0, 1, 5};  // x, y, yaw among six
  const double linear = std::sqrt(options_.position_covariance_scale);
  const std::array<double, 3> scale = {linear, linear, std::sqrt(options_.yaw_covariance_scale)};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      message.pose.covariance[6 * kPlanar[row] + kPlanar[column]] =
          scale[row] * scale[column] *
          pose.covariance(static_cast<int>(row), static_cast<int>(column));
    }
  }
  for (const ros::Publisher& publisher : pose_publishers_) publisher.publish(message);
}

void SlamNode::publish_correction() {
  if (options_.transform_publish_period <= 0.0) return;
  geometry_msgs::TransformStamped message;
  {
    const std::lock_guard<std::mutex> lock(queue_mutex_);
    message.header.stamp =
        ros::Time::now() +
        ros::Duration(options_.tf_delay < 0.0 ? options_.transform_timeout : options_.tf_delay);
    // The same stamp twice would be ignored by every listener, with a warning.
    if (!has_correction_ || message.header.stamp == last_correction_) return;
    last_correction_ = message.header.stamp;
    const geometry_msgs::Pose pose = maps::to_pose_message(T_map_odom_);
    message.transform.translation.x = pose.position.x;
    message.transform.translation.y = pose.position.y;
    message.transform.rotation = pose.orientation;
  }
  message.header.frame_id = options_.map_frame;
  message.child_frame_id = options_.odom_frame.empty() ? options_.base_frame : options_.odom_frame;
  broadcaster_.sendTransform(message);
}

std::function<OccupancyGrid()> SlamNode::map_snapshot() {
  return with_slam([](const Slam2d& slam) -> std::function<OccupancyGrid()> {
    const auto* able = dynamic_cast<const Slam2dMapSnapshot*>(&slam);
    if (able != nullptr) return able->map_snapshot();
    return [map = slam.map()] { return map; };
  });
}

nav_msgs::OccupancyGrid SlamNode::to_message(const OccupancyGrid& map) const {
  std_msgs::Header header;
  header.frame_id = options_.map_frame;
  header.stamp = ros::Time::now();
  return maps::to_map_message(map, header);
}

nav_msgs::OccupancyGrid SlamNode::map_message() { return to_message(map_snapshot()()); }

void SlamNode::publish_map_if_due(const ros::Time& now) {
  if (map_task_.is_busy() || !map_publisher_->is_due(now)) return;
  map_task_.start([this, now, draw = map_snapshot()] {
    try {
      map_publisher_->publish(to_message(draw()), now);
    } catch (const Error& error) {
      tell(error.what());
    }
  });
}

void SlamNode::tell(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  problems_.add(problem);
  complain(problem);
}

std::function<void(const std::string&)> SlamNode::session_snapshot() {
  return with_slam([](const Slam2d& slam) {
    const auto* session = dynamic_cast<const Slam2dSession*>(&slam);
    if (session == nullptr) throw Error("this method cannot keep sessions");
    return session->session_snapshot();
  });
}

void SlamNode::save_session(const std::string& file) { session_snapshot()(file); }

void SlamNode::save_map(const std::string& stem) {
  if (options_.is_sync) with_slam([](Slam2d& slam) { slam.finish(); });
  trident::maps::save_map(stem, map_snapshot()());
}

void SlamNode::reset() {
  clear_queue();
  std::unique_ptr<Slam2d> next = new_slam();
  {
    const std::lock_guard<std::mutex> lock(slam_mutex_);
    slam_.swap(next);
  }
  forget_correction();
  is_looping_ = false;
}

void SlamNode::forget_correction() {
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  has_correction_ = false;
}

void SlamNode::clear_queue() {
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  queue_.clear();
}

void SlamNode::set_held(bool is_held) {
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  is_held_ = is_held;
  queue_changed_.notify_all();
}

bool SlamNode::get_map(nav_msgs::GetMap::Request& /*request*/,
                       nav_msgs::GetMap::Response& response) {
  response.map = map_message();
  return true;
}

void SlamNode::publish_diagnostics() {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time::now();
  array.status.resize(1);
  diagnostic_msgs::DiagnosticStatus& status = array.status[0];
  status.name = ros::this_node::getName().substr(1) + ": SLAM";
  status.hardware_id = "none";
  const std::lock_guard<std::mutex> lock(queue_mutex_);
  const std::size_t problems = problems_.count() + intake_.problems().count();
  const bool is_worse = problems > told_problems_;
  told_problems_ = problems;
  status.level =
      is_worse ? diagnostic_msgs::DiagnosticStatus::WARN : diagnostic_msgs::DiagnosticStatus::OK;
  status.message = is_worse ? last_problem_ : (used_ == 0 ? "no scan yet" : "mapping");
  const MotionDiagnosis motion = diagnose_motion(newest_);
  if (!is_worse && !motion.warning.empty()) {
    status.level = diagnostic_msgs::DiagnosticStatus::WARN;
    status.message = motion.warning;
  }
  if (is_paused_) status.message = "paused";
  status.values = {key_value("scans received", std::to_string(intake_.received())),
                   key_value("scans used", std::to_string(used_)),
                   key_value("scans waiting for transforms", std::to_string(intake_.waiting())),
                   key_value("scans waiting for SLAM", std::to_string(queue_.size())),
                   key_value("scans replaced by newer ones", std::to_string(dropped_)),
                   key_value("scans left out", std::to_string(intake_.left_out())),
                   key_value("scans without gyro", std::to_string(intake_.without_gyro())),
                   key_value("motion between scans by", motion.motion_by),
                   key_value("direction left open", motion.open),
                   key_value("problems", std::to_string(problems_.count())),
                   key_value("last problem", last_problem_)};
  for (const CalibrationEstimate& estimate : calibration_) {
    status.values.push_back(key_value(std::string("odometry: ") + estimate.name, text(estimate)));
  }
  diagnostics_publisher_.publish(array);
}

}  // namespace trident::slam
