#include "bus/probe_answerer.hpp"

#include <gtest/gtest.h>

#include "bus/node.hpp"
#include "bus/own_types.hpp"
#include "bus/wire/lcm_bus.hpp"

namespace priamos::bus {
namespace {

class ProbeAnswererTest : public testing::Test {
 protected:
  void Ask(std::int8_t kind = probe_t::ASKS) {
    probe_t question{};
    question.kind = kind;
    question.instance = 4711;
    question.number = ++number_;
    bus_.Publish("PROBE", Encode(question));
    // A message of memq that is sent while one is handled waits for the next round.
    for (int i = 0; i < 5; ++i) bus_.Drain();
  }
  std::vector<probe_t> Answers() {
    std::vector<probe_t> answers;
    for (const probe_t& message : heard_.Drain())
      if (message.kind == probe_t::ANSWERS) answers.push_back(message);
    return answers;
  }
  Schema schema_ = OwnTypes();
  SimulatedClock clock_{FromUtime(1'000'000'000)};
  LcmBus bus_{"memq://"};
  Node node_{bus_, schema_, clock_};
  Inbox<probe_t> heard_ = node_.SubscribeAll(channels::kProbe);
  ProbeAnswerer dut_{bus_, schema_, clock_, "robot"};
  std::int32_t number_ = 0;
};

TEST_F(ProbeAnswererTest, AnswersWhoAsksAndSaysWhereItIs) {
  Ask();
  const auto answers = Answers();
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].instance, 4711);
  EXPECT_EQ(answers[0].number, 1);
  EXPECT_EQ(answers[0].process, "robot");
  EXPECT_EQ(answers[0].host, ThisHost().name);
  EXPECT_EQ(answers[0].host_id, ThisHost().IdAt(""));
  EXPECT_EQ(answers[0].utime, 1'000'000'000);
  EXPECT_FALSE(answers[0].alone);
}

TEST_F(ProbeAnswererTest, AnAnswerIsNotAnswered) {
  Ask(probe_t::ANSWERS);
  Ask(7);
  EXPECT_EQ(dut_.answers(), 0U);
}

TEST_F(ProbeAnswererTest, AFloodOfQuestionsMakesNone) {
  for (int i = 0; i < 1000; ++i) Ask();
  EXPECT_EQ(dut_.answers(), 10U);
  clock_.Set(clock_.Now() + std::chrono::seconds(1));
  for (int i = 0; i < 1000; ++i) Ask();
  EXPECT_EQ(dut_.answers(), 20U);
}

TEST_F(ProbeAnswererTest, WhatIsNoQuestionDoesNoHarm) {
  auto bytes = Encode(probe_t{});
  for (std::size_t size = 0; size < bytes.size(); ++size)
    bus_.Publish("PROBE", std::span<const std::byte>(bytes).first(size));
  bytes[20] = std::byte{0xff};
  bus_.Publish("PROBE", bytes);
  bus_.Publish("PROBE", Encode(claim_t{}));
  bus_.Drain();
  SUCCEED();
}

TEST(MakeProbe, TellsByWhichWayItSends) {
  const probe_t probe = MakeProbe({"vision", "", 5}, "a-name-of-more-than-16-letters",
                                  "udpm://239.255.1.67:20000?ttl=3&network=127.0.0.1", Time{});
  EXPECT_EQ(probe.network, "lo");
  EXPECT_EQ(probe.ttl, 3);
  EXPECT_EQ(probe.process.size(), 16U);
}

}  // namespace
}  // namespace priamos::bus
