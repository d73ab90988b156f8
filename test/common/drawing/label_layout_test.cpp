#include "common/drawing/label_layout.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace priamos::drawing {
namespace {

constexpr Box kPage{0, 0, 400, 300};

LabelWish WishAt(double x, double y) {
  return {.at = {x, y}, .width = 60, .height = 12, .distance = 5};
}

TEST(LabelLayout, ALabelStandsBesideItsPoint) {
  const auto dut = PlaceLabels({WishAt(200, 150)}, {kPage, {}, {}});
  ASSERT_TRUE(dut[0]);
  EXPECT_FALSE(dut[0]->Grown(4).Holds(Eigen::Vector2d(200, 150)));
  EXPECT_TRUE(dut[0]->Grown(8).Holds(Eigen::Vector2d(200, 150)));
}

TEST(LabelLayout, ACentredLabelStandsOnItsPoint) {
  LabelWish wish = WishAt(200, 150);
  wish.centred = true;
  const auto dut = PlaceLabels({wish}, {kPage, {}, {}});
  ASSERT_TRUE(dut[0]);
  EXPECT_DOUBLE_EQ(dut[0]->middle().x(), 200);
  EXPECT_DOUBLE_EQ(dut[0]->middle().y(), 150);
}

TEST(LabelLayout, TheFirstWishStandsNearest) {
  const auto dut = PlaceLabels(std::vector<LabelWish>(30, WishAt(200, 150)), {kPage, {}, {}});
  const auto distance = [&](std::size_t i) { return (dut[i]->middle() - Eigen::Vector2d(200, 150)).norm(); };
  ASSERT_TRUE(dut[0] && dut[29]);
  EXPECT_LT(distance(0), distance(29));
}

TEST(LabelLayout, LinesAreCoveredOnlyWhereNothingElseIsLeft) {
  Surroundings around{kPage, {}, {}};
  for (int x = 0; x < 400; x += 8) around.lines.emplace_back(x, 140);
  const auto dut = PlaceLabels({WishAt(200, 145)}, around);
  ASSERT_TRUE(dut[0]);
  for (const auto& point : around.lines) EXPECT_FALSE(dut[0]->Holds(point));
}

TEST(LabelLayout, WhatFitsNowhereHasNoPlace) {
  LabelWish wide = WishAt(200, 150);
  wide.width = 401;
  const auto dut = PlaceLabels({wide, WishAt(200, 150)}, {kPage, {}, {}});
  EXPECT_FALSE(dut[0]);
  EXPECT_TRUE(dut[1]);
  EXPECT_FALSE(PlaceLabels({WishAt(200, 150)}, {kPage, {kPage}, {}})[0]);
  EXPECT_FALSE(PlaceLabels({WishAt(NAN, 150)}, {kPage, {}, {}})[0]);
}

/// Whatever is wished: no label leaves the page, covers what is taken, or another label.
TEST(LabelLayout, LabelsNeitherOverlapNorLeaveThePage) {
  EXPECT_TRUE(rc::check([] {
    const auto number = [](int low, int high) { return static_cast<double>(*rc::gen::inRange(low, high)); };
    std::vector<LabelWish> wishes;
    Surroundings around{kPage, {}, {}};
    for (int i = *rc::gen::inRange(0, 25); i > 0; --i)
      wishes.push_back({.at = {number(-50, 450), number(-50, 350)},
                        .width = number(1, 150),
                        .height = number(1, 30),
                        .distance = number(0, 20),
                        .centred = *rc::gen::arbitrary<bool>()});
    for (int i = *rc::gen::inRange(0, 6); i > 0; --i)
      around.taken.push_back({number(0, 400), number(0, 300), number(1, 120), number(1, 90)});
    for (int i = *rc::gen::inRange(0, 40); i > 0; --i)
      around.lines.emplace_back(number(0, 400), number(0, 300));
    const auto places = PlaceLabels(wishes, around);
    RC_ASSERT(places.size() == wishes.size());
    auto covered = around.taken;
    for (const auto& place : places) {
      if (!place) continue;
      RC_ASSERT(kPage.Holds(*place));
      for (const Box& box : covered) RC_ASSERT(!box.Overlaps(*place));
      covered.push_back(*place);
    }
  }));
}

}  // namespace
}  // namespace priamos::drawing
