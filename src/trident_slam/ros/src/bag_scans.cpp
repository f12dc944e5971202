// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/bag_scans.h"

#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2/buffer_core.h>
#include <tf2/exceptions.h>
#include <tf2_msgs/TFMessage.h>

#include <set>
#include <utility>
#include <vector>

#include "trident_base/error.h"
#include "trident_base/string_util.h"
#include "trident_slam_ros/scan_intake.h"

namespace trident {
namespace {

constexpr double kCacheS = 3600.0;  // transforms are few beside scans
constexpr std::size_t kMessagesLookedAt = 5000;
constexpr char kAuthority[] = "bag";

using Topics = std::vector<std::string>;

std::string without_slash(const std::string& frame) {
  return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
}

geometry_msgs::TransformStamped without_slashes(geometry_msgs::TransformStamped transform) {
  transform.header.frame_id = without_slash(transform.header.frame_id);
  transform.child_frame_id = without_slash(transform.child_frame_id);
  return transform;
}

geometry_msgs::TransformStamped as_transform(const nav_msgs::Odometry& message) {
  geometry_msgs::TransformStamped transform;
  transform.header = message.header;
  transform.child_frame_id = message.child_frame_id;
  transform.transform.translation.x = message.pose.pose.position.x;
  transform.transform.translation.y = message.pose.pose.position.y;
  transform.transform.translation.z = message.pose.pose.position.z;
  transform.transform.rotation = message.pose.pose.orientation;
  return without_slashes(transform);
}

std::string chosen_topic(const std::string& wanted, const std::string& usual, const Topics& topics,
                         const std::string& type) {
  const auto has = [&topics](const std::string& name) {
    return std::find(topics.begin(), topics.end(), name) != topics.end();
  };
  if (!wanted.empty() && !has(wanted)) {
    throw Error("no topic " + wanted + " of " + type +
                "; there are: " + (topics.empty() ? "none" : join(topics)));
  }
  if (!wanted.empty()) return wanted;
  if (has(usual)) return usual;
  if (topics.size() > 1) throw Error("several topics of " + type + ": " + join(topics));
  return topics.empty() ? "" : topics.front();
}

}  // namespace

class BagScans::Impl {
 public:
  Impl(std::string path, const BagScansOptions& options)
      : path_(std::move(path)), transforms_(ros::Duration(kCacheS)) {
    try {
      bag_.open(path_, rosbag::bagmode::Read);
      choose(options);
    } catch (const rosbag::BagUnindexedException&) {
      throw Error(path_ + ": has no index (truncated recording?); mend it with: rosbag reindex");
    } catch (const rosbag::BagException& error) {
      throw Error(path_ + ": " + error.what() +
                  " (no bag, or a truncated one, which is mended with: rosbag reindex)");
    } catch (const Error& error) {
      throw Error(path_ + ": " + error.what());
    }
  }

  bool next(ScanRecord& record) {
    while (ready_.empty() && at_ != view_.end()) read_message();
    if (ready_.empty()) {
      for (ScanRecord& last : intake_->end()) ready_.push_back(std::move(last));
    }
    if (ready_.empty()) return false;
    record = std::move(ready_.front());
    ready_.pop_front();
    return true;
  }

  const LogProblems& problems() {
    // One list of what was wrong with the bag and with its scans.
    for (; told_ < intake_->problems().texts().size(); ++told_) {
      problems_.add(path_ + ": " + intake_->problems().texts()[told_]);
    }
    for (; told_ < intake_->problems().count(); ++told_) problems_.add("");
    return problems_;
  }

  double progress() const {
    return total_ > 0 ? static_cast<double>(count_) / static_cast<double>(total_) : 1.0;
  }

 private:
  void choose(const BagScansOptions& options) {
    Topics scans;
    Topics odometry;
    Topics imus;
    rosbag::View everything(bag_);
    for (const rosbag::ConnectionInfo* connection : everything.getConnections()) {
      if (connection->datatype == "sensor_msgs/LaserScan") scans.push_back(connection->topic);
      if (connection->datatype == "nav_msgs/Odometry") odometry.push_back(connection->topic);
      if (connection->datatype == "sensor_msgs/Imu") imus.push_back(connection->topic);
    }
    scan_topic_ = chosen_topic(options.scan_topic, "/scan", scans, "sensor_msgs/LaserScan");
    if (scan_topic_.empty()) throw Error("has no topic of sensor_msgs/LaserScan");
    odom_topic_ = chosen_topic(options.odom_topic, "/odom", odometry, "nav_msgs/Odometry");
    const bool uses_tf = look_at_frames(options);
    if (uses_tf && options.odom_topic.empty()) odom_topic_.clear();
    if (!options.imu_topic.empty()) {
      imu_topic_ = chosen_topic(options.imu_topic, "", imus, "sensor_msgs/Imu");
    }
    intake_options_.uses_gyro = !imu_topic_.empty();
    intake_ = std::make_unique<ScanIntake>(intake_options_, transforms_);
    Topics topics = {scan_topic_, "/tf", "/tf_static"};
    if (!imu_topic_.empty()) topics.push_back(imu_topic_);
    if (!odom_topic_.empty()) topics.push_back(odom_topic_);
    view_.addQuery(bag_, rosbag::TopicQuery(topics));
    total_ = view_.size();
    at_ = view_.begin();
  }

  // True when /tf itself has the odometry.
  bool look_at_frames(const BagScansOptions& options) {
    std::set<std::string> frames;
    std::string laser;
    nav_msgs::OdometryConstPtr odometry;
    Topics topics = {scan_topic_, "/tf", "/tf_static"};
    if (!odom_topic_.empty()) topics.push_back(odom_topic_);
    rosbag::View view(bag_, rosbag::TopicQuery(topics));
    std::size_t looked_at = 0;
    for (const rosbag::MessageInstance& message : view) {
      if (++looked_at > kMessagesLookedAt) break;
      if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {
        for (const auto& transform : tf->transforms) {
          frames.insert(without_slash(transform.header.frame_id));
          frames.insert(without_slash(transform.child_frame_id));
        }
      } else if (const auto scan = message.instantiate<sensor_msgs::LaserScan>()) {
        laser = without_slash(scan->header.frame_id);
      } else if (!odometry) {
        odometry = message.instantiate<nav_msgs::Odometry>();
      }
    }
    return name_frames(options, frames, laser, odometry.get());
  }

  bool name_frames(const BagScansOptions& options, const std::set<std::string>& frames,
                   const std::string& laser, const nav_msgs::Odometry* odometry) {
    intake_options_.waits_for_all = true;
    std::string& odom = intake_options_.odom_frame;
    std::string& base = intake_options_.base_frame;
    odom = options.odom_frame.empty() ? "odom" : options.odom_frame;
    base = options.base_frame;
    for (const char* usual : {"base_footprint", "base_link"}) {
      if (base.empty() && frames.count(usual) != 0) base = usual;
    }
    const bool uses_tf = frames.count(odom) != 0 && frames.count(base) != 0;
    if (!uses_tf && odometry != nullptr) {
      if (options.odom_frame.empty()) odom = without_slash(odometry->header.frame_id);
      if (options.base_frame.empty()) base = without_slash(odometry->child_frame_id);
    }
    if (base.empty()) base = "base_link";
    if (!options.uses_odometry) {
      odom.clear();
    } else if (!uses_tf && odometry == nullptr) {
      problems_.add(path_ + ": has no odometry, neither " + odom + " -> " + base +
                    " in /tf nor a topic of nav_msgs/Odometry: scans alone");
      set_fixed(odom, base);
    }
    if (frames.count(laser) == 0 && laser != base) {
      problems_.add(path_ + ": /tf does not tell where " + laser + " is: taken for " + base);
      set_fixed(base, laser);
    }
    return uses_tf;
  }

  void set_fixed(const std::string& parent, const std::string& child) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    transform.transform.rotation.w = 1.0;
    transforms_.setTransform(transform, kAuthority, true);
  }

  void read_message() {
    const rosbag::MessageInstance& message = *at_;
    try {
      if (message.getTopic() == scan_topic_) {
        const auto scan = message.instantiate<sensor_msgs::LaserScan>();
        const auto copy = boost::make_shared<sensor_msgs::LaserScan>(*scan);
        copy->header.frame_id = without_slash(copy->header.frame_id);
        intake_->add(copy);
      } else if (message.getTopic() == imu_topic_) {
        sensor_msgs::Imu imu = *message.instantiate<sensor_msgs::Imu>();
        imu.header.frame_id = without_slash(imu.header.frame_id);
        intake_->add(imu);
      } else if (message.getTopic() == odom_topic_) {
        transforms_.setTransform(as_transform(*message.instantiate<nav_msgs::Odometry>()),
                                 kAuthority);
      } else {
        const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
        for (const auto& transform : transforms->transforms) {
          transforms_.setTransform(without_slashes(transform), kAuthority,
                                   message.getTopic() == "/tf_static");
        }
      }
    } catch (const rosbag::BagException& error) {
      problems_.add(path_ + ": message " + std::to_string(count_ + 1) + ": " + error.what());
    }
    ++at_;
    ++count_;
    for (ScanRecord& record : intake_->take()) ready_.push_back(std::move(record));
  }

  std::string path_;
  rosbag::Bag bag_;
  rosbag::View view_;
  rosbag::View::iterator at_;
  std::string scan_topic_;
  std::string odom_topic_;
  std::string imu_topic_;
  tf2::BufferCore transforms_;
  ScanIntakeOptions intake_options_;
  std::unique_ptr<ScanIntake> intake_;
  std::deque<ScanRecord> ready_;
  LogProblems problems_;
  std::size_t told_ = 0;
  std::size_t count_ = 0;
  std::size_t total_ = 0;
};

BagScans::BagScans(std::string path, const BagScansOptions& options)
    : impl_(std::make_unique<Impl>(std::move(path), options)) {}

BagScans::~BagScans() = default;

bool BagScans::next(ScanRecord& record) { return impl_->next(record); }

const LogProblems& BagScans::problems() const { return impl_->problems(); }

double BagScans::progress() const { return impl_->progress(); }

}  // namespace trident
