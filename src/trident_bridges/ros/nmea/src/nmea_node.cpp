// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/nmea_node.h"

#include <utility>

#include "trident_bridges_ros/utc.h"

namespace trident::bridges {
namespace {

/// The handle of the topics of what is read.
ros::NodeHandle output_handle(const ros::NodeHandle& node, const std::string& name_space) {
  return name_space.empty() ? node : ros::NodeHandle(node, name_space);
}

NavsatOutputParams output_params(const NmeaNodeParams& params) {
  NavsatOutputParams output;
  output.frame_id = params.frame_id;
  return output;
}

NodePublisher<nmea_msgs::Sentence> make_sentences(const ros::NodeHandle& node,
                                                  const NmeaNodeParams& params) {
  ros::NodeHandle handle = output_handle(node, params.output);
  return NodePublisher<nmea_msgs::Sentence>(handle, "nmea_sentence");
}

}  // namespace

NmeaNode::NmeaNode(ros::NodeHandle& node, NodePollLoop& loop, const NmeaNodeParams& params,
                   const UtcClock& clock)
    : loop_(loop),
      clock_(clock),
      rare_(loop.served(ros::NodeHandle())),
      refusals_(rare_),
      output_(output_handle(node, params.output), output_params(params)),
      sentences_(make_sentences(node, params)),
      sender_(params.talker, *this),
      routes_(node, loop, params, sender_, clock_, refusals_),
      diagnostics_(rare_, links_) {
  output_.set_autopilot(routes_.autopilot());
  for (const NmeaLinkParams& link : params.links) open(node, link, params);
  open_ais(node, params);
  // Who only listens has no use for what the vehicle measures.
  if (senders_.empty() && !ais_ && !params.autopilot.is_on) return;
  input_ = std::make_unique<VehicleInput>(node, loop, params.topics, params.origin.heading_rad,
                                          sender_, clock_, refusals_, vehicle_hooks());
}

NmeaNode::~NmeaNode() = default;

void NmeaNode::open(ros::NodeHandle& node, const NmeaLinkParams& link,
                    const NmeaNodeParams& params) {
  NmeaReadParams reading;
  reading.framer = params.framer;
  reading.receiver.navsat = params.navsat;
  reading.receiver.steering = params.autopilot.steering;
  if (params.talker.magnetic_variation_deg != 0.0) {
    reading.receiver.magnetic_variation_deg = params.talker.magnetic_variation_deg;
  }
  NmeaReadHooks hooks;
  hooks.receipt = [this] { return receive(); };
  hooks.sentence = [this](const nmea::Sentence& sentence) { pass_on(sentence); };
  hooks.events = &output_;
  hooks.refusals = &refusals_;
  links_.push_back(std::make_unique<NmeaLink>(link.options(), reading, std::move(hooks),
                                              link.listens, loop_, node));
  if (link.sends) senders_.push_back(links_.back().get());
  ROS_INFO("%s %s", links_.back()->name().c_str(),
           link.sends ? (link.listens ? "sends and listens" : "sends") : "listens");
}

void NmeaNode::open_ais(ros::NodeHandle& node, const NmeaNodeParams& params) {
  if (params.ais.mmsi == 0) return;
  AisExchangeHooks hooks;
  hooks.to_links = [this](std::string_view sentences) { on_sentence(sentences, {}); };
  hooks.output = &output_;
  hooks.refusals = &refusals_;
  ais_ = std::make_unique<AisExchange>(node, loop_, params.ais, clock_, std::move(hooks));
}

VehicleHooks NmeaNode::vehicle_hooks() {
  VehicleHooks hooks;
  hooks.fixed = [this](SimTime stamp, const nmea::AisState& state, double altitude_m) {
    if (state.latitude_deg && state.longitude_deg) {
      routes_.on_fix({*state.latitude_deg, *state.longitude_deg}, altitude_m);
    }
    if (ais_) ais_->on_state(stamp, state);
  };
  hooks.moved = [this](SimTime stamp, const std::string& frame, const Eigen::Vector2d& p_frame,
                       const nmea::GroundVelocity& velocity) {
    routes_.on_position(stamp, frame, p_frame, velocity);
  };
  return hooks;
}

nmea::Receipt NmeaNode::receive() {
  output_.set_now();
  return {loop_.loop().now_s(), unix_ns_of(clock_, ros::Time::now())};
}

void NmeaNode::pass_on(const nmea::Sentence& sentence) {
  if (sentences_.subscribers() == 0) return;
  message_.header.stamp = ros::Time::now();
  message_.sentence = text_of(sentence);
  sentences_.publish(message_);
}

void NmeaNode::on_sentence(std::string_view sentence, SimTime /*stamp*/) {
  for (NmeaLink* const link : senders_) link->send(sentence);
}

void NmeaNode::on_problem(std::string_view type, const nmea::Refusal& refusal) {
  const std::string name(type);
  refusals_.note(name + " not sent", name + " is not sent: " + nmea::to_text(refusal));
}

}  // namespace trident::bridges
