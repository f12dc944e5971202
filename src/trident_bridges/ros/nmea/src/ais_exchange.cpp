// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/ais_exchange.h"

#include <cmath>
#include <utility>

#include "trident_base/angle.h"
#include "trident_bridges/nmea/all_sentences.h"
#include "trident_bridges_ros/utc.h"

namespace trident::bridges {
namespace {

constexpr const char* kTalker = "AI";  ///< a mobile AIS station
constexpr std::uint32_t kChannelQueueSize = 200;
constexpr double kEarthRadiusM = 6'371'008.8;  ///< mean (IUGG)

/// On a sphere, which is within 0.6 % of the ellipsoid.
double distance_m(const nmea::RoutePlace& a, const nmea::RoutePlace& b) {
  const double lat_a = deg_to_rad(a.latitude_deg), lat_b = deg_to_rad(b.latitude_deg);
  const double sin_lat = std::sin(0.5 * (lat_b - lat_a));
  const double sin_lon = std::sin(0.5 * deg_to_rad(b.longitude_deg - a.longitude_deg));
  const double h = sin_lat * sin_lat + std::cos(lat_a) * std::cos(lat_b) * sin_lon * sin_lon;
  return 2.0 * kEarthRadiusM * std::asin(std::sqrt(std::min(1.0, h)));
}

template <class T>
T sentence_of(const nmea::AisPart& part) {
  T sentence;
  static_cast<nmea::AisPart&>(sentence) = part;
  return sentence;
}

/// An encoded sentence; empty when it cannot be written, which valid parts always can.
template <class T>
std::string text_of_part(const nmea::AisPart& part) {
  nmea::EncodedSentence out;
  nmea::Refusal refusal;
  if (!nmea::encode(kTalker, sentence_of<T>(part), &out, &refusal)) return "";
  return std::string(out.view());
}

}  // namespace

AisExchange::AisExchange(ros::NodeHandle& node, NodePollLoop& loop, const AisExchangeParams& params,
                         const UtcClock& clock, AisExchangeHooks hooks)
    : params_(params),
      hooks_(std::move(hooks)),
      transmitter_(params, clock, *this),
      channel_(node, params.topic) {
  message_.header.frame_id = ros::this_node::getName();
  reading_.receipt = [&loop, clock] {
    return nmea::Receipt{loop.loop().now_s(), unix_ns_of(clock, ros::Time::now())};
  };
  reading_.events = this;
  reading_.refusals = hooks_.refusals;
  reader_ =
      std::make_unique<SentenceReader>(params.topic, "its stations", NmeaReadParams{}, reading_);
  subscription_ = loop.subscribe<nmea_msgs::Sentence>(
      node, params.topic, kChannelQueueSize, [this](const nmea_msgs::Sentence& m) { hear(m); });
}

void AisExchange::on_state(SimTime stamp, const nmea::AisState& state) {
  if (state.latitude_deg && state.longitude_deg) {
    place_ = nmea::RoutePlace{*state.latitude_deg, *state.longitude_deg};
  }
  transmitter_.on_state(stamp, state);
}

void AisExchange::on_part(const nmea::AisPart& part, SimTime stamp) {
  hooks_.to_links(text_of_part<nmea::Vdo>(part));
  if (*part.number == 1) message_.sentence.clear();
  message_.sentence += text_of_part<nmea::Vdm>(part);
  if (*part.number < *part.total) return;
  message_.header.stamp.fromNSec(static_cast<std::uint64_t>(stamp.ns));
  channel_.publish(message_);
}

void AisExchange::hear(const nmea_msgs::Sentence& message) {
  if (message.header.frame_id == message_.header.frame_id) return;  // its own
  heard_ = message.sentence;
  reader_->read(Bytes(reinterpret_cast<const std::uint8_t*>(heard_.data()), heard_.size()), true);
}

bool AisExchange::is_in_range(const nmea::AisVessel& vessel) const {
  if (!place_ || !vessel.motion.latitude_deg || !vessel.motion.longitude_deg) return true;
  return distance_m(*place_, {*vessel.motion.latitude_deg, *vessel.motion.longitude_deg}) <=
         params_.range_m;
}

void AisExchange::on_ais(const nmea::AisVessel& vessel, bool is_own) {
  if (!is_in_range(vessel)) return;
  hooks_.to_links(heard_);
  hooks_.output->on_ais(vessel, is_own);
}

}  // namespace trident::bridges
