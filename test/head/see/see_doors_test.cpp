#include "head/see/see_doors.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/geometry.hpp"
#include "test/support/drawn_shapes.hpp"
#include "test/support/thrown_reason.hpp"

namespace priamos::head {
namespace {

/// The cameras as a base frame on the floor sees them.
std::vector<CameraModel> Standing(std::vector<CameraModel> cameras, const std::vector<double>& stand) {
  for (CameraModel& camera : cameras) camera = OnTheFloor(camera, StandFrom(stand));
  return cameras;
}

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::ElementsAre;

constexpr double kFocal_px = 500, kBaseline_m = 0.2;
constexpr int kWidth = 640, kHeight = 480;
const Vector2d kMiddle(320, 240);

/// Rectified: the second one stands to the right of the first, which is the origin.
std::vector<CameraModel> Pair() {
  std::vector<CameraModel> cameras(2);
  for (int i = 0; i < 2; ++i) {
    cameras[i].image_from_base << kFocal_px, 0, kMiddle.x(), -kFocal_px * kBaseline_m * i, 0, kFocal_px,
        kMiddle.y(), 0, 0, 0, 1, 0;
  }
  return cameras;
}

DetectedDoor Door() {
  DetectedDoor door;
  door.base_from_door = {3, 0.4, Radians(20)};
  door.covariance << 0.0009, 0.0001, 0.0001, 0.0016;
  door.width_m = 0.9;
  door.height_m = 2.0;
  door.on_floor = true;
  door.log_odds = 12.5;
  return door;
}

TEST(StandFrom, AnUprightCameraLooksAheadFromItsHeight) {
  const auto dut = Standing(Pair(), {1.2});
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_LT((dut[0].Project({5, 0, 1.2}) - kMiddle).norm(), 1e-9);
  EXPECT_NEAR(dut[0].Depth({5, 0.3, 0.7}), 5, 1e-9);
  // A metre to the left and a metre up, five metres ahead.
  EXPECT_LT((dut[0].Project({5, 1, 2.2}) - (kMiddle + Vector2d(-100, -100))).norm(), 1e-9);
}

TEST(StandFrom, TheSecondCameraKeepsItsPlaceBesideTheFirst) {
  const auto dut = Standing(Pair(), {1.2, 10, 5});
  // Its optical centre is where the first one's x axis leads.
  const Vector3d first = -dut[0].image_from_base.leftCols<3>().inverse() * dut[0].image_from_base.col(3),
                 second = -dut[1].image_from_base.leftCols<3>().inverse() * dut[1].image_from_base.col(3);
  EXPECT_LT((first - Vector3d(0, 0, 1.2)).norm(), 1e-9);
  EXPECT_NEAR((second - first).norm(), kBaseline_m, 1e-9);
  EXPECT_LT(second.y(), 0) << "to the right";
  EXPECT_LT(second.z(), 1.2) << "and lower, as the right side is down";
}

TEST(StandFrom, ATiltedCameraLooksDown) {
  const auto dut = Standing(Pair(), {1.2, 30});
  // The line of sight meets the floor at height / tan(tilt).
  EXPECT_LT((dut[0].Project({1.2 / std::tan(Radians(30)), 0, 0}) - kMiddle).norm(), 1e-9);
}

TEST(StandFrom, ARolledCameraHasItsRightSideDown) {
  const auto dut = Standing(Pair(), {1.2, 0, 10});
  const double side = 2 * std::cos(Radians(10)), down = 2 * std::sin(Radians(10));
  // Two metres along the camera's own x axis, five metres ahead.
  EXPECT_LT((dut[0].Project({5, -side, 1.2 - down}) - (kMiddle + Vector2d(200, 0))).norm(), 1e-9);
}

TEST(StandFrom, WhatIsNoStandIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& stand : {std::vector<double>{},
                                           {0.0},
                                           {-1.0},
                                           {1000.0},
                                           {nan},
                                           {1.2, nan},
                                           {1.2, 0, INFINITY},
                                           {1.2, 0, 0, 0}})
    EXPECT_THAT(
        support::ThrownReason([&] { StandFrom(stand); }),
        testing::StartsWith("--stand: expected the height of the left camera above the floor, 0.1 to 10 m"))
        << stand.size();
  EXPECT_THAT(support::ThrownReason([] { StandFrom({1000, -5}); }), testing::EndsWith("got 1000 -5"));
}

TEST(DoorsToJson, TellsPlaceSizeAndHowSureItIs) {
  const auto dut = DoorsToJson(std::vector{Door()});
  ASSERT_EQ(dut.size(), 1u);
  EXPECT_EQ(dut[0]["middle_m"], nlohmann::ordered_json({3, 0.4}));
  EXPECT_NEAR(dut[0]["yaw_deg"].get<double>(), 20, 1e-9);
  EXPECT_EQ(dut[0]["width_m"], 0.9);
  EXPECT_EQ(dut[0]["height_m"], 2.0);
  EXPECT_EQ(dut[0]["on_floor"], true);
  EXPECT_EQ(dut[0]["log_odds"], 12.5);
  EXPECT_NEAR(dut[0]["sigma_m"][0].get<double>(), 0.03, 1e-12);
  EXPECT_NEAR(dut[0]["sigma_m"][1].get<double>(), 0.04, 1e-12);
}

TEST(DoorsToJson, AVarianceBelowZeroIsRounding) {
  DetectedDoor door = Door();
  door.covariance(0, 0) = -1e-18;
  EXPECT_EQ(DoorsToJson(std::vector{door})[0]["sigma_m"][0], 0);
}

TEST(DoorsToJson, NoDoorsAreAnEmptyList) {
  EXPECT_EQ(DoorsToJson({}).dump(), "[]");
}

class DrawDoorsTest : public testing::Test {
 protected:
  DrawDoorsTest() {
    for (int c = 0; c < 2; ++c) {
      edges_[c].width = kWidth;
      edges_[c].height = kHeight;
      edges_[c].segments.resize(c + 1);
      for (EdgeSegment& s : edges_[c].segments) {
        s.begin = {10, 20};
        s.end = {10, 120};
      }
    }
    for (int c = 0; c < 2; ++c)
      views_.push_back({.camera = &cameras_[c], .edges = &edges_[c], .size = {}, .lines = {}, .points = {}});
  }
  SeePage Draw(const std::vector<DetectedDoor>& doors) const { return DrawDoors(greys_, views_, doors); }

  const std::vector<CameraModel> cameras_ = Standing(Pair(), {1.2});
  std::array<EdgeImage, 2> edges_;
  std::vector<CameraView> views_;
  const std::vector<cv::Mat> greys_{2, cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(100))};
};

TEST_F(DrawDoorsTest, PostsAndLintelLieWhereEitherCameraSeesThem) {
  const SeePage dut = Draw({Door()});
  const auto lines = support::LinesOn(dut.drawing(), "door", kHeight);
  ASSERT_EQ(lines.size(), 6u);
  for (int c = 0; c < 2; ++c) {
    const auto on_page = [&](double side, double z) -> Vector2d {
      const Vector2d at = Door().base_from_door * Vector2d(0, side * 0.45);
      return cameras_[c].Project({at.x(), at.y(), z}) + Vector2d(c * kWidth + 0.5, 0.5);
    };
    const auto *post = &lines[3 * c], *lintel = post + 1, *other = post + 2;
    EXPECT_LT((post->points[0] - on_page(1, 0)).norm(), 1e-6);
    EXPECT_LT((post->points[1] - on_page(1, 2.0)).norm(), 1e-6);
    EXPECT_LT((lintel->points[0] - on_page(1, 2.0)).norm(), 1e-6);
    EXPECT_LT((lintel->points[1] - on_page(-1, 2.0)).norm(), 1e-6);
    EXPECT_LT((other->points[0] - on_page(-1, 2.0)).norm(), 1e-6);
    EXPECT_LT((other->points[1] - on_page(-1, 0)).norm(), 1e-6);
  }
}

TEST_F(DrawDoorsTest, DoorsAreNumberedFromOneInEveryImage) {
  DetectedDoor other = Door();
  other.base_from_door.y = -0.8;
  const SeePage dut = Draw({Door(), other});
  std::vector<std::string> labels;
  for (const auto& text : support::FormsOn<drawing::Text>(dut.drawing(), "label", kHeight))
    labels.push_back(text.text);
  EXPECT_THAT(labels, testing::UnorderedElementsAre("1", "2", "1", "2"));
}

TEST_F(DrawDoorsTest, EdgesAreDrawnWithOrWithoutDoors) {
  const SeePage dut = Draw({});
  EXPECT_EQ(support::LinesOn(dut.drawing(), "edge", kHeight).size(), 3u);
  EXPECT_THAT(support::MeaningsIn(dut.drawing()), ElementsAre("edge"));
  EXPECT_THAT(support::MeaningsIn(Draw({Door()}).drawing()), ElementsAre("edge", "door: posts and lintel"));
}

}  // namespace
}  // namespace priamos::head
