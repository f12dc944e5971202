// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "port_binder.h"

#include <algorithm>

#include "conversions/conversions.h"
#include "image_transport.h"
#include "trident_ros/schedule_fuzz.h"

namespace trident::sim {
namespace {

/// 25 Hz of wall time, enough for displays.
constexpr auto kDisplayPeriod = std::chrono::milliseconds(40);

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

}  // namespace

PortBinder::PortBinder(ros::NodeHandle& node, PortBoard& board)
    : board_(board), advertiser_(node), tf_(advertiser_.advertise<tf2_msgs::TFMessage>("/tf")) {}

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
  return OutputTopics::instance().bind(advertiser_, port);
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

OutputBinding* PortBinder::find(const std::string& port) const {
  const auto found = entries_.find(port);
  return found == entries_.end() ? nullptr : found->second.binding.get();
}

OutputBinding* PortBinder::tap(const std::string& port) {
  OutputBinding* const binding = find(port);
  if (binding == nullptr || binding->is_tapped) return binding;
  binding->is_tapped = true;
  advertiser_.note_change();
  return binding;
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
         entry.binding->is_tapped || (entry.held_back && entry.binding->wanted());
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
  // By rank, so that transforms are known before what needs them; within a rank by name.
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
    // All transforms of a step are one message, ahead of the first other one.
    if (rank > PortRank::kTransform) send_frames();
    publish_if_fresh(*binding, is_display_due);
  }
  send_frames();
}

/// What is for a display only waits until one is due, or until the world stands.
void PortBinder::publish_if_fresh(OutputBinding& binding, bool is_display_due) {
  if (!binding.take_fresh()) return;
  if (binding.is_tapped && binding.subscribers() == 0 && !binding.is_latched()) return;
  binding.is_late = binding.is_for_display() && !is_display_due;
  if (!binding.is_late) binding.publish();
}

void PortBinder::publish_held_display() {
  for (OutputBinding* binding : active_) {
    if (!binding->is_late) continue;
    binding->is_late = false;
    binding->publish();
  }
}

}  // namespace trident::sim
