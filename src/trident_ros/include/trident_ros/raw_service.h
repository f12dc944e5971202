// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace trident::ros_utils {

/// What a server says of its service.
struct ServiceType {
  std::string name;               ///< "std_srvs/SetBool"
  std::string md5sum;             ///< of its definition
  std::string request, response;  ///< types of messages: "std_srvs/SetBoolRequest"
  std::string node;               ///< that serves it
};

/// Calls a service whose type is known as the program runs only, by bytes. ros::ServiceClient could
/// send them, too, but writes what the server reports to the log and keeps it from its caller; nor
/// does it end a call that another thread wants to end. Calls must not overlap.
class RawServiceClient {
 public:
  /// `service`: absolute name. Throws Error when the system has no descriptor left.
  explicit RawServiceClient(std::string service);
  ~RawServiceClient();
  RawServiceClient(const RawServiceClient&) = delete;
  RawServiceClient& operator=(const RawServiceClient&) = delete;

  /// Asks the server for its type, by a connection that calls nothing (TCPROS, probe=1). Throws
  /// Error as call() does.
  ServiceType probe();
  /// Sends a serialized request and returns the serialized response. Blocks until there is one.
  /// Throws Error: there is no such service, its server has ended, reports an error (whose text is
  /// in this one's) or says what is not TCPROS; cancel() was called.
  std::string call(const std::string& md5sum, const std::string& request);
  /// From any thread: the call in progress and all later ones end.
  void cancel();

 private:
  class Stream;

  std::string service_;
  int cancelled_ = -1;  ///< an eventfd, readable from cancel() on
};

}  // namespace trident::ros_utils
