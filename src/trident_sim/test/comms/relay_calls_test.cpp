// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
// Calls of services between robots of a world by the rules of a file.
#include "comms/relay/relay_calls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "relay_world.h"
#include "trident_base/random_stream.h"

namespace trident::sim {
namespace {

constexpr const char* kCallRules = R"(
radio: {tx_power: 10.0, height: 0.5}
model: {path: free_space, shadowing_sigma: 0}
rules:
  - {service: arm, from: [a], to: [b], deadline: 2.0, depth: 3, priority: 0}
  - {service: ask, deadline: 5.0, delay: 0.5}
)";

const RelayService kArm{"", "a", "b", "arm"};

/// A world and the nodes around it: servers answer as soon as the world lets them.
class CallWorld {
 public:
  explicit CallWorld(const std::string& rules = kCallRules, double distance_m = 50.0,
                     const ParamList& air = {{"path", "log_distance"}})
      : world(rules, distance_m, air) {}

  RelayServices& services() { return *find_relay_services(*world.world); }
  std::uint64_t call(const RelayService& service, const std::string& request) {
    return services().call(service, std::make_shared<const std::string>(request));
  }
  void answer(std::uint64_t number, const std::string& text, bool is_answered = true) {
    services().answer({number, is_answered, std::make_shared<const std::string>(text)});
  }
  /// Steps; what is due is answered by "re: " and the request.
  void step(int steps) {
    for (int i = 0; i < steps; ++i) {
      std::vector<ServedCall> rest;
      for (const ServedCall& served : waiting) {
        if (served.due > world.world->time() || !has_server) {
          rest.push_back(served);
        } else {
          answer(served.number, "re: " + *served.request);
        }
      }
      waiting = rest;
      world.world->step();
      for (ServedCall& served : services().take_served()) {
        requests.push_back(served.service.server + ": " + *served.request);
        waiting.push_back(std::move(served));
      }
      for (CallResult& result : services().take_results()) {
        ends_s.push_back(world.world->time().seconds());
        results.push_back(std::move(result));
      }
    }
  }
  CallCounts counts() { return find_relay(*world.world)->calls().at(0).counts; }

  RelayWorld world;
  bool has_server = true;
  std::vector<ServedCall> waiting;
  std::vector<std::string> requests;
  std::vector<CallResult> results;
  std::vector<double> ends_s;
};

/// Of the one call that has ended.
std::string error_of_call(CallWorld& world) {
  if (world.results.size() != 1 || world.results[0].is_answered) return "not one error";
  return *world.results[0].data;
}

TEST(RelayCalls, TheAnswerOfTheOtherRobotsServerComesByRadio) {
  CallWorld two;
  two.step(3);
  const std::uint64_t number = two.call(kArm, std::string("x\0y", 3));
  two.step(1);
  EXPECT_EQ(two.requests, (std::vector<std::string>{std::string("b: x\0y", 6)}));
  EXPECT_TRUE(two.results.empty());
  two.step(1);
  ASSERT_EQ(two.results.size(), 1u);
  EXPECT_EQ(two.results[0].number, number);
  EXPECT_TRUE(two.results[0].is_answered);
  EXPECT_EQ(*two.results[0].data, std::string("re: x\0y", 7));
  two.step(300);
  EXPECT_EQ(two.results.size(), 1u);
  EXPECT_EQ(two.requests.size(), 1u);
  EXPECT_EQ(two.counts().answered, 1u);
  EXPECT_GT(two.counts().max_delay_s, 0.01);
  EXPECT_LT(two.counts().max_delay_s, 0.02);
}

TEST(RelayCalls, OnlyWhatARuleAllowsMayBeCalled) {
  CallWorld two;
  std::vector<std::string> names;
  for (const RelayService& service : two.services().services()) {
    names.push_back(service.caller + "/to/" + service.server + "/" + service.name + ", " +
                    service.rule);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"a/to/b/arm, rule 1 (arm)", "a/to/b/ask, rule 2 (ask)",
                                             "b/to/a/ask, rule 2 (ask)"}));
  for (const RelayService& service : std::vector<RelayService>{{"", "b", "a", "arm"},
                                                               {"", "a", "b", "disarm"},
                                                               {"", "a", "c", "ask"},
                                                               {"", "a", "a", "ask"}}) {
    EXPECT_TRUE(contains(error_of([&] { two.call(service, ""); }), "no rule lets"));
  }
  EXPECT_TRUE(find_relay(*two.world.world)->flows().empty());
}

TEST(RelayCalls, BothMayCallEachOtherByOneRule) {
  CallWorld two;
  two.call({"", "a", "b", "ask"}, "of a");
  two.call({"", "b", "a", "ask"}, "of b");
  two.step(100);
  std::vector<std::string> answers;
  for (const CallResult& result : two.results) answers.push_back(*result.data);
  std::sort(answers.begin(), answers.end());
  EXPECT_EQ(answers, (std::vector<std::string>{"re: of a", "re: of b"}));
}

TEST(RelayCalls, AnAnswerLeavesAfterTheDelay) {
  CallWorld two;
  two.call({"", "a", "b", "ask"}, "x");
  two.step(200);
  ASSERT_EQ(two.results.size(), 1u);
  EXPECT_GT(two.ends_s[0], 0.5);
  EXPECT_LT(two.ends_s[0], 0.53);
}

TEST(RelayCalls, AnErrorOfTheServerIsTheCallers) {
  CallWorld two;
  two.has_server = false;
  const std::uint64_t number = two.call(kArm, "x");
  two.step(10);
  two.answer(number, "there is no service /b/arm", false);
  two.answer(number, "twice");
  two.step(10);
  EXPECT_EQ(error_of_call(two),
            "rule 1 (arm): the call of a to b/arm has failed: there is no service /b/arm");
  EXPECT_EQ(two.counts().failed, 1u);
}

TEST(RelayCalls, AtItsDeadlineACallIsOneError) {
  const auto end_of = [](const std::function<void(CallWorld&)>& disturb) {
    CallWorld two;
    two.step(3);
    two.call(kArm, "x");
    disturb(two);
    two.step(600);
    EXPECT_EQ(two.counts().expired, 1u);
    EXPECT_EQ(two.ends_s, (std::vector<double>{2.03}));
    return error_of_call(two);
  };
  const auto out = [](CallWorld& two, double until_s) {
    find_radio(*two.world.world)->set_outage("b", "", SimTime::from_seconds(until_s));
  };
  const std::string begin = "rule 1 (arm): the call of a to b/arm has no answer after 2 s: ";
  EXPECT_EQ(end_of([&](CallWorld& two) { out(two, 1000.0); }),
            begin + "its request has not arrived");
  EXPECT_EQ(end_of([&](CallWorld& two) { two.has_server = false; }),
            begin + "its server has not answered");
  EXPECT_EQ(end_of([&](CallWorld& two) {
              two.step(1);
              out(two, 1000.0);
            }),
            begin + "the answer has not arrived");
}

TEST(RelayCalls, OutlastAnOutageThatIsShorterThanTheDeadline) {
  CallWorld two;
  find_radio(*two.world.world)->set_outage("b", "", SimTime::from_seconds(1.0));
  two.call(kArm, "x");
  two.step(200);
  ASSERT_EQ(two.results.size(), 1u);
  EXPECT_TRUE(two.results[0].is_answered);
  EXPECT_GT(two.ends_s[0], 1.0);
}

TEST(RelayCalls, AnAnswerAfterTheDeadlineIsNobodys) {
  CallWorld two;
  two.has_server = false;
  two.call(kArm, "x");
  two.step(300);
  ASSERT_EQ(two.results.size(), 1u);
  two.has_server = true;
  two.step(100);
  EXPECT_EQ(two.results.size(), 1u);
}

TEST(RelayCalls, MoreThanDepthAtOnceAreRefused) {
  CallWorld two;
  for (int i = 0; i < 5; ++i) two.call(kArm, std::to_string(i));
  two.step(1);
  ASSERT_EQ(two.results.size(), 2u);
  EXPECT_EQ(*two.results[0].data,
            "rule 1 (arm): the call of a to b/arm is refused: 3 others are in progress, legal: "
            "fewer than depth");
  two.step(10);
  EXPECT_EQ(two.results.size(), 5u);
  EXPECT_EQ(two.counts().called, 5u);
  EXPECT_EQ(two.counts().refused, 2u);
  EXPECT_EQ(two.counts().answered, 3u);
}

TEST(RelayCalls, ARobotThatGoesEndsItsCalls) {
  CallWorld two;
  two.has_server = false;
  two.call(kArm, "x");
  two.step(10);
  two.world.world->remove("b");
  two.step(1);
  EXPECT_EQ(error_of_call(two),
            "rule 1 (arm): the call of a to b/arm has ended: there is no radio 'b' any more");
  EXPECT_EQ(two.counts().aborted, 1u);
  EXPECT_TRUE(two.services().services().empty());
}

TEST(RelayCalls, OneThatIsAbortedHasOneResult) {
  CallWorld two;
  const std::uint64_t number = two.call(kArm, "x");
  two.services().abort(number, "nobody waits");
  two.services().abort(number, "twice");
  two.step(300);
  EXPECT_EQ(error_of_call(two), "rule 1 (arm): the call of a to b/arm has ended: nobody waits");
  EXPECT_EQ(two.counts().aborted, 1u);
}

TEST(RelayCalls, AResetEndsThem) {
  CallWorld two;
  two.call(kArm, "x");
  two.step(1);
  two.waiting.clear();
  two.world.world->reset();
  two.step(300);
  EXPECT_EQ(error_of_call(two),
            "rule 1 (arm): the call of a to b/arm has ended: the world was reset");
  EXPECT_TRUE(find_relay(*two.world.world)->calls().empty());
  two.results.clear();
  two.call(kArm, "y");
  two.step(10);
  ASSERT_EQ(two.results.size(), 1u);
  EXPECT_EQ(*two.results[0].data, "re: y");
}

/// Long requests at the edge of reach, where frames are lost.
std::vector<std::string> long_calls(bool with_snapshot, std::string* hash) {
  CallWorld two(kCallRules, 1000.0, {});
  for (int i = 0; i < 50; ++i) {
    two.call({"", "a", "b", "ask"}, std::string(5000, 'x') + std::to_string(i));
    two.step(20);
    if (!with_snapshot || i != 20) continue;
    const Snapshot snapshot = two.world.world->save_snapshot();
    const CallWorld* const outside = &two;
    const auto waiting = outside->waiting;
    const auto results = outside->results;
    two.step(30);
    two.world.world->restore_snapshot(snapshot);
    two.waiting = waiting;
    two.results = results;
  }
  two.step(300);
  *hash = two.world.world->state_hash();
  std::vector<std::string> answers;
  for (const CallResult& result : two.results) {
    EXPECT_TRUE(result.is_answered) << *result.data;
    answers.push_back(*result.data);
  }
  return answers;
}

TEST(RelayCalls, RepeatWithAndWithoutSnapshots) {
  std::string hash, other_hash;
  const auto answers = long_calls(false, &hash);
  EXPECT_EQ(answers.size(), 50u);
  EXPECT_EQ(long_calls(true, &other_hash), answers);
  EXPECT_EQ(other_hash, hash);
}

TEST(RelayCalls, ARobotThatHasNoRadioIsNamedOnce) {
  RelayWorld two("rules:\n  - {service: arm, to: [ship], deadline: 1.0}\n");
  two.world->step(600);
  EXPECT_EQ(two.world.report_count(Severity::kWarning, "rule 1 (arm): there is no radio 'ship'"),
            1u);
  EXPECT_EQ(two.world.reports.size(), 1u);
}

}  // namespace
}  // namespace trident::sim
