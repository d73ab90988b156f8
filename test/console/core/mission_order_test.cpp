#include "console/core/mission_order.hpp"

#include <gmock/gmock.h>

#include "console/core/browser_message.hpp"

namespace priamos::console {
namespace {

using testing::HasSubstr;
using enum MissionOrder::Kind;

Outcome<BrowserMessage> Read(const std::string& fields) {
  return ReadBrowserMessage(R"({"type":"mission",)" + fields + "}");
}

MissionOrder Order(const std::string& fields) {
  const auto message = Read(fields);
  EXPECT_EQ(message.reason(), "") << fields;
  return message ? std::get<MissionOrder>(*message) : MissionOrder{};
}

TEST(MissionOrder, WithoutFieldsIsItsNameAlone) {
  EXPECT_EQ(Order(R"("order":"abort")").kind, kAbort);
  EXPECT_EQ(Order(R"("order":"pause")").kind, kPause);
  EXPECT_EQ(Order(R"("order":"resume")").kind, kResume);
  EXPECT_EQ(Order(R"("order":"explore")").kind, kExplore);
  EXPECT_EQ(Order(R"("order":"locate")").kind, kLocate);
}

TEST(MissionOrder, NamesADoorOrAnOrder) {
  EXPECT_EQ(Order(R"("order":"pass_door","landmark":3)").landmark_id, 3);
  EXPECT_EQ(Order(R"("order":"cancel","number":65535)").order_id, 65535);
}

TEST(MissionOrder, DrivesToAPlaceWithOrWithoutAHeading) {
  const auto order = Order(R"("order":"goto","x_m":4.5,"y_m":-1,"yaw_rad":3.15,"turn":true)");
  EXPECT_EQ(order.kind, kGoto);
  ASSERT_TRUE(order.goal);
  EXPECT_EQ(order.goal->map_from_base.x, 4.5);
  EXPECT_EQ(order.goal->map_from_base.y, -1);
  EXPECT_NEAR(order.goal->map_from_base.yaw, 3.15 - 2 * kPi, 1e-12) << "a slider's rounding";
  EXPECT_TRUE(order.goal->turn);
  EXPECT_FALSE(Order(R"("order":"goto","x_m":4.5,"y_m":-1,"yaw_rad":0)").goal->turn);
}

TEST(MissionOrder, FollowsACorridorTheWayTheBaseStandsOrAnother) {
  const auto as_it_stands = Order(R"("order":"corridor","distance_m":0)");
  EXPECT_EQ(as_it_stands.kind, kCorridor);
  EXPECT_FALSE(as_it_stands.goal);
  const auto north = Order(R"("order":"corridor","distance_m":20,"yaw_rad":1.5,"turn":true)");
  EXPECT_EQ(north.distance_m, 20);
  ASSERT_TRUE(north.goal);
  EXPECT_EQ(north.goal->map_from_base.yaw, 1.5);
  EXPECT_TRUE(north.goal->turn);
}

TEST(MissionOrder, PatrolsPlacesInTheirOrder) {
  const auto order = Order(
      R"("order":"patrol","rounds":0,"places":[{"x_m":1,"y_m":2,"yaw_rad":0},{"x_m":3,"y_m":4,"yaw_rad":1,"turn":true}])");
  EXPECT_EQ(order.rounds, 0);
  ASSERT_EQ(order.places.size(), 2u);
  EXPECT_EQ(order.places[1].map_from_base.x, 3);
  EXPECT_TRUE(order.places[1].turn);
}

TEST(MissionOrder, APatrolOfAllItsPlacesFitsIntoAMessage) {
  std::string places;
  for (std::size_t i = 0; i < MissionOrder::kMostPlaces; ++i)
    places += std::string(i ? "," : "") + R"({"x_m":-99.123,"y_m":-99.123,"yaw_rad":-3.123,"turn":true})";
  EXPECT_EQ(Order(R"("order":"patrol","rounds":9999,"places":[)" + places + "]").places.size(),
            MissionOrder::kMostPlaces);
}

struct Wrong {
  std::string fields, reason;
};

class WrongMissionOrder : public testing::TestWithParam<Wrong> {};

TEST_P(WrongMissionOrder, IsRefusedWithASentence) {
  EXPECT_THAT(Read(GetParam().fields).reason(), HasSubstr(GetParam().reason)) << GetParam().fields;
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongMissionOrder,
    testing::Values(Wrong{R"("order":"fly")",
                          "order: expected one of abort, pause, resume, cancel, pass_door, goto"},
                    Wrong{R"("order":"pass_door")", "\"landmark\" is missing"},
                    Wrong{R"("order":"pass_door","landmark":0)", "landmark: expected a whole number from 1"},
                    Wrong{R"("order":"pass_door","landmark":1000)", "from 1 to 999"},
                    Wrong{R"("order":"goto","x_m":1,"y_m":2)", "\"yaw_rad\" is missing"},
                    Wrong{R"("order":"goto","x_m":101,"y_m":2,"yaw_rad":0)", "x_m: expected a number from"},
                    Wrong{R"("order":"goto","x_m":"1","y_m":2,"yaw_rad":0)", "x_m: expected a number"},
                    Wrong{R"("order":"abort","x_m":1)", "\"x_m\" is not known"},
                    Wrong{R"("order":"explore","landmark":1)", "\"landmark\" is not known"},
                    Wrong{R"("order":"cancel")", "\"number\" is missing"},
                    Wrong{R"("order":"cancel","number":0)", "number: expected a whole number from 1"},
                    Wrong{R"("order":"corridor")", "\"distance_m\" is missing"},
                    Wrong{R"("order":"corridor","distance_m":-1)", "distance_m: expected a number from 0"},
                    Wrong{R"("order":"corridor","distance_m":1,"turn":true)", "\"yaw_rad\" is missing"},
                    Wrong{R"("order":"patrol","rounds":1)", "\"places\" is missing"},
                    Wrong{R"("order":"patrol","rounds":1,"places":[])", "places: expected 1 to 12"},
                    Wrong{R"("order":"patrol","rounds":1,"places":{})", "places: expected 1 to 12"},
                    Wrong{R"("order":"patrol","rounds":1,"places":[1])", "places: expected objects"},
                    Wrong{R"("order":"patrol","rounds":1,"places":[{"x_m":1,"y_m":2,"yaw_rad":0,"z_m":1}])",
                          "\"z_m\" is not known"},
                    Wrong{R"("order":"patrol","rounds":-1,"places":[{"x_m":1,"y_m":2,"yaw_rad":0}])",
                          "rounds: expected a whole number from 0"}));

}  // namespace
}  // namespace priamos::console
