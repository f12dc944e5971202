// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
#include "run/server_options.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "run/server_params.h"
#include "trident_ros/node_params.h"

namespace trident::sim {
namespace {

using XmlRpc::XmlRpcValue;

ServerOptions options_of(const XmlRpcValue& value, const std::vector<std::string>& words = {}) {
  return server_options_of("/gazebo", value, words);
}

std::string error_of(const XmlRpcValue& value, const std::vector<std::string>& words = {}) {
  try {
    options_of(value, words);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ServerOptions, ArgumentsComeBeforeParametersAndTheseBeforeTheEnvironment) {
  setenv("TRIDENT_SEED", "3", 1);
  setenv("TRIDENT_WAIT_FOR", "2", 1);
  XmlRpcValue value;
  EXPECT_EQ(options_of(value).seed, 3U);
  EXPECT_EQ(options_of(value).wait_for, 2);
  value["seed"] = 5;
  value["wait_for"] = 0;
  EXPECT_EQ(options_of(value).seed, 5U);
  EXPECT_EQ(options_of(value).wait_for, 0);
  EXPECT_EQ(options_of(value, {"--seed", "7"}).seed, 7U);
  unsetenv("TRIDENT_SEED");
  unsetenv("TRIDENT_WAIT_FOR");
}

TEST(ServerOptions, WaitForIsANumberOrNames) {
  XmlRpcValue value;
  value["wait_for"][0] = "boat";
  value["wait_for"][1] = "buoy";
  EXPECT_EQ(options_of(value).wait_for, 2);
  EXPECT_EQ(options_of(value).wait_for_models, (std::vector<std::string>{"boat", "buoy"}));
}

TEST(ServerOptions, AnEmptyPolicyAsksForNothing) {
  XmlRpcValue value;
  value["lockstep_policy"] = "";
  EXPECT_TRUE(options_of(value).has_default_policy);
  value["lockstep_policy"] = "pause";
  EXPECT_FALSE(options_of(value).has_default_policy);
  EXPECT_EQ(options_of(value).loss.policy, LossPolicy::kPause);
  setenv("TRIDENT_LOCKSTEP_POLICY", "hope", 1);
  EXPECT_EQ(options_of(value).loss.policy, LossPolicy::kPause);
  EXPECT_EQ(error_of(XmlRpcValue()),
            "TRIDENT_LOCKSTEP_POLICY is 'hope', must be free_run, wait or pause");
  unsetenv("TRIDENT_LOCKSTEP_POLICY");
}

TEST(ServerOptions, AnswersHaveTheNamesOfPorts) {
  XmlRpcValue value;
  value["answers"]["nav"]["state"] = "/scan";
  value["answers"]["nav"]["commands"][0] = "cmd_vel";
  value["answers"]["nav"]["reader"] = "nav";
  const AnswerOptions answer = options_of(value).answers.at("nav");
  EXPECT_EQ(answer.state, "scan");
  EXPECT_EQ(answer.commands, std::vector<std::string>{"cmd_vel"});
  EXPECT_EQ(answer.reader, "/nav");
  EXPECT_EQ(answer.delay_s, 0.01);
  value["answers"]["nav"]["delay"] = 11;
  EXPECT_EQ(error_of(value),
            "parameter /gazebo/answers/nav/delay: 11 is out of range; must be a number in [0, 10] "
            "s");
  value["answers"]["nav"]["delay"] = 1;
  value["answers"]["nav"]["commands"][0] = "/";
  EXPECT_EQ(
      error_of(value),
      "parameter /gazebo/answers/nav: state and commands must name topics, at least one each");
  value["answers"]["nav"]["commands"][0] = 3;
  EXPECT_NE(error_of(value).find("parameter /gazebo/answers/nav: topic '3': "), std::string::npos);
}

TEST(ServerOptions, ErrorsAndWarningsNameTheParameter) {
  XmlRpcValue value;
  value["timing"] = "fast";
  EXPECT_EQ(error_of(value),
            "parameter /gazebo/timing: must be one of rotors, direct, but is the text 'fast'");
  value["timing"] = "direct";
  value["real_time_facter"] = 3.0;
  value["use_sim_time"] = "maybe";
  value["enable_ros_network"] = true;
  EXPECT_EQ(options_of(value).warnings,
            (std::vector<std::string>{
                "argument use_sim_time of the launch file is the text 'maybe', legal: true or "
                "false; taken as true",
                "parameter /gazebo/real_time_facter is unknown, not used; did you mean "
                "real_time_factor?"}));
}

TEST(ServerOptions, TheReferenceIsThatOfTheStruct) {
  const std::string page = ros_utils::params_page(
      "gazebo",
      "Private parameters of the simulator (`/gazebo/...`), printed from the server's struct.\n"
      "Environment variables and arguments: see architecture.md.",
      ros_utils::document_params<ServerParams>());
  EXPECT_EQ(ros_utils::page_on_disk(PARAMETER_PAGES "/gazebo.md", page), page)
      << "set TRIDENT_WRITE_DOCS=1 to write it";
}

}  // namespace
}  // namespace trident::sim
