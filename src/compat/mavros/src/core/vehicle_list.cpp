// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "core/vehicle_list.h"

#include <ros/console.h>
#include <ros/names.h>

#include <map>
#include <utility>

#include "core/link.h"
#include "trident_base/error.h"
#include "trident_bridges/transport/url.h"

namespace trident::mavros {
namespace {

/// What no two endpoints of a computer can have; empty: the URL has nothing of that kind.
std::string resource_of(const std::string& text) {
  using bridges::EndpointKind;
  if (text.empty()) return "";
  const bridges::EndpointUrl url = bridges::parse_endpoint_url(text);
  const std::uint16_t port = url.bind_port.value_or(kDefaultBindPort);
  switch (url.kind) {
    case EndpointKind::kTcpClient:
      return "";
    case EndpointKind::kTcpServer:
      return port == 0 ? "" : "TCP port " + std::to_string(port);
    case EndpointKind::kSerial:
    case EndpointKind::kSerialHardwareFlow:
    case EndpointKind::kPty:
      return url.device;
    default:
      return port == 0 ? "" : "UDP port " + std::to_string(port);
  }
}

/// The first of `vehicles` that has a text that one before it has.
template <class TextsOf>
std::string shared_by_two(const std::vector<VehicleParams>& vehicles, const std::string& what,
                          const TextsOf& texts_of) {
  std::map<std::string, std::string> owners;
  for (const VehicleParams& vehicle : vehicles) {
    for (const std::string& text : texts_of(vehicle)) {
      const auto [owner, is_new] = owners.emplace(text, vehicle.name);
      if (!is_new) {
        return "vehicles " + owner->second + " and " + vehicle.name + " have one " + what + ": '" +
               text + "'";
      }
    }
  }
  return "";
}

/// "/fleet/uav1/mavros" of uav1 and /fleet/mavros.
std::string name_of(const std::string& vehicle, const std::string& node_name) {
  std::string problem;
  if (vehicle.empty() || vehicle.front() == '~' || !ros::names::validate(vehicle, problem)) {
    throw Error("parameter " + node_name + "/vehicles: '" + vehicle +
                "' is no namespace, legal: a name of letters, digits, _ and /");
  }
  const std::size_t end = node_name.rfind('/');
  return ros::names::append(ros::names::append(node_name.substr(0, end), vehicle),
                            node_name.substr(end + 1));
}

VehicleParams read_one(ros_utils::NodeParams params, const std::string& name) {
  VehicleParams vehicle{name, read_mavros_params(params, name)};
  params.log_warnings();
  for (const std::string& problem : vehicle.params.problems) ROS_ERROR("%s", problem.c_str());
  return vehicle;
}

}  // namespace

std::vector<VehicleParams> read_vehicles(ros_utils::NodeParams& node, const FetchParams& fetch) {
  const auto names = node.read<VehicleListParams>().vehicles;
  node.take("vehicles");
  if (names.empty()) return {read_one(node, node.name_space())};
  std::vector<VehicleParams> vehicles;
  for (const std::string& vehicle : names) {
    const std::string name = name_of(vehicle, node.name_space());
    vehicles.push_back(read_one(node.overlaid(fetch(name)), name));
  }
  const std::string clash = clash_of(vehicles);
  if (!clash.empty()) throw Error("parameter " + node.name_space() + "/vehicles: " + clash);
  return vehicles;
}

std::string clash_of(const std::vector<VehicleParams>& vehicles) {
  using Texts = std::vector<std::string>;
  const auto first = [](const std::string& a, const std::string& b) { return a.empty() ? b : a; };
  const std::string names = shared_by_two(
      vehicles, "name", [](const VehicleParams& vehicle) { return Texts{vehicle.name}; });
  const std::string frames = shared_by_two(
      vehicles, "frame_prefix",
      [](const VehicleParams& vehicle) { return Texts{vehicle.params.frame_prefix}; });
  const std::string endpoints =
      shared_by_two(vehicles, "endpoint", [](const VehicleParams& vehicle) {
        Texts resources;
        for (const std::string* url : {&vehicle.params.fcu_url, &vehicle.params.gcs_url}) {
          const std::string resource = resource_of(*url);
          if (!resource.empty()) resources.push_back(resource);
        }
        return resources;
      });
  return first(names, first(frames, endpoints));
}

}  // namespace trident::mavros
