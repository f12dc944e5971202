// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Calls serving_node.py; run by test_raw_service.py.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_srvs/SetBool.h>

#include <string>
#include <thread>

#include "trident_base/error.h"
#include "trident_ros/raw_service.h"

namespace trident::ros_utils {
namespace {

const std::string kMd5 = ros::service_traits::md5sum<std_srvs::SetBool>();
const std::string kTrue("\x01", 1), kFalse("\0", 1);

/// Text of the Error that a call ends with.
std::string error_of(const std::string& service, const std::string& md5sum = kMd5) {
  try {
    RawServiceClient(service).call(md5sum, kTrue);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// A service of this node, which succeeds or fails.
ros::ServiceServer serve(ros::NodeHandle& node, bool is_success) {
  using Handler = boost::function<bool(std_srvs::SetBoolRequest&, std_srvs::SetBoolResponse&)>;
  return node.advertiseService("/own", Handler([is_success](auto&, auto&) { return is_success; }));
}

void expect_answer(const std::string& bytes, bool success, const std::string& text) {
  std_srvs::SetBoolResponse response;
  std::string copy = bytes;
  ros::serialization::IStream stream(reinterpret_cast<std::uint8_t*>(copy.data()),
                                     static_cast<std::uint32_t>(copy.size()));
  ros::serialization::deserialize(stream, response);
  EXPECT_EQ(response.success, success);
  EXPECT_EQ(response.message, text);
}

TEST(RawService, LearnsTheTypeFromAServerInPythonAndInCpp) {
  ros::NodeHandle node;
  const ros::ServiceServer server = serve(node, true);
  for (const auto& [service, owner] :
       {std::pair{"/repeat", "/serving"}, std::pair{"/own", "/raw_service_check"}}) {
    const ServiceType type = RawServiceClient(service).probe();
    EXPECT_EQ(type.name, "std_srvs/SetBool");
    EXPECT_EQ(type.md5sum, kMd5);
    EXPECT_EQ(type.request, "std_srvs/SetBoolRequest");
    EXPECT_EQ(type.response, "std_srvs/SetBoolResponse");
    EXPECT_EQ(type.node, owner);
  }
}

TEST(RawService, CallsByBytes) {
  RawServiceClient repeat("/repeat");
  expect_answer(repeat.call(kMd5, kFalse), false, "x");
  expect_answer(repeat.call(kMd5, kTrue), true, std::string(1'000'000, 'x'));
  expect_answer(repeat.call("*", kFalse), false, "x");
}

TEST(RawService, WhatAServerReportsIsTheError) {
  EXPECT_EQ(error_of("/object"),
            "the server of /object reports: service cannot process request: the arm is folded");
  ros::NodeHandle node;
  const ros::ServiceServer server = serve(node, false);
  EXPECT_EQ(error_of("/own"), "the server of /own reports a failure, without a text");
}

TEST(RawService, AnotherTypeIsRefusedByTheServer) {
  const std::string error = error_of("/repeat", std::string(32, '0'));
  EXPECT_NE(error.find("the server of /repeat refuses the connection: "), std::string::npos)
      << error;
}

TEST(RawService, OneThatIsNotThereIsAnError) {
  EXPECT_EQ(error_of("/nobody"), "there is no service /nobody");
  EXPECT_THROW(RawServiceClient("/nobody").probe(), Error);
}

TEST(RawService, ACallThatHangsEndsWhenItIsCancelled) {
  RawServiceClient hang("/hang");
  std::string error;
  std::thread caller([&] {
    try {
      hang.call(kMd5, kTrue);
    } catch (const Error& e) {
      error = e.what();
    }
  });
  hang.cancel();
  caller.join();
  EXPECT_EQ(error, "the call of /hang was cancelled");
  EXPECT_THROW(hang.call(kMd5, kTrue), Error);
}

// The last one: the node has ended then.
TEST(RawServiceAtItsEnd, AServerThatDiesDuringTheCallIsAnError) {
  EXPECT_EQ(error_of("/die"), "the server of /die has ended during the call");
  const std::string error = error_of("/repeat");
  EXPECT_NE(error.find("/repeat"), std::string::npos) << error;
  EXPECT_NE(error.find("has ended"), std::string::npos) << error;
}

}  // namespace
}  // namespace trident::ros_utils

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "raw_service_check");
  const ros::NodeHandle keeps_ros_running;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
