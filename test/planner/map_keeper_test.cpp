#include "planner/map_keeper.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "common/config.hpp"
#include "test/support/temporary_folder.hpp"
#include "test/support/thrown_reason.hpp"
#include "workstation.hpp"

namespace priamos::planner {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

feature_t Wall(int id, double x_m = 3) {
  feature_t wall{};
  wall.id = static_cast<std::int16_t>(id);
  wall.utime_seen = 1'000'000'000;
  wall.x_m = x_m;
  wall.y_m = 2.4;
  wall.yaw_rad = 1.5;
  wall.length_m = 1.5;
  wall.sigma_across_m = 0.02;
  wall.sigma_yaw_rad = 0.01;
  wall.sigma_end_m = 0.1;
  return wall;
}

features_t Batch(int store, int batch, std::vector<feature_t> walls) {
  features_t message{};
  message.store = store;
  message.batch = static_cast<std::int16_t>(batch);
  message.n_features = static_cast<std::int8_t>(walls.size());
  message.features = std::move(walls);
  return message;
}

TEST(FeatureMessage, AWallIsWhatItSays) {
  const auto seen = FromMessage(9, Wall(4));
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->name(), FeatureName(9, 4));
  const LearnedWall* dut = seen->wall();
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->yaw_deg, Degrees(1.5), 1e-9);
  EXPECT_EQ(dut->length_m, 1.5);
  EXPECT_EQ(dut->seen_s, 1000);
}

TEST(FeatureMessage, APointIsOneWithoutLength) {
  feature_t message = Wall(4);
  message.kind = feature_t::POINT;
  message.length_m = 0;
  const auto seen = FromMessage(9, message);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->name(), FeatureName(9, 4));
  const LearnedPoint* dut = seen->point();
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->at(), Eigen::Vector2d(message.x_m, message.y_m));
  EXPECT_EQ(dut->sigma_m, message.sigma_across_m);
  EXPECT_EQ(seen->own_sigma_m, message.sigma_end_m);
  EXPECT_EQ(seen->towards_rad, message.yaw_rad - kPi / 2) << "a point is told as a wall that faces the base";
  message.x_m = 1e9;
  EXPECT_FALSE(FromMessage(9, message));
}

TEST(FeatureMessage, WhatHasGoneHasNoKindAndNeedsNoLength) {
  feature_t message = Wall(4);
  message.kind = feature_t::GONE;
  ASSERT_TRUE(FromMessage(9, message));
  EXPECT_TRUE(FromMessage(9, message)->gone());
  message.length_m = 0;
  ASSERT_TRUE(FromMessage(9, message)) << "it was a point";
  EXPECT_EQ(FromMessage(9, message)->name(), FeatureName(9, 4));
}

TEST(FeatureMessage, NumbersOutOfRangeAreNoWall) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const auto& damage) {
    feature_t wall = Wall(4);
    damage(wall);
    return !FromMessage(9, wall);
  };
  EXPECT_TRUE(refused([](feature_t& w) { w.x_m = kNaN; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.y_m = 1e9; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.yaw_rad = kNaN; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.length_m = 0; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.sigma_across_m = -1; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.rho = 1.5; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.kind = 7; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.utime_seen = -1; }));
  EXPECT_TRUE(refused([](feature_t& w) { w.utime_seen = std::numeric_limits<std::int64_t>::max(); }));
  EXPECT_TRUE(refused([](feature_t& w) { w.id = -1; }));
  EXPECT_FALSE(FromMessage(0, Wall(4)));
}

door_found_t Door(double x_m = 6) {
  door_found_t door{};
  door.utime_seen = 1'000'000'000;
  door.id = 2;
  door.x_m = x_m;
  door.y_m = 1.1;
  door.yaw_rad = 1.5;
  door.width_m = 0.9;
  door.sigma_along_m = 0.02;
  door.sigma_across_m = 0.01;
  door.state = door_found_t::AJAR;
  door.log_odds = 5;
  door.looks = 3;
  return door;
}

TEST(DoorMessage, ADoorIsWhatItSays) {
  const auto dut = FromMessage(Door());
  ASSERT_TRUE(dut);
  EXPECT_NEAR(dut->yaw_deg, Degrees(1.5), 1e-9);
  EXPECT_EQ(dut->state, "ajar");
  EXPECT_EQ(dut->seen_s, 1000);
  EXPECT_EQ(dut->looks, 3);
}

TEST(DoorMessage, NumbersOutOfRangeAreNoDoor) {
  const auto refused = [](const auto& damage) {
    door_found_t door = Door();
    damage(door);
    return !FromMessage(door);
  };
  EXPECT_TRUE(refused([](door_found_t& d) { d.x_m = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](door_found_t& d) { d.width_m = 0; }));
  EXPECT_TRUE(refused([](door_found_t& d) { d.state = 4; }));
  EXPECT_TRUE(refused([](door_found_t& d) { d.looks = 0; }));
  EXPECT_TRUE(refused([](door_found_t& d) { d.log_odds = -1; }));
  EXPECT_TRUE(refused([](door_found_t& d) { d.utime_seen = -1; }));
}

scene_object_t Thing(double x_m = 3) {
  scene_object_t thing{};
  thing.utime_seen = 1'000'000'000;
  thing.id = 2;
  thing.kind = scene_object_t::BOX;
  thing.x_m = x_m;
  thing.y_m = 2.4;
  thing.yaw_rad = 1.5;
  thing.width_m = 0.6;
  thing.depth_m = 0.4;
  thing.top_m = 1.1;
  thing.sigma_along_m = 0.02;
  thing.sigma_across_m = 0.01;
  thing.sigma_yaw_rad = 0.05;
  thing.looks = 3;
  return thing;
}

TEST(ObjectMessage, AThingIsWhatItSays) {
  const auto dut = FromMessage(Thing());
  ASSERT_TRUE(dut);
  EXPECT_EQ(dut->kind, "box");
  EXPECT_NEAR(dut->yaw_deg, Degrees(1.5), 1e-9);
  EXPECT_EQ(dut->width_m, 0.6);
  EXPECT_EQ(dut->depth_m, 0.4);
  EXPECT_EQ(dut->top_m, 1.1);
  EXPECT_NEAR(dut->sigma_yaw_deg, Degrees(0.05), 1e-9);
  EXPECT_EQ(dut->seen_s, 1000);
  EXPECT_EQ(dut->looks, 3);
  scene_object_t edge = Thing();
  edge.kind = scene_object_t::EDGE;
  edge.width_m = 0;
  ASSERT_TRUE(FromMessage(edge));
  EXPECT_EQ(FromMessage(edge)->kind, "edge");
  EXPECT_EQ(FromMessage(edge)->depth_m, 0);
}

TEST(ObjectMessage, NumbersOutOfRangeAreNoThing) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const auto& damage) {
    scene_object_t thing = Thing();
    damage(thing);
    return !FromMessage(thing);
  };
  EXPECT_TRUE(refused([](scene_object_t& t) { t.kind = 3; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.kind = -1; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.x_m = kNaN; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.y_m = -101; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.yaw_rad = 4; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.width_m = 0; })) << "a front without breadth";
  EXPECT_TRUE(refused([](scene_object_t& t) { t.width_m = 6; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.depth_m = -0.1; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.bottom_m = kNaN; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.bottom_m = 1.2; })) << "it would end below where it begins";
  EXPECT_TRUE(refused([](scene_object_t& t) { t.top_m = std::numeric_limits<double>::infinity(); }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.sigma_along_m = -0.1; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.sigma_across_m = 1; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.sigma_yaw_rad = kNaN; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.looks = -1; }));
  EXPECT_TRUE(refused([](scene_object_t& t) { t.utime_seen = -1; }));
}

TEST(BatchLog, SaysWhichOfTheLastEightCame) {
  BatchLog dut;
  EXPECT_EQ(dut.Note(7, 250).earlier, 0);
  EXPECT_EQ(dut.Note(7, 251).earlier, 0b1);
  const auto after_a_loss = dut.Note(7, 253);
  EXPECT_EQ(after_a_loss.batch, 253);
  EXPECT_EQ(after_a_loss.earlier, 0b110);
  const auto late = dut.Note(7, 252);
  EXPECT_EQ(late.batch, 253);
  EXPECT_EQ(late.earlier, 0b111);
  EXPECT_EQ(dut.Note(7, 1).earlier, 0b01111000 & 0xff) << "numbers go round";
  EXPECT_EQ(dut.Note(7, 100).earlier, 0);
  EXPECT_EQ(dut.Note(8, 3).store, 8) << "another robot, or the same after a restart";
  EXPECT_EQ(dut.Note(8, 4).earlier, 0b1);
}

class MapKeeperTest : public testing::Test {
 protected:
  void Begin(bool from_log = false) {
    PlannerConfig config;
    config.learned_map = file_;
    station_.emplace(config, MakeMissions, from_log);
    features_.emplace(station_->other.Advertise(channels::kFeatures));
    orders_.emplace(station_->other.Advertise(channels::kMapCommand));
    acks_.emplace(station_->other.SubscribeAll(channels::kFeaturesAck));
    station_->Run(2);
  }
  TemporaryFolder folder_;
  std::string file_ = (folder_ / "learned-map.toml").string();
  std::optional<Workstation> station_;
  std::optional<bus::Publisher<features_t>> features_;
  std::optional<bus::Publisher<map_command_t>> orders_;
  std::optional<bus::Inbox<features_ack_t>> acks_;
};

TEST_F(MapKeeperTest, WhatIsToldIsAcknowledgedAndWritten) {
  Begin();
  auto acks = acks_->Drain();
  ASSERT_THAT(acks, SizeIs(1));
  EXPECT_EQ(acks[0].store, 0) << "it begins with nothing, and wants all";
  features_->Publish(Batch(9, 5, {Wall(1), Wall(2, 4)}));
  station_->Run(2);
  acks = acks_->Drain();
  ASSERT_THAT(acks, SizeIs(1));
  EXPECT_EQ(acks[0].store, 9);
  EXPECT_EQ(acks[0].batch, 5);
  EXPECT_THAT(LoadLearnedWalls(file_).walls, SizeIs(2));
}

TEST_F(MapKeeperTest, APointThatHasGoneIsTakenOffTheFile) {
  Begin();
  feature_t point = Wall(3);
  point.kind = feature_t::POINT;
  point.length_m = 0;
  features_->Publish(Batch(9, 5, {point}));
  station_->Run(40);
  ASSERT_THAT(LoadLearnedWalls(file_).points, SizeIs(1));
  EXPECT_EQ(LoadLearnedWalls(file_).points[0].id, 1);
  point.kind = feature_t::GONE;
  features_->Publish(Batch(9, 6, {point}));
  station_->Run(400);
  EXPECT_THAT(LoadLearnedWalls(file_).points, IsEmpty());
}

TEST_F(MapKeeperTest, AnotherPlannerGoesOnWithIt) {
  Begin();
  features_->Publish(Batch(9, 5, {Wall(1)}));
  station_->Run(2);
  features_->Publish(Batch(9, 6, {Wall(2, 4)}));
  station_->Run(2);
  station_.reset();  // it was not time to write yet
  EXPECT_THAT(LoadLearnedWalls(file_).walls, SizeIs(2));
  Begin();
  EXPECT_THAT(acks_->Drain(), IsEmpty()) << "it has a map";
  features_->Publish(Batch(10, 1, {Wall(1)}));
  station_->Run(2);
  station_.reset();
  EXPECT_THAT(LoadLearnedWalls(file_).walls, SizeIs(2)) << "the same wall, found by another run";
}

TEST_F(MapKeeperTest, ALogOfAnotherDayLeavesTheMapOfTodayAsItIs) {
  Begin();
  features_->Publish(Batch(9, 5, {Wall(1)}));
  station_->Run(2);
  station_.reset();
  Begin(true);
  features_->Publish(Batch(8, 1, {Wall(2, 4)}));
  station_->Run(40);
  station_.reset();
  EXPECT_THAT(LoadLearnedWalls(file_).walls, SizeIs(1));
}

TEST_F(MapKeeperTest, DoorsAreWrittenAndForgottenWithTheRest) {
  Begin();
  auto doors = station_->other.Advertise(channels::kDoorFound);
  doors.Publish(Door());
  door_found_t damaged = Door(9);
  damaged.y_m = std::numeric_limits<double>::infinity();
  doors.Publish(damaged);
  station_->Run(40);
  const LearnedWalls map = LoadLearnedWalls(file_);
  ASSERT_THAT(map.doors, SizeIs(1));
  EXPECT_EQ(map.doors[0].state, "ajar");
  EXPECT_THAT(station_->log, testing::Contains(testing::HasSubstr("a door refused")));
  map_command_t order{};
  order.action = map_command_t::RESET;
  orders_->Publish(order);
  station_->Run(2);
  EXPECT_THAT(LoadLearnedWalls(file_).doors, IsEmpty());
}

TEST_F(MapKeeperTest, ThingsAreWrittenAndForgottenWithTheRest) {
  Begin();
  auto objects = station_->other.Advertise(channels::kSceneObject);
  objects.Publish(Thing());
  scene_object_t damaged = Thing(9);
  damaged.yaw_rad = std::numeric_limits<double>::infinity();
  objects.Publish(damaged);
  station_->Run(40);
  const LearnedWalls map = LoadLearnedWalls(file_);
  ASSERT_THAT(map.objects, SizeIs(1));
  EXPECT_EQ(map.objects[0].kind, "box");
  EXPECT_THAT(station_->log,
              testing::Contains(testing::HasSubstr("thing 2 of the head refused: numbers out of range")));
  map_command_t order{};
  order.action = map_command_t::RESET;
  orders_->Publish(order);
  station_->Run(2);
  EXPECT_THAT(LoadLearnedWalls(file_).objects, IsEmpty());
  EXPECT_THAT(station_->log, testing::Contains(testing::HasSubstr("0 walls, 0 points, 0 doors, 1 things")));
  objects.Publish(Thing());
  station_->Run(40);
  EXPECT_THAT(LoadLearnedWalls(file_).objects, IsEmpty()) << "it was seen before all was forgotten";
}

TEST_F(MapKeeperTest, ResetForgetsAtOnce) {
  Begin();
  features_->Publish(Batch(9, 5, {Wall(1)}));
  station_->Run(2);
  map_command_t order{};
  order.action = 3;
  orders_->Publish(order);
  station_->Run(2);
  EXPECT_THAT(LoadLearnedWalls(file_).walls, SizeIs(1)) << "no such order";
  order.action = map_command_t::RESET;
  orders_->Publish(order);
  station_->Run(2);
  EXPECT_THAT(LoadLearnedWalls(file_).walls, IsEmpty());
}

TEST_F(MapKeeperTest, ADamagedBatchIsNotAcknowledgedAndItsGoodWallsCount) {
  Begin();
  acks_->Drain();
  feature_t damaged = Wall(2);
  damaged.x_m = std::numeric_limits<double>::infinity();
  features_->Publish(Batch(9, 5, {Wall(1), damaged}));
  station_->Run(2);
  EXPECT_THAT(acks_->Drain(), IsEmpty());
  EXPECT_THAT(station_->log, testing::Contains(testing::HasSubstr("features refused")));
  station_.reset();
  EXPECT_THAT(LoadLearnedWalls(file_).walls, SizeIs(1));
}

TEST_F(MapKeeperTest, ADamagedFileStopsThePlannerWithItsLine) {
  std::ofstream(file_) << "version = 1\nrevision = -4\n";
  EXPECT_THAT(support::ThrownReason([this] { Begin(); }),
              testing::HasSubstr("learned-map.toml:2:revision: expected"));
}

TEST_F(MapKeeperTest, AFolderThatCannotBeWrittenIsToldOnce) {
  file_ = (folder_ / "missing" / "map.toml").string();
  Begin();
  for (int i = 0; i < 3; ++i) {
    features_->Publish(Batch(9, i, {Wall(i, i)}));
    station_->Run(200);
  }
  EXPECT_EQ(
      std::count_if(station_->log.begin(), station_->log.end(),
                    [](const std::string& line) { return line.find("is not kept") != std::string::npos; }),
      1);
}

}  // namespace
}  // namespace priamos::planner
