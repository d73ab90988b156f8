#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/cli/priamos_answer.hpp"
#include "test/support/temporary_folder.hpp"

namespace priamos::cli {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class ViewCommand : public testing::Test {
 protected:
  /// A fix and the view of the same look, as the head sends them.
  void Look(int id) {
    landmark_fix_t fix{};
    fix.request_id = id;
    landmark_view_t view{};
    view.request_id = id;
    view.landmark_id = 4;
    log_.AddBytes(0, "LANDMARK_FIX", bus::Encode(fix)).AddBytes(0, "LANDMARK_VIEW", bus::Encode(view));
  }
  PriamosAnswer View(std::vector<std::string> more) {
    std::vector<std::string> words{"view", "--bus", log_.url()};
    words.insert(words.end(), more.begin(), more.end());
    return Priamos(words);
  }
  TemporaryFolder folder_;
  MessageLog log_{folder_ / "bus.lcmlog"};
};

TEST_F(ViewCommand, OnceEndsWithTheFirstLook) {
  Look(7);
  const auto answer = View({"--once"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, StartsWith("look 7: landmark 4,"));
}

TEST_F(ViewCommand, JsonIsALinePerMessageWithItsChannel) {
  Look(7);
  const auto lines = LinesOf(View({"--once", "--json"}).out);
  ASSERT_EQ(lines.size(), 2u);
  int views = 0;
  for (const std::string& line : lines) {
    const auto dut = json::parse(line);
    views += dut.at("channel") == "LANDMARK_VIEW";
    EXPECT_EQ(dut.at("message").at("request_id"), 7);
  }
  EXPECT_EQ(views, 1);
}

TEST_F(ViewCommand, TheFloorAloneIsAViewToo) {
  obstacle_line_t line{};
  line.verdict = obstacle_line_t::CLEAR;
  line.seen_share = 1;
  log_.AddBytes(0, "OBSTACLE_LINE", bus::Encode(line));
  const auto answer = View({"--once"});
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_THAT(answer.out, HasSubstr("floor: "));
}

TEST_F(ViewCommand, WhenNothingComesInTimeTheCodeIsOne) {
  const auto answer = View({"--once", "--for", "0.02", "--json"});
  EXPECT_EQ(answer.exit_code, 1);
  EXPECT_EQ(answer.out, "");
}

TEST_F(ViewCommand, TheTimeHasBounds) {
  for (const char* seconds : {"-1", "86401", "long"}) {
    const auto answer = View({"--for", seconds});
    EXPECT_EQ(answer.exit_code, 2) << seconds;
    EXPECT_THAT(answer.err, AllOf(HasSubstr("--for: expected a number, 0 to 86400"), HasSubstr(seconds)));
  }
}

}  // namespace
}  // namespace priamos::cli
