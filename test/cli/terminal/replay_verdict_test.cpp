#include "cli/terminal/replay_verdict.hpp"

#include <gtest/gtest.h>

namespace priamos::cli {
namespace {

TEST(ReplayVerdictTest, HasTheCountsOfEveryChannelAndTheDifferences) {
  ReplayVerdict dut{.log = "a.lcmlog", .module = "robot", .fed = 7, .skipped_bytes = 2, .comparison = {}};
  dut.comparison.channels["POSE"] = {.recorded = 3, .replayed = 4, .equal = 1};
  dut.comparison.differences = {"POSE 1 at 0.020 s: x_m: recorded 1, replayed 2"};
  dut.comparison.equal = false;
  EXPECT_EQ(JsonLine(dut), R"({"log":"a.lcmlog","module":"robot","fed":7,"skipped_bytes":2,"equal":false,)"
                           R"("channels":[{"channel":"POSE","recorded":3,"replayed":4,"equal":1}],)"
                           R"("differences":["POSE 1 at 0.020 s: x_m: recorded 1, replayed 2"]})");
}

}  // namespace
}  // namespace priamos::cli
