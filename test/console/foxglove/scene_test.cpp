#include "console/foxglove/scene.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "bus/schema/text_codec.hpp"
#include "console/foxglove/scene_schemas.hpp"

namespace priamos::console {
namespace {

using Json = Scene::Json;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Time kNow = FromUtime(1'000'000'500'000);

Json Pose() {
  return {{"utime", 1'000'000'000'000}, {"x_m", 2.0},       {"y_m", 1.0},    {"yaw_rad", M_PI / 2},
          {"sigma_x_m", 0.1},           {"sigma_y_m", 0.2}, {"rho_x_y", 0.0}};
}
Json Model() {
  return {{"landmark_id", 5},
          {"x_m", 4.0},
          {"y_m", 3.0},
          {"yaw_rad", 0.0},
          {"edges", {{{"x1_m", 0}, {"y1_m", 0.45}, {"z1_m", 0}, {"x2_m", 0}, {"y2_m", 0.45}, {"z2_m", 2}}}}};
}
Json Fix(int verdict) {
  return {{"landmark_id", 5}, {"verdict", verdict}, {"x_m", 3.0}, {"y_m", 0.1}, {"yaw_rad", 0.02}};
}

/// Whether `value` has the shape that a JSON schema describes: the same keys, of the same types.
void ExpectFits(const Json& value, const Json& schema, const std::string& where) {
  const std::string type = schema["type"];
  if (type == "object") {
    ASSERT_TRUE(value.is_object()) << where;
    if (!schema.contains("properties")) return;
    for (const auto& [key, item] : value.items()) {
      ASSERT_TRUE(schema["properties"].contains(key)) << where << "." << key;
      ExpectFits(item, schema["properties"][key], where + "." + key);
    }
    for (const auto& [key, item] : schema["properties"].items())
      EXPECT_TRUE(value.contains(key)) << where << "." << key;
  } else if (type == "array") {
    ASSERT_TRUE(value.is_array()) << where;
    for (const Json& item : value) ExpectFits(item, schema["items"], where + "[]");
  } else {
    EXPECT_TRUE(type == "number"    ? value.is_number()
                : type == "integer" ? value.is_number_integer()
                : type == "boolean" ? value.is_boolean()
                                    : value.is_string())
        << where << ": " << value;
  }
}

void ExpectFits(const std::vector<Scene::Message>& messages) {
  ASSERT_FALSE(messages.empty());
  for (const Scene::Message& message : messages)
    ExpectFits(message.json, Json::parse(SceneSchema(Scene::SchemaOf(message.topic))),
               std::string(message.topic));
}

TEST(Scene, APoseIsATransformAndABodyWithItsUncertainty) {
  Scene dut{{}};
  const auto messages = dut.Hear("POSE", Pose(), kNow);
  ExpectFits(messages);
  ASSERT_EQ(messages.size(), 2u);
  const Json& transform = messages[0].json;
  EXPECT_EQ(messages[0].time, FromUtime(1'000'000'000'000)) << "that of the estimate, not of its arrival";
  EXPECT_EQ(transform["timestamp"], (Json{{"sec", 1'000'000}, {"nsec", 0}}));
  EXPECT_EQ(transform["parent_frame_id"], "map");
  EXPECT_EQ(transform["child_frame_id"], "base");
  EXPECT_EQ(transform["translation"]["x"], 2.0);
  EXPECT_NEAR(transform["rotation"]["z"], std::sqrt(0.5), 1e-12);
  const Json& entities = messages[1].json["entities"];
  EXPECT_EQ(entities[0]["frame_id"], "base");
  EXPECT_EQ(entities[0]["frame_locked"], true);
  double right = 0, left = 0;
  for (const Json& point : entities[1]["lines"][0]["points"]) {
    right = std::max(right, point["x"].get<double>());
    left = std::max(left, point["y"].get<double>());
  }
  EXPECT_NEAR(right, 2.3, 1e-6) << "three sigmas";
  EXPECT_NEAR(left, 1.6, 1e-2);
}

TEST(Scene, AnEchoIsAPointWhereItCameFrom) {
  Scene dut{{1.0, 0.8, 1.3}};
  Json ranges = Json::array();
  for (int i = 0; i < 24; ++i) ranges.push_back(i == 0 || i == 6 ? Json(1.0) : Json(-1.0));
  const auto messages = dut.Hear("SONAR_RANGES", {{"range_m", ranges}}, kNow);
  ExpectFits(messages);
  const Json& cloud = messages[0].json;
  EXPECT_EQ(cloud["point_stride"], 12);
  const auto bytes = bus::FromBase64(cloud["data"].get<std::string>());
  std::vector<float> values(bytes->size() / sizeof(float));
  std::memcpy(values.data(), bytes->data(), bytes->size());
  ASSERT_EQ(values.size(), 6u) << "no echo, no point";
  EXPECT_NEAR(values[0], 1.5, 1e-6);
  EXPECT_NEAR(values[4], 1.4, 1e-6);
  EXPECT_NEAR(values[5], 0.4, 1e-6);
}

TEST(Scene, ALandmarkStandsWhereItIsExpectedAndWhereItWasFound) {
  Scene dut{{}};
  EXPECT_THAT(dut.Hear("LANDMARK_FIX", Fix(0), kNow), IsEmpty()) << "of what shape?";
  const auto expected = dut.Hear("LANDMARK_MODEL", Model(), kNow);
  ExpectFits(expected);
  EXPECT_EQ(expected[0].json["entities"][0]["frame_id"], "map");
  const auto found = dut.Hear("LANDMARK_FIX", Fix(0), kNow);
  ExpectFits(found);
  const Json& entity = found[0].json["entities"][0];
  EXPECT_EQ(entity["frame_id"], "base");
  EXPECT_EQ(entity["frame_locked"], false) << "the robot drives on";
  EXPECT_EQ(entity["lines"][0]["pose"]["position"]["x"], 3.0);
  EXPECT_EQ(entity["lines"][0]["points"].size(), 2u);
  EXPECT_THAT(dut.Hear("LANDMARK_FIX", Fix(5), kNow), IsEmpty()) << "not found";
}

TEST(Scene, PathViewAndObstaclesAreDrawn) {
  Scene dut{{}};
  const auto path =
      dut.Hear("PATH", {{"path_id", 1}, {"points", {{{"x_m", 1}, {"y_m", 2}, {"yaw_rad", 0}}}}}, kNow);
  ExpectFits(path);
  const auto halt = dut.Hear("PATH", {{"path_id", 2}, {"points", Json::array()}}, kNow);
  EXPECT_THAT(halt[0].json["entities"][0]["lines"], IsEmpty()) << "takes the one before away";
  const auto view = dut.Hear("LANDMARK_VIEW",
                             {{"edges",
                               {{{"kind", 1}, {"u1_px", 1}, {"v1_px", 2}, {"u2_px", 3}, {"v2_px", 4}},
                                {{"kind", 9}, {"u1_px", 1}, {"v1_px", 2}, {"u2_px", 3}, {"v2_px", 4}}}}},
                             kNow);
  ExpectFits(view);
  EXPECT_EQ(view[0].json["points"][1]["points"].size(), 2u);
  ExpectFits(dut.Hear(
      "OBSTACLE_LINE",
      {{"segments", {{{"x1_m", 1}, {"y1_m", 0}, {"x2_m", 1}, {"y2_m", 1}, {"height_m", 0.2}}}}}, kNow));
}

TEST(Scene, ThePlanIsDrawnOnce) {
  GroundPlan plan;
  plan.walls.resize(2);
  plan.walls[0].to_m = {3, 0};
  plan.doors.resize(1);
  plan.cupboards.resize(1);
  const auto dut = Scene::Plan(plan, kNow);
  ExpectFits({dut});
  const Json& entity = dut.json["entities"][0];
  EXPECT_EQ(entity["cubes"].size(), 3u);
  EXPECT_EQ(entity["cubes"][0]["pose"]["position"]["x"], 1.5);
  EXPECT_EQ(entity["texts"].size(), 1u);
}

TEST(Scene, AForeignMessageUnderOneOfOurNamesGivesNothing) {
  Scene dut{{}};
  for (const char* channel : {"POSE", "PATH", "SONAR_RANGES", "LANDMARK_MODEL", "LANDMARK_FIX",
                              "LANDMARK_VIEW", "OBSTACLE_LINE", "X"})
    for (const Json& message :
         {Json(), Json(3), Json::array(), Json::object(), Json{{"x_m", "NaN"}}, Json{{"range_m", {1, 2}}}})
      EXPECT_THAT(dut.Hear(channel, message, kNow), IsEmpty()) << channel << message;
  Json huge = Model();
  huge["landmark_id"] = 1e300;
  EXPECT_THAT(dut.Hear("LANDMARK_MODEL", huge, kNow), IsEmpty());
}

}  // namespace
}  // namespace priamos::console
