#include <gmock/gmock.h>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using testing::HasSubstr;

class ViewCommand : public testing::Test {
 protected:
  PriamosAnswer ViewFor(const char* seconds) {
    return Priamos({"view", "--once", "--bus", log_.url(), "--for", seconds});
  }
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(ViewCommand, EndsAfterTheTimeGivenHoweverShort) {
  log_.Add(0, "POSE", pose_t{});
  EXPECT_EQ(ViewFor("0.1").exit_code, 1) << "nothing was seen";
  log_.AddBytes(0, "LANDMARK_VIEW", bus::Encode(landmark_view_t{}));
  EXPECT_EQ(ViewFor("0.1").exit_code, 0);
}

TEST_F(ViewCommand, ATimeBelowNothingIsRefused) {
  const auto answer = ViewFor("-0.1");
  EXPECT_EQ(answer.exit_code, 2);
  EXPECT_THAT(answer.err, HasSubstr("--for"));
}

}  // namespace
}  // namespace priamos::cli
