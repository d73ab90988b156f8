#include "cli/terminal/where_text.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace priamos::cli {
namespace {

using testing::HasSubstr;

Whereabouts Somewhere() {
  Whereabouts where;
  where.pose.emplace();
  where.pose->utime = 9'750'000;
  where.pose->x_m = 2.31;
  where.pose->y_m = -12.4;
  where.pose->yaw_rad = 3.14;
  where.pose->sigma_x_m = 0.021;
  where.pose->sigma_yaw_rad = 0.01;
  where.drive.emplace();
  where.drive->utime = 9'900'000;
  where.drive->mode = drive_status_t::FOLLOWING;
  where.drive->limit = drive_status_t::LIMIT_SONAR;
  where.drive->allowed = 0.35;
  where.drive->path_id = 17;
  where.drive->remaining_m = 2.35;
  where.mission.emplace();
  where.mission->phase = mission_status_t::PASSING;
  where.mission->text = "passing the door";
  return where;
}

TEST(WhereText, SaysWhereWhatAndWhy) {
  const std::string dut = WhereText(Somewhere(), FromUtime(10'000'000));
  EXPECT_THAT(dut, HasSubstr("x 2.31 m, y -12.40 m, heading 179.9 deg in the map, 0.25 s ago"));
  EXPECT_THAT(dut, HasSubstr("2.1 cm in x"));
  EXPECT_THAT(dut, HasSubstr("FOLLOWING, 2.35 m to go on path 17"));
  EXPECT_THAT(dut, HasSubstr("an echo is too near; 35 % of the wanted speed"));
  EXPECT_THAT(dut, HasSubstr("PASSING: passing the door"));
  std::istringstream lines(dut);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

TEST(WhereText, SaysWhatWasNotHeard) {
  const std::string dut = WhereText({}, {});
  EXPECT_THAT(dut, HasSubstr("no POSE"));
  EXPECT_THAT(dut, HasSubstr("no DRIVE_STATUS"));
  EXPECT_THAT(dut, HasSubstr("no planner"));
}

TEST(WhereText, AnEmergencyStopIsTold) {
  Whereabouts where = Somewhere();
  where.drive->estop = 1;
  EXPECT_THAT(WhereText(where, {}), HasSubstr("E-STOP is latched"));
}

TEST(WhereJson, HasTheSameAndNullForWhatWasNotHeard) {
  const auto dut = WhereJson(Somewhere(), FromUtime(10'000'000));
  EXPECT_EQ(dut["pose"]["x_m"], 2.31);
  EXPECT_DOUBLE_EQ(dut["pose"]["age_s"], 0.25);
  EXPECT_EQ(dut["drive"]["mode"], "FOLLOWING");
  EXPECT_EQ(dut["drive"]["limit"], "an echo is too near");
  EXPECT_EQ(dut["mission"]["phase"], "PASSING");
  EXPECT_TRUE(WhereJson({}, {})["pose"].is_null());
}

}  // namespace
}  // namespace priamos::cli
