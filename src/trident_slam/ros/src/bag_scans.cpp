// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_slam_ros/bag_scans.h"

#include <nav_msgs/Odometry.h>
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
#include "trident_slam_ros/bag_file.h"
#include "trident_slam_ros/scan_intake.h"

namespace trident::slam {
namespace {

constexpr double kCacheS = 3600.0;  // transforms are few compared with scans
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

bool has(const Topics& topics, const std::string& name) {
  return std::find(topics.begin(), topics.end(), name) != topics.end();
}

/// The topic of the usual name, or the only one; "": there is no topic.
std::string obvious_topic(const std::string& usual, const Topics& topics, const std::string& type) {
  if (has(topics, usual)) return usual;
  if (topics.size() > 1) {
    throw Error("several topics of " + type + ": " + join(topics) +
                "; give one (program: --scan or --odom)");
  }
  return topics.empty() ? "" : topics.front();
}

std::string chosen_topic(const std::string& wanted, const std::string& usual, const Topics& topics,
                         const std::string& type) {
  if (wanted.empty()) return obvious_topic(usual, topics, type);
  if (!has(topics, wanted)) {
    throw Error("no topic " + wanted + " of " + type +
                "; there are: " + (topics.empty() ? "none" : join(topics)));
  }
  return wanted;
}

// A topic that several nodes have published has a connection for each.
void add_once(Topics& topics, const std::string& topic) {
  if (std::find(topics.begin(), topics.end(), topic) == topics.end()) topics.push_back(topic);
}

}  // namespace

class BagScans::Impl {
 public:
  Impl(std::string path, const BagScansOptions& options)
      : path_(std::move(path)), transforms_(ros::Duration(kCacheS)) {
    try {
      bag_ = std::make_unique<BagFile>(path_);
      for (const std::string& damage : bag_->damage()) problems_.add(path_ + ": " + damage);
      choose(options);
    } catch (const Error& error) {
      throw Error(path_ + ": " + error.what());
    }
  }

  bool next(ScanRecord& record) {
    while (ready_.empty() && at_ < view_.size()) read_message();
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
    for (; reported_ < intake_->problems().texts().size(); ++reported_) {
      problems_.add(path_ + ": " + intake_->problems().texts()[reported_]);
    }
    for (; reported_ < intake_->problems().count(); ++reported_) problems_.add("");
    return problems_;
  }

  std::string chosen() const {
    std::string text = "scans: " + scan_topic_;
    if (!intake_options_.odom_frame.empty() && has_odometry_) {
      const std::string frames = intake_options_.odom_frame + " -> " + intake_options_.base_frame;
      text += "; odometry: " + (odom_topic_.empty() ? frames + " in /tf" : odom_topic_);
    }
    return imu_topic_.empty() ? text : text + "; turning rates: " + imu_topic_;
  }

  bool has_odometry() const { return has_odometry_; }

  double progress() const {
    return view_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(view_.size());
  }

 private:
  Topics topics_of(const std::string& type) const {
    Topics topics;
    for (const BagFile::Connection& connection : bag_->connections()) {
      if (connection.type == type) add_once(topics, connection.topic);
    }
    return topics;
  }

  std::string choose_topic(const std::string& wanted, const std::string& usual,
                           const std::string& type) const {
    return chosen_topic(wanted, usual, topics_of(type), type);
  }

  Topics topics_to_read() const {
    Topics topics = {scan_topic_, "/tf", "/tf_static"};
    if (!imu_topic_.empty()) topics.push_back(imu_topic_);
    if (!odom_topic_.empty()) topics.push_back(odom_topic_);
    return topics;
  }

  void choose(const BagScansOptions& options) {
    scan_topic_ = choose_topic(options.scan_topic, "/scan", "sensor_msgs/LaserScan");
    if (scan_topic_.empty()) {
      throw Error("has no topic of sensor_msgs/LaserScan" +
                  (bag_->damage().empty() ? "" : "; " + bag_->damage().front()));
    }
    odom_topic_ = choose_topic(options.odom_topic, "/odom", "nav_msgs/Odometry");
    const bool uses_tf = look_at_frames(options);
    if (uses_tf && options.odom_topic.empty()) odom_topic_.clear();
    if (!options.imu_topic.empty()) {
      imu_topic_ = choose_topic(options.imu_topic, "", "sensor_msgs/Imu");
    }
    intake_options_.uses_gyro = !imu_topic_.empty();
    intake_ = std::make_unique<ScanIntake>(intake_options_, transforms_);
    view_ = bag_->messages(topics_to_read());
  }

  // True when /tf itself has the odometry.
  bool look_at_frames(const BagScansOptions& options) {
    std::set<std::string> frames;
    std::string laser;
    nav_msgs::OdometryConstPtr odometry;
    Topics topics = {scan_topic_, "/tf", "/tf_static"};
    if (!odom_topic_.empty()) topics.push_back(odom_topic_);
    std::size_t looked_at = 0;
    for (const BagFile::Message& message : bag_->messages(topics)) {
      if (++looked_at > kMessagesLookedAt) break;
      look_at(message, frames, laser, odometry);
    }
    return name_frames(options, frames, laser, odometry.get());
  }

  // Reads the frames of a message; a damaged one is ignored.
  void look_at(const BagFile::Message& message, std::set<std::string>& frames, std::string& laser,
               nav_msgs::OdometryConstPtr& odometry) {
    try {
      if (const auto tf = bag_->instantiate<tf2_msgs::TFMessage>(message)) {
        for (const auto& transform : tf->transforms) {
          frames.insert(without_slash(transform.header.frame_id));
          frames.insert(without_slash(transform.child_frame_id));
        }
      } else if (const auto scan = bag_->instantiate<sensor_msgs::LaserScan>(message)) {
        laser = without_slash(scan->header.frame_id);
      } else if (!odometry) {
        odometry = bag_->instantiate<nav_msgs::Odometry>(message);
      }
    } catch (const Error&) {
      return;  // it is reported when it is read in order
    }
  }

  // Where nothing reports odometry that is wanted, it stands still.
  void settle_odometry(bool is_wanted, bool is_reported) {
    if (!is_wanted) {
      intake_options_.odom_frame.clear();
    } else if (!is_reported) {
      fix_odometry();
    }
  }

  bool name_frames(const BagScansOptions& options, const std::set<std::string>& frames,
                   const std::string& laser, const nav_msgs::Odometry* odometry) {
    intake_options_.waits_for_all = true;
    const bool uses_tf = name_usual_frames(options, frames);
    if (!uses_tf && odometry != nullptr) name_frames_of(*odometry, options);
    if (intake_options_.base_frame.empty()) intake_options_.base_frame = "base_link";
    settle_odometry(options.uses_odometry, uses_tf || odometry != nullptr);
    if (frames.count(laser) == 0) fix_laser(laser);
    return uses_tf;
  }

  // What the user names, else what REP 105 names. True when /tf has both frames.
  bool name_usual_frames(const BagScansOptions& options, const std::set<std::string>& frames) {
    std::string& odom = intake_options_.odom_frame;
    std::string& base = intake_options_.base_frame;
    odom = options.odom_frame.empty() ? "odom" : options.odom_frame;
    base = options.base_frame;
    for (const char* usual : {"base_footprint", "base_link"}) {
      if (base.empty() && frames.count(usual) != 0) base = usual;
    }
    return frames.count(odom) != 0 && frames.count(base) != 0;
  }

  // Frames of the topic of odometry, where the user names none.
  void name_frames_of(const nav_msgs::Odometry& odometry, const BagScansOptions& options) {
    if (options.odom_frame.empty()) {
      intake_options_.odom_frame = without_slash(odometry.header.frame_id);
    }
    if (options.base_frame.empty()) {
      intake_options_.base_frame = without_slash(odometry.child_frame_id);
    }
  }

  // The base stands still in the frame of an odometry that the bag does not have.
  void fix_odometry() {
    const std::string& odom = intake_options_.odom_frame;
    const std::string& base = intake_options_.base_frame;
    problems_.add(path_ + ": has no odometry, neither " + odom + " -> " + base +
                  " in /tf nor a topic of nav_msgs/Odometry");
    has_odometry_ = false;
    set_fixed(odom, base);
  }

  // A laser that no transform leads to is at the base.
  void fix_laser(const std::string& laser) {
    const std::string& base = intake_options_.base_frame;
    if (laser == base) return;
    problems_.add(path_ + ": /tf has no transform to " + laser + ": its frame is taken to be " +
                  base);
    set_fixed(base, laser);
  }

  void set_fixed(const std::string& parent, const std::string& child) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.child_frame_id = child;
    transform.transform.rotation.w = 1.0;
    transforms_.setTransform(transform, kAuthority, true);
  }

  void read_message() {
    try {
      take(view_[at_]);
    } catch (const Error& error) {
      problems_.add(path_ + ": " + error.what());
    }
    ++at_;
    for (ScanRecord& record : intake_->take()) ready_.push_back(std::move(record));
  }

  void take(const BagFile::Message& message) {
    const std::string& topic = bag_->topic(message);
    if (topic == scan_topic_) {
      take_scan(message);
    } else if (topic == imu_topic_) {
      take_imu(message);
    } else if (topic == odom_topic_) {
      const auto odometry = whole<nav_msgs::Odometry>(message);
      if (odometry) transforms_.setTransform(as_transform(*odometry), kAuthority);
    } else {
      take_transforms(message, topic == "/tf_static");
    }
  }

  void take_scan(const BagFile::Message& message) {
    const auto scan = whole<sensor_msgs::LaserScan>(message);
    if (!scan) return;
    scan->header.frame_id = without_slash(scan->header.frame_id);
    intake_->add(scan);
  }

  void take_imu(const BagFile::Message& message) {
    const auto imu = whole<sensor_msgs::Imu>(message);
    if (!imu) return;
    imu->header.frame_id = without_slash(imu->header.frame_id);
    intake_->add(*imu);
  }

  void take_transforms(const BagFile::Message& message, bool are_static) {
    const auto transforms = whole<tf2_msgs::TFMessage>(message);
    if (!transforms) return;
    for (const auto& transform : transforms->transforms) {
      transforms_.setTransform(without_slashes(transform), kAuthority, are_static);
    }
  }

  // Throws Error when the topic holds another type there, too.
  template <class M>
  boost::shared_ptr<M> whole(const BagFile::Message& message) {
    auto found = bag_->instantiate<M>(message);
    if (!found) {
      throw Error(bag_->topic(message) + ": a message of another type than " +
                  ros::message_traits::DataType<M>::value());
    }
    return found;
  }

  std::string path_;
  std::unique_ptr<BagFile> bag_;
  std::vector<BagFile::Message> view_;
  std::size_t at_ = 0;
  std::string scan_topic_;
  std::string odom_topic_;
  std::string imu_topic_;
  bool has_odometry_ = true;
  tf2::BufferCore transforms_;
  ScanIntakeOptions intake_options_;
  std::unique_ptr<ScanIntake> intake_;
  std::deque<ScanRecord> ready_;
  LogProblems problems_;
  std::size_t reported_ = 0;
};

BagScans::BagScans(std::string path, const BagScansOptions& options)
    : impl_(std::make_unique<Impl>(std::move(path), options)) {}

BagScans::~BagScans() = default;

bool BagScans::next(ScanRecord& record) { return impl_->next(record); }

const LogProblems& BagScans::problems() const { return impl_->problems(); }

double BagScans::progress() const { return impl_->progress(); }

std::string BagScans::chosen() const { return impl_->chosen(); }

bool BagScans::has_odometry() const { return impl_->has_odometry(); }

}  // namespace trident::slam
