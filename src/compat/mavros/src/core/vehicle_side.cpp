// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/vehicle_side.h"

#include <ros/console.h>

#include <cmath>
#include <utility>

#include "trident_bridges/mavlink/dialect.h"

namespace trident::mavros {
namespace {

constexpr double kTextsDelay_s = 0.2;   // of a text that explains a refusal
constexpr double kClocksApart_s = 5.0;  // beyond it a vehicle's clock is not believed

Address address_of(int system, int component) {
  return {static_cast<std::uint8_t>(system), static_cast<std::uint8_t>(component)};
}

bool is_one_clock(const TimeParams& time) {
  return time.source == "sim" || (time.source == "auto" && ros::Time::isSimTime());
}

Link::Events link_events(std::function<void(const Packet&)> received,
                         ros_utils::Refusals& refusals) {
  Link::Events events;
  events.received = std::move(received);
  events.warning = [](const std::string& text) { ROS_WARN("%s", text.c_str()); };
  events.notice = [](const std::string& text) { ROS_INFO("%s", text.c_str()); };
  events.refused = [&refusals](const std::string& text) { refusals.note("signatures", text); };
  return events;
}

}  // namespace

VehicleSide::VehicleSide(const MavrosParams& params, ros_utils::Refusals& refusals,
                         bridges::PollLoop& loop)
    : loop_(loop),
      self_(address_of(params.system_id, params.component_id)),
      target_(address_of(params.target_system_id, params.target_component_id)),
      uses_own_time_(params.time.source == "wall"),
      is_one_clock_(is_one_clock(params.time)),
      monitor_(
          params.conn.timeout,
          [this](Address source, const Heartbeat&) {
            if (source == target_) set_connected(true);
          },
          [this](Address source, double) {
            if (source == target_) set_connected(false);
          }),
      timesync_(self_, is_one_clock_),
      link_({params.fcu_url, params.gcs_url, params.allow_remote, params.max_peer_rate,
             params.signing_key_file},
            loop, link_events([this](const Packet& packet) { receive(packet); }, refusals)),
      commands_(self_, [this](const Message& message) { send(message); }) {}

bridges::mavlink::BothTimes VehicleSide::both_times() const {
  return {SimTime{static_cast<std::int64_t>(ros::Time::now().toNSec())}, now()};
}

bool VehicleSide::is_px4() const { return heartbeat_.autopilot == MAV_AUTOPILOT_PX4; }

void VehicleSide::receive(const Packet& packet) {
  for (const auto& handler : handlers_.packet) handler(packet);
  if (packet.source.system != target_.system || packet.source == self_) return;
  const Message message = bridges::mavlink::to_message(packet);
  if (packet.source == target_) note_heartbeat(message);
  note_text(message);
  commands_.handle(message, now());
  hand_on(message);
}

void VehicleSide::hand_on(const Message& message) const {
  const auto found = handlers_.by_type.find(message.id);
  if (found == handlers_.by_type.end()) return;
  for (const Handler& handler : found->second) handler(message);
}

void VehicleSide::note_heartbeat(const Message& message) {
  const auto heartbeat = bridges::mavlink::read_heartbeat(message);
  if (!heartbeat) return;
  heartbeat_ = *heartbeat;
  monitor_.handle(message, both_times());
}

void VehicleSide::set_connected(bool is_connected) {
  is_connected_ = is_connected;
  if (is_connected) {
    ROS_INFO("CON: system %d is there: %s", target_.system, is_px4() ? "PX4" : "not PX4");
  } else {
    ROS_WARN("CON: system %d is lost: no HEARTBEAT comes", target_.system);
  }
  for (const auto& handler : handlers_.connection) handler(is_connected);
}

void VehicleSide::note_text(const Message& message) {
  const auto text = texts_.handle(message, now());
  if (!text) return;
  newest_text_ = text->text;
  newest_text_at_ = now();
}

void VehicleSide::tick() {
  monitor_.update(both_times());
  commands_.update(now());
  for (const auto& handler : handlers_.tick) handler(now());
}

std::string VehicleSide::reason_since(SimTime asked) const {
  const bool is_fresh = newest_text_at_.ns != 0 && newest_text_at_ >= asked;
  return is_fresh ? newest_text_ : "";
}

void VehicleSide::command(const bridges::mavlink::Command& command, bool is_for_all,
                          std::function<void(const CommandOutcome&)> done) {
  const SimTime asked = now();
  const Address to = is_for_all ? Address{0, 0} : target_;
  commands_.send(to, command, asked, [this, asked, done = std::move(done)](auto outcome) {
    const bool is_refused =
        outcome.is_answered && outcome.reply.result != bridges::mavlink::CommandResult::kAccepted;
    if (!outcome.is_answered && outcome.reply.reason.empty()) {
      outcome.reply.reason = "the vehicle does not answer";
    }
    if (!is_refused) return done(outcome);
    explain(outcome, asked, done);
  });
}

void VehicleSide::explain(const CommandOutcome& outcome, SimTime asked,
                          const std::function<void(const CommandOutcome&)>& done) {
  const auto finish = [this, outcome, asked, done] {
    CommandOutcome explained = outcome;
    const std::string reason = reason_since(asked);
    explained.reply.reason = reason.empty() ? std::string(text_of(outcome.reply.result)) +
                                                  ", the vehicle gives no reason"
                                            : reason;
    done(explained);
  };
  if (!reason_since(asked).empty()) return finish();
  loop_.call_after(kTextsDelay_s, finish);
}

/// From this clock to the vehicle's; nullopt: it is not known yet.
std::optional<std::int64_t> VehicleSide::clock_offset_ns() const {
  if (is_one_clock_) return 0;
  const auto& best = timesync_.best();
  if (!best) return std::nullopt;
  return best->offset_ns;
}

ros::Time VehicleSide::stamp(std::int64_t since_boot_ns) const {
  const ros::Time present = ros::Time::now();
  const auto offset_ns = clock_offset_ns();
  if (uses_own_time_ || !offset_ns) return present;
  const std::int64_t ns = since_boot_ns - *offset_ns;
  const double apart_s =
      1e-9 * std::abs(static_cast<double>(ns) - static_cast<double>(present.toNSec()));
  if (ns <= 0 || apart_s > kClocksApart_s) return present;
  ros::Time result;
  result.fromNSec(static_cast<std::uint64_t>(ns));
  return result;
}

std::uint32_t VehicleSide::boot_ms(const ros::Time& stamp) const {
  const auto offset_ns = clock_offset_ns();
  // The difference of two times may be no ros::Duration.
  const double apart_s = std::abs(stamp.toSec() - ros::Time::now().toSec());
  if (stamp.isZero() || apart_s > kClocksApart_s || !offset_ns) return 0;
  const std::int64_t ns = static_cast<std::int64_t>(stamp.toNSec()) + *offset_ns;
  constexpr std::int64_t kPerMillisecond = 1'000'000;
  return ns > 0 ? static_cast<std::uint32_t>(ns / kPerMillisecond) : 0U;
}

}  // namespace trident::mavros
