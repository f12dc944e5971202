// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// TCPROS of services: a header from each end, then 4 bytes of length and the request, and in return
// a byte that is 1 for success, 4 bytes of length, and the response or the text of an error.
#include "trident_ros/raw_service.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <ros/header.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "trident_base/error.h"

namespace trident::ros_utils {
namespace {

constexpr std::uint32_t kMaxHeaderBytes = 1'000'000;
constexpr std::uint32_t kMaxResponseBytes = 1'000'000'000;  // as roscpp's own
constexpr int kConnectLimit_ms = 2000;

struct Address {
  std::string host;
  std::uint32_t port = 0;
};

Address lookup(const std::string& service) {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = ros::this_node::getName();
  request[1] = service;
  const bool is_known = ros::master::execute("lookupService", request, response, uri, false) &&
                        uri.getType() == XmlRpc::XmlRpcValue::TypeString;
  Address address;
  if (is_known &&
      ros::network::splitURI(static_cast<std::string&>(uri), address.host, address.port)) {
    return address;
  }
  throw Error("there is no service " + service);
}

std::uint32_t length_of(const std::string& bytes) {
  std::uint32_t length = 0;
  std::memcpy(&length, bytes.data(), sizeof(length));
  return length;
}

std::string with_length(const char* bytes, std::uint32_t size) {
  std::string result(reinterpret_cast<const char*>(&size), sizeof(size));
  return result.append(bytes, size);
}

}  // namespace

/// The connection of one call.
class RawServiceClient::Stream {
 public:
  Stream(const std::string& service, int cancelled) : service_(service), cancelled_(cancelled) {
    try {
      connect(lookup(service));
    } catch (...) {
      close(socket_);
      throw;
    }
  }
  ~Stream() { close(socket_); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  void write(const std::string& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      wait(POLLOUT, -1);
      const ssize_t count = send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
      if (count > 0) done += static_cast<std::size_t>(count);
      if (count < 0 && errno != EAGAIN && errno != EINTR) fail_ended();
    }
  }
  std::string read(std::uint32_t size) {
    std::string bytes;
    while (bytes.size() < size) {
      wait(POLLIN, -1);
      char part[65536];
      const ssize_t count = recv(socket_, part, std::min(sizeof(part), size - bytes.size()), 0);
      if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) fail_ended();
      if (count > 0) bytes.append(part, static_cast<std::size_t>(count));
    }
    return bytes;
  }
  /// The server's header in return for ours.
  ros::Header shake_hands(ros::M_string fields) {
    fields["service"] = service_;
    fields["callerid"] = ros::this_node::getName();
    boost::shared_array<std::uint8_t> bytes;
    std::uint32_t size = 0;
    ros::Header::write(fields, bytes, size);
    write(with_length(reinterpret_cast<const char*>(bytes.get()), size));
    const std::uint32_t length = length_of(read(sizeof(std::uint32_t)));
    if (length > kMaxHeaderBytes) fail("has a header that is not of TCPROS");
    std::string text = read(length);
    ros::Header header;
    std::string problem;
    if (!header.parse(reinterpret_cast<std::uint8_t*>(text.data()), length, problem)) {
      fail("has a header that is not of TCPROS");
    }
    if (header.getValue("error", problem)) fail("refuses the connection: " + problem);
    return header;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("the server of " + service_ + " " + what);
  }

 private:
  [[noreturn]] void fail_ended() const { fail("has ended during the call"); }

  /// Throws Error when the client is cancelled, or nothing happens within the limit; -1: no limit.
  void wait(short events, int limit_ms) const {
    pollfd waited[] = {{socket_, events, 0}, {cancelled_, POLLIN, 0}};
    int count = 0;
    while ((count = poll(waited, 2, limit_ms)) < 0 && errno == EINTR) {
    }
    if (waited[1].revents != 0) throw Error("the call of " + service_ + " was cancelled");
    if (count <= 0) fail("does not take the connection");
  }
  void connect(const Address& address) {
    addrinfo hints{}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    const std::string port = std::to_string(address.port);
    if (getaddrinfo(address.host.c_str(), port.c_str(), &hints, &found) != 0) {
      fail("is at '" + address.host + "', which is no host that is known here");
    }
    bool is_connected = false;
    for (const addrinfo* it = found; it != nullptr && !is_connected; it = it->ai_next) {
      close(socket_);
      socket_ =
          socket(it->ai_family, it->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, it->ai_protocol);
      is_connected = socket_ >= 0 && reaches(*it);
    }
    freeaddrinfo(found);
    // The master knows of services whose nodes were killed.
    if (!is_connected) throw Error("there is no service " + service_ + ": its server has ended");
    const int on = 1;
    setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  }
  bool reaches(const addrinfo& address) const {
    int error = ::connect(socket_, address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
    if (error != EINPROGRESS) return error == 0;
    wait(POLLOUT, kConnectLimit_ms);
    socklen_t size = sizeof(error);
    getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
    return error == 0;
  }
  static void close(int descriptor) {
    if (descriptor >= 0) ::close(descriptor);
  }

  const std::string& service_;
  int cancelled_;
  int socket_ = -1;
};

RawServiceClient::RawServiceClient(std::string service)
    : service_(std::move(service)), cancelled_(eventfd(0, EFD_CLOEXEC)) {
  if (cancelled_ < 0) throw Error(std::string("eventfd: ") + std::strerror(errno));
}

RawServiceClient::~RawServiceClient() { close(cancelled_); }

void RawServiceClient::cancel() {
  const std::uint64_t one = 1;
  // It cannot fail: nobody reads the counter, and it is far from full.
  const ssize_t written = write(cancelled_, &one, sizeof(one));
  static_cast<void>(written);
}

ServiceType RawServiceClient::probe() {
  Stream stream(service_, cancelled_);
  const ros::Header header = stream.shake_hands({{"md5sum", "*"}, {"probe", "1"}});
  ServiceType type;
  header.getValue("type", type.name);
  header.getValue("md5sum", type.md5sum);
  header.getValue("request_type", type.request);
  header.getValue("response_type", type.response);
  header.getValue("callerid", type.node);
  if (type.name.empty() || type.md5sum.empty()) stream.fail("does not name its type");
  // rospy leaves these two out.
  if (type.request.empty()) type.request = type.name + "Request";
  if (type.response.empty()) type.response = type.name + "Response";
  return type;
}

std::string RawServiceClient::call(const std::string& md5sum, const std::string& request) {
  Stream stream(service_, cancelled_);
  stream.shake_hands({{"md5sum", md5sum}});
  stream.write(with_length(request.data(), static_cast<std::uint32_t>(request.size())));
  const bool is_success = stream.read(1)[0] == 1;
  const std::uint32_t length = length_of(stream.read(sizeof(std::uint32_t)));
  if (length > kMaxResponseBytes) stream.fail("has a response that is too long");
  std::string response = stream.read(length);
  if (is_success) return response;
  stream.fail(response.empty() ? "reports a failure, without a text" : "reports: " + response);
}

}  // namespace trident::ros_utils
