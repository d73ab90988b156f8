#include "cli/report/run_recorder.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "bus/log/type_texts.hpp"
#include "test/cli/message_log.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

const Time kNow = FromUtime(1'234'567'890);

TEST(RunRecorder, EachBusHasALogWithTheTimeOfArrival) {
  TemporaryFolder folder;
  RunRecorder dut(folder.path().string());
  const auto pose = bus::Encode(pose_t{});
  dut.OnMessage("onboard", kNow, "POSE", pose);
  dut.OnMessage("offboard", kNow + std::chrono::seconds(1), "MISSION_STATUS",
                bus::Encode(mission_status_t{}));
  dut.OnMessage("offboard", kNow + std::chrono::seconds(2), "FOREIGN", {});
  dut.Flush();
  auto onboard = EventsOf(folder / "onboard.lcmlog"), offboard = EventsOf(folder / "offboard.lcmlog");
  for (auto* log : {&onboard, &offboard}) {
    EXPECT_TRUE(bus::IsTypeText(log->front().bytes)) << "it says first what the messages are";
    std::erase_if(*log, [](const auto& event) { return bus::IsTypeText(event.bytes); });
  }
  ASSERT_EQ(onboard.size(), 1u);
  EXPECT_EQ(onboard[0].utime, 1'234'567'890);
  EXPECT_EQ(onboard[0].channel, "POSE");
  EXPECT_EQ(onboard[0].bytes, pose);
  ASSERT_EQ(offboard.size(), 2u) << "what the report does not need is in the log all the same";
  EXPECT_EQ(offboard[1].utime, 1'236'567'890);
  EXPECT_TRUE(dut.good());
}

TEST(RunRecorder, TheRecordKnowsWhichBusItWas) {
  RunRecorder dut(std::nullopt);
  dut.OnMessage("onboard", kNow, "POSE", bus::Encode(pose_t{}));
  dut.OnMessage("offboard", kNow, "MISSION_STATUS", bus::Encode(mission_status_t{}));
  dut.OnMessage("onboard", kNow, "MISSION_STATUS", bus::Encode(mission_status_t{}));
  EXPECT_EQ(dut.record().poses.size(), 1u);
  EXPECT_EQ(dut.record().mission.size(), 1u) << "what the planner said counts where it said it";
}

TEST(RunRecorder, WithoutAFolderNothingIsWritten) {
  RunRecorder dut(std::nullopt);
  dut.OnMessage("onboard", kNow, "POSE", bus::Encode(pose_t{}));
  dut.Flush();
  EXPECT_TRUE(dut.good());
  EXPECT_FALSE(std::filesystem::exists("onboard.lcmlog"));
}

TEST(RunRecorder, AFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(RunRecorder("/no/such/folder"), std::runtime_error);
}

TEST(RunRecorder, AFullDiskIsNoticed) {
  TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "offboard.lcmlog");
  RunRecorder dut(folder.path().string());
  dut.OnMessage("offboard", kNow, "POSE", bus::Encode(pose_t{}));
  dut.Flush();
  EXPECT_FALSE(dut.good()) << "of one bus is enough";
}

}  // namespace
}  // namespace priamos::cli
