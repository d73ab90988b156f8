#include "console/replay_station.hpp"

#include <gmock/gmock.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "bus/own_types.hpp"
#include "console/log_of_file.hpp"
#include "lcmtypes/channels.hpp"
#include "test/cli/message_log.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/web/web_client.hpp"

namespace priamos::console {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A log of 20 s with a pose ten times a second whose x is the time, and one mission's words at 3 s; a page
/// that looks at it.
class ReplayStationTest : public testing::Test {
 protected:
  ReplayStationTest() {
    cli::MessageLog log(folder_ / "run.lcmlog");
    for (int i = 0; i <= 200; ++i) {
      pose_t pose{};
      pose.x_m = i / 10.0;
      log.Add(i / 10.0, "POSE", pose);
      if (i == 30) log.Add(3.0, "MISSION_STATUS", Words());
    }
    bus::LogPlayer player(bus::LogReader(log.file()), {});
    player.Pause(true, now_);
    dut_ = std::make_unique<ReplayStation>(std::make_unique<LogOfFile>(std::move(player)), schema_,
                                           GroundPlan{}, R"({"type":"hello"})", WebServerOptions{});
    const std::string address = dut_->address(), host = address.substr(7, address.size() - 8);
    page_ = std::make_unique<WebClient>(std::stoi(host.substr(host.rfind(':') + 1)), [this] { Turn(); });
    EXPECT_TRUE(page_->Upgrade("http://" + host, "/socket", host));
  }
  static mission_status_t Words() {
    mission_status_t status{};
    status.text = "approaching";
    return status;
  }
  void Turn() { dut_->Tick(now_ += Duration(10'000)); }
  void Order(const std::string& action, double value = -1) {
    json order{{"type", "replay"}, {"action", action}};
    if (value >= 0) order["value"] = value;
    page_->Say(WebClient::Frame(order.dump()));
  }
  /// Newest text of `type` after so long.
  json After(double seconds, const std::string& type = "news") {
    page_->Forget();
    for (const Time end = now_ + FromSeconds(seconds); now_ < end;) page_->ended();
    const std::string heard = page_->Hear([](const std::string&) { return true; });
    const auto begin = heard.rfind("{\"type\":\"" + type + "\"");
    if (begin == std::string::npos) return {};
    int depth = 0;
    for (std::size_t i = begin; i < heard.size(); ++i) {
      depth += heard[i] == '{';
      depth -= heard[i] == '}';
      if (depth == 0) return json::parse(heard.substr(begin, i + 1 - begin));
    }
    return {};
  }
  double Position() { return After(0.3)["station"]["replay"]["position_s"]; }

  TemporaryFolder folder_;
  const bus::Schema schema_ = bus::OwnTypes();
  Time now_ = FromUtime(1'000'000'000);
  std::unique_ptr<ReplayStation> dut_;
  std::unique_ptr<WebClient> page_;
};

TEST_F(ReplayStationTest, PausedItStands) {
  const json news = After(0.5);
  EXPECT_EQ(news["station"]["role"], "viewer");
  EXPECT_EQ(news["station"]["replay"], json({{"position_s", 0.0}, {"speed", 1.0}, {"paused", true}}));
}

TEST_F(ReplayStationTest, ItPlaysAtTheLogsTimeOrAtAnother) {
  After(0.3);
  Order("play");
  EXPECT_NEAR(After(2)["station"]["replay"]["position_s"].get<double>(), 2.0, 0.2);
  Order("speed", 4);
  EXPECT_NEAR(Position(), 2.0 + 4 * 0.3, 0.5);
}

TEST_F(ReplayStationTest, AStepIsOneMessage) {
  After(0.3);
  Order("step");
  EXPECT_NEAR(Position(), 0.1, 1e-9);
  Order("step");
  EXPECT_NEAR(Position(), 0.2, 1e-9);
}

TEST_F(ReplayStationTest, AfterASeekAPageIsGreetedAnewAndKnowsTheStatesOfThatMoment) {
  After(0.3);
  Order("seek", 12.5);
  page_->Forget();
  for (int i = 0; i < 30; ++i) page_->ended();
  const std::string heard = page_->Hear([](const std::string&) { return true; });
  EXPECT_THAT(heard, HasSubstr(R"({"type":"hello"})"));
  EXPECT_THAT(heard, HasSubstr(R"("position_s":12.5)"));
  EXPECT_THAT(heard, HasSubstr(R"("x_m":12.4)"));
  EXPECT_THAT(heard, HasSubstr("approaching")) << "said 9.5 s before";
}

TEST_F(ReplayStationTest, AgesAreThoseOfTheLog) {
  After(0.3);
  Order("seek", 10);
  page_->Forget();
  for (int i = 0; i < 200; ++i) page_->ended();
  const std::string heard = page_->Hear([](const std::string&) { return true; });
  EXPECT_THAT(heard, HasSubstr(R"("channel":"MISSION_STATUS","type":"priamos.mission_status_t","age_s":7.0)"))
      << "though 2 s have passed since";
}

TEST_F(ReplayStationTest, BeyondTheEndItStandsThereAndBeginsAgain) {
  After(0.3);
  Order("seek", 1e6);
  Order("play");
  EXPECT_LE(Position(), 0.5) << "play at the end is from the beginning";
  Order("speed", 32);
  const json news = After(2);
  EXPECT_EQ(news["station"]["replay"]["position_s"], 20.0);
  EXPECT_TRUE(news["station"]["replay"]["paused"]);
}

TEST_F(ReplayStationTest, OrdersForARobotFindNoneAndNonsenseIsCutOff) {
  After(0.3);
  page_->Say(WebClient::Frame(R"({"type":"stop"})"));
  After(0.3);
  EXPECT_FALSE(page_->ended());
  page_->Say(WebClient::Frame(R"({"type":"replay","action":"fly"})"));
  After(0.3);
  EXPECT_TRUE(page_->ended());
}

}  // namespace
}  // namespace priamos::console
