#include <gtest/gtest.h>

#include "bus/own_types.hpp"
#include "cli/lockstep/lockstep_run.hpp"
#include "cli/verbs/world/generated_files.hpp"
#include "test/support/temporary_folder.hpp"

// A building that is made up from a seed, on a plan that is wrong as a tape makes it: the robot is sent
// through its door to a place, and back.

namespace priamos::cli {
namespace {

TEST(GeneratedRun, TheRobotDrivesToTheOtherRoomAndBack) {
  constexpr std::uint64_t kSeed = 104;
  const bus::Schema schema = bus::OwnTypes();
  const TemporaryFolder folder;
  LockstepRequest request;
  request.deployment = (folder / "made").string();
  request.scenario =
      WriteGenerated(world::Generate("room", kSeed), "room", kSeed, GeneratedTask::kThereAndBack,
                     PRIAMOS_SOURCE_DIR "/config/sim", request.deployment)
          .scenario;
  request.seed = kSeed;
  const Summary dut = RunLockstep(schema, request).summary;
  EXPECT_TRUE(dut.passed) << dut.reason;
  EXPECT_EQ(dut.contacts, 0);
}

}  // namespace
}  // namespace priamos::cli
