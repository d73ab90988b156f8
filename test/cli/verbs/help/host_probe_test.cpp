#include "cli/verbs/help/host_probe.hpp"

#include <gmock/gmock.h>

namespace priamos::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Verdict = Finding::Verdict;

constexpr std::int32_t kOwn = 1, kVision = 2, kInstance = 77;
constexpr const char* kTheirs = "10.77.0.2";
constexpr Time kBegin{std::chrono::hours(400000)};

/// Three questions were asked on the robot's bus.
class HostProbeTest : public testing::Test {
 protected:
  static HostProbe::Self Self(int ttl = 1) {
    return {kOwn, kInstance, {"127.0.0.1", "10.77.0.1"}, "eth1", ttl, "udpm://239.255.1.67:20000?ttl=1"};
  }
  explicit HostProbeTest(int ttl = 1) : dut_(Self(ttl)) {
    for (int i = 0; i < 3; ++i) dut_.Asked(kBegin + i * std::chrono::milliseconds(400));
  }
  static probe_t Answer(std::int32_t number, std::int32_t host = kVision) {
    probe_t message{};
    message.kind = probe_t::ANSWERS;
    message.instance = kInstance;
    message.number = number;
    message.host_id = host;
    message.host = "vision";
    message.process = "head";
    message.network = "eth0";
    message.ttl = 1;
    return message;
  }
  void Answered(bool alone, int count = 3) {
    for (int i = 1; i <= count; ++i) dut_.HearProbe(Answer(i), kTheirs, alone, kBegin);
  }
  Finding Only(const std::vector<std::string>& expected = {}) const {
    const auto findings = dut_.Findings(expected);
    EXPECT_EQ(findings.size(), 1U);
    return findings.front();
  }
  HostProbe dut_;
};

TEST_F(HostProbeTest, WhoAnswersToTheBusIsReachedBothWays) {
  Answered(false);
  Answered(true);
  EXPECT_EQ(Only().verdict, Verdict::kGood);
  EXPECT_EQ(Only().what, "host vision (10.77.0.2)");
  EXPECT_THAT(Only().found, HasSubstr("3 of 3 questions answered, by 1 process, by eth0 with ttl 1"));
}

TEST_F(HostProbeTest, TheClockOfAHostIsMeasured) {
  probe_t answer = Answer(3);
  const Time asked = kBegin + std::chrono::milliseconds(800);
  answer.utime = ToUtime(asked + std::chrono::milliseconds(1) - std::chrono::seconds(3));
  dut_.HearProbe(answer, kTheirs, false, asked + std::chrono::milliseconds(2));
  EXPECT_THAT(Only().found, HasSubstr("its clock is 3.0000 s behind, to 1.0 ms"));
  answer.utime = ToUtime(asked + std::chrono::microseconds(300));
  dut_.HearProbe(answer, kTheirs, false, asked + std::chrono::microseconds(500));
  EXPECT_THAT(Only().found, HasSubstr("its clock agrees to 0.3 ms"));
}

TEST_F(HostProbeTest, AMachineThatWasCopiedWhileItRanIsNamed) {
  probe_t answer = Answer(3);
  answer.utime = ToUtime(kBegin + std::chrono::seconds(3));
  dut_.HearProbe(answer, kTheirs, false, kBegin + std::chrono::milliseconds(802));
  dut_.HearNumber("10.77.0.1", 5);
  dut_.HearNumber("127.0.0.1", 5);
  dut_.HearNumber(kTheirs, 6);
  EXPECT_THAT(Only().found, HasSubstr("processes translate its stamps")) << "each host has its own number";
  dut_.HearNumber(kTheirs, 5);
  const auto findings = dut_.Findings({});
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_THAT(findings[0].found, testing::Not(HasSubstr("translate")));
  EXPECT_EQ(findings[1].verdict, Verdict::kBad);
  EXPECT_THAT(findings[1].found, StartsWith("vision (10.77.0.2) and this host run with one clock's number"));
  EXPECT_THAT(findings[1].command, HasSubstr("start the processes of the copy again"));
}

TEST_F(HostProbeTest, AClockThatIsNotKnownExactlyEnoughIsNamed) {
  Answered(false);
  health_t health{};
  health.process = "head";
  health.clock_uncertainty_s = 0.02;
  dut_.HearClock(kTheirs, health);
  EXPECT_EQ(Only().what, "host vision (10.77.0.2)");
  health.clock_uncertainty_s = 0.0212;
  dut_.HearClock(kTheirs, health);
  health.process = "ro\x1b[31mbot";
  health.clock_uncertainty_s = -1;
  dut_.HearClock("10.77.0.1", health);
  const auto findings = dut_.Findings({});
  ASSERT_EQ(findings.size(), 3U);
  EXPECT_EQ(findings[1].what, "clock of ro??31mbot on this host");
  EXPECT_THAT(findings[1].found, StartsWith("not known against the reference of the bus, 20 ms expected"));
  EXPECT_EQ(findings[2].what, "clock of head on vision (10.77.0.2)");
  EXPECT_THAT(findings[2].found, StartsWith("known to 21 ms against"));
  EXPECT_EQ(findings[2].verdict, Verdict::kBad);
  for (int i = 0; i < 10'000; ++i) {
    health.process = std::to_string(i);
    dut_.HearClock(kTheirs, health);
  }
  EXPECT_LE(dut_.Findings({}).size(), 300U);
}

TEST_F(HostProbeTest, AnAnswerToNoQuestionTellsNothing) {
  dut_.HearProbe(Answer(0), kTheirs, false, kBegin);
  dut_.HearProbe(Answer(4), kTheirs, false, kBegin);
  EXPECT_EQ(Only().verdict, Verdict::kBad);
}

TEST_F(HostProbeTest, LostAnswersAreCounted) {
  Answered(false, 2);
  EXPECT_EQ(Only().verdict, Verdict::kNotNeededYet);
  EXPECT_THAT(Only().found, HasSubstr("2 of 3 questions answered"));
}

TEST_F(HostProbeTest, WhoAnswersToTheSocketAloneDoesNotReachTheBus) {
  Answered(true);
  EXPECT_EQ(Only().verdict, Verdict::kBad);
  EXPECT_EQ(Only().what, "way from vision (10.77.0.2) to here");
  EXPECT_THAT(Only().found, HasSubstr("nothing that it sends to the bus (by eth0 with ttl 1) arrives here"));
}

TEST_F(HostProbeTest, ATtlOf0ThereIsNamed) {
  probe_t answer = Answer(1);
  answer.ttl = 0;
  dut_.HearProbe(answer, kTheirs, true, kBegin);
  EXPECT_THAT(Only().command, StartsWith("export PRIAMOS_TTL=1   # there"));
}

TEST_F(HostProbeTest, WhoIsHeardAndDoesNotAnswerIsNotReached) {
  dut_.HearOther(kTheirs);
  dut_.HearOther(kTheirs, "vision");
  dut_.HearOther(kTheirs);
  EXPECT_EQ(Only().verdict, Verdict::kBad);
  EXPECT_EQ(Only().what, "way from here to vision (10.77.0.2)");
  EXPECT_THAT(Only().found, HasSubstr("answered none of 3 questions"));
  EXPECT_THAT(Only().command, HasSubstr("udp port 20000"));
}

TEST_F(HostProbeTest, AQuestionFromThereIsAMessageFromThere) {
  probe_t question = Answer(1);
  question.kind = probe_t::ASKS;
  question.instance = 5;
  dut_.HearProbe(question, kTheirs, false, kBegin);
  EXPECT_EQ(Only().what, "way from here to vision (10.77.0.2)");
}

TEST_F(HostProbeTest, AnswersToAnotherAskerAreNoAnswers) {
  probe_t answer = Answer(1);
  answer.instance = 5;
  dut_.HearProbe(answer, kTheirs, false, kBegin);
  EXPECT_EQ(Only().what, "way from here to vision (10.77.0.2)");
}

TEST_F(HostProbeTest, ItsOwnProcessesAreNoOtherHost) {
  dut_.HearProbe(Answer(1, kOwn), "10.77.0.1", false, kBegin);
  dut_.HearOther("10.77.0.1", "base");
  dut_.HearOther("localhost");
  EXPECT_EQ(Only().what, "other hosts");
  EXPECT_EQ(Only().verdict, Verdict::kNotNeededYet) << "a lone computer: nothing has to be wrong";
  EXPECT_THAT(
      Only().found,
      HasSubstr("none is heard, and none answered 3 questions sent by eth1 with ttl 1: whether one is "
                "there and cut off both ways cannot be told from here"));
  EXPECT_EQ(dut_.Findings({"vision"}).front().verdict, Verdict::kBad) << "unless one is expected";
}

TEST_F(HostProbeTest, WhoIsExpectedAndNotThereIsNamed) {
  Answered(false);
  EXPECT_EQ(dut_.Findings({"vision"}).size(), 1U);
  const auto findings = dut_.Findings({"vision", "arm"});
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[1].what, "way from arm to here");
  EXPECT_EQ(findings[1].verdict, Verdict::kBad);
  EXPECT_THAT(findings[1].command,
              HasSubstr("priamos doctor --probe --bus 'udpm://239.255.1.67:20000?ttl=1'"));
}

TEST_F(HostProbeTest, TwoHostsOfOneNameAreTwo) {
  Answered(false);
  dut_.HearProbe(Answer(1, 3), "10.77.0.3", true, kBegin);
  EXPECT_EQ(dut_.Findings({}).size(), 2U);
}

TEST_F(HostProbeTest, ARadioThatHearsNothingIsNamed) {
  Answered(false);
  link_status_t status{};
  status.up = true;
  dut_.HearLink(status);
  EXPECT_EQ(dut_.Findings({}).back().what, "radio of the workstation's end");
  EXPECT_EQ(dut_.Findings({}).back().verdict, Verdict::kGood);
  status.loss = 0.3;
  dut_.HearLink(status);
  EXPECT_THAT(dut_.Findings({}).back().found, HasSubstr("30 % of what the robot's end sends is lost"));
  status.up = false;
  dut_.HearLink(status);
  EXPECT_EQ(dut_.Findings({}).back().verdict, Verdict::kBad);
  EXPECT_THAT(dut_.Findings({}).back().found, HasSubstr("cut: nothing of the robot's end is heard"));
  status.table_mismatch = true;
  dut_.HearLink(status);
  EXPECT_THAT(dut_.Findings({}).back().found, HasSubstr("another table of channels"));
  status.onboard = true;
  dut_.HearLink(status);
  EXPECT_EQ(dut_.Findings({}).size(), 3U) << "an end each";
}

TEST_F(HostProbeTest, WordsOfOthersDoNoHarmToATerminal) {
  probe_t answer = Answer(1);
  answer.host = "\x1b[2Jvi\nsion";
  answer.network = "\x1b]0;x\x07";
  dut_.HearProbe(answer, kTheirs, true, kBegin);
  for (const std::string& text : {Only().what, Only().found, Only().command})
    EXPECT_EQ(text.find_first_of("\x1b\n\x07"), std::string::npos) << text;
}

}  // namespace
}  // namespace priamos::cli
