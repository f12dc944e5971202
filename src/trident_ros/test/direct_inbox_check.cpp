// SPDX-FileCopyrightText: 2026 The Trident authors
// SPDX-License-Identifier: Apache-2.0
//
// Talks to echo_node.py; run by test_direct_inbox.py.
#include <gtest/gtest.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "trident_ros/direct_inbox.h"
#include "trident_ros/direct_publication.h"

namespace trident::ros_utils {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

std::string text_of(Span<const std::uint8_t> bytes) {
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  std_msgs::String message;
  ros::serialization::deserialize(stream, message);
  return message.data;
}

class DirectInboxTest : public testing::Test {
 protected:
  DirectInboxTest()
      : questions_(node_.advertise<std_msgs::String>("question", 1000)),
        direct_(questions_),
        answers_(inbox_.subscribe<std_msgs::String>(
            node_, "answer", 1000,
            [this](Span<const std::uint8_t> bytes) { got_.push_back(text_of(bytes)); })) {
    EXPECT_TRUE(spin([this] { return direct_.subscribers() > 0 && answers_->publishers() > 0; }));
  }

  bool spin(const std::function<bool()>& condition) {
    const auto limit = Clock::now() + 20s;
    while (!condition() && Clock::now() < limit) {
      if (inbox_.wait(2ms)) inbox_.read();
    }
    return condition();
  }

  void ask(const std::string& text) {
    std_msgs::String message;
    message.data = text;
    const auto frame = ros::serialization::serializeMessage(message);
    direct_.send({frame.buf.get(), frame.num_bytes});
  }

  // Asks until an answer comes: the answering side may still be connecting.
  bool is_answered() {
    const std::size_t before = got_.size();
    const auto limit = Clock::now() + 20s;
    while (got_.size() == before && Clock::now() < limit) {
      ask("there?");
      const auto patience = Clock::now() + 50ms;
      while (got_.size() == before && Clock::now() < patience) {
        if (inbox_.wait(2ms)) inbox_.read();
      }
    }
    return got_.size() > before;
  }

  // Answers to is_answered() that came late are not of interest.
  std::vector<std::string> answers() const {
    std::vector<std::string> result;
    for (const std::string& text : got_) {
      if (text != "there?") result.push_back(text);
    }
    return result;
  }

  ros::NodeHandle node_;
  std::vector<std::string> got_;
  DirectInbox inbox_;
  ros::Publisher questions_;
  DirectPublication direct_;
  std::unique_ptr<DirectSubscription> answers_;
};

TEST_F(DirectInboxTest, EveryMessageComesOnceAndInOrder) {
  ASSERT_TRUE(is_answered());
  std::vector<std::string> sent;
  for (int i = 0; i < 2000; ++i) {
    sent.push_back(std::to_string(i));
    ask(sent.back());
  }
  EXPECT_TRUE(spin([&] { return answers().size() >= sent.size(); }));
  EXPECT_EQ(answers(), sent);
  EXPECT_EQ(inbox_.link_count(), 1U);
}

TEST_F(DirectInboxTest, ReportsTheProcessThatSends) {
  ASSERT_TRUE(is_answered());
  ask("process");
  ASSERT_TRUE(spin([&] { return answers().size() == 1 && inbox_.link_count() == 1; }));
  EXPECT_EQ(answers_->processes(), std::vector<pid_t>{std::stoi(answers().front())});
}

TEST_F(DirectInboxTest, MessagesLongerThanAReadArriveWhole) {
  ASSERT_TRUE(is_answered());
  std::vector<std::string> sent;
  for (const std::size_t length : {0U, 1U, 65535U, 65536U, 3'000'000U, 10U, 200'000U}) {
    sent.emplace_back(length, static_cast<char>('a' + sent.size()));
    ask(sent.back());
  }
  EXPECT_TRUE(spin([&] { return answers().size() >= sent.size(); }));
  EXPECT_TRUE(answers() == sent);  // not EXPECT_EQ: it would print megabytes
}

TEST_F(DirectInboxTest, APublisherThatComesBackIsHeardAgain) {
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(is_answered());
    EXPECT_TRUE(spin([&] { return inbox_.link_count() == 1; }));
    ask("reconnect");
    EXPECT_TRUE(spin([&] { return inbox_.link_count() == 0; }));
  }
  ASSERT_TRUE(is_answered());
  ask("after");
  EXPECT_TRUE(spin([&] { return answers().size() == 1; }));
  EXPECT_EQ(answers(), std::vector<std::string>{"after"});
}

TEST_F(DirectInboxTest, NothingComesAfterTheSubscriptionHasEnded) {
  ASSERT_TRUE(is_answered());
  ask("unread");
  answers_.reset();
  const std::size_t before = got_.size();
  for (int i = 0; i < 10; ++i) {
    if (inbox_.wait(2ms)) inbox_.read();
  }
  EXPECT_EQ(got_.size(), before);
  answers_ = inbox_.subscribe<std_msgs::String>(
      node_, "answer", 10,
      [this](Span<const std::uint8_t> bytes) { got_.push_back(text_of(bytes)); });
  EXPECT_TRUE(is_answered());
}

TEST_F(DirectInboxTest, MessagesOfThisProcessPassThroughRoscpp) {
  ros::Publisher own = node_.advertise<std_msgs::String>("answer", 10);
  EXPECT_TRUE(spin([&] { return answers_->publishers() == 2; }));
  std_msgs::String message;
  for (const char* text : {"one", "two", "three"}) {
    message.data = text;
    own.publish(message);
  }
  EXPECT_TRUE(spin([&] { return answers().size() == 3; }));
  EXPECT_EQ(answers(), (std::vector<std::string>{"one", "two", "three"}));
}

/// Publisher and subscriber in this process, on a topic of their own.
class InsideTest : public testing::Test {
 protected:
  InsideTest()
      : publisher_(node_.advertise<std_msgs::String>("inside", 10)),
        direct_(publisher_),
        subscription_(inbox_.subscribe<std_msgs::String>(
            node_, "inside", 10,
            [this](Span<const std::uint8_t> bytes) { bytes_.push_back(text_of(bytes)); },
            [this](const std_msgs::String& message) { on_object(message); })) {}

  void on_object(const std_msgs::String& message) {
    objects_.push_back(&message);
    texts_.push_back(message.data);
    if (message.data == "ask again") send("from a handler");
  }
  boost::shared_ptr<const std_msgs::String> send(const std::string& text) {
    auto message = boost::make_shared<std_msgs::String>();
    message->data = text;
    ObjectMessage<std_msgs::String> outgoing(message);
    direct_.send(outgoing);
    return message;
  }
  void read() {
    if (inbox_.wait(0ms)) inbox_.read();
  }

  ros::NodeHandle node_;
  std::vector<std::string> bytes_, texts_;
  std::vector<const std_msgs::String*> objects_;
  DirectInbox inbox_{DirectInbox::Sockets::kReadByRoscpp};
  ros::Publisher publisher_;
  DirectPublication direct_;
  std::unique_ptr<DirectSubscription> subscription_;
};

TEST_F(InsideTest, AnObjectComesAsItIsAndOnce) {
  const auto first = send("one"), second = send("two");
  EXPECT_TRUE(objects_.empty());  // handlers run in read() only
  read();
  EXPECT_EQ(objects_, (std::vector<const std_msgs::String*>{first.get(), second.get()}));
  EXPECT_TRUE(bytes_.empty());
}

TEST_F(InsideTest, EverySubscriberGetsTheFormThatItTakes) {
  std::vector<std::string> raw;
  const auto also = inbox_.subscribe<std_msgs::String>(
      node_, "inside", 10,
      [&raw](Span<const std::uint8_t> bytes) { raw.push_back(text_of(bytes)); });
  const auto sent = send("one");
  read();
  EXPECT_EQ(objects_, std::vector<const std_msgs::String*>{sent.get()});
  EXPECT_EQ(raw, std::vector<std::string>{"one"});
  std_msgs::String two;
  two.data = "two";
  const auto frame = ros::serialization::serializeMessage(two);
  direct_.send({frame.buf.get(), frame.num_bytes});
  read();
  EXPECT_EQ(bytes_, std::vector<std::string>{"two"});
  EXPECT_EQ(raw, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(objects_.size(), 1U);
}

TEST_F(InsideTest, AHandlerMayPublishToItsOwnInbox) {
  send("ask again");
  read();
  read();
  EXPECT_EQ(texts_, (std::vector<std::string>{"ask again", "from a handler"}));
}

TEST_F(InsideTest, ASubscriberOfRoscppGetsTheObject) {
  boost::shared_ptr<const std_msgs::String> got;
  ros::CallbackQueue queue;
  ros::NodeHandle node;
  node.setCallbackQueue(&queue);
  const ros::Subscriber subscriber = node.subscribe<std_msgs::String>(
      "inside", 1, [&got](const boost::shared_ptr<const std_msgs::String>& m) { got = m; });
  const auto sent = send("one");
  queue.callAvailable();
  EXPECT_EQ(got.get(), sent.get());
}

TEST(MessagePool, GivesWhatNobodyHoldsAnyMore) {
  MessagePool<std_msgs::String> pool;
  auto first = pool.take();
  const auto second = pool.take();
  EXPECT_NE(first.get(), second.get());
  const auto* const address = first.get();
  first.reset();
  EXPECT_EQ(pool.take().get(), address);
  std::vector<boost::shared_ptr<std_msgs::String>> held;
  for (int i = 0; i < 100; ++i) held.push_back(pool.take());
  std::sort(held.begin(), held.end());
  EXPECT_EQ(std::adjacent_find(held.begin(), held.end()), held.end());
}

TEST(DirectInboxWaits, UntilItIsWokenOrTheTimeIsOver) {
  DirectInbox inbox;
  EXPECT_FALSE(inbox.wait(1ms));
  std::thread waker([&inbox] { inbox.wake(); });
  EXPECT_TRUE(inbox.wait(20s));
  waker.join();
  inbox.read();
  EXPECT_FALSE(inbox.wait(1ms));
}

}  // namespace
}  // namespace trident::ros_utils

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "direct_inbox_check");
  const ros::NodeHandle keeps_ros_running;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
