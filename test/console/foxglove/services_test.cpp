#include "console/foxglove/services.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "console/core/browser_message.hpp"

namespace priamos::console {
namespace {

std::uint32_t NumberOf(const std::string& name) {
  const auto all = Services();
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
  return static_cast<std::uint32_t>(at - all.begin() + 1);
}
BrowserMessage Read(const std::string& name, const std::string& fields) {
  const auto text = PageMessageOf(NumberOf(name), fields);
  EXPECT_TRUE(text) << text.reason();
  const auto message = ReadBrowserMessage(*text);
  EXPECT_TRUE(message) << message.reason();
  return *message;
}

TEST(Services, EveryOneIsWhatAButtonOfThePageDoes) {
  EXPECT_TRUE(std::holds_alternative<StopOrder>(Read("stop", "")));
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/abort", "{}")).kind, MissionOrder::Kind::kAbort);
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/pass_door", R"({"landmark":12})")).landmark_id, 12);
  const auto goal =
      std::get<MissionOrder>(Read("mission/goto", R"({"x_m":1.5,"y_m":-2,"yaw_rad":0.5,"turn":true})")).goal;
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->map_from_base.x, 1.5);
  EXPECT_TRUE(goal->turn);
  using enum MissionOrder::Kind;
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/corridor", R"({"distance_m":12})")).distance_m, 12);
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/explore", "")).kind, kExplore);
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/locate", "")).kind, kLocate);
  const auto patrol = std::get<MissionOrder>(
      Read("mission/patrol", R"({"places":[{"x_m":1,"y_m":2,"yaw_rad":0}],"rounds":3})"));
  EXPECT_EQ(patrol.places.size(), 1u);
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/pause", "")).kind, kPause);
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/resume", "")).kind, kResume);
  EXPECT_EQ(std::get<MissionOrder>(Read("mission/cancel", R"({"number":7})")).order_id, 7);
  EXPECT_EQ(std::get<PlaceOrder>(Read("place", R"({"x_m":1,"y_m":2,"yaw_rad":3})")).map_from_base.y, 2);
}

TEST(Services, ACallCannotBecomeAnotherMessage) {
  EXPECT_FALSE(PageMessageOf(NumberOf("mission/abort"), R"({"type":"stick"})"));
  EXPECT_FALSE(PageMessageOf(NumberOf("mission/abort"), R"({"order":"goto"})"));
  for (const char* fields : {"[]", "3", "{", "null", "\xff"})
    EXPECT_FALSE(PageMessageOf(1, fields)) << fields;
  EXPECT_FALSE(PageMessageOf(1, "{\"a\":\"" + std::string(1000, 'x') + "\"}"));
  EXPECT_FALSE(PageMessageOf(0, "{}"));
  EXPECT_FALSE(PageMessageOf(99, "{}"));
}

TEST(Services, TheirSchemasAreObjects) {
  for (const OfferedService& service : Services())
    EXPECT_EQ(nlohmann::json::parse(service.request_schema)["type"], "object") << service.name;
}

}  // namespace
}  // namespace priamos::console
