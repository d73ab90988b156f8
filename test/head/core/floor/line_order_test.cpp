#include "head/core/floor/line_order.hpp"

#include <gtest/gtest.h>

#include "common/geometry.hpp"
#include "test/support/laser_floor.hpp"

namespace priamos::head {
namespace {

class LineOrderTest : public testing::Test {
 protected:
  std::vector<ExpectedLine> Expect(double tilt_deg) const {
    return ExpectLines(support::ThirdCamera(Radians(tilt_deg)), scene_.lasers, {}, {});
  }
  static StripePoint At(int column, double row) { return {{column, row}, 100, 0.1, 100}; }

  const support::LaserFloor scene_ = support::NominalLaserPair();
};

TEST_F(LineOrderTest, TheFarLineIsExpectedAboveTheNearOne) {
  const auto dut = Expect(31);
  ASSERT_EQ(dut.size(), 2U);
  EXPECT_EQ(dut[0].laser, 1U);
  EXPECT_EQ(dut[1].laser, 0U);
  EXPECT_EQ(dut[0].columns, 768);
  EXPECT_LT(*dut[0].row[384], *dut[1].row[384] - 100);
}

TEST_F(LineOrderTest, ALineThatIsNotInThePictureIsNotExpected) {
  const auto dut = Expect(12);
  ASSERT_EQ(dut.size(), 1U);
  EXPECT_EQ(dut[0].laser, 1U);
  EXPECT_TRUE(Expect(-5).empty());
}

TEST_F(LineOrderTest, TwoRidgesAreToldApartByTheirOrderHoweverFarTheyAreOff) {
  const auto lines = Expect(31);
  const double far = *lines[0].row[100], near = *lines[1].row[100];
  const std::vector<StripePoint> ridges = {At(100, far + 80), At(100, near + 60)};
  const auto dut = TellApart(ridges, lines);
  ASSERT_EQ(dut[0].size(), 1U);
  EXPECT_EQ(dut[0][0].at.y(), far + 80) << "nearer to where the other is expected";
  ASSERT_EQ(dut[1].size(), 1U);
  EXPECT_EQ(dut[1][0].at.y(), near + 60);
}

TEST_F(LineOrderTest, OneRidgeIsThatOfTheLineItIsNearerTo) {
  const auto lines = Expect(31);
  const std::vector<StripePoint> ridges = {At(100, *lines[0].row[100] + 5), At(200, *lines[1].row[200] - 9)};
  const auto dut = TellApart(ridges, lines);
  ASSERT_EQ(dut[0].size(), 1U);
  EXPECT_EQ(dut[0][0].at.x(), 100);
  ASSERT_EQ(dut[1].size(), 1U);
  EXPECT_EQ(dut[1][0].at.x(), 200);
}

TEST_F(LineOrderTest, ARidgeWhereNoLineCanBeBelongsToNone) {
  const auto lines = Expect(31);
  const std::vector<StripePoint> ridges = {At(100, lines[0].rows.first - 5.0), At(100, *lines[0].row[100])};
  const auto dut = TellApart(ridges, lines);
  ASSERT_EQ(dut[0].size(), 1U);
  EXPECT_EQ(dut[0][0].at.y(), *lines[0].row[100]);
  EXPECT_TRUE(dut[1].empty());
}

}  // namespace
}  // namespace priamos::head
