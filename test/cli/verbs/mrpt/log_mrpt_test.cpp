#include <gmock/gmock.h>
#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <limits>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

// `log mrpt`: what MRPT reads of a run.

namespace priamos::cli {
namespace {

using testing::HasSubstr;

sonar_ranges_t Cycle() {
  sonar_ranges_t cycle{};
  std::fill_n(cycle.range_m, 24, -1.0);
  cycle.range_m[0] = 1.5;
  cycle.range_m[6] = 0.4;
  return cycle;
}

class LogMrpt : public testing::Test {
 protected:
  LogMrpt() {
    MessageLog log(log_);
    for (int i = 0; i < 10; ++i) {
      odometry_t odometry{};
      odometry.x_m = 0.03 * i;
      pose_t pose{};
      pose.x_m = 2 + 0.03 * i;
      pose.sigma_x_m = 0.02;
      pose.sigma_yaw_rad = 0.01;
      log.Add(0.1 * i, "ODOMETRY", odometry).Add(0.1 * i, "POSE", pose).Add(0.1 * i, "SONAR_RANGES", Cycle());
    }
    odometry_t nowhere{};
    nowhere.x_m = std::numeric_limits<double>::quiet_NaN();
    log.Add(2, "ODOMETRY", nowhere).AddBytes(2, "SONAR_RANGES", std::vector<std::byte>(20));
  }
  TemporaryFolder folder_;
  std::string log_ = folder_ / "run.lcmlog";
};

TEST_F(LogMrpt, ARawlogHasOdometryAndEchoesFromTheSensorsPlaces) {
  const std::string file = folder_ / "run.rawlog";
  const auto answer = Priamos({"log", "mrpt", log_, file});
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_THAT(answer.out, HasSubstr("10 cycles of the sonars, 10 places of the base; 2 undecodable"));
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(file));
  ASSERT_EQ(rawlog.size(), 20u);
  const auto odometry =
      std::dynamic_pointer_cast<mrpt::obs::CObservationOdometry>(rawlog.getAsObservation(2));
  ASSERT_TRUE(odometry);
  EXPECT_NEAR(odometry->odometry.x(), 0.03, 1e-9);
  EXPECT_NEAR(mrpt::Clock::toDouble(odometry->timestamp), MessageLog::UtimeAt(0.1) * 1e-6, 1e-6);
  const auto ranges = std::dynamic_pointer_cast<mrpt::obs::CObservationRange>(rawlog.getAsObservation(3));
  ASSERT_TRUE(ranges);
  ASSERT_EQ(ranges->sensedData.size(), 2u);
  EXPECT_NEAR(ranges->sensedData[0].sensedDistance, 1.5, 1e-6);
  EXPECT_NEAR(ranges->sensedData[0].sensorPose.x, 0.475, 1e-6);
  EXPECT_NEAR(ranges->sensedData[1].sensorPose.y, 0.39, 1e-6);
}

TEST_F(LogMrpt, ASimplemapHasAPlaceEachTenCentimetres) {
  const std::string file = folder_ / "run.simplemap";
  EXPECT_EQ(Priamos({"log", "mrpt", log_, file}).exit_code, 0);
  mrpt::maps::CSimpleMap map;
  ASSERT_TRUE(map.loadFromFile(file));
  ASSERT_EQ(map.size(), 3u);
  mrpt::poses::CPose3DPDF::Ptr pose;
  mrpt::obs::CSensoryFrame::Ptr frame;
  map.get(1, pose, frame);
  EXPECT_NEAR(pose->getMeanVal().x(), 2.12, 1e-6);
  EXPECT_EQ(frame->size(), 1u);
}

TEST_F(LogMrpt, OtherNamesAndLogsWithoutSonarsAreRefused) {
  const auto name = Priamos({"log", "mrpt", log_, folder_ / "run.bag"});
  EXPECT_EQ(name.exit_code, 2);
  EXPECT_THAT(name.err, HasSubstr("out: expected a file called *.rawlog or *.simplemap"));
  const std::string other = folder_ / "other.lcmlog", file = folder_ / "other.rawlog";
  MessageLog(other).Add(0, "POSE", pose_t{});
  const auto none = Priamos({"log", "mrpt", other, file});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("expected a log of the robot's bus, got one without sonar cycles"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace priamos::cli
