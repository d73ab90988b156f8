#include "robot/core/safety/failsafe.hpp"

#include <gmock/gmock.h>

#include "test/robot/failsafe_table.hpp"

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using enum Condition;

constexpr Time kStart = FromUtime(1'000'000'000);

class FailsafeTest : public testing::Test {
 protected:
  /// The machine asked every 20 ms for `time` with unchanged inputs; conditions last on.
  FailsafeDecision After(milliseconds time) {
    FailsafeDecision decision = Ask();
    for (milliseconds done{}; done < time; done += milliseconds(20)) {
      now_ += milliseconds(20);
      for (Duration& lasting : inputs_.lasting)
        if (lasting > Duration::zero()) lasting += milliseconds(20);
      decision = Ask();
    }
    return decision;
  }
  FailsafeDecision Ask() { return dut_.Update(inputs_, now_); }
  void Begin(Condition condition) { inputs_[condition] = Duration(1); }
  void End(Condition condition) { inputs_[condition] = {}; }

  FailsafeInputs inputs_{.lasting = {}, .source = DriveSource::kPath};
  Time now_ = kStart;
  Failsafe dut_{FailsafeConfig{}};
};

TEST_F(FailsafeTest, NothingIsWrong) {
  EXPECT_EQ(After(milliseconds(1000)).action, FailsafeAction::kNone);
}

TEST_F(FailsafeTest, EstopHaltsAtOnce) {
  Begin(kEstop);
  EXPECT_EQ(Ask().action, FailsafeAction::kHalt);
  EXPECT_EQ(Ask().cause, kEstop);
}

TEST_F(FailsafeTest, SonarFallsSilentAndComesBack) {
  Begin(kSonarSilent);
  EXPECT_EQ(After(milliseconds(480)).action, FailsafeAction::kNone);
  EXPECT_EQ(After(milliseconds(40)).action, FailsafeAction::kHold);
  End(kSonarSilent);
  EXPECT_EQ(After(milliseconds(200)).action, FailsafeAction::kHold) << "one cycle is not yet a ring";
  EXPECT_EQ(After(milliseconds(200)).action, FailsafeAction::kNone);
}

TEST_F(FailsafeTest, AConditionThatFlickersGrantsNoNewPeriod) {
  Begin(kSonarSilent);
  After(milliseconds(600));
  for (int i = 0; i < 10; ++i) {
    End(kSonarSilent);
    EXPECT_EQ(After(milliseconds(100)).action, FailsafeAction::kHold);
    Begin(kSonarSilent);
    EXPECT_EQ(After(milliseconds(20)).action, FailsafeAction::kHold);
  }
}

TEST_F(FailsafeTest, EstopOutranksASilentSonarAndLeavesItsHoldBehind) {
  Begin(kSonarSilent);
  After(milliseconds(600));
  Begin(kEstop);
  EXPECT_EQ(Ask().cause, kEstop);
  End(kEstop);
  EXPECT_EQ(Ask().cause, kSonarSilent);
  EXPECT_EQ(Ask().action, FailsafeAction::kHold);
}

TEST_F(FailsafeTest, TheRadioFailsWhileAnOperatorDrives) {
  inputs_.source = DriveSource::kOperator;
  Begin(kLinkLost);
  EXPECT_EQ(After(milliseconds(260)).action, FailsafeAction::kHalt);
}

TEST_F(FailsafeTest, TheRadioFailsWhileAPathIsDriven) {
  Begin(kLinkLost);
  EXPECT_EQ(After(milliseconds(9900)).action, FailsafeAction::kNone);
  EXPECT_EQ(After(milliseconds(200)).action, FailsafeAction::kHold);
  End(kLinkLost);
  EXPECT_EQ(After(milliseconds(600)).action, FailsafeAction::kNone);
}

TEST_F(FailsafeTest, AnOperatorWhoFallsSilentHaltsTheBaseButNotAPath) {
  Begin(kOperatorSilent);
  EXPECT_EQ(Ask().action, FailsafeAction::kNone);
  inputs_.source = DriveSource::kOperator;
  EXPECT_EQ(Ask().action, FailsafeAction::kHalt);
}

TEST_F(FailsafeTest, ALostPoseStopsAPathButNotAnOperatorWhoSees) {
  Begin(kPoseLost);
  EXPECT_EQ(After(milliseconds(300)).action, FailsafeAction::kHold);
  inputs_.source = DriveSource::kOperator;
  EXPECT_EQ(Ask().action, FailsafeAction::kNone);
}

TEST_F(FailsafeTest, WheelsThatDoNotAnswerHoldWhoeverDrives) {
  for (const DriveSource source : {DriveSource::kPath, DriveSource::kOperator}) {
    inputs_.source = source;
    Begin(kWheelsSilent);
    EXPECT_EQ(After(milliseconds(220)).cause, kWheelsSilent);
    End(kWheelsSilent);
    EXPECT_EQ(After(milliseconds(300)).action, FailsafeAction::kNone);
  }
}

TEST_F(FailsafeTest, EveryConditionHasARule) {
  const auto rules = FailsafeRules({});
  for (std::size_t c = 0; c < kConditions; ++c) {
    EXPECT_TRUE(std::any_of(rules.begin(), rules.end(), [&](const FailsafeRule& rule) {
      return static_cast<std::size_t>(rule.condition) == c;
    })) << c;
  }
}

TEST_F(FailsafeTest, RulesAreOrderedByPrecedence) {
  const auto rules = FailsafeRules({});
  for (std::size_t i = 1; i < rules.size(); ++i) EXPECT_GE(rules[i - 1].action, rules[i].action);
}

TEST_F(FailsafeTest, TheTableNamesEveryRule) {
  const std::string table = FailsafeTable({});
  for (const FailsafeRule& rule : FailsafeRules({})) EXPECT_THAT(table, HasSubstr(std::string(rule.meaning)));
}

}  // namespace
}  // namespace priamos::robot
