#include "cli/report/report_touches.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "test/cli/report/report_synthetic_run.hpp"

namespace priamos::cli {
namespace {

void Touch(RunRecord& record, double t_s, std::int8_t kind, const std::string& thing) {
  world_touch_t touch{};
  touch.kind = kind;
  touch.thing = thing;
  Feed(record, Side::kOnboard, t_s, "WORLD_TOUCH", touch);
}

void Status(RunRecord& record, double t_s, std::int8_t limit) {
  drive_status_t status{};
  status.limit = limit;
  Feed(record, Side::kOnboard, t_s, "DRIVE_STATUS", status);
}

TEST(TouchesOfTest, TellsWhenTheRobotKnew) {
  RunRecord record;
  Status(record, 1.0, drive_status_t::LIMIT_TOUCHED);
  Touch(record, 2.0, world_touch_t::DRIVEN, "post");
  Status(record, 2.1, drive_status_t::LIMIT_SONAR);
  Status(record, 2.3, drive_status_t::LIMIT_TOUCHED);
  const auto dut = TouchesOf(record, kRunBegin + 500'000);
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_NEAR(dut[0].t_s, 1.5, 1e-9);
  EXPECT_EQ(dut[0].kind, "driven");
  ASSERT_TRUE(dut[0].noticed_after_s) << "what was known before is another touch";
  EXPECT_NEAR(*dut[0].noticed_after_s, 0.3, 1e-9);
}

TEST(TouchesOfTest, StuckWheelsAreNoticedTooAndNothingAfterHalfAMinute) {
  RunRecord record;
  Touch(record, 1, world_touch_t::MOVED_IN, "visitor: trunk");
  Touch(record, 3, world_touch_t::FELL, "stairs");
  Status(record, 32, drive_status_t::LIMIT_WHEELS_STUCK);
  const auto dut = TouchesOf(record, kRunBegin);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_EQ(dut[0].kind, "moved in");
  EXPECT_FALSE(dut[0].noticed_after_s);
  EXPECT_NEAR(dut[1].noticed_after_s.value(), 29, 1e-9);
  EXPECT_EQ(ToJson(dut[0]).dump(),
            R"({"t_s":1.0,"kind":"moved in","thing":"visitor: trunk","noticed_after_s":null})");
}

}  // namespace
}  // namespace priamos::cli
