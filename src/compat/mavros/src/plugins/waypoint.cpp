// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include <mavros_msgs/WaypointClear.h>
#include <mavros_msgs/WaypointList.h>
#include <mavros_msgs/WaypointPull.h>
#include <mavros_msgs/WaypointPush.h>
#include <mavros_msgs/WaypointReached.h>
#include <mavros_msgs/WaypointSetCurrent.h>

#include <optional>

#include "core/typed_messages.h"
#include "core/waypoints.h"
#include "plugins/plugins.h"
#include "trident_bridges/mavlink/mission_client.h"

namespace trident::mavros {
namespace {

using bridges::mavlink::MissionOutcome;
using bridges::mavlink::MissionType;
using mavros_msgs::WaypointClear;
using mavros_msgs::WaypointPull;
using mavros_msgs::WaypointPush;
using mavros_msgs::WaypointSetCurrent;

/// One of the vehicle's lists: pull, push, clear, and a latched topic of what it is.
class ListPlugin : public Plugin {
 public:
  ListPlugin(Hub& hub, MissionType type, const std::string& prefix)
      : hub_(hub),
        vehicle_(hub.vehicle),
        type_(type),
        client_(
            hub.vehicle.self(), [this](const Message& message) { vehicle_.send(message); },
            [this](const MissionOutcome& outcome) { on_end(outcome); }) {
    list_ = hub.ros.advertise_latched<mavros_msgs::WaypointList>(prefix + "/waypoints");
    for (const std::uint32_t id :
         {MAVLINK_MSG_ID_MISSION_REQUEST_INT, MAVLINK_MSG_ID_MISSION_REQUEST,
          MAVLINK_MSG_ID_MISSION_COUNT, MAVLINK_MSG_ID_MISSION_ITEM_INT,
          MAVLINK_MSG_ID_MISSION_ITEM, MAVLINK_MSG_ID_MISSION_ACK}) {
      vehicle_.on(id, [this](const Message& message) { on_message(message); });
    }
    vehicle_.on_tick([this](SimTime now) { client_.update(now); });
    vehicle_.on_connection([this](bool is_there) {
      if (is_there) pull([](const MissionOutcome&) {});
    });
    serve(prefix);
  }

 protected:
  using Done = std::function<void(const MissionOutcome&)>;

  void pull(const Done& done) {
    const bool is_begun = begin([this, done](const MissionOutcome& end) {
      if (end.verdict.is_accepted()) replace(end.mission);
      done(end);
    });
    if (is_begun) client_.download(vehicle_.target(), type_, vehicle_.now());
  }
  void publish_list(std::uint16_t current) {
    mavros_msgs::WaypointList list;
    list.current_seq = current;
    for (const auto& item : items_) list.waypoints.push_back(to_waypoint(item));
    list_.publish(list);
  }
  void refuse(const std::string& text) { hub_.ros.refuse("lists refused", text); }
  virtual std::uint16_t current() const { return 0; }
  std::size_t size() const { return items_.size(); }

  Hub& hub_;
  VehicleSide& vehicle_;

 private:
  void serve(const std::string& prefix) {
    hub_.ros.serve_waiting<WaypointPull>(prefix + "/pull", [this](const auto&, auto reply) {
      pull([reply](const MissionOutcome& end) {
        WaypointPull::Response response;
        response.success = end.verdict.is_accepted();
        response.wp_received = static_cast<std::uint32_t>(end.mission.size());
        reply(response);
      });
    });
    hub_.ros.serve_waiting<WaypointPush>(
        prefix + "/push", [this](const auto& request, auto reply) { push(request, reply); });
    hub_.ros.serve_waiting<WaypointClear>(prefix + "/clear", [this](const auto&, auto reply) {
      const bool is_begun = begin([this, reply](const MissionOutcome& end) {
        WaypointClear::Response response;
        response.success = end.verdict.is_accepted();
        if (response.success != 0U) replace({});
        reply(response);
      });
      if (is_begun) client_.clear(vehicle_.target(), type_, vehicle_.now());
    });
  }

  /// False, and an answer: a transfer is in progress, or there is no vehicle.
  bool begin(Done done) {
    if (vehicle_.is_connected() && !done_) {
      done_ = std::move(done);
      return true;
    }
    MissionOutcome outcome;
    outcome.type = type_;
    outcome.verdict = {bridges::mavlink::MissionResult::kError,
                       vehicle_.is_connected() ? "another transfer is in progress"
                                               : "the vehicle is not connected"};
    report(outcome);
    done(outcome);
    return false;
  }

  /// Puts the waypoints in their places; returns why they cannot be put there, if so.
  static std::string put_waypoints(const WaypointPush::Request& request,
                                   bridges::mavlink::Mission& list) {
    if (request.start_index > list.size()) {
      return "start_index is " + std::to_string(request.start_index) +
             ", legal: up to the number of items that are known, " + std::to_string(list.size());
    }
    const std::size_t end = request.start_index + request.waypoints.size();
    if (request.start_index == 0 || end > list.size()) list.resize(end);
    for (std::size_t i = 0; i < request.waypoints.size(); ++i) {
      const std::string problem = problem_of(request.waypoints[i]);
      if (!problem.empty()) return "waypoint " + std::to_string(i) + ": " + problem;
      list[request.start_index + i] = to_item(request.waypoints[i]);
    }
    return "";
  }

  void push(const WaypointPush::Request& request,
            const WaitingServices::Reply<WaypointPush>& reply) {
    bridges::mavlink::Mission list(items_);
    const std::string problem = put_waypoints(request, list);
    if (!problem.empty()) {
      refuse(problem);
      return reply(WaypointPush::Response());
    }
    const auto count = static_cast<std::uint32_t>(request.waypoints.size());
    const bool is_begun = begin([this, reply, list, count](const MissionOutcome& outcome) {
      WaypointPush::Response response;
      response.success = outcome.verdict.is_accepted();
      response.wp_transfered = response.success != 0U ? count : 0U;
      if (response.success != 0U) replace(list);
      reply(response);
    });
    if (is_begun) client_.upload(vehicle_.target(), type_, list, vehicle_.now());
  }

  void on_message(const Message& message) {
    const bool was_mine = client_.handle(message, vehicle_.now());
    if (was_mine || message.id != MAVLINK_MSG_ID_MISSION_ACK ||
        !hub_.params.mission.pull_after_gcs) {
      return;
    }
    const auto ack = bridges::mavlink::unpack<mavlink_mission_ack_t>(message);
    if (is_upload_of_others(ack) && !client_.is_busy()) pull([](const MissionOutcome&) {});
  }

  bool is_upload_of_others(const mavlink_mission_ack_t& ack) const {
    return ack.target_system != vehicle_.self().system &&
           ack.mission_type == static_cast<std::uint8_t>(type_) && ack.type == MAV_MISSION_ACCEPTED;
  }

  void on_end(const MissionOutcome& outcome) {
    const Done done = std::exchange(done_, nullptr);
    report(outcome);
    if (done) done(outcome);
  }
  void report(const MissionOutcome& outcome) {
    if (outcome.verdict.is_accepted()) return;
    refuse(std::string(text_of(type_)) + " refused: " + text_of(outcome.verdict.result) + ", " +
           outcome.verdict.reason);
  }
  void replace(const bridges::mavlink::Mission& list) {
    items_ = list;
    publish_list(current());
  }

  MissionType type_;
  bridges::mavlink::MissionClient client_;
  bridges::mavlink::Mission items_;
  ros::Publisher list_;
  Done done_;
};

/// The mission, with what the vehicle does of it.
class WaypointPlugin : public ListPlugin {
 public:
  explicit WaypointPlugin(Hub& hub) : ListPlugin(hub, MissionType::kMission, "mission") {
    reached_ = hub.ros.advertise<mavros_msgs::WaypointReached>("mission/reached");
    on<mavlink_mission_item_reached_t>(vehicle_, [this](const auto& payload) {
      mavros_msgs::WaypointReached message;
      message.header.stamp = ros::Time::now();
      message.wp_seq = payload.seq;
      reached_->publish(message);
    });
    on<mavlink_mission_current_t>(vehicle_, [this](const auto& p) { on_current(p.seq); });
    hub.ros.serve_waiting<WaypointSetCurrent>(
        "mission/set_current",
        [this](const auto& request, auto reply) { set_current(request.wp_seq, reply); });
    vehicle_.on_tick([this](SimTime now) { repeat(now); });
  }

 private:
  struct Wanted {
    std::uint16_t item;
    SimTime begun, sent;
    WaitingServices::Reply<WaypointSetCurrent> reply;
  };
  static constexpr double kRepeat_s = 0.5, kPatience_s = 3.0;

  std::uint16_t current() const override { return current_; }

  void on_current(std::uint16_t item) {
    if (item != current_) {
      current_ = item;
      publish_list(current_);
    }
    if (wanted_ && wanted_->item == item) end_wanted(true);
  }
  void set_current(std::uint16_t item, const WaitingServices::Reply<WaypointSetCurrent>& reply) {
    if (wanted_) end_wanted(false);
    wanted_ = Wanted{item, vehicle_.now(), vehicle_.now(), reply};
    send_wanted();
  }
  void send_wanted() {
    mavlink_mission_set_current_t payload{};
    payload.seq = wanted_->item;
    send_to_target(vehicle_, payload);
  }
  void repeat(SimTime now) {
    if (!wanted_) return;
    if ((now - wanted_->begun).seconds() > kPatience_s) return end_wanted(false);
    if ((now - wanted_->sent).seconds() < kRepeat_s) return;
    wanted_->sent = now;
    send_wanted();
  }
  void end_wanted(bool is_good) {
    const Wanted wanted = *std::exchange(wanted_, std::nullopt);
    if (!is_good) {
      refuse("mission item " + std::to_string(wanted.item) + " does not become current, of " +
             std::to_string(size()) + " items");
    }
    WaypointSetCurrent::Response response;
    response.success = is_good;
    wanted.reply(response);
  }

  std::unique_ptr<bridges::NodePublisher<mavros_msgs::WaypointReached>> reached_;
  std::uint16_t current_ = 0;
  std::optional<Wanted> wanted_;
};

}  // namespace

std::unique_ptr<Plugin> make_waypoint(Hub& hub) { return std::make_unique<WaypointPlugin>(hub); }
std::unique_ptr<Plugin> make_geofence(Hub& hub) {
  return std::make_unique<ListPlugin>(hub, MissionType::kFence, "geofence");
}
std::unique_ptr<Plugin> make_rallypoint(Hub& hub) {
  return std::make_unique<ListPlugin>(hub, MissionType::kRally, "rallypoint");
}

}  // namespace trident::mavros
