// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "node_probe.h"

#include <netdb.h>
#include <poll.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <sys/socket.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <thread>

namespace trident::sim {
namespace {

constexpr int kConnectLimit_ms = 2000;  ///< the backlog of a stopped process may be full

constexpr double kAskAgain_s = 0.02;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Whether the kernel refuses a connection: nobody has the port any more.
bool refuses(const std::string& host, std::uint32_t port) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return false;
  bool is_refused = false;
  for (const addrinfo* it = found; it != nullptr; it = it->ai_next) {
    const int descriptor =
        socket(it->ai_family, it->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, it->ai_protocol);
    if (descriptor < 0) continue;
    int error = connect(descriptor, it->ai_addr, it->ai_addrlen) == 0 ? 0 : errno;
    pollfd waited{descriptor, POLLOUT, 0};
    if (error == EINPROGRESS && poll(&waited, 1, kConnectLimit_ms) == 1) {
      socklen_t size = sizeof(error);
      getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size);
    }
    close(descriptor);
    is_refused = error == ECONNREFUSED;
    if (!is_refused) break;
  }
  freeaddrinfo(found);
  return is_refused;
}

/// Whether a value is a list of at least `size` elements.
bool is_list(XmlRpc::XmlRpcValue& value, int size) {
  return value.getType() == XmlRpc::XmlRpcValue::TypeArray && value.size() >= size;
}

std::string text(XmlRpc::XmlRpcValue& value) {
  const bool is_text = value.getType() == XmlRpc::XmlRpcValue::TypeString;
  return is_text ? static_cast<std::string>(value) : std::string();
}

enum class Lookup { kUnknown, kOdd, kFound };

Lookup find_node(const std::string& node, std::string* host, std::uint32_t* port) {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) return Lookup::kUnknown;
  if (uri.getType() != XmlRpc::XmlRpcValue::TypeString) return Lookup::kOdd;
  return ros::network::splitURI(static_cast<std::string>(uri), *host, *port) ? Lookup::kFound
                                                                             : Lookup::kOdd;
}

bool is_alive(const std::string& node) {
  std::string host;
  std::uint32_t port = 0;
  const Lookup found = find_node(node, &host, &port);
  if (found == Lookup::kFound) return !refuses(host, port);
  // A node that the master does not know has gone; an odd answer is no sign of that.
  return found == Lookup::kOdd;
}

/// What a node says of its connections, each [id, peer, direction, transport, topic, ...]; nothing
/// where it does not answer as the slave API of ROS wants.
std::optional<XmlRpc::XmlRpcValue> bus_info(const std::string& host, std::uint32_t port) {
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  if (!client.execute("getBusInfo", request, response) || client.isFault()) return std::nullopt;
  if (!is_list(response, 3) || !is_list(response[2], 0)) return std::nullopt;
  return response[2];
}

/// Topics that a node sends to this one, by its own account.
std::set<std::string> topics_from(const std::string& node) {
  std::string host;
  std::uint32_t port = 0;
  std::set<std::string> topics;
  if (find_node(node, &host, &port) != Lookup::kFound) return topics;
  std::optional<XmlRpc::XmlRpcValue> links = bus_info(host, port);
  for (int i = 0; links && i < links->size(); ++i) {
    XmlRpc::XmlRpcValue& link = (*links)[i];
    if (!is_list(link, 5)) continue;
    if (text(link[1]) != ros::this_node::getName() || text(link[2]) != "o") continue;
    topics.insert(text(link[4]));
  }
  return topics;
}

}  // namespace

void NodeProbe::ask(const std::shared_ptr<Answers>& answers, const std::string& node) {
  const bool alive = is_alive(node);
  const std::lock_guard<std::mutex> lock(answers->mutex);
  // Only a node that was seen alive can have gone.
  State& state = answers->states[node];
  if (alive) {
    state = State::kAlive;
  } else if (state == State::kAlive) {
    state = State::kGone;
  }
  answers->asked_at[node] = wall_s();
}

void NodeProbe::ask_for_links(const std::shared_ptr<Answers>& answers, const std::string& node) {
  const std::set<std::string> topics = topics_from(node);
  const std::lock_guard<std::mutex> lock(answers->mutex);
  for (const std::string& topic : topics) answers->links.insert(node + " " + topic);
  answers->asked_at["links of " + node] = wall_s();
}

bool NodeProbe::sends(const std::string& node, const std::string& topic) {
  if (node == ros::this_node::getName()) return true;
  const std::lock_guard<std::mutex> lock(answers_->mutex);
  if (answers_->links.count(node + " " + topic) > 0) return true;
  const auto asked = answers_->asked_at.find("links of " + node);
  const bool is_due = asked == answers_->asked_at.end() ||
                      (asked->second >= 0.0 && wall_s() - asked->second > kAskAgain_s);
  if (is_due) {
    // On a thread of its own: neither the master nor a node that hangs may hold up a step. A
    // negative time says that the answer is awaited.
    answers_->asked_at["links of " + node] = -1.0;
    std::thread([answers = answers_, node] { ask_for_links(answers, node); }).detach();
  }
  return false;
}

NodeProbe::State NodeProbe::look(const std::string& node, double period_s) {
  const std::lock_guard<std::mutex> lock(answers_->mutex);
  const auto asked = answers_->asked_at.find(node);
  const bool is_due = asked == answers_->asked_at.end() ||
                      (asked->second >= 0.0 && wall_s() - asked->second > period_s);
  if (is_due) {
    answers_->asked_at[node] = -1.0;
    std::thread([answers = answers_, node] { ask(answers, node); }).detach();
  }
  return answers_->states[node];
}

}  // namespace trident::sim
