#include "planner/core/missions/estop_watch.hpp"

#include <gtest/gtest.h>

namespace priamos::planner {
namespace {

DriveReport Counted(int changes, bool latched = false) {
  DriveReport drive;
  drive.estop = latched;
  drive.estop_changes = changes;
  return drive;
}

TEST(EstopWatch, AnOrderStandsOnWhatWasReportedBeforeIt) {
  EstopWatch dut(Counted(7));
  dut.Note(Counted(8));
  EXPECT_EQ(dut.changes(), 7);
  EXPECT_FALSE(dut.WhyEnds(Counted(7)));
  EXPECT_EQ(dut.WhyEnds(Counted(8)),
            "the emergency stop was pressed or lifted since the order; next: order it again");
}

TEST(EstopWatch, ElseOnWhatIsReportedFirstAfterIt) {
  EstopWatch dut;
  EXPECT_EQ(dut.changes(), 0);
  dut.Note(Counted(3));
  dut.Note(Counted(4));
  EXPECT_EQ(dut.changes(), 3);
}

TEST(EstopWatch, AStopThatIsLatchedEndsEveryOrder) {
  EXPECT_TRUE(EstopWatch(Counted(7, true)).WhyEnds(Counted(7, true)));
}

}  // namespace
}  // namespace priamos::planner
