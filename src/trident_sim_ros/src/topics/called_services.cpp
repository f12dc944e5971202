// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "called_services.h"

#include <ros/serialization.h>

#include <algorithm>
#include <cstring>
#include <future>
#include <utility>

#include "trident_base/error.h"
#include "trident_base/mutex.h"
#include "trident_ros/schedule_fuzz.h"

namespace trident::sim {

/// A call of a node, which waits for its result.
class NodeCall {
 public:
  NodeCall(RelayService called, std::string caller, std::string bytes, std::uint64_t index,
           bool is_by_chance)
      : service(std::move(called)),
        node(std::move(caller)),
        request(std::make_shared<const std::string>(std::move(bytes))),
        before(index),
        came_as_time_ran(is_by_chance) {}

  /// Once.
  void finish(const CallResult& result) { result_.set_value(result); }
  CallResult wait() { return future_.get(); }
  bool is_of(const std::string& caller, std::uint64_t received) const {
    return node == caller && before >= received;
  }

  const RelayService service;
  const std::string node;
  const std::shared_ptr<const std::string> request;
  const std::uint64_t before;  ///< how many had come before
  const bool came_as_time_ran;

 private:
  std::promise<CallResult> result_;
  std::future<CallResult> future_ = result_.get_future();
};

/// Calls that have come and not begun yet.
class CallInbox {
 public:
  CallInbox(Repeatability& repeatability, std::shared_ptr<MessageBell> bell)
      : repeatability_(repeatability), bell_(std::move(bell)) {}

  /// By the caller's thread: returns when the call has ended.
  CallResult call(const RelayService& service, const std::string& node, std::string request) {
    ros_utils::hand_over("call received");
    std::shared_ptr<NodeCall> call;
    {
      const Lock lock(mutex_);
      if (!end_.empty()) return {0, false, std::make_shared<const std::string>(end_)};
      call = std::make_shared<NodeCall>(service, node, std::move(request), received_++,
                                        repeatability_.running());
      waiting_.push_back(call);
    }
    bell_->ring();
    // Without the lock, or no other call could come in.
    return call->wait();
  }
  std::vector<std::shared_ptr<NodeCall>> take() {
    const Lock lock(mutex_);
    return std::exchange(waiting_, {});
  }
  bool has_call_of(const std::string& node, std::uint64_t received) const {
    const Lock lock(mutex_);
    return std::any_of(waiting_.begin(), waiting_.end(),
                       [&node, received](const auto& call) { return call->is_of(node, received); });
  }
  std::uint64_t received() const {
    const Lock lock(mutex_);
    return received_;
  }
  std::size_t size() const {
    const Lock lock(mutex_);
    return waiting_.size();
  }
  void end(const std::string& why) {
    const Lock lock(mutex_);
    end_ = why;
  }

 private:
  Repeatability& repeatability_;
  std::shared_ptr<MessageBell> bell_;
  mutable Mutex mutex_;
  std::vector<std::shared_ptr<NodeCall>> waiting_ TRIDENT_GUARDED_BY(mutex_);
  std::uint64_t received_ TRIDENT_GUARDED_BY(mutex_) = 0;
  std::string end_ TRIDENT_GUARDED_BY(mutex_);  ///< why no call begins any more
};

namespace {

/// As TCPROS has it: a byte that is 1 for success, 4 bytes of length, the response or the error.
ros::SerializedMessage response_of(const CallResult& result) {
  const std::string& data = *result.data;
  const auto length = static_cast<std::uint32_t>(data.size());
  ros::SerializedMessage message;
  message.num_bytes = 1 + sizeof(length) + data.size();
  message.buf.reset(new std::uint8_t[message.num_bytes]);
  message.buf[0] = result.is_answered ? 1 : 0;
  std::memcpy(message.buf.get() + 1, &length, sizeof(length));
  std::memcpy(message.buf.get() + 1 + sizeof(length), data.data(), data.size());
  return message;
}

/// Has roscpp answer by bytes.
class BytesHelper : public ros::ServiceCallbackHelper {
 public:
  BytesHelper(RelayService service, std::shared_ptr<CallInbox> inbox)
      : service_(std::move(service)), inbox_(std::move(inbox)) {}

  /// True for errors, too: of false roscpp would make an error without a text.
  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    std::string request(reinterpret_cast<const char*>(params.request.buf.get()),
                        params.request.num_bytes);
    const std::string& node = (*params.connection_header)["callerid"];
    params.response = response_of(inbox_->call(service_, node, std::move(request)));
    return true;
  }

 private:
  RelayService service_;
  std::shared_ptr<CallInbox> inbox_;
};

CallResult error_result(const std::string& text) {
  return {0, false, std::make_shared<const std::string>(text)};
}

}  // namespace

std::string name_at_server(const RelayService& service) {
  return "/" + service.server + "/" + service.name;
}

std::string name_at_caller(const RelayService& service) {
  return "/" + service.caller + "/to/" + service.server + "/" + service.name;
}

CalledServices::CalledServices(ros::NodeHandle& node, ServiceTypes& types,
                               Repeatability& repeatability,
                               const std::shared_ptr<MessageBell>& bell)
    : node_(node),
      types_(types),
      repeatability_(repeatability),
      inbox_(std::make_shared<CallInbox>(repeatability, bell)) {}

CalledServices::~CalledServices() { end("the simulation has ended"); }

void CalledServices::sync(const std::vector<RelayService>& services) {
  std::map<std::string, Entry> entries;
  for (const RelayService& service : services) {
    const std::string name = name_at_caller(service);
    const auto known = entries_.find(name);
    Entry& entry = entries[name];
    // Servers of rules that stay keep their connections.
    if (known != entries_.end()) entry = std::move(known->second);
    entry.service = service;
  }
  entries_ = std::move(entries);
}

void CalledServices::advertise(const std::string& name, const ros_utils::ServiceType& type,
                               Entry* entry) {
  // A type that has changed needs a new server: the type is part of the handshake.
  entry->server.shutdown();
  ros::AdvertiseServiceOptions options;
  options.service = name;
  options.md5sum = type.md5sum;
  options.datatype = type.name;
  options.req_datatype = type.request;
  options.res_datatype = type.response;
  options.helper = boost::make_shared<BytesHelper>(entry->service, inbox_);
  options.callback_queue = &queue_;
  entry->server = node_.advertiseService(options);
  entry->md5sum = type.md5sum;
}

void CalledServices::look_for_types() {
  for (auto& [name, entry] : entries_) {
    const ros_utils::ServiceType type = types_.look(name_at_server(entry.service));
    if (!type.name.empty() && type.md5sum != entry.md5sum) advertise(name, type, &entry);
  }
}

void CalledServices::begin(const std::shared_ptr<NodeCall>& call, RelayServices& relay) {
  try {
    in_progress_.emplace(relay.call(call->service, call->request), call);
  } catch (const Error& error) {
    call->finish(error_result(error.what()));
  }
}

void CalledServices::deliver(SimTime begin_time, RelayServices& relay,
                             const std::function<bool(const std::string&)>& is_expected) {
  for (const std::shared_ptr<NodeCall>& call : inbox_->take()) {
    if (call->came_as_time_ran && !is_expected(call->node)) {
      repeatability_.spoil(call->node, begin_time,
                           "calls " + name_at_caller(call->service) + " outside of the lockstep");
    }
    begin(call, relay);
  }
}

void CalledServices::finish(const CallResult& result) {
  const auto call = in_progress_.find(result.number);
  if (call == in_progress_.end()) return;
  call->second->finish(result);
  in_progress_.erase(call);
}

std::uint64_t CalledServices::received() const { return inbox_->received(); }

bool CalledServices::is_calling(const std::string& node, std::uint64_t received) const {
  return inbox_->has_call_of(node, received) ||
         std::any_of(
             in_progress_.begin(), in_progress_.end(),
             [&node, received](const auto& entry) { return entry.second->is_of(node, received); });
}

void CalledServices::abort(const std::string& node, const std::string& why, RelayServices& relay) {
  for (const auto& [number, call] : in_progress_) {
    if (call->node == node) relay.abort(number, why);
  }
}

std::size_t CalledServices::waiting() const { return inbox_->size(); }

void CalledServices::clear() {
  for (const std::shared_ptr<NodeCall>& call : inbox_->take()) {
    call->finish(error_result("the world was reset"));
  }
}

void CalledServices::end(const std::string& why) {
  inbox_->end(why);
  for (const std::shared_ptr<NodeCall>& call : inbox_->take()) call->finish(error_result(why));
  for (const auto& [number, call] : in_progress_) call->finish(error_result(why));
  in_progress_.clear();
}

std::map<std::string, std::vector<std::string>> CalledServices::unserved() const {
  std::map<std::string, std::vector<std::string>> servers;
  for (const auto& [name, entry] : entries_) {
    std::vector<std::string>& names = servers[entry.service.rule];
    const std::string server = name_at_server(entry.service);
    if (std::find(names.begin(), names.end(), server) == names.end()) names.push_back(server);
  }
  for (const auto& [name, entry] : entries_) {
    if (!entry.md5sum.empty()) servers.erase(entry.service.rule);
  }
  return servers;
}

}  // namespace trident::sim
