#include "robot/core/near_map.hpp"

#include <gmock/gmock.h>

namespace priamos::robot {
namespace {

using std::chrono::milliseconds;
using testing::IsEmpty;
using testing::SizeIs;

constexpr Time kStart = FromUtime(1'000'000'000);

class NearMapTest : public testing::Test {
 protected:
  NearMap dut_{NearMapConfig{}};
};

TEST_F(NearMapTest, KeepsAThingWhereItIsWhileTheBaseMoves) {
  dut_.Add({0.475, 0, 0}, 0.3, kStart);
  const auto points = dut_.Points({0.2, 0, kPi / 2});
  ASSERT_THAT(points, SizeIs(1));
  EXPECT_NEAR(points[0].x(), 0, 1e-9);
  EXPECT_NEAR(points[0].y(), -0.575, 1e-9);
}

TEST_F(NearMapTest, KeepsNothingThatIsFarAway) {
  dut_.Add({0.475, 0, 0}, 0.8, kStart);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(NearMapTest, TheSamePlaceIsKeptOnce) {
  for (int i = 0; i < 10; ++i) dut_.Add({0.475, 0, 0}, 0.3 + 0.0005 * i, kStart);
  EXPECT_THAT(dut_.Points({}), SizeIs(1));
}

TEST_F(NearMapTest, ABeamThatSeesOnBehindAThingClearsIt) {
  dut_.Add({0.475, 0, 0}, 0.3, kStart);
  dut_.Clear({0.475, 0, 0}, 0.4);
  EXPECT_THAT(dut_.Points({}), SizeIs(1)) << "that may be the thing itself";
  dut_.Clear({0.475, 0.2, 0}, 2.0);
  EXPECT_THAT(dut_.Points({}), SizeIs(1)) << "that beam passes beside it";
  dut_.Clear({0.475, 0, 0}, 2.0);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

TEST_F(NearMapTest, ForgetsWhatIsOldOrFarAway) {
  dut_.Add({0.475, 0, 0}, 0.3, kStart);
  dut_.Forget({}, kStart + milliseconds(4900));
  EXPECT_THAT(dut_.Points({}), SizeIs(1));
  dut_.Forget({}, kStart + milliseconds(5100));
  EXPECT_THAT(dut_.Points({}), IsEmpty());
  dut_.Add({0.475, 0, 0}, 0.3, kStart);
  dut_.Forget({-2, 0, 0}, kStart);
  EXPECT_THAT(dut_.Points({}), IsEmpty());
}

}  // namespace
}  // namespace priamos::robot
