// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "thruster_services.h"

#include <uuv_gazebo_ros_plugins_msgs/GetThrusterConversionFcn.h>
#include <uuv_gazebo_ros_plugins_msgs/GetThrusterEfficiency.h>
#include <uuv_gazebo_ros_plugins_msgs/GetThrusterState.h>
#include <uuv_gazebo_ros_plugins_msgs/SetThrusterEfficiency.h>
#include <uuv_gazebo_ros_plugins_msgs/SetThrusterState.h>

#include <utility>
#include <vector>

#include "trident_sim/thruster_setup.h"

namespace trident::sim {
namespace {

namespace msgs = uuv_gazebo_ros_plugins_msgs;

/// What services and the stepping thread share; outlives a call in progress.
class Desk {
 public:
  explicit Desk(const Repeatability& repeatability) : repeatability_(repeatability) {}
  void change(const ThrusterChange& change) {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_late_ = is_late_ || repeatability_.running();
    apply(change, &setup_);
    changes_.push_back(change);
    ++count_;
  }
  ThrusterSetup setup() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return setup_;
  }
  void follow(const ThrusterSetup& setup) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (changes_.empty()) setup_ = setup;
  }
  std::vector<ThrusterChange> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(changes_, {});
  }
  std::uint64_t count() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }
  /// True once after a change in a moment of a running world.
  bool take_late() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(is_late_, false);
  }

 private:
  const Repeatability& repeatability_;
  mutable std::mutex mutex_;
  bool is_late_ = false;
  ThrusterSetup setup_;
  std::vector<ThrusterChange> changes_;
  std::uint64_t count_ = 0;
};

class ThrusterServices final : public InputBinding {
 public:
  ThrusterServices(ros::NodeHandle& node, ros::CallbackQueueInterface& queue,
                   InPort<ThrusterChange>& port, const OutPort<ThrusterSetup>& setup,
                   Repeatability& repeatability)
      : port_(port),
        setup_(setup),
        repeatability_(repeatability),
        desk_(std::make_shared<Desk>(repeatability)) {
    desk_->follow(setup.value);
    advertise_state(node, queue);
    advertise_efficiency(node, queue, "thrust_force_efficiency", &ThrusterChange::thrust_efficiency,
                         &ThrusterSetup::thrust_efficiency);
    advertise_efficiency(node, queue, "dynamic_state_efficiency",
                         &ThrusterChange::dynamic_state_efficiency,
                         &ThrusterSetup::dynamic_state_efficiency);
    advertise<msgs::GetThrusterConversionFcn>(node, queue, "get_thruster_conversion_fcn",
                                              [desk = desk_](const auto&, auto& response) {
                                                const ThrusterSetup setup = desk->setup();
                                                response.fcn.function_name = setup.conversion;
                                                response.fcn.tags = setup.tags;
                                                response.fcn.data = setup.data;
                                                response.fcn.lookup_table_input = setup.inputs;
                                                response.fcn.lookup_table_output = setup.outputs;
                                              });
  }

  PortBase& port() const override { return port_; }
  void deliver(SimTime begin) override {
    if (desk_->take_late()) {
      repeatability_.spoil("a service of /" + port_.name(), begin,
                           "called outside of the lockstep");
    }
    for (const ThrusterChange& change : desk_->take()) port_.write(change);
    if (seen_ == setup_.count()) return;
    seen_ = setup_.count();
    desk_->follow(setup_.value);
  }
  void forget() override {
    desk_->take();
    desk_->follow(setup_.value);
  }
  std::uint64_t received() const override { return desk_->count(); }
  std::uint32_t publishers() const override { return 0; }

 private:
  void advertise_state(ros::NodeHandle& node, ros::CallbackQueueInterface& queue) {
    advertise<msgs::SetThrusterState>(node, queue, "set_thruster_state",
                                      [desk = desk_](const auto& request, auto& response) {
                                        ThrusterChange change;
                                        change.is_on = request.on != 0;
                                        desk->change(change);
                                        response.success = 1;
                                      });
    advertise<msgs::GetThrusterState>(node, queue, "get_thruster_state",
                                      [desk = desk_](const auto&, auto& response) {
                                        response.is_on = desk->setup().is_on ? 1 : 0;
                                      });
  }

  void advertise_efficiency(ros::NodeHandle& node, ros::CallbackQueueInterface& queue,
                            const std::string& name, std::optional<double> ThrusterChange::*asked,
                            double ThrusterSetup::*setup) {
    advertise<msgs::SetThrusterEfficiency>(
        node, queue, "set_" + name, [desk = desk_, asked](const auto& request, auto& response) {
          response.success = is_efficiency(request.efficiency) ? 1 : 0;
          if (!is_efficiency(request.efficiency)) return;
          ThrusterChange change;
          change.*asked = request.efficiency;
          desk->change(change);
        });
    advertise<msgs::GetThrusterEfficiency>(node, queue, "get_" + name,
                                           [desk = desk_, setup](const auto&, auto& response) {
                                             response.efficiency = desk->setup().*setup;
                                           });
  }

  template <class Service, class Answer>
  void advertise(ros::NodeHandle& node, ros::CallbackQueueInterface& queue, const std::string& name,
                 const Answer& answer) {
    const std::string prefix = port_.name().substr(0, port_.name().rfind('/') + 1);
    ros::AdvertiseServiceOptions options;
    options.init<typename Service::Request, typename Service::Response>(
        "/" + prefix + name,
        [answer](typename Service::Request& request, typename Service::Response& response) {
          answer(request, response);
          return true;
        });
    options.callback_queue = &queue;
    servers_.push_back(node.advertiseService(options));
  }

  InPort<ThrusterChange>& port_;
  const OutPort<ThrusterSetup>& setup_;
  Repeatability& repeatability_;
  std::shared_ptr<Desk> desk_;
  std::uint64_t seen_ = 0;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace

std::unique_ptr<InputBinding> bind_thruster_services(ros::NodeHandle& node,
                                                     ros::CallbackQueueInterface& queue,
                                                     PortBase& port, const PortBoard& board,
                                                     Repeatability& repeatability) {
  auto* const changes = dynamic_cast<InPort<ThrusterChange>*>(&port);
  const auto* const setup = board.find_out<ThrusterSetup>(port.name());
  if (changes == nullptr || setup == nullptr) return nullptr;
  return std::make_unique<ThrusterServices>(node, queue, *changes, *setup, repeatability);
}

}  // namespace trident::sim
