// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "trident_ros/direct_inbox.h"

#include <fcntl.h>
#include <ros/poll_manager.h>
#include <ros/transport_publisher_link.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "roscpp_internals.h"
#include "trident_base/error.h"
#include "trident_ros/peer_process.h"
#include "trident_ros/schedule_fuzz.h"

namespace trident::ros_utils {
namespace {

constexpr std::uint64_t kWakeKey = 0;
constexpr std::size_t kFirstBuffer = 1 << 16;
constexpr std::size_t kLength = sizeof(std::uint32_t);    // before each message of TCPROS
constexpr std::uint32_t kLongestMessage = 1'000'000'000;  // roscpp's own limit

void watch(int epoll, int descriptor, std::uint64_t key) {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = key;
  if (epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event) != 0) {
    throw Error(std::string("epoll_ctl: ") + std::strerror(errno));
  }
}

ros::SubscriptionPtr find_subscription(const std::string& topic) {
  ros::TopicManager& manager = *ros::TopicManager::instance();
  boost::mutex::scoped_lock lock(manager.*pointer_to(SubscriptionsMutex{}));
  for (const ros::SubscriptionPtr& subscription : manager.*pointer_to(Subscriptions{})) {
    if (subscription->getName() == topic) return subscription;
  }
  return nullptr;
}

/// Between two messages: all bytes read so far belong to messages that were handed over.
bool is_between_messages(const ros::Connection& connection) {
  return connection.*pointer_to(HasReadCallback{}) != 0 &&
         connection.*pointer_to(ReadSize{}) == kLength && connection.*pointer_to(ReadFilled{}) == 0;
}

/// A second descriptor of the transport's socket, valid whenever roscpp closes its own; -1: none.
int duplicate_socket(ros::TransportTCP& transport) {
  boost::recursive_mutex::scoped_lock lock(transport.*pointer_to(CloseMutex{}));
  if (transport.*pointer_to(SocketClosed{})) return -1;
  return fcntl(transport.*pointer_to(Socket{}), F_DUPFD_CLOEXEC, 0);
}

}  // namespace

struct DirectInbox::Link {
  Link(int epoll_set, std::uint64_t topic_id, ros::ConnectionPtr its_connection, int socket)
      : topic(topic_id),
        connection(std::move(its_connection)),
        descriptor(socket),
        epoll(epoll_set) {}
  ~Link() {
    // Closing alone would not end the watch: roscpp's descriptor is of the same socket.
    epoll_ctl(epoll, EPOLL_CTL_DEL, descriptor, nullptr);
    close(descriptor);
  }
  std::uint64_t topic;
  ros::ConnectionPtr connection;
  int descriptor;
  int epoll;
  std::vector<std::uint8_t> partial;  ///< the beginning of a message
};

DirectSubscription::~DirectSubscription() {
  subscriber_.shutdown();
  inbox_.remove(id_);
}

std::vector<pid_t> DirectSubscription::processes() const {
  const std::lock_guard<std::mutex> lock(inbox_.mutex_);
  std::vector<pid_t> result;
  for (const auto& [key, link] : inbox_.links_) {
    if (link->topic != id_) continue;
    if (const pid_t process = peer_process(link->descriptor); process > 0)
      result.push_back(process);
  }
  return result;
}

DirectInbox::DirectInbox(Sockets sockets) : sockets_(sockets), buffer_(kFirstBuffer) {
  descriptors_.epoll = epoll_create1(EPOLL_CLOEXEC);
  descriptors_.wake = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (descriptors_.epoll < 0 || descriptors_.wake < 0)
    throw Error(std::string("sockets: ") + std::strerror(errno));
  watch(descriptors_.epoll, descriptors_.wake, kWakeKey);
  if (sockets_ == Sockets::kReadByRoscpp) return;
  listener_ = ros::PollManager::instance()->addPollThreadListener([this] { take_over_links(); });
}

DirectInbox::~DirectInbox() {
  ros::PollManager::instance()->removePollThreadListener(listener_);
  links_.clear();
  close(descriptors_.wake);
  close(descriptors_.epoll);
}

std::uint64_t DirectInbox::add(Topic topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::uint64_t id = next_key_++;
  topics_.emplace(id, std::move(topic));
  return id;
}

std::unique_ptr<DirectSubscription> DirectInbox::subscribed(ros::NodeHandle& node, std::uint64_t id,
                                                            ros::SubscribeOptions options) {
  std::unique_ptr<DirectSubscription> result(new DirectSubscription(*this, id));
  result->subscriber_ = node.subscribe(options);
  ros::SubscriptionPtr subscription = find_subscription(result->subscriber_.getTopic());
  const std::lock_guard<std::mutex> lock(mutex_);
  topics_.at(id).subscription = std::move(subscription);
  return result;
}

void DirectInbox::remove(std::uint64_t id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  topics_.erase(id);
  for (auto it = links_.begin(); it != links_.end();) {
    it = it->second->topic == id ? links_.erase(it) : std::next(it);
  }
}

DirectInbox::Handler DirectInbox::putter(std::uint64_t id) {
  return [this, id](Span<const std::uint8_t> bytes) {
    put({id, {bytes.begin(), bytes.end()}, nullptr});
  };
}

// Without mutex_, which the reading thread may hold: its handlers publish, too.
void DirectInbox::put(Item item) {
  hand_over("inbox put");
  {
    const std::lock_guard<std::mutex> lock(put_.mutex);
    put_.waiting.push_back(std::move(item));
  }
  if (!put_.any.exchange(true)) wake();
}

// On roscpp's socket thread, between two polls: nobody is reading.
void DirectInbox::take_over_links() {
  if (!has_new_links_.exchange(false)) return;
  hand_over("inbox takes links over");
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto& [id, topic] : topics_) {
    if (topic.has_new_link && topic.subscription) take_over(topic, id);
  }
}

void DirectInbox::take_over(Topic& topic, std::uint64_t id) {
  topic.has_new_link = false;
  boost::mutex::scoped_lock lock((*topic.subscription).*pointer_to(PublisherLinksMutex{}));
  for (const ros::PublisherLinkPtr& link : (*topic.subscription).*pointer_to(PublisherLinks{})) {
    auto* const tcp_link = dynamic_cast<ros::TransportPublisherLink*>(link.get());
    if (tcp_link == nullptr) continue;
    const ros::ConnectionPtr& connection = tcp_link->getConnection();
    auto* const transport = dynamic_cast<ros::TransportTCP*>(connection->getTransport().get());
    const bool is_ours = std::any_of(links_.begin(), links_.end(), [&](const auto& entry) {
      return entry.second->connection == connection;
    });
    if (transport == nullptr || is_ours || !is_between_messages(*connection)) continue;
    const int descriptor = duplicate_socket(*transport);
    if (descriptor < 0) continue;
    transport->disableRead();
    const std::uint64_t key = next_key_++;
    links_[key] = std::make_unique<Link>(descriptors_.epoll, id, connection, descriptor);
    watch(descriptors_.epoll, descriptor, key);
    newest_link_ = key;
  }
}

bool DirectInbox::wait(std::chrono::milliseconds limit) {
  std::array<epoll_event, 64> events;
  const int count =
      epoll_wait(descriptors_.epoll, events.data(), events.size(), static_cast<int>(limit.count()));
  ready_.clear();
  for (int i = 0; i < count; ++i) ready_.push_back(events[static_cast<std::size_t>(i)].data.u64);
  return count > 0;
}

void DirectInbox::read() {
  const std::lock_guard<std::mutex> lock(mutex_);
  // Before what it announces: a put() that comes meanwhile must end the next wait.
  if (std::find(ready_.begin(), ready_.end(), kWakeKey) != ready_.end()) {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto size = ::read(descriptors_.wake, &count, sizeof(count));
  }
  if (put_.any.exchange(false)) read_put();
  for (const std::uint64_t key : ready_) {
    if (key != kWakeKey) read_link(key);
  }
  ready_.clear();
}

void DirectInbox::wake() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto size = ::write(descriptors_.wake, &one, sizeof(one));
}

std::size_t DirectInbox::link_count() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return links_.size();
}

void DirectInbox::read_put() {
  {
    const std::lock_guard<std::mutex> lock(put_.mutex);
    put_.being_read.swap(put_.waiting);
  }
  for (const Item& item : put_.being_read) {
    const auto topic = topics_.find(item.topic);
    if (topic == topics_.end()) continue;
    if (item.object) {
      topic->second.on_object(item.object.get());
      continue;
    }
    topic->second.on_bytes({item.bytes.data(), item.bytes.size()});
    topic->second.has_new_link = true;
    has_new_links_ = true;
  }
  put_.being_read.clear();
}

void DirectInbox::read_link(std::uint64_t key) {
  const auto entry = links_.find(key);
  if (entry == links_.end()) return;
  hand_over("inbox reads");
  Link& link = *entry->second;
  const std::size_t kept = link.partial.size();
  std::copy(link.partial.begin(), link.partial.end(), buffer_.begin());
  link.partial.clear();
  const auto got =
      recv(link.descriptor, buffer_.data() + kept, buffer_.size() - kept, MSG_DONTWAIT);
  if (got > 0) {
    hand_out(link, kept + static_cast<std::size_t>(got));
  } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
    return_to_roscpp(key);
  } else {
    link.partial.assign(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(kept));
  }
}

void DirectInbox::hand_out(Link& link, std::size_t size) {
  const Handler& handler = topics_.at(link.topic).on_bytes;
  std::size_t begin = 0;
  while (size - begin >= kLength) {
    std::uint32_t length = 0;
    std::memcpy(&length, buffer_.data() + begin, kLength);
    if (length > kLongestMessage) {
      shutdown(link.descriptor, SHUT_RDWR);  // the next read ends the link
      return;
    }
    if (size - begin < kLength + length) {
      if (buffer_.size() < 2 * (kLength + length)) {
        std::vector<std::uint8_t> larger(2 * (kLength + length));
        std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(begin), size - begin,
                    larger.begin());
        buffer_.swap(larger);
        size -= begin;
        begin = 0;
      }
      break;
    }
    handler({buffer_.data() + begin + kLength, length});
    begin += kLength + length;
  }
  link.partial.assign(buffer_.begin() + static_cast<std::ptrdiff_t>(begin),
                      buffer_.begin() + static_cast<std::ptrdiff_t>(size));
}

// roscpp finds the end of the connection by reading, drops it and looks for its publisher again.
void DirectInbox::return_to_roscpp(std::uint64_t key) {
  const auto entry = links_.find(key);
  const ros::ConnectionPtr connection = entry->second->connection;
  links_.erase(entry);
  connection->getTransport()->enableRead();
}

}  // namespace trident::ros_utils
