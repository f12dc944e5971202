// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "trident_base/sim_time.h"

namespace trident::sim {

/// Of messages of which only the newest count: one that waits whole is dropped when `depth` newer
/// ones of its flow are in the queue.
struct RadioHistory {
  std::uint32_t flow = 0;     ///< of the source's; each destination of it is apart
  int depth = 0;              ///< 0: all are kept
  std::uint64_t message = 0;  ///< number in the flow, ascending
  bool is_begin = true;       ///< of its message, which may have several parts
};

/// How a message is to be sent.
struct RadioQos {
  int priority = 1;         ///< 0 (first) to 3
  double deadline_s = 0.0;  ///< dropped when it has not been sent after this time; 0: never [s]
  int port = 0;             ///< of the receiver, as of UDP: each is asked for apart
  RadioHistory history{};   ///< that it is part of
};

/// What a radio can take.
struct RadioLimits {
  std::size_t queue_bytes = 0;   ///< of each priority
  double broadcast_bit_s = 0.0;  ///< rate of what goes to all
  bool is_base_station = false;  ///< routes rather lead over it
};

/// What a radio has received.
struct RadioMessage {
  std::string source;      ///< name of the radio that sent it
  std::string data;        ///< any bytes
  SimTime sent, received;  ///< when it was given to the one radio, and came from the other
  double snr_db = 0.0;     ///< signal over noise of the frame that brought it
};

/// From one radio to another, as it is now and since the radios were reset.
struct RadioLink {
  std::string source, destination;  ///< names
  double distance_m = 0.0;          ///< from antenna to antenna
  /// Between the antennas' connectors; infinite: they do not hear each other.
  double loss_db = 0.0;
  double rssi_dbm = 0.0;           ///< power at the destination; minus infinity as above
  double snr_db = 0.0;             ///< signal over noise there; minus infinity as above
  int mcs = 0;                     ///< that frames have now
  double rate_bit_s = 0.0;         ///< of the data of such a frame
  double packet_error_rate = 0.0;  ///< of 1500 bytes at that rate, without interference
  bool is_up = false;              ///< a short frame at the lowest rate arrives more often than not
  bool has_line_of_sight = false;  ///< nothing is in the path
  double queue_bytes = 0.0;        ///< that wait at the source, for all its destinations
  std::uint64_t sent = 0, delivered = 0;             ///< messages
  std::uint64_t lost = 0, expired = 0, refused = 0;  ///< after all tries, too late, queue full
  std::uint64_t bytes = 0;                           ///< of what was delivered
  double delay_s = 0.0, squared_delay_s2 = 0.0;      ///< sums over what was delivered
  double airtime_s = 0.0;                            ///< that frames of this link took

  /// Of what was delivered [s]; 0: nothing was.
  double mean_delay_s() const {
    return delivered > 0 ? delay_s / static_cast<double>(delivered) : 0.0;
  }
};

/// All radios of a world (IEEE 802.11ac), and the air between them. It follows the world's
/// steps, and is called between them. Radios have the names of their robots.
class Radio {
 public:
  /// As a destination: all radios of the channel, once and without acknowledgement.
  static constexpr const char* kAll = "all";
  /// Bytes of a message, at most.
  static constexpr std::size_t kMaxBytes = 11000;

  virtual ~Radio() = default;
  /// In alphabetical order.
  virtual std::vector<std::string> names() = 0;
  /// Gives a message to the source's radio now. False: its queue is full. Throws Error for names
  /// that no radio has, source and destination that are one, and values out of range.
  virtual bool send(const std::string& source, const std::string& destination, std::string data,
                    const RadioQos& qos) = 0;
  /// What has come to a port by now and was not asked for before, oldest first. Throws Error as
  /// send().
  virtual std::vector<RadioMessage> receive(const std::string& name, int port = 0) = 0;
  /// Every radio to every other one, or those from `source`.
  virtual std::vector<RadioLink> links(const std::string& source = "") = 0;
  /// Throws Error as send().
  virtual RadioLimits limits(const std::string& name) = 0;
  /// Of the data of a frame that the source would send now. Throws Error as send().
  virtual double rate_bit_s(const std::string& source, const std::string& destination) = 0;
  /// Until that time a radio neither sends nor hears (destination ""), or hears nothing of another
  /// one, nor that of it; a time that is over ends it. Throws Error as send().
  virtual void set_outage(const std::string& source, const std::string& destination,
                          SimTime until) = 0;
  /// What has happened so far, for World::state_hash().
  virtual std::string state_text() const = 0;
};

class RelayReport;
class RelayServices;
class World;

/// How the plugin that makes a world's air for radios hands it on: on the output port kRadioPort,
/// which is no topic. A world has one.
struct RadioSample {
  std::shared_ptr<Radio> radio;              ///< lives as long as its plugin, or its last holder
  std::shared_ptr<const RelayReport> relay;  ///< nullptr: the world has no rules
  std::shared_ptr<RelayServices> services;   ///< the same
};
constexpr const char* kRadioPort = "world/radio";  ///< name of the port that carries a RadioSample

/// nullptr: the world has none.
std::shared_ptr<Radio> find_radio(const World& world);

}  // namespace trident::sim
