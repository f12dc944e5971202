// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_bridges_ros/nmea/navsat_drivers.h"

#include <nmea_msgs/Sentence.h>
#include <ros/ros.h>

#include <functional>
#include <memory>
#include <string>

#include "trident_base/error.h"
#include "trident_bridges_ros/nmea/navsat_output.h"
#include "trident_bridges_ros/nmea/nmea_link.h"
#include "trident_bridges_ros/node_poll_loop.h"
#include "trident_bridges_ros/utc.h"
#include "trident_ros/node_params.h"

namespace trident::bridges {
namespace {

constexpr std::uint32_t kSentenceQueueSize = 1000;

/// What every driver has.
struct Driver {
  ros::NodeHandle node;
  ros_utils::NodeParams params{ros::NodeHandle("~")};
  NodePollLoop loop;
  UtcClock clock{read_utc_start()};
  ros::NodeHandle rare = loop.served(node);
  ros_utils::Refusals refusals{rare};
};

/// Runs `body` as a node of this name; an error ends it with its text and 1.
int run(int argc, char** argv, const char* name, const std::function<void(Driver&)>& body) {
  init_node(argc, argv, name);
  ros::NodeHandle node;  // outlives the catch: logging ends with the last handle
  try {
    Driver driver;
    driver.loop.follow_clock(driver.node, [](const ros::Time&) {});
    body(driver);
  } catch (const Error& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}

/// Below the tf_prefix of the namespace, as upstream.
std::string prefixed(const std::string& frame_id) {
  std::string name, prefix;
  if (!ros::param::search("tf_prefix", name) || !ros::param::get(name, prefix)) return frame_id;
  return prefix + '/' + frame_id;
}

NavsatOutputParams output_params(const NavsatDriverParams& own) {
  NavsatOutputParams params;
  params.frame_id = prefixed(own.frame_id);
  params.time_source = own.time_ref_source;
  params.uses_gnss_time = own.uses_gnss_time;
  params.has_compass_heading = !own.enu_heading;
  params.shows_no_fix = true;
  return params;
}

NmeaReadParams read_params(const NavsatDriverParams& own) {
  NmeaReadParams params;
  params.framer.max_length = nmea::SentenceFramer::kMaxLength;  // upstream has no limit
  params.receiver.navsat = own.navsat;
  return params;
}

EndpointOptions serial_options(const NavsatSerialParams& own) {
  EndpointOptions options;
  options.url = "serial://" + own.port + ":" + std::to_string(own.baud);
  return options;
}

nmea::Receipt receipt_now(Driver& driver) {
  return {driver.loop.loop().now_s(), unix_ns_of(driver.clock, ros::Time::now())};
}

/// Reads a link and publishes what it says.
void publish_link(Driver& driver, const NavsatDriverParams& own, const EndpointOptions& options) {
  NavsatOutput output(driver.node, output_params(own));
  NmeaReadHooks hooks;
  hooks.receipt = [&] {
    output.set_now();
    return receipt_now(driver);
  };
  hooks.events = &output;
  hooks.refusals = &driver.refusals;
  NmeaLink link(options, read_params(own), hooks, true, driver.loop, driver.node);
  driver.loop.run();
}

}  // namespace

int nmea_serial_driver_main(int argc, char** argv) {
  return run(argc, argv, "nmea_serial_driver", [](Driver& driver) {
    const auto own = driver.params.read<NavsatDriverParams>();
    const auto serial = driver.params.read<NavsatSerialParams>();
    driver.params.log_warnings();
    publish_link(driver, own, serial_options(serial));
  });
}

int nmea_socket_driver_main(int argc, char** argv) {
  return run(argc, argv, "nmea_socket_driver", [](Driver& driver) {
    const auto own = driver.params.read<NavsatDriverParams>();
    const bool is_default = driver.params.find("ip") == nullptr;
    const auto socket = driver.params.read<NavsatSocketParams>();
    driver.params.log_warnings();
    if (is_default) {
      ROS_WARN("~ip is not set: bound is 127.0.0.1:%d alone, where upstream binds all interfaces",
               socket.port);
    }
    EndpointOptions options;
    options.url = "udp://" + socket.ip + ":" + std::to_string(socket.port) + "@";
    options.allow_remote = !is_default;  // a user who names an address wants it
    publish_link(driver, own, options);
  });
}

int nmea_topic_driver_main(int argc, char** argv) {
  return run(argc, argv, "nmea_topic_driver", [](Driver& driver) {
    const auto own = driver.params.read<NavsatDriverParams>();
    driver.params.log_warnings();
    NavsatOutput output(driver.node, output_params(own));
    NmeaReadHooks hooks;
    hooks.receipt = [&] { return receipt_now(driver); };
    hooks.events = &output;
    hooks.refusals = &driver.refusals;
    SentenceReader reader("nmea_sentence", "its publishers", read_params(own), hooks);
    const auto subscription = driver.loop.subscribe<nmea_msgs::Sentence>(
        driver.node, "nmea_sentence", kSentenceQueueSize, [&](const nmea_msgs::Sentence& message) {
          const bool has_stamp = !message.header.stamp.isZero();
          output.set_origin(has_stamp ? message.header.stamp : ros::Time::now(),
                            message.header.frame_id);
          const std::string& text = message.sentence;
          reader.read(Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), true);
        });
    driver.loop.run();
  });
}

int nmea_topic_serial_reader_main(int argc, char** argv) {
  return run(argc, argv, "nmea_topic_serial_reader", [](Driver& driver) {
    const auto own = driver.params.read<NavsatDriverParams>();
    const auto serial = driver.params.read<NavsatSerialParams>();
    driver.params.log_warnings();
    NodePublisher<nmea_msgs::Sentence> publisher(driver.node, "nmea_sentence");
    nmea_msgs::Sentence message;
    message.header.frame_id = prefixed(own.frame_id);
    NmeaReadHooks hooks;
    hooks.receipt = [&] { return receipt_now(driver); };
    hooks.sentence = [&](const nmea::Sentence& sentence) {
      message.header.stamp = ros::Time::now();
      message.sentence = text_of(sentence);
      publisher.publish(message);
    };
    hooks.refusals = &driver.refusals;
    NmeaLink link(serial_options(serial), read_params(own), hooks, true, driver.loop, driver.node);
    driver.loop.run();
  });
}

}  // namespace trident::bridges
