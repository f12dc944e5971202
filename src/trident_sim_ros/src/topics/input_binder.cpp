// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "input_binder.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <heron_msgs/Drive.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <std_srvs/Empty.h>
#include <uuv_gazebo_ros_plugins_msgs/FloatStamped.h>

#include <mutex>
#include <type_traits>
#include <vector>

#include "any_messages.h"
#include "conversions/conversions.h"
#include "conversions/radio_conversions.h"
#include "thruster_services.h"
#include "trident_ros/any_message.h"
#include "trident_ros/schedule_fuzz.h"
#include "trident_sim/commands.h"
#include "trident_sim/samples/bytes_sample.h"
#include "trident_sim/samples/text_sample.h"

namespace trident::sim {
namespace {

TwistCommand from_message(const geometry_msgs::Twist& message) { return from_twist(message); }
ScalarSample from_message(const std_msgs::Float64& message) { return {SimTime{}, message.data}; }
SingleNumber from_message(const std_msgs::Float32& message) { return {SimTime{}, message.data}; }
StampedNumber from_message(const uuv_gazebo_ros_plugins_msgs::FloatStamped& message) {
  return {SimTime{}, message.data};
}
DriveCommand from_message(const heron_msgs::Drive& message) {
  return {SimTime{}, static_cast<double>(message.left), static_cast<double>(message.right)};
}
JointCommand from_message(const sensor_msgs::JointState& message) {
  return {SimTime{}, message.name, message.position, message.velocity, message.effort};
}
TriggerCommand from_message(const std_msgs::Empty&) { return {}; }
PoseSample from_message(const geometry_msgs::PoseStamped& message) {
  return {from_ros(message.header.stamp), message.header.frame_id, from_pose(message.pose)};
}
PathCommand from_message(const nav_msgs::Path& message) {
  PathCommand path{from_ros(message.header.stamp), {}};
  for (const auto& pose : message.poses) path.p_world.push_back(from_point(pose.pose.position));
  return path;
}
RadioPacketSample from_message(const trident_msgs::RadioPacket& message) {
  return from_packet(message);
}
TextCommand from_message(const std_msgs::String& message) { return {SimTime{}, message.data}; }

/// When a command counts; zero: in the next step.
template <class Command>
SimTime stamp_of(const Command& command) {
  if constexpr (std::is_same_v<Command, PoseSample> || std::is_same_v<Command, PathCommand> ||
                std::is_same_v<Command, BytesSample>) {
    return command.stamp;
  } else {
    return {};
  }
}

/// Whether a command that is here in a step at `now` counts later, at its stamp.
template <class Command>
bool waits_for(SimTime stamp, SimTime now) {
  const bool is_of_any_clock = std::is_same_v<Command, BytesSample>;
  return is_of_any_clock ? stamp_use(stamp, now) == StampUse::kAtItsStamp : stamp > now;
}

/// What a binding is made with, besides its port.
struct Surroundings {
  ros::NodeHandle& node;
  ros::CallbackQueueInterface& queue;
  std::shared_ptr<MessageBell> bell;
  Repeatability& repeatability;
};

template <class Command>
class Mailbox {
 public:
  /// Of texts and packets all that a port holds wait, as each says a part only; else the newest.
  static constexpr bool kAllCount = std::is_same_v<Command, TextCommand> ||
                                    std::is_same_v<Command, RadioPacketSample> ||
                                    std::is_same_v<Command, BytesSample>;
  static constexpr std::size_t kDepth = kAllCount ? InPort<Command>::kDepth : 1;

  explicit Mailbox(const Surroundings& around)
      : bell_(around.bell), repeatability_(around.repeatability) {}
  /// `sender` is kept if the step in which the command acts is left to chance.
  void put(const Command& command, const std::string& sender) {
    ros_utils::hand_over("input received");
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_awaited && repeatability_.running()) late_.emplace_back(sender, stamp_of(command));
      // As a subscriber's queue: the oldest makes room.
      if (waiting_.size() == kDepth) waiting_.erase(waiting_.begin());
      waiting_.push_back(command);
      ++count_;
    }
    bell_->ring();
  }
  std::uint64_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }
  /// Swaps what waits into `taken`, oldest first.
  void take(std::vector<Command>* taken) {
    taken->clear();
    const std::lock_guard<std::mutex> lock(mutex_);
    taken->swap(waiting_);
  }
  /// Notes who has sent what acts in a step at `begin` by chance.
  void note_late(SimTime begin, const std::string& port) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [sender, stamp] : late_) {
      if (waits_for<Command>(stamp, begin)) continue;
      repeatability_.spoil(sender, begin, "writes /" + port + " outside of the lockstep");
    }
    late_.clear();
  }

  std::atomic<bool> is_awaited{false};  ///< the world waits for these messages

 private:
  std::shared_ptr<MessageBell> bell_;
  Repeatability& repeatability_;
  std::vector<std::pair<std::string, SimTime>> late_;  ///< sender and stamp
  mutable std::mutex mutex_;
  std::vector<Command> waiting_;
  std::uint64_t count_ = 0;
};

/// What topics and services have in common.
template <class Command>
class MailboxBinding : public InputBinding {
 public:
  MailboxBinding(InPort<Command>& port, const Surroundings& around)
      : port_(port), mailbox_(std::make_shared<Mailbox<Command>>(around)) {}

  PortBase& port() const final { return port_; }
  void hold() final { is_held = mailbox_->is_awaited = true; }
  void deliver(SimTime begin) final {
    // Called by the stepping thread; messages are put in by those of the callback queue.
    mailbox_->note_late(begin, port_.name());
    mailbox_->take(&taken_);
    for (const Command& command : taken_) port_.write(command);
  }
  void forget() final { mailbox_->take(&taken_); }
  std::uint64_t received() const final { return mailbox_->count(); }

 protected:
  using Box = std::shared_ptr<Mailbox<Command>>;
  const Box& mailbox() const { return mailbox_; }

 private:
  InPort<Command>& port_;
  std::vector<Command> taken_;
  Box mailbox_;  ///< outlives a message in progress
};

template <class Command, class Message>
class TopicBinding : public MailboxBinding<Command> {
 public:
  using Event = const ros::MessageEvent<Message const>&;

  TopicBinding(const Surroundings& around, InPort<Command>& port)
      : MailboxBinding<Command>(port, around) {
    ros::SubscribeOptions options;
    options.initByFullCallbackType<Event>(
        "/" + port.name(), Mailbox<Command>::kDepth, [mailbox = this->mailbox()](Event event) {
          mailbox->put(from_message(*event.getMessage()), event.getPublisherName());
        });
    options.callback_queue = &around.queue;
    // Nagle's algorithm would hold small commands back for up to 40 ms.
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    subscriber_ = around.node.subscribe(options);
  }

  std::uint32_t publishers() const final { return subscriber_.getNumPublishers(); }

 private:
  ros::Subscriber subscriber_;
};

/// Messages of any type.
class BytesBinding : public MailboxBinding<BytesSample> {
 public:
  BytesBinding(const Surroundings& around, InPort<BytesSample>& port)
      : MailboxBinding<BytesSample>(port, around) {
    const auto inbox = [mailbox = mailbox(), reader = std::make_shared<BytesReader>()](
                           const std::shared_ptr<const std::string>& bytes,
                           const ros::M_string& publisher) {
      mailbox->put(reader->read(bytes, publisher), publisher_field(publisher, "callerid"));
    };
    ros::SubscribeOptions options = ros_utils::any_subscription(
        "/" + port.name(), Mailbox<BytesSample>::kDepth, inbox, &around.queue);
    subscriber_ = around.node.subscribe(options);
  }

  std::uint32_t publishers() const final { return subscriber_.getNumPublishers(); }
  ros_utils::TopicType type() const final { return ros_utils::topic_type("/" + port().name()); }

 private:
  ros::Subscriber subscriber_;
};

/// Answers at once; what was asked for is done in the next step.
class ServiceBinding : public MailboxBinding<ServiceCommand> {
 public:
  using Event = ros::ServiceEvent<std_srvs::Empty::Request, std_srvs::Empty::Response>;

  ServiceBinding(const Surroundings& around, InPort<ServiceCommand>& port)
      : MailboxBinding(port, around) {
    ros::AdvertiseServiceOptions options;
    options.initBySpecType<Event>("/" + port.name(), [mailbox = mailbox()](const Event& event) {
      mailbox->put({}, event.getCallerName());
      return true;
    });
    options.callback_queue = &around.queue;
    server_ = around.node.advertiseService(options);
  }

  std::uint32_t publishers() const final { return 0; }

 private:
  ros::ServiceServer server_;
};

/// What the simulator publishes itself is handed over within the step (RadioRelay).
bool is_own_output(const PortBase& port, const PortBoard& board) {
  return dynamic_cast<const InPort<BytesSample>*>(&port) != nullptr &&
         board.find(port.name(), PortDirection::kOut) != nullptr;
}

template <class Command, class Binding>
std::unique_ptr<InputBinding> try_bind(const Surroundings& around, PortBase& port) {
  auto* typed = dynamic_cast<InPort<Command>*>(&port);
  if (typed == nullptr) return nullptr;
  return std::make_unique<Binding>(around, *typed);
}

using BindFunction = std::unique_ptr<InputBinding> (*)(const Surroundings&, PortBase&);
/// The type of the port decides; the first that fits binds it.
constexpr BindFunction kBindFunctions[] = {
    try_bind<TwistCommand, TopicBinding<TwistCommand, geometry_msgs::Twist>>,
    try_bind<ScalarSample, TopicBinding<ScalarSample, std_msgs::Float64>>,
    try_bind<SingleNumber, TopicBinding<SingleNumber, std_msgs::Float32>>,
    try_bind<PoseSample, TopicBinding<PoseSample, geometry_msgs::PoseStamped>>,
    try_bind<PathCommand, TopicBinding<PathCommand, nav_msgs::Path>>,
    try_bind<StampedNumber, TopicBinding<StampedNumber, uuv_gazebo_ros_plugins_msgs::FloatStamped>>,
    try_bind<DriveCommand, TopicBinding<DriveCommand, heron_msgs::Drive>>,
    try_bind<JointCommand, TopicBinding<JointCommand, sensor_msgs::JointState>>,
    try_bind<TriggerCommand, TopicBinding<TriggerCommand, std_msgs::Empty>>,
    try_bind<RadioPacketSample, TopicBinding<RadioPacketSample, trident_msgs::RadioPacket>>,
    try_bind<BytesSample, BytesBinding>,
    try_bind<TextCommand, TopicBinding<TextCommand, std_msgs::String>>,
    try_bind<ServiceCommand, ServiceBinding>,
};

}  // namespace

void MessageBell::ring() {
  const std::lock_guard<std::mutex> lock(mutex_);
  has_rung_ = true;
  rung_.notify_one();
}

void MessageBell::wait(std::chrono::milliseconds limit) {
  std::unique_lock<std::mutex> lock(mutex_);
  rung_.wait_for(lock, limit, [this] { return has_rung_; });
  has_rung_ = false;
}

void InputBinder::forget_gone_ports() {
  for (auto it = entries_.begin(); it != entries_.end();) {
    const PortBase* const now = board_.find(it->first, PortDirection::kIn);
    it = now == &it->second->port() ? std::next(it) : entries_.erase(it);
  }
}

/// nullptr: there is no topic or service of this type.
std::unique_ptr<InputBinding> InputBinder::bind(PortBase& port) {
  if (is_own_output(port, board_)) return nullptr;
  const Surroundings around{node_, queue_, bell_, repeatability_};
  for (const BindFunction bind_type : kBindFunctions) {
    if (std::unique_ptr<InputBinding> binding = bind_type(around, port)) return binding;
  }
  return bind_thruster_services(node_, queue_, port, board_, repeatability_);
}

void InputBinder::sync() {
  if (board_.version() == version_) return;
  version_ = board_.version();
  forget_gone_ports();
  board_.for_each([&](PortBase& port) {
    if (port.direction() != PortDirection::kIn || entries_.count(port.name()) > 0) return;
    std::unique_ptr<InputBinding> binding = bind(port);
    if (binding) entries_.emplace(port.name(), std::move(binding));
  });
}

void InputBinder::deliver(SimTime begin) {
  for (auto& [name, binding] : entries_) {
    if (!binding->is_held) binding->deliver(begin);
  }
}

InputBinding* InputBinder::find(const std::string& port) const {
  const auto found = entries_.find(port);
  return found == entries_.end() ? nullptr : found->second.get();
}

void InputBinder::hold(const std::string& port) {
  if (InputBinding* const binding = find(port)) binding->hold();
}

void InputBinder::deliver_held(const std::string& port, SimTime begin) {
  if (InputBinding* const binding = find(port)) binding->deliver(begin);
}

std::uint64_t InputBinder::received(const std::string& port) const {
  const InputBinding* const binding = find(port);
  return binding == nullptr ? 0 : binding->received();
}

std::uint32_t InputBinder::publishers(const std::string& port) const {
  const InputBinding* const binding = find(port);
  return binding == nullptr ? 0 : binding->publishers();
}

void InputBinder::clear() {
  for (auto& [name, binding] : entries_) binding->forget();
}

}  // namespace trident::sim
