#include "cli/report/story_verdict.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

/// A story that has ended.
class Ended : public ScenarioStory {
 public:
  Ended(bool decides, bool succeeded) : decides_(decides), succeeded_(succeeded) {}
  void Tick(Time) override {}
  bool Done(Time) const override { return true; }
  bool Started() const override { return true; }
  bool Succeeded() const override { return succeeded_; }
  bool DecidesTheRun() const override { return decides_; }
  std::string Reason() const override { return "last words"; }

 private:
  bool decides_, succeeded_;
};

/// A drive by hand that stood in the passage for so long while pushed.
Summary Stood(double stop_s) {
  Summary summary;
  summary.hand.emplace();
  summary.hand->longest_stop_s = stop_s;
  return summary;
}

TEST(StoryVerdict, TheRecordOfARunDecidesUnlessTheStoryDoes) {
  for (const bool passed : {true, false}) {
    Summary summary;
    summary.passed = passed;
    EXPECT_EQ(Judge({}, Ended(false, !passed), summary), "last words");
    EXPECT_EQ(summary.passed, passed);
  }
}

TEST(StoryVerdict, AStoryThatDecidesPassesWhenItSucceeded) {
  for (const bool succeeded : {true, false}) {
    Summary summary;
    summary.passed = !succeeded;
    EXPECT_EQ(Judge({}, Ended(true, succeeded), summary), "last words");
    EXPECT_EQ(summary.passed, succeeded);
  }
}

TEST(StoryVerdict, AStopInThePassageIsAFaultOfADriveThatSucceeded) {
  Scenario scenario;
  scenario.longest_stop_s = 2;
  Summary faulty = Stood(2.5), good = Stood(1.5), failed = Stood(2.5);
  const std::string fault = Judge(scenario, Ended(true, true), faulty);
  EXPECT_FALSE(faulty.passed);
  EXPECT_NE(fault.find("2.5"), std::string::npos) << fault;
  EXPECT_EQ(Judge(scenario, Ended(true, true), good), "last words");
  EXPECT_TRUE(good.passed);
  EXPECT_EQ(Judge(scenario, Ended(true, false), failed), "last words") << "its own reason comes first";
  EXPECT_FALSE(failed.passed);
}

TEST(StoryVerdict, AnExplorationThatSawTooLittleHasNotPassed) {
  Summary summary;
  summary.explore.emplace();
  summary.explore->seen = 0.977;
  summary.explore->reachable_m2 = 36;
  summary.explore->end = "explored 35 m2";
  const std::string fault = Judge({}, Ended(true, true), summary);
  EXPECT_FALSE(summary.passed);
  EXPECT_EQ(fault, "seen 97.7 % of 36.0 m2 that can be reached, 98.0 % are asked; explored 35 m2");
  summary.explore->seen = 0.98;
  EXPECT_EQ(Judge({}, Ended(true, true), summary), "last words");
  EXPECT_TRUE(summary.passed);
  summary.explore->seen = 0.2;
  Scenario any;
  any.least_seen = 0;
  Judge(any, Ended(true, true), summary);
  EXPECT_TRUE(summary.passed);
  EXPECT_EQ(Judge({}, Ended(true, false), summary), "last words") << "its own reason comes first";
  EXPECT_FALSE(summary.passed);
}

}  // namespace
}  // namespace priamos::cli
