// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "port_binder.h"

#include <algorithm>

#include "conversions/camera_conversions.h"
#include "conversions/conversions.h"
#include "conversions/environment_conversions.h"
#include "conversions/range_conversions.h"
#include "image_transport.h"
#include "trident_ros/schedule_fuzz.h"

namespace trident::sim {
namespace {

// Deep: a recorder that falls behind for a moment must not lose anything.
constexpr std::uint32_t kPublisherQueue = 1000;
// Of samples of megabytes, of which a deep queue would fill the memory.
constexpr std::uint32_t kPictureQueue = 10;
template <class Sample>
constexpr std::uint32_t kQueueOf =
    std::is_same_v<Sample, ImageSample> || std::is_same_v<Sample, ImageCloudSample> ||
            std::is_same_v<Sample, LidarCloudSample>
        ? kPictureQueue
        : kPublisherQueue;
/// Of what changes seldom.
template <class Sample>
constexpr bool kIsLatched = std::is_same_v<Sample, EnvironmentSample>;
constexpr auto kDisplayPeriod = std::chrono::milliseconds(40);

template <class Sample, class OutputMessage>
class TypedBinding : public OutputBinding {
 public:
  TypedBinding(TopicAdvertiser& advertiser, OutPort<Sample>& port)
      : OutputBinding(port),
        port_(port),
        publisher_(advertiser.advertise<OutputMessage>("/" + port.name(), kQueueOf<Sample>,
                                                       kIsLatched<Sample>)) {
    if (kIsLatched<Sample> && port.count() > 0) publisher_.publish(converted(port.value));
  }

  void publish() override {
    for (const Sample& sample : port_.earlier()) publisher_.publish(converted(sample));
    publisher_.publish(converted(port_.value));
  }
  std::unique_ptr<ros_utils::DirectMessage> message() override {
    return std::make_unique<ros_utils::ObjectMessage<OutputMessage>>(converted(port_.value));
  }
  std::uint32_t subscribers() const override { return publisher_.getNumSubscribers(); }
  const ros::Publisher& publisher() const override { return publisher_; }
  bool is_for_display() const override { return std::is_same_v<Sample, JointStateSample>; }
  bool is_latched() const override { return kIsLatched<Sample>; }

 private:
  boost::shared_ptr<OutputMessage> converted(const Sample& sample) {
    const auto message = pool_.take();
    convert(sample, *message);
    return message;
  }

  OutPort<Sample>& port_;
  ros::Publisher publisher_;
  ros_utils::MessagePool<OutputMessage> pool_;
};

/// A transform: collected, and published with all others of the step as one message.
class FrameBinding : public OutputBinding {
 public:
  FrameBinding(OutPort<FrameSample>& port, ros::Publisher& tf, tf2_msgs::TFMessage& message)
      : OutputBinding(port), port_(port), tf_(tf), message_(message) {}

  void publish() override {
    message_.transforms.emplace_back();
    convert(port_.value, message_.transforms.back());
  }
  std::unique_ptr<ros_utils::DirectMessage> message() override { return nullptr; }
  std::uint32_t subscribers() const override { return tf_.getNumSubscribers(); }
  const ros::Publisher& publisher() const override { return tf_; }

 private:
  OutPort<FrameSample>& port_;
  ros::Publisher& tf_;
  tf2_msgs::TFMessage& message_;
};

template <class Sample, class OutputMessage>
std::unique_ptr<OutputBinding> try_bind(TopicAdvertiser& advertiser, PortBase& port) {
  auto* typed = dynamic_cast<OutPort<Sample>*>(&port);
  if (typed == nullptr) return nullptr;
  return std::make_unique<TypedBinding<Sample, OutputMessage>>(advertiser, *typed);
}

using OutputBindFunction = std::unique_ptr<OutputBinding> (*)(TopicAdvertiser&, PortBase&);
constexpr OutputBindFunction kOutputBindFunctions[] = {
    try_bind<OdometrySample, nav_msgs::Odometry>,
    try_bind<PoseSample, geometry_msgs::Pose>,
    try_bind<PoseWithCovarianceSample, geometry_msgs::PoseWithCovarianceStamped>,
    try_bind<PointSample, geometry_msgs::PointStamped>,
    try_bind<TransformSample, geometry_msgs::TransformStamped>,
    try_bind<ImuSample, sensor_msgs::Imu>,
    try_bind<LaserScanSample, sensor_msgs::LaserScan>,
    try_bind<ImageSample, sensor_msgs::Image>,
    try_bind<CameraInfoSample, sensor_msgs::CameraInfo>,
    try_bind<ImageCloudSample, sensor_msgs::PointCloud2>,
    try_bind<BoundingBoxesSample, trident_msgs::BoundingBoxes>,
    try_bind<LidarCloudSample, sensor_msgs::PointCloud2>,
    try_bind<PointListSample, sensor_msgs::PointCloud>,
    try_bind<RangeSample, sensor_msgs::Range>,
    try_bind<GnssStatusSample, trident_msgs::GnssStatus>,
    try_bind<ContactsSample, gazebo_msgs::ContactsState>,
    try_bind<FluidPressureSample, sensor_msgs::FluidPressure>,
    try_bind<MagneticFieldSample, sensor_msgs::MagneticField>,
    try_bind<GnssFixSample, sensor_msgs::NavSatFix>,
    try_bind<TwistSample, geometry_msgs::TwistStamped>,
    try_bind<ActuatorState, mav_msgs::Actuators>,
    try_bind<JointStateSample, sensor_msgs::JointState>,
    try_bind<ScalarSample, std_msgs::Float32>,
    try_bind<StampedNumber, uuv_gazebo_ros_plugins_msgs::FloatStamped>,
    try_bind<WindSample, rotors_comm::WindSpeed>,
    try_bind<WrenchSample, geometry_msgs::WrenchStamped>,
    try_bind<VectorSample, geometry_msgs::Vector3Stamped>,
    try_bind<EnvironmentSample, trident_msgs::EnvironmentState>,
    try_bind<WindReadingSample, trident_msgs::WindReading>,
    try_bind<NumberSample, std_msgs::Float64>,
    try_bind<FlagSample, std_msgs::Bool>,
};

}  // namespace

void OutputBinding::set_wanted(bool wanted) {
  if (wanted == wanted_) return;
  wanted_ = wanted;
  if (wanted) {
    port_->add_listener();
  } else {
    port_->remove_listener();
  }
}

PortBinder::PortBinder(ros::NodeHandle& node, PortBoard& board)
    : board_(board),
      advertiser_(node),
      tf_(advertiser_.advertise<tf2_msgs::TFMessage>("/tf", kPublisherQueue)) {}

void PortBinder::forget_gone_ports() {
  for (auto it = entries_.begin(); it != entries_.end();) {
    PortBase* now = board_.find(it->second.port, PortDirection::kOut);
    it = now == &it->second.binding->port() ? std::next(it) : entries_.erase(it);
  }
}

/// nullptr: there is no topic of this type.
std::unique_ptr<OutputBinding> PortBinder::bind(PortBase& port) {
  if (auto* frame = dynamic_cast<OutPort<FrameSample>*>(&port)) {
    return std::make_unique<FrameBinding>(*frame, tf_, tf_message_);
  }
  for (const OutputBindFunction bind_type : kOutputBindFunctions) {
    if (std::unique_ptr<OutputBinding> binding = bind_type(advertiser_, port)) return binding;
  }
  return nullptr;
}

void PortBinder::sync() {
  if (board_.version() == version_) return;
  version_ = board_.version();
  forget_gone_ports();
  board_.for_each([this](PortBase& port) {
    if (port.direction() != PortDirection::kOut || entries_.count(port.name()) > 0) return;
    std::unique_ptr<OutputBinding> binding = bind(port);
    if (binding) entries_.emplace(port.name(), Entry{port.name(), std::move(binding), false});
    if (auto* image = dynamic_cast<OutPort<ImageSample>*>(&port)) {
      entries_.emplace(port.name() + "/" + compressed_name(image->value),
                       Entry{port.name(), bind_compressed(advertiser_, *image), false});
    }
  });
  rebuild_active();
}

std::uint32_t PortBinder::subscribers(const std::string& port) const {
  std::uint32_t count = 0;
  for (const auto& [topic, entry] : entries_) {
    if (entry.port == port) count += entry.binding->subscribers();
  }
  return count;
}

std::vector<OutputBinding*> PortBinder::hold_back_odometry(const std::string& prefix) {
  std::vector<OutputBinding*> result;
  for (auto& [name, entry] : entries_) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    if (dynamic_cast<OutPort<OdometrySample>*>(&entry.binding->port()) == nullptr) continue;
    entry.held_back = true;
    result.push_back(entry.binding.get());
  }
  rebuild_active();
  return result;
}

/// Odometry that the lockstep sends stays wanted: when its reader dies, the world must still have a
/// state to wait for an answer to.
bool PortBinder::is_needed(const Entry& entry) {
  return entry.binding->subscribers() > 0 || entry.binding->is_latched() ||
         (entry.held_back && entry.binding->wanted());
}

void PortBinder::scan_subscribers() {
  if (!advertiser_.take_change()) return;
  ros_utils::hand_over("subscription found");
  bool changed = false;
  for (auto& [name, entry] : entries_) {
    const bool wanted = is_needed(entry);
    changed = changed || wanted != entry.binding->wanted();
    entry.binding->set_wanted(wanted);
  }
  if (changed) rebuild_active();
}

void PortBinder::rebuild_active() {
  active_.clear();
  for (auto& [name, entry] : entries_) {
    if (entry.binding->wanted() && !entry.held_back) active_.push_back(entry.binding.get());
  }
  std::stable_sort(active_.begin(), active_.end(), [](OutputBinding* a, OutputBinding* b) {
    return a->port().rank() < b->port().rank();
  });
}

void PortBinder::send_frames() {
  if (tf_message_.transforms.empty()) return;
  tf_.publish(tf_message_);
  tf_message_.transforms.clear();
}

bool PortBinder::display_is_due(bool every_step) {
  const auto now = std::chrono::steady_clock::now();
  if (!every_step && now - last_display_ < kDisplayPeriod) return false;
  last_display_ = now;
  return true;
}

void PortBinder::publish_fresh(PortRank first, PortRank last, bool every_step) {
  const bool is_display_due = last >= PortRank::kState && display_is_due(every_step);
  for (OutputBinding* binding : active_) {
    const PortRank rank = binding->port().rank();
    if (rank < first || rank > last) continue;
    if (rank > PortRank::kTransform) send_frames();
    if (!binding->take_fresh()) continue;
    binding->is_late = binding->is_for_display() && !is_display_due;
    if (!binding->is_late) binding->publish();
  }
  send_frames();
}

void PortBinder::publish_held_display() {
  for (OutputBinding* binding : active_) {
    if (!binding->is_late) continue;
    binding->is_late = false;
    binding->publish();
  }
}

}  // namespace trident::sim
