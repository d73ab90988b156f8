#include "world/core/scene/occupancy_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <functional>

#include "world/core/scene/outline.hpp"

namespace priamos::world {
namespace {

using testing::HasSubstr;

constexpr const char* kYaml =
    "image: hall.pgm\nresolution: 0.1\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

GridHeader Header() {
  return ParseGridHeader("hall.yaml", kYaml);
}

/// Four by three cells: a wall along the upper row, one cell at the lower right.
OccupancyGrid Hall() {
  return ParseGrid(Header(), "hall.pgm", "P2\n# a hall\n4 3\n255\n0 0 0 0\n205 254 254 254\n254 254 254 0\n");
}

std::string ErrorOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(GridHeaderTest, ReadsWhatMapServerWrites) {
  const GridHeader dut = Header();
  EXPECT_EQ(dut.image, "hall.pgm");
  EXPECT_EQ(dut.resolution_m, 0.1);
  EXPECT_EQ(dut.map_from_grid.x, -1);
  EXPECT_EQ(dut.map_from_grid.y, 2);
}

TEST(GridHeaderTest, WrongOnesAreAnsweredWithTheLine) {
  const auto answer = [](const std::string& text) {
    return ErrorOf([&] { ParseGridHeader("m.yaml", text); });
  };
  EXPECT_THAT(answer("image: a\nresolution: big\n"),
              HasSubstr("m.yaml:2: resolution: expected a number of 0.005"));
  EXPECT_THAT(answer("image: a\norigin: [1, 2]\n"),
              HasSubstr("m.yaml:2: origin: expected [x, y, yaw], got \"[1, 2]\""));
  EXPECT_THAT(answer("image: a\nwalls: 3\n"), HasSubstr("m.yaml:2: walls: expected no key but"));
  EXPECT_THAT(answer("image: a\nnonsense\n"), HasSubstr("m.yaml:2: nonsense: expected `key: value`"));
  EXPECT_THAT(answer("resolution: 0.1\n"), HasSubstr("m.yaml: image: expected the name"));
  EXPECT_THAT(answer("image: a\n"), HasSubstr("m.yaml: resolution: expected metres"));
  EXPECT_THAT(answer("image: a\nimage: b\n"), HasSubstr("m.yaml:2: image: expected each key once"));
  EXPECT_THAT(answer("image: a\nmode: raw\n"), HasSubstr("m.yaml:2: mode: expected trinary"));
}

TEST(OccupancyGridTest, TheFirstRowOfThePictureIsTheUppermost) {
  const OccupancyGrid dut = Hall();
  EXPECT_TRUE(dut.At(0, 2));
  EXPECT_TRUE(dut.At(3, 0));
  EXPECT_FALSE(dut.At(0, 1)) << "unknown is not occupied";
  EXPECT_FALSE(dut.At(0, 0));
}

TEST(OccupancyGridTest, BytesAreReadAsTextIs) {
  const std::string pixels("\x00\xFE\xFE\x00", 4);
  const OccupancyGrid dut = ParseGrid(Header(), "a.pgm", "P5\n2 2\n255\n" + pixels);
  EXPECT_TRUE(dut.At(0, 1));
  EXPECT_TRUE(dut.At(1, 0));
  EXPECT_FALSE(dut.At(1, 1));
}

TEST(OccupancyGridTest, DamagedPicturesAreRefused) {
  const auto answer = [](const std::string& pgm) {
    return ErrorOf([&] { ParseGrid(Header(), "a.pgm", pgm); });
  };
  EXPECT_THAT(answer("P6\n1 1\n255\nxxx"), HasSubstr("a.pgm: byte 2: expected a grey PGM"));
  EXPECT_THAT(answer("P5\n2 2\n255\nabc"), HasSubstr("4 bytes of pixels, got 3"));
  EXPECT_THAT(answer("P5\n99999 2\n255\n"), HasSubstr("a width of 1 to 8192"));
  EXPECT_THAT(answer("P2\n1 1\n255\n256\n"), HasSubstr("a grey level of 0 to 255"));
  EXPECT_THAT(answer(""), HasSubstr("a grey PGM"));
}

TEST(GridSolidsTest, AStraightWallIsOneSolidWhereTheMapHasIt) {
  GridPlan plan;
  const auto dut = GridSolids(Hall(), plan, {0, 2}, 2.5);
  ASSERT_EQ(dut.size(), 2u);
  EXPECT_NEAR(dut[0].map_from_solid.x, -1 + 0.35, 1e-9);
  EXPECT_NEAR(dut[0].map_from_solid.y, 2.05, 1e-9);
  EXPECT_NEAR(dut[1].map_from_solid.x, -0.8, 1e-9);
  EXPECT_NEAR(dut[1].map_from_solid.y, 2.25, 1e-9);
  EXPECT_NEAR(dut[1].size_m.x(), 0.4, 1e-9);
  EXPECT_EQ(dut[1].z_max_m, 2.5);
}

TEST(GridSolidsTest, WhatIsFarFromTheStartIsLeftOut) {
  GridPlan plan;
  plan.reach_m = 1;
  EXPECT_TRUE(GridSolids(Hall(), plan, {50, 2}, 2.5).empty());
}

RC_GTEST_PROP(GridSolidsTest, TheSolidsCoverTheOccupiedCellsAndNoOthersOnce, ()) {
  OccupancyGrid grid{Header(), *rc::gen::inRange(1, 12), *rc::gen::inRange(1, 12), {}};
  for (int i = 0; i < grid.width * grid.height; ++i) grid.occupied.push_back(*rc::gen::arbitrary<bool>());
  const auto solids = GridSolids(grid, GridPlan{}, {0, 2}, 2.5);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      const Eigen::Vector2d middle =
          grid.header.map_from_grid * Eigen::Vector2d((x + 0.5) * 0.1, (y + 0.5) * 0.1);
      int covers = 0;
      for (const Solid& solid : solids) covers += Distance(OutlineOf(solid), middle) == 0;
      RC_ASSERT(covers == (grid.At(x, y) ? 1 : 0));
    }
}

}  // namespace
}  // namespace priamos::world
